#pragma once
// Compares the original's and PSTRIPACK's results for the same nodes, checked exactly.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "differences.h"
#include "original.h"
#include "our_checks.h"

namespace comparison {

/// The two error codes and why they differ; none if they are equal.
struct IerDifference {
  Cause cause;
  std::string text;
};

/// The results of the original and of all our calls.
struct Result {
  std::string points_name, original_name;
  std::size_t n = 0;
  legacy_stripack::Triangulation original;
  Checked original_checked;
  std::vector<OurRun> ours;  ///< the first one returned, if any did
  Checked ours_checked;
  std::vector<std::string> broken_promises;
  std::optional<IerDifference> ier;
  bool meshes_compared = false;
  comparison::Differences differences;
  std::vector<pstripack::index_t> original_boundary, our_boundary;

  /// False: our lists, in the order `bitwise`, are of the mesh that the original's rounded tests make. It is
  /// not compared.
  bool ours_is_exact() const { return ours_checked.nodes == 0 || ours_checked.verdict; }
  bool original_returned() const { return original.outcome == legacy_stripack::Outcome::returned; }
  bool against_us() const {
    return !broken_promises.empty() || (ier && ier->cause == Cause::ours_wrong) ||
           differences.of(Cause::ours_wrong).places > 0;
  }
  bool equal() const {
    return original_returned() && ours_is_exact() && !ier && (!meshes_compared || differences.none());
  }
};

/// Checks and compares results for the same nodes; at least one is ours. `epsilon`: of the original's
/// arithmetic. `show`: number of differences described per cause. The caller fills in points_name and
/// original_name.
Result compare(const std::vector<pstripack::Point>& points, legacy_stripack::Triangulation original,
               double epsilon, std::vector<OurRun> ours, std::size_t show);

/// True if the meshes differ only by tie rule and rounding: the original's is then not called wrong.
bool only_ties_and_rounding(const Result& result);

/// "equal", "explained", "no result", "WE ARE WRONG"
std::string verdict_in_short(const Result& result);

/// The verdict as a phrase: "equal", "every difference is explained", "WE ARE WRONG", ...
std::string verdict_of(const Result& result);

}  // namespace comparison
