#include "node_sets.h"

#include <algorithm>
#include <cmath>

#include "point_sets.h"

namespace comparison {

using pstripack::Point;

std::vector<Point> read_nodes(const std::string& file, const files::ReadOptions& options) {
  return files::read(file, options).points;
}

void put_in_order(std::vector<Point>& points, const std::string& order, std::uint64_t seed) {
  if (order == "shuffled") point_sets::shuffle(points, seed);
  if (order != "sorted") return;
  std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.z != b.z ? a.z < b.z : std::atan2(a.y, a.x) < std::atan2(b.y, b.x);
  });
}

void round_to_single(std::vector<Point>& points) {
  for (Point& p : points) p = point_sets::rounded_to_single(p);
}

}  // namespace comparison
