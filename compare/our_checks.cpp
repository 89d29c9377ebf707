#include "our_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "capi/pstripack.h"
#include "determinant.h"
#include "lists/adjacency_lists.h"

namespace comparison {
namespace {

using pstripack::ListsView;
using pstripack::Point;

bool finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// True if TRMESH may return -5 for the vector: not finite, zero, or so short or long that no exact product
// fits a double.
bool bad_vector(const Point& p) {
  const double largest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return !finite(p) || !(largest > 1e-150) || largest > 1e150;
}

}  // namespace

std::size_t nodes_before_duplicate(const std::vector<Point>& points, int ier) {
  if (ier < 1 || static_cast<std::size_t>(ier) >= points.size()) return 0;
  const Point& first = points[ier - 1];
  if (!finite(first)) return 0;
  for (std::size_t m = ier; m < points.size(); ++m)
    if (finite(points[m]) && pstripack::same_direction(first, points[m])) return m;
  return 0;
}

Checked check(const std::vector<Point>& points, int ier, const std::vector<std::int32_t>& list,
              const std::vector<std::int32_t>& lptr, const std::vector<std::int32_t>& lend, std::int32_t lnew,
              const Setting& how) {
  Checked result;
  result.nodes = ier == 0           ? points.size()
                 : how.is_bitwise() ? std::find(lend.begin(), lend.end(), kUntouched) - lend.begin()
                                    : nodes_before_duplicate(points, ier);
  if (result.nodes < 3) {
    result.nodes = 0;
    return result;
  }
  const ListsView<std::int32_t> view{result.nodes, list.data(), lptr.data(), lend.data(), lnew};
  result.verdict = pstripack::check_lists(view);
  result.is_mesh = result.verdict && pstripack::check_topology(view);
  if (!result.verdict) return result;
  result.triangles = pstripack::triangles_of(view);
  pstripack::make_canonical(result.triangles);
  result.verdict = pstripack::is_valid(
      points.data(), result.nodes, result.triangles.data(), result.triangles.size(),
      how.order == "delaunay" ? pstripack::Lengths::directions : pstripack::Lengths::automatic,
      how.is_canonical() ? pstripack::Ties::by_rule : pstripack::Ties::either_way);
  return result;
}

std::vector<std::string> broken_promises(const std::vector<Point>& points, const OurRun& run,
                                         const Checked& checked) {
  std::vector<std::string> broken;
  const Lists& lists = run.lists;
  const bool three_good = finite(points[0]) && finite(points[1]) && finite(points[2]);
  const bool collinear = three_good && left_test(points[0], points[1], points[2]).sign() == 0;

  switch (run.ier) {
    case PSTRIPACK_COLLINEAR:
      if (!collinear)
        broken.push_back("IER = -2, but nodes 1, 2, 3 are not on one great circle (exact sign)");
      break;
    case PSTRIPACK_BAD_COORDINATE:
      if (std::none_of(points.begin(), points.end(), bad_vector))
        broken.push_back("IER = -5, but every node is a finite vector of sound length");
      break;
    default:
      if (run.ier < 0) {
        broken.push_back(fmt::format("IER = {}: {}", run.ier, pstripack_strerror(run.ier)));
      } else {
        if (collinear && !run.is_bitwise())
          broken.push_back("nodes 1, 2, 3 are on one great circle (exact sign), but IER is not -2");
        if (!std::all_of(points.begin(), points.begin() + checked.nodes, finite))
          broken.push_back("a coordinate is not finite, but IER is not -5");
        if (checked.nodes == 0)
          broken.push_back(
              fmt::format("IER = {0}, but no later node has the direction of node {0}", run.ier));
      }
  }

  const auto touched = [](std::int32_t entry) { return entry != kUntouched; };
  if (run.ier < 0) {
    if (std::any_of(lists.list.begin(), lists.list.end(), touched) ||
        std::any_of(lists.lptr.begin(), lists.lptr.end(), touched) ||
        std::any_of(lists.lend.begin(), lists.lend.end(), touched) || touched(lists.lnew))
      broken.push_back(fmt::format("IER = {}, but an output array was written", run.ier));
    return broken;
  }
  if (checked.nodes == 0) return broken;

  if (run.is_bitwise() ? !checked.is_mesh : !checked.verdict) {
    broken.push_back("our mesh is wrong: " + checked.verdict.message);
    return broken;
  }
  const ListsView<std::int32_t> view{checked.nodes, lists.list.data(), lists.lptr.data(), lists.lend.data(),
                                     lists.lnew};
  if (run.is_canonical() && !pstripack::lists_are_canonical(view))
    broken.push_back("our lists are not canonical");
  const std::size_t used = static_cast<std::size_t>(lists.lnew) - 1;
  if (std::any_of(lists.list.begin() + used, lists.list.end(), touched) ||
      std::any_of(lists.lptr.begin() + used, lists.lptr.end(), touched) ||
      std::any_of(lists.lend.begin() + checked.nodes, lists.lend.end(), touched))
    broken.push_back("a slot outside 1..LNEW-1, or an entry of LEND beyond the last node, was written");
  return broken;
}

}  // namespace comparison
