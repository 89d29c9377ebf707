#pragma once
// Generators that are spread over ranks: no rank ever has all. A process alone is a group of one rank.
//
// The generators of all ranks have numbers from 1, which follow from the generators alone. So what follows
// from the generators is the same for any number of ranks.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/point.h"
#include "parallel/communicator.h"
#include "scvt/cells.h"

namespace pstripack::scvt {

/// Those of this rank.
struct Spread {
  std::vector<Point> points;          ///< unit vectors
  std::vector<std::int64_t> numbers;  ///< of each
};

/// Those of this rank, then the neighbours that they have on other ranks.
struct Neighbourhood {
  const Point* points = nullptr;
  const std::int64_t* numbers = nullptr;
  NeighbourLists stars;  ///< of those of this rank; neighbours are places in these arrays, from 1
};

/// Numbers the points of all ranks along a curve that fills the sphere; each rank gets a part of the curve
/// with about as many points as the others. Collective.
Spread along_a_curve(Communicator& ranks, const std::vector<Point>& points);

/// Of this process alone.
std::vector<Point> along_a_curve(const std::vector<Point>& points);

/// `width` values of each generator of this rank.
struct Rows {
  std::size_t width = 0;
  std::vector<double> values;  ///< row after row
  std::vector<std::int64_t> numbers;
};

/// Row i goes to the rank to[i], which gets its rows by increasing number. Frees `rows` on the way.
/// Collective.
Rows moved(Communicator& ranks, Rows rows, const std::vector<std::int32_t>& to);

/// The rank of each of these numbers, if rank r has the r-th of equal slices of 1..n.
std::vector<std::int32_t> ranks_of_slices(const Communicator& ranks, std::int64_t n,
                                          const std::vector<std::int64_t>& numbers);

/// How many all ranks have. Collective.
std::int64_t sum_of_all(Communicator& ranks, std::size_t mine);
/// How many the ranks before this one have. Collective.
std::int64_t sum_before(Communicator& ranks, std::size_t mine);

/// For each target the largest number, below 2^63, that at most so many items of all ranks are below, where
/// `below` tells how many of this rank are. Collective.
std::vector<std::uint64_t> bounds(Communicator& ranks, const std::vector<std::int64_t>& targets,
                                  const std::function<std::size_t(std::uint64_t)>& below);

}  // namespace pstripack::scvt
