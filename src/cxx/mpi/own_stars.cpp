#include "mpi/own_stars.h"

#include <cstdlib>

namespace pstripack {

void OwnStars::find_outside() {
  const std::vector<HaloNode>& nodes = outside();
  place_ = NumberTable<std::size_t>(nodes.size());
  for (std::size_t j = 0; j < nodes.size(); ++j) place_.insert(nodes[j].counted, j);
}

/// Calls visit(a, b, c) for each triangle, counterclockwise, whose smallest corner a is a point here.
template <class Visit>
void OwnStars::for_each_triangle(const Visit& visit) const {
  for_each_ring([&](std::size_t i, const auto& ring) {
    const std::int64_t a = numbers_[i];
    const std::uint32_t first = first_of(ring);
    const auto entry = [&](std::uint32_t k) { return number_of(ring.begin[(first + k) % ring.count]); };
    std::int64_t before = entry(ring.count - 1);
    for (std::uint32_t k = 0; k < ring.count; ++k) {
      const std::int64_t b = before, c = std::abs(entry(k));
      before = c;
      if (k == 0 && b < 0) continue;  // the gap of a boundary point
      if (a < b && a < c) visit(a, b, c);
    }
  });
}

std::int64_t OwnStars::boundary_points() const {
  std::int64_t points = 0;
  for_each_ring([&](std::size_t, const auto& ring) { points += ring.begin[ring.count - 1] < 0; });
  return points;
}

std::int64_t OwnStars::triangles() const {
  std::int64_t triangles = 0;
  for_each_triangle([&](std::int64_t, std::int64_t, std::int64_t) { ++triangles; });
  return triangles;
}

void OwnStars::stars(std::int64_t* begin, std::int64_t* neighbour) const {
  begin[0] = 0;
  for_each_ring([&](std::size_t i, const auto& ring) {
    begin[i + 1] = begin[i] + ring.count;
    write(ring, neighbour + begin[i]);
  });
}

void OwnStars::triangles(std::int64_t* corner) const {
  for_each_triangle([&](std::int64_t a, std::int64_t b, std::int64_t c) {
    *corner++ = a;
    *corner++ = b;
    *corner++ = c;
  });
}

void OwnStars::halo(std::int64_t* number, double* xyz) const {
  for (const HaloNode& node : outside()) {
    *number++ = value_of(node.number);
    for (const double c : {node.point.x, node.point.y, node.point.z}) *xyz++ = c;
  }
}

void OwnStars::halo_owners(std::int32_t* rank, std::int32_t* local) const {
  for (const HaloNode& node : outside()) {
    const NodeAddress owner = ranges_.address(node.counted);
    *rank++ = static_cast<std::int32_t>(owner.rank);
    *local++ = static_cast<std::int32_t>(owner.node) + 1;
  }
}

void OwnStars::local_stars(std::int64_t* begin, std::int32_t* neighbour) const {
  begin[0] = 0;
  for_each_ring([&](std::size_t i, const auto& ring) {
    begin[i + 1] = begin[i] + ring.count;
    std::int32_t* const out = neighbour + begin[i];
    for (std::uint32_t k = 0; k < ring.count; ++k) {
      const auto entry = ring.begin[k];
      const auto place = static_cast<std::int32_t>(index(std::abs(std::int64_t{entry}))) + 1;
      out[k] = entry < 0 ? -place : place;
    }
    if (out[ring.count - 1] < 0) return;
    std::int32_t* const first = std::min_element(out, out + ring.count, [&](std::int32_t a, std::int32_t b) {
      return number(static_cast<std::size_t>(a) - 1) < number(static_cast<std::size_t>(b) - 1);
    });
    std::rotate(out, first, out + ring.count);
  });
}

}  // namespace pstripack
