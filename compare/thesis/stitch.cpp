#include "thesis/stitch.h"

namespace thesis {

//    stripe |          | stripe      The base climbs from (l1, r1). If pr lies in the circle through base and
//          pl ........ pr            pl, the next triangle is (lbase, rbase, pr) and r goes on to pr;
//           |  .    .  |             else it is (lbase, rbase, pl) and l goes on to pl. At the end of one
//           |    ..    |             chain the rest of the other is joined to its last node.
//       lbase -------- rbase         The triangles inside the stripes are neither tested nor changed.
//           |   done   |
//          l1 -------- r1
//
pstripack::Triangles stitch(const std::vector<Point>& points, const Chain& left, const Chain& right) {
  pstripack::Triangles triangles;
  if (left.empty() || right.empty() || left.front() == right.front()) return triangles;
  const auto point = [&](pstripack::index_t i) { return points[static_cast<std::size_t>(i)]; };
  std::size_t l = 0, r = 0;
  const auto add_left = [&] { triangles.push_back({left[l], right[r], left[l + 1]}), ++l; };
  const auto add_right = [&] { triangles.push_back({left[l], right[r], right[r + 1]}), ++r; };
  while (l + 1 < left.size() && r + 1 < right.size())
    if (is_inside(point(right[r + 1]), circumcircle(point(left[l]), point(right[r]), point(left[l + 1]))))
      add_right();
    else
      add_left();
  while (l + 1 < left.size()) add_left();
  while (r + 1 < right.size()) add_right();
  return triangles;
}

}  // namespace thesis
