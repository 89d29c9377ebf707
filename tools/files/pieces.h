#pragma once
// Parts of cells, collected as faces.

#include <array>
#include <boost/functional/hash.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/map_rings.h"

namespace files {

/// Collects rings as faces. Corners with the same coordinates are stored once.
class Pieces {
 public:
  explicit Pieces(const Faces& cells) : cells_(cells) { faces_.begin.push_back(0); }

  /// `area`: of the part, if it is known.
  void add(const MapRing& ring, std::size_t cell, double area = std::numeric_limits<double>::quiet_NaN()) {
    std::vector<std::int32_t> corners;
    for (const MapCorner& c : ring) {
      const auto [known, is_new] =
          number_.try_emplace({c.p.x, c.p.y, c.p.z}, static_cast<std::int32_t>(faces_.points.size() + 1));
      if (is_new) {
        faces_.points.push_back(c.p);
        faces_.given_points.lon.push_back(wrapped(c.lon));
        faces_.given_points.lat.push_back(c.lat);
      }
      if (corners.empty() || corners.back() != known->second) corners.push_back(known->second);
    }
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    if (corners.size() < 3) return;
    faces_.area.push_back(is_whole(ring, cell) && !cells_.area.empty() ? cells_.area[cell] : area);
    faces_.corner.insert(faces_.corner.end(), corners.begin(), corners.end());
    faces_.begin.push_back(faces_.corner.size());
    faces_.centres.push_back(cells_.centres[cell]);
    faces_.nodes.push_back(cells_.node_of(cell));
  }
  std::size_t size() const { return faces_.size(); }
  Faces take() { return std::move(faces_); }

 private:
  /// True for all corners of the cell, in their order, whichever is the first.
  bool is_whole(const MapRing& ring, std::size_t cell) const {
    const std::size_t begin = cells_.begin[cell], n = cells_.corners(cell);
    std::size_t first = 0;
    while (first < n && ring[0].p != cells_.point(begin + first)) ++first;
    if (first == n || ring.size() != n) return false;
    for (std::size_t k = 0; k < n; ++k)
      if (ring[k].p != cells_.point(begin + (first + k) % n)) return false;
    return true;
  }

  const Faces& cells_;
  Faces faces_;
  using Coordinates = std::array<double, 3>;
  std::unordered_map<Coordinates, std::int32_t, boost::hash<Coordinates>> number_;  ///< of each point
};

}  // namespace files
