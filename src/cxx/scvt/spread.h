#pragma once
// Generators that are spread over ranks: no rank ever has all. A single process is a group of one rank.
//
// The generators of all ranks have global numbers from 1, which depend on the generators alone. So the
// results are the same for any number of ranks.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/point.h"
#include "parallel/communicator.h"
#include "parallel/halo.h"
#include "scvt/cells.h"

namespace pstripack::scvt {

struct Spread {
  std::vector<Point> points;          ///< unit vectors
  std::vector<std::int64_t> numbers;  ///< their global numbers
};

/// The points of this rank, followed by their neighbours on other ranks (the halo).
struct Neighbourhood {
  const Point* points = nullptr;
  const std::int64_t* numbers = nullptr;
  NeighbourLists stars;  ///< of the points of this rank; neighbours are indices into the arrays above, from 1
  std::size_t known = 0;       ///< number of all these points
  const Halo* halo = nullptr;  ///< exchanges values of those behind the points of this rank
};

/// Numbers the points of all ranks along a space-filling curve on the sphere. Each rank gets a part of the
/// curve, all with about the same number of points. Collective. Throws AgreedFailure.
Spread along_a_curve(Communicator& ranks, const std::vector<Point>& points);

/// The same on this process alone; not collective.
std::vector<Point> along_a_curve(const std::vector<Point>& points);

/// `width` values for each generator of this rank.
struct Rows {
  std::size_t width = 0;
  std::vector<double> values;  ///< row after row
  std::vector<std::int64_t> numbers;
};

/// Sends row i to rank to[i]. The result has the rows received, by increasing number. Frees `rows` before the
/// exchange. Collective. Throws AgreedFailure.
Rows moved(Communicator& ranks, Rows rows, const std::vector<std::int32_t>& to);

/// The sum of `mine` over all ranks. Collective.
std::int64_t sum_of_all(Communicator& ranks, std::size_t mine);
/// The sum of `mine` over the ranks below this one. Collective.
std::int64_t sum_before(Communicator& ranks, std::size_t mine);

/// For each target the largest number b < 2^63 such that at most `target` items of all ranks are below b.
/// below(b): the number of items of this rank that are below b. Collective. Throws AgreedFailure.
std::vector<std::uint64_t> bounds(Communicator& ranks, const std::vector<std::int64_t>& targets,
                                  const std::function<std::size_t(std::uint64_t)>& below);

}  // namespace pstripack::scvt
