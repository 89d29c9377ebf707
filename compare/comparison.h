#pragma once
// What the original and PSTRIPACK made of the same nodes, checked exactly, and the verdict.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "differences.h"
#include "original.h"
#include "our_checks.h"

namespace comparison {

/// The difference between the two error codes; none if they are equal.
struct IerDifference {
  Cause cause;
  std::string text;
};

/// Everything that is known after both have run.
struct Result {
  std::string points_name, original_name;
  std::size_t n = 0;
  legacy_stripack::Triangulation original;
  Checked original_checked;
  std::vector<OurRun> ours;  ///< the first returned, if any did
  Checked ours_checked;
  std::vector<std::string> broken_promises;
  std::optional<IerDifference> ier;
  bool meshes_compared = false;
  comparison::Differences differences;
  std::vector<pstripack::index_t> original_boundary, our_boundary;

  bool original_returned() const { return original.outcome == legacy_stripack::Outcome::returned; }
  bool against_us() const {
    return !broken_promises.empty() || (ier && ier->cause == Cause::ours_wrong) ||
           differences.of(Cause::ours_wrong).places > 0;
  }
  bool equal() const { return original_returned() && !ier && (!meshes_compared || differences.none()); }
};

/// Checks and compares results on the same nodes, of ours at least one: `epsilon` is that of the original's
/// arithmetic, `show` how many differences of each cause are described. points_name and original_name are the
/// caller's to fill in.
Result compare(const std::vector<pstripack::Point>& points, legacy_stripack::Triangulation original,
               double epsilon, std::vector<OurRun> ours, std::size_t show);

/// True if the meshes differ, and by nothing but tie rule and rounding: no reason to call the original's
/// wrong.
bool only_ties_and_rounding(const Result& result);

/// "equal", "explained", "no result", "WE ARE WRONG"
std::string verdict_in_short(const Result& result);

/// One phrase: "equal", "every difference is explained", "WE ARE WRONG", ...
std::string verdict_of(const Result& result);

}  // namespace comparison
