#include "mpi/own_stars.h"

#include <cstdlib>

#include "mesh/triangulation.h"

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

/// Whether the ring has enough neighbours, each once: nodes here or outside, and not i itself.
template <class Int>
bool OwnStars::is_cycle(std::size_t i, const Ring<Int>& ring, std::vector<std::int64_t>& sorted) const {
  sorted.clear();
  for (std::uint32_t k = 0; k < ring.count; ++k) {
    const std::int64_t neighbour = std::abs(std::int64_t{ring.begin[k]});
    const bool is_here = static_cast<std::uint64_t>(neighbour - first_) < count();
    if (neighbour - first_ == static_cast<std::int64_t>(i)) return false;
    if (!is_here && (neighbour == 0 || place_.find(GlobalNumber{neighbour}) == nullptr)) return false;
    if (ring.begin[k] < 0 && k + 1 < ring.count) return false;
    sorted.push_back(neighbour);
  }
  std::sort(sorted.begin(), sorted.end());
  const std::size_t least = ring.count > 0 && ring.begin[ring.count - 1] < 0 ? 2 : 3;
  return sorted.size() >= least && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

/// A triangle stands in the stars of its three corners. Each star claims of both others that they have it,
/// too. The balance of a star is twice the sum of the hashes of its triangles less those that are claimed of
/// it: 0 if they are the same, and, up to a probability of 2^-64, only then.
OwnStars::Checked OwnStars::check(Communicator& ranks) const {
  struct Claim {
    std::int64_t at, next, last;  // counted; in the star of `at`, `last` follows `next`
    std::uint64_t hash() const {
      return hash_of_triangle(static_cast<std::uint64_t>(at), static_cast<std::uint64_t>(next),
                              static_cast<std::uint64_t>(last));
    }
  };
  Checked found;
  std::int64_t neighbours = 0, boundary = 0;
  std::vector<std::uint64_t> balance;
  const Parcels claimed = exchange_in_agreement(ranks, [&] {
    balance.resize(count());
    std::vector<std::vector<Claim>> to(static_cast<std::size_t>(ranks.size()));
    std::vector<std::int64_t> sorted;
    const auto claim = [&](const Claim& c) {
      const auto here = static_cast<std::size_t>(c.at - first_);
      if (here < count())
        balance[here] -= c.hash();
      else
        to[ranges_.address(GlobalNumber{c.at}).rank].push_back(c);
    };
    for_each_ring([&](std::size_t i, const auto& ring) {
      if (!is_cycle(i, ring, sorted)) {
        found.wrong.value = std::min(found.wrong.value, numbers_[i]);
        return;
      }
      const std::int64_t a = first_ + static_cast<std::int64_t>(i);
      const bool is_boundary = ring.begin[ring.count - 1] < 0;
      neighbours += ring.count;
      boundary += is_boundary;
      for (std::uint32_t k = is_boundary ? 1 : 0; k < ring.count; ++k) {
        const std::int64_t b = ring.begin[(k + ring.count - 1) % ring.count],
                           c = std::abs(std::int64_t{ring.begin[k]});
        balance[i] += 2 * Claim{a, b, c}.hash();
        claim({b, c, a});
        claim({c, a, b});
      }
    });
    return packed(to);
  });
  for (const Claim& c : Items<Claim>(claimed)) balance[static_cast<std::size_t>(c.at - first_)] -= c.hash();
  for (std::size_t i = 0; i < count(); ++i)
    if (balance[i] != 0) found.wrong.value = std::min(found.wrong.value, numbers_[i]);
  agree(ranks, found.wrong);
  if (found.wrong.exists()) return found;
  std::uint64_t hashes = 0;
  for_each_triangle([&](std::int64_t a, std::int64_t b, std::int64_t c) {
    const auto index = [](std::int64_t number) { return static_cast<std::uint64_t>(number) - 1; };
    hashes += hash_of_triangle(index(a), index(b), index(c));
  });
  // Halves, so that no sum is too large.
  std::int64_t sums[] = {static_cast<std::int64_t>(count()),
                         neighbours,
                         boundary,
                         triangles(),
                         static_cast<std::int64_t>(hashes & UINT32_MAX),
                         static_cast<std::int64_t>(hashes >> 32)};
  ranks.all_sum(sums, std::size(sums));
  const auto sum = [&](std::size_t k) { return static_cast<std::uint64_t>(sums[k]); };
  // Euler's formula. V nodes, F triangles and B boundary arcs of a sphere (B = 0) or a disc have
  // V - (F + B)/2 = 2 or 1. A star has as many triangles as neighbours; at the boundary, one less.
  found.is_sphere_or_disc = 6 * sums[0] - sums[1] - 2 * sums[2] == (sums[2] > 0 ? 6 : 12);
  found.fingerprint = fingerprint_of(sum(4) + (sum(5) << 32), sum(3));
  return found;
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
    const std::uint32_t first = first_of(ring);
    for (std::uint32_t k = 0; k < ring.count; ++k) {
      const auto entry = ring.begin[(first + k) % ring.count];
      const auto place = static_cast<std::int32_t>(index(std::abs(std::int64_t{entry}))) + 1;
      neighbour[begin[i] + k] = entry < 0 ? -place : place;
    }
  });
}

}  // namespace pstripack
