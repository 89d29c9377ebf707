#pragma once
// Agreement of ranks on an exception that a procedure of the caller threw.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <tuple>

#include "parallel/agreement.h"
#include "scvt/errors.h"

namespace pstripack::scvt {

/// Runs body(), which may call a density or another procedure of the caller, on every rank. Then the ranks
/// agree on how it ended and on the votes. All ranks throw the same: AgreedFailure if memory ran out; else
/// what the caller's procedure threw on the lowest rank, as a NoTessellation with its text; else BadDensity
/// at the place that is lexicographically first. A single rank throws what body() throws, but AgreedFailure
/// for std::bad_alloc. Collective.
template <class Body, class... Votes>
void in_agreement_with_caller(Communicator& ranks, const Body& body, Votes&... votes) {
  if (ranks.size() == 1) {
    try {
      return body();
    } catch (const std::bad_alloc&) {
      throw AgreedFailure(code_of(std::current_exception()));
    }
  }
  struct Complaint {
    bool is_of_density, is_width;
    Point place;
    double value, elsewhere;
    char text[1000];
  };
  std::optional<Complaint> mine;
  const auto complain = [&](const char* text) {
    mine = Complaint{};
    std::snprintf(mine->text, sizeof mine->text, "%s", text);
  };
  OnAny is_any;
  in_agreement(
      ranks,
      [&] {
        try {
          body();
        } catch (const BadDensity& e) {
          mine = Complaint{true, e.is_width, e.place, e.value, e.elsewhere, {}};
        } catch (const std::bad_alloc&) {
          throw;
        } catch (const std::exception& e) {
          complain(e.what());
        } catch (...) {
          complain("a procedure of the caller threw an exception");
        }
        is_any.value = mine.has_value();
      },
      is_any, votes...);
  if (!is_any.value) return;
  const Parcels all = ranks.all_gather(mine ? &*mine : nullptr, mine ? sizeof(Complaint) : 0);
  const Items<Complaint> complaints(all);
  const Complaint& first =
      *std::min_element(complaints.begin(), complaints.end(), [](const Complaint& a, const Complaint& b) {
        return std::tie(a.is_of_density, a.place.x, a.place.y, a.place.z) <
               std::tie(b.is_of_density, b.place.x, b.place.y, b.place.z);
      });
  if (first.is_of_density) throw BadDensity(first.place, first.value, first.elsewhere, first.is_width);
  throw NoTessellation(first.text);
}

}  // namespace pstripack::scvt
