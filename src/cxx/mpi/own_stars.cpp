#include "mpi/own_stars.h"

#include <algorithm>

#include "parallel/number_table.h"

namespace pstripack {
namespace {

template <class Int>
std::int64_t absolute(Int number) {
  return number < 0 ? -static_cast<std::int64_t>(number) : static_cast<std::int64_t>(number);
}

/// Calls visit(b, c) for each triangle (number, b, c), counterclockwise, whose smallest corner is `number`.
template <class Int, class Visit>
void for_each_triangle_of(std::int64_t number, const Int* ring, std::size_t count, const Visit& visit) {
  std::int64_t before = ring[count - 1];
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t b = before, c = absolute(ring[i]);
    before = c;
    if (i == 0 && b < 0) continue;  // the gap of a boundary point
    if (number < b && number < c) visit(b, c);
  }
}

}  // namespace

std::int64_t OwnStars::boundary_points() const {
  std::int64_t points = 0;
  for_each([&](std::size_t, std::size_t count, const auto* ring) { points += ring[count - 1] < 0; });
  return points;
}

std::int64_t OwnStars::triangles() const {
  std::int64_t triangles = 0;
  for_each([&](std::size_t i, std::size_t count, const auto* ring) {
    for_each_triangle_of(numbers_[i], ring, count, [&](std::int64_t, std::int64_t) { ++triangles; });
  });
  return triangles;
}

void OwnStars::stars(std::int64_t* begin, std::int64_t* neighbour) const {
  begin[0] = 0;
  for_each([&](std::size_t i, std::size_t count, const auto* ring) {
    begin[i + 1] = begin[i] + static_cast<std::int64_t>(count);
    std::copy(ring, ring + count, neighbour + begin[i]);
  });
}

void OwnStars::triangles(std::int64_t* corner) const {
  for_each([&](std::size_t i, std::size_t count, const auto* ring) {
    for_each_triangle_of(numbers_[i], ring, count, [&](std::int64_t b, std::int64_t c) {
      *corner++ = numbers_[i];
      *corner++ = b;
      *corner++ = c;
    });
  });
}

void OwnStars::halo(std::int64_t* number, double* xyz) const {
  for (const auto& [point, name] : outside()) {
    *number++ = value_of(name);
    for (const double c : {point.x, point.y, point.z}) *xyz++ = c;
  }
}

void OwnStars::local_stars(std::int64_t* begin, std::int32_t* neighbour) const {
  constexpr std::size_t kAhead = 16;
  const std::int64_t *const own = numbers(), *const end_of_own = own + count();
  const bool is_sorted = std::is_sorted(own, end_of_own);  // then a search needs no table
  NumberTable<std::int32_t> local((is_sorted ? 0 : count()) + outside().size());
  for (std::size_t i = 0; i < count() && !is_sorted; ++i) {
    if (i + kAhead < count()) local.prefetch(GlobalNumber{own[i + kAhead]});
    local.insert(GlobalNumber{own[i]}, static_cast<std::int32_t>(i) + 1);
  }
  auto next = static_cast<std::int32_t>(count());
  for (const Record& point : outside()) local.insert(point.number, ++next);
  const auto find = [&](std::int64_t wanted) {
    if (is_sorted) {
      const std::int64_t* const at = std::lower_bound(own, end_of_own, wanted);
      if (at != end_of_own && *at == wanted) return static_cast<std::int32_t>(at - own) + 1;
    }
    return local.at(GlobalNumber{wanted});
  };
  begin[0] = 0;
  for_each([&](std::size_t i, std::size_t count, const auto* ring) {
    begin[i + 1] = begin[i] + static_cast<std::int64_t>(count);
    // Usually own numbers are consecutive, as those of points along a curve are: then no search is needed.
    const std::int64_t number_of_first = own[i] - static_cast<std::int64_t>(i);
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t wanted = absolute(ring[k]);
      const auto guess = static_cast<std::size_t>(wanted - number_of_first);
      const std::int32_t found = guess < numbers_.size() && own[guess] == wanted
                                     ? static_cast<std::int32_t>(guess) + 1
                                     : find(wanted);
      *neighbour++ = ring[k] < 0 ? -found : found;
    }
  });
}

}  // namespace pstripack
