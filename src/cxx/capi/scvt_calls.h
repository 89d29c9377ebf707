#pragma once
// Shared by the C functions for centroidal tessellations, with and without MPI.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <string>

#include "base/floating_point.h"
#include "capi/pstripack.h"
#include "parallel/communicator.h"
#include "scvt/errors.h"
#include "scvt/tessellation.h"
#include "scvt/widths.h"

namespace pstripack {

/// Thrown to return a code with a message.
struct Refusal {
  std::int32_t code;
  std::string why;
};

class DensityOfCaller final : public scvt::Density {
 public:
  explicit DensityOfCaller(const pstripack_density* density, bool are_widths = false)
      : density_(density != nullptr ? *density : pstripack_density{}), are_widths_(are_widths) {}

  void at(std::size_t n, const Point* p, double* value) const override {
    constexpr std::size_t kMost = 65536;
    std::fill_n(value, n, is_constant() ? 1 : std::numeric_limits<double>::quiet_NaN());
    if (is_constant()) return;
    for (std::size_t i = 0; i < n; i += kMost)
      density_.at(static_cast<std::int32_t>(std::min(kMost, n - i)), &p[i].x, value + i, density_.user);
    if (are_widths_) scvt::densities_of_widths(n, p, value);
  }
  bool is_constant() const override { return density_.at == nullptr; }
  bool is_serial() const override { return !is_constant() && density_.any_thread == 0; }

 private:
  pstripack_density density_;
  bool are_widths_;  ///< the procedure returns widths of cells
};

/// Runs body() and returns 0, or the code of its exception, whose text goes to `message`. An exception of a
/// type that is not listed here comes from a density in C++.
template <class Body>
std::int32_t guarded_scvt(char* message, std::int32_t length, const Body& body) noexcept {
  const auto say = [&](std::int32_t code, const char* text) {
    if (message != nullptr && length > 0)
      std::snprintf(message, static_cast<std::size_t>(length), "%s", text);
    return code;
  };
  try {
    in_default_floating_point(body);
    return PSTRIPACK_OK;
  } catch (const Refusal& refusal) {
    return say(refusal.code, refusal.why.c_str());
  } catch (const scvt::NoTessellation& error) {
    return say(error.code, error.what());
  } catch (const AgreedFailure& failure) {
    return say(failure.code, pstripack_strerror(failure.code));
  } catch (const std::bad_alloc&) {
    return say(PSTRIPACK_OUT_OF_MEMORY, pstripack_strerror(PSTRIPACK_OUT_OF_MEMORY));
  } catch (const std::exception& error) {
    return say(PSTRIPACK_BAD_DENSITY, error.what());
  } catch (...) {
    return say(PSTRIPACK_BAD_DENSITY, "the density threw an exception");
  }
}

inline void require(bool is_good, const char* option) {
  if (!is_good) throw Refusal{PSTRIPACK_BAD_OPTION, std::string("pstripack_scvt_options: ") + option};
}

/// A copy of the options. Throws Refusal if a value is not allowed. Null: all fields are 0.
inline pstripack_scvt_options checked(const pstripack_scvt_options* given) {
  pstripack_scvt_options options{};
  if (given != nullptr) {
    require(given->bytes >= static_cast<std::int64_t>(sizeof given->bytes),
            "bytes must be sizeof(pstripack_scvt_options)");
    require(given->bytes <= static_cast<std::int64_t>(sizeof options),
            "bytes: the program was compiled for a newer library than the one that is loaded");
    std::memcpy(&options, given, static_cast<std::size_t>(given->bytes));
  }
  require(options.start >= PSTRIPACK_SCVT_BY_NUMBER && options.start <= PSTRIPACK_SCVT_FRONT,
          "start must be 0, 1, 2, 3 or 4");
  require(options.method == PSTRIPACK_SCVT_NEWTON || options.method == PSTRIPACK_SCVT_LLOYD,
          "method must be 0 or 1");
  require(options.tolerance >= 0 && std::isfinite(options.tolerance),
          "tolerance must be positive, or 0 for the default");
  require(options.widths == 0 || options.widths == 1, "widths must be 0 or 1");
  require(options.well_centred == 0 || options.well_centred == 1, "well_centred must be 0 or 1");
  require(options.most_evaluations >= 0, "most_evaluations must be positive, or 0 for the default");
  return options;
}

inline scvt::RunOptions run_options(const pstripack_scvt_options& options) {
  scvt::RunOptions run;
  run.levels = options.start != PSTRIPACK_SCVT_RANDOM;
  run.method = static_cast<scvt::Method>(options.method);
  if (options.tolerance != 0) run.tolerance = options.tolerance;
  if (options.most_evaluations != 0) run.most_evaluations = options.most_evaluations;
  run.well_centred = options.well_centred != 0;
  if (options.seed != 0) run.seed = static_cast<std::uint64_t>(options.seed);
  if (options.progress != nullptr)
    run.progress = [progress = options.progress, user = options.user](const scvt::Progress& p) {
      return progress(&p, user) == 0;
    };
  return run;
}

inline std::int32_t reason_of(scvt::End end, const scvt::Repair& repair) {
  return repair.obtuse > 0 ? std::int32_t{PSTRIPACK_SCVT_NOT_WELL_CENTRED} : static_cast<std::int32_t>(end);
}

}  // namespace pstripack
