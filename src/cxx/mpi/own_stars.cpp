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
    *number++ = name;
    for (const double c : {point.x, point.y, point.z}) *xyz++ = c;
  }
}

void OwnStars::local_stars(std::int64_t* begin, std::int32_t* neighbour) const {
  constexpr std::size_t kAhead = 16;
  NumberTable<std::int32_t> local(count() + outside().size());
  std::int32_t next = 0;
  for (std::size_t i = 0; i < count(); ++i) {
    if (i + kAhead < count()) local.prefetch(numbers_[i + kAhead]);
    local.insert(numbers_[i], ++next);
  }
  for (const Record& point : outside()) local.insert(point.number, ++next);
  begin[0] = 0;
  for_each([&](std::size_t i, std::size_t count, const auto* ring) {
    begin[i + 1] = begin[i] + static_cast<std::int64_t>(count);
    // Numbers mostly follow one another, as those of points along a curve do: no look into the table then.
    const std::int64_t number_of_first = numbers_[i] - static_cast<std::int64_t>(i);
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t wanted = absolute(ring[k]);
      const auto guess = static_cast<std::size_t>(wanted - number_of_first);
      const std::int32_t found = guess < numbers_.size() && numbers_[guess] == wanted
                                     ? static_cast<std::int32_t>(guess) + 1
                                     : local.at(wanted);
      *neighbour++ = ring[k] < 0 ? -found : found;
    }
  });
}

}  // namespace pstripack
