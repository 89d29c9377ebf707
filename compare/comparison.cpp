#include "comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "capi/pstripack.h"
#include "determinant.h"

namespace comparison {
namespace {

using pstripack::Point;

std::optional<IerDifference> compare_ier(const std::vector<Point>& points, int theirs, const OurRun& ours,
                                         double epsilon) {
  if (theirs == ours.ier) return std::nullopt;
  const std::string both = fmt::format("IER of the original {}, ours {}: ", theirs, ours.ier);
  if (ours.ier == PSTRIPACK_BAD_COORDINATE)
    return IerDifference{Cause::original_wrong, both + "a coordinate is not finite or a vector is zero"};
  if (ours.ier == PSTRIPACK_COLLINEAR || theirs == PSTRIPACK_COLLINEAR) {
    const auto det = left_test(points[0], points[1], points[2]);
    const std::string text = fmt::format("exact det of nodes 1, 2, 3 is {}, rounding of its LEFT {}",
                                         det.value(), det.bound(epsilon));
    return IerDifference{det.within_rounding(epsilon) ? Cause::rounding : Cause::original_wrong, both + text};
  }
  if (ours.ier > 0)
    return IerDifference{Cause::original_wrong,
                         both + fmt::format("nodes {} and {} coincide, and no earlier two", ours.ier,
                                            nodes_before_duplicate(points, ours.ier) + 1)};
  return IerDifference{Cause::original_wrong, both + "ours passes every exact check"};
}

// Lengths near 1 must be used as given unless that hides a node. A valid mesh of the original shows that none
// is hidden.
bool used_directions_without_need(const std::vector<Point>& points, const Checked& original,
                                  const Checked& ours) {
  using pstripack::Lengths;
  if (original.nodes == 0 || original.nodes != ours.nodes || !original.verdict || !ours.verdict) return false;
  if (ours.verdict.lengths != Lengths::directions || original.verdict.lengths != Lengths::as_given)
    return false;
  return std::all_of(points.begin(), points.begin() + ours.nodes,
                     [](const Point& p) { return std::fabs(std::hypot(p.x, p.y, p.z) - 1) <= 1e-6; });
}

}  // namespace

Result compare(const std::vector<Point>& points, legacy_stripack::Triangulation original, double epsilon,
               std::vector<OurRun> ours, std::size_t show) {
  Result result;
  result.n = points.size();
  result.original = std::move(original);
  result.ours = std::move(ours);

  for (const OurRun& run : result.ours)
    if (!run.failure.empty())
      result.broken_promises.push_back(fmt::format("the call on {} {}", describe(run), run.failure));
  const auto returned = [](const OurRun& run) { return run.failure.empty(); };
  std::stable_partition(result.ours.begin(), result.ours.end(), returned);
  const OurRun& first = result.ours.front();
  if (!returned(first)) return result;

  const auto check = [&](int ier, const auto& lists, const Setting& how) {
    return comparison::check(points, ier, lists.list, lists.lptr, lists.lend, lists.lnew, how);
  };
  result.ours_checked = check(first.ier, first.lists, first);
  for (std::string& line : comparison::broken_promises(points, first, result.ours_checked))
    result.broken_promises.push_back(std::move(line));
  for (const OurRun& other : result.ours)
    if (returned(other) && !same_bytes(first, other))
      result.broken_promises.push_back(
          fmt::format("the result on {} has other bytes than that on {}", describe(other), describe(first)));

  if (!result.original_returned()) return result;
  result.original_checked = check(result.original.ier, result.original, {});
  if (first.is_bitwise() && !result.ours_is_exact()) return result;
  if (first.order != "delaunay" &&
      used_directions_without_need(points, result.original_checked, result.ours_checked))
    result.broken_promises.push_back(
        "our mesh is that of the directions, although all lengths are within 1e-6 of 1 "
        "and the original's mesh is right for the coordinates as given");
  if (result.broken_promises.empty()) result.ier = compare_ier(points, result.original.ier, first, epsilon);

  result.meshes_compared = result.original.ier == first.ier && result.ours_checked.nodes > 0;
  if (result.meshes_compared) {
    result.original_boundary = boundary_nodes(result.original_checked.triangles);
    result.our_boundary = boundary_nodes(result.ours_checked.triangles);
    result.differences =
        comparison::differences(points, {result.original_checked.triangles, result.original_checked.verdict},
                                {result.ours_checked.triangles, result.ours_checked.verdict}, epsilon, show);
  }
  return result;
}

bool only_ties_and_rounding(const Result& result) {
  const Differences& d = result.differences;
  return !d.none() && d.of(Cause::directions).places == 0 && d.of(Cause::original_wrong).places == 0 &&
         d.of(Cause::ours_wrong).places == 0;
}

std::string verdict_in_short(const Result& result) {
  if (result.against_us()) return "WE ARE WRONG";
  if (!result.original_returned()) return "no result";
  return result.equal() ? "equal" : "explained";
}

std::string verdict_of(const Result& result) {
  if (result.against_us()) return "WE ARE WRONG";
  if (!result.original_returned()) return "the original gave no result; ours passes every exact check";
  if (result.equal()) return result.meshes_compared ? "equal" : "equal error codes";
  return "every difference is explained";
}

}  // namespace comparison
