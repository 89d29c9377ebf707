#include "show_result.h"

#include <fmt/format.h>

#include <string>

#include "capi/pstripack.h"

namespace comparison {
namespace {

using pstripack::Point;

std::string validity(const Checked& checked) {
  if (checked.nodes == 0) return "no mesh";
  if (checked.verdict) return "valid";
  return fmt::format("NOT VALID ({}): {}", name(checked.verdict.defect), checked.verdict.message);
}

std::string validity_of_original(const Result& result) {
  if (!only_ties_and_rounding(result)) return validity(result.original_checked);
  return result.differences.of(Cause::rounding).places > 0 ? "valid up to its rounding"
                                                           : "valid up to the tie rule";
}

void print_table(const Result& result, double timeout) {
  fmt::print("nodes      {}\noriginal   {}\npstripack  {}\n\n", result.points_name, result.original_name,
             pstripack_version());
  constexpr auto kRow = "{:<10} {:<4} {:>7} {:>5} {:<9} {:>8} {:>10} {:>7}  {}\n";
  const auto four_digits = [](double value) { return fmt::format("{:.4g}", value); };
  fmt::print(kRow, "", "ABI", "threads", "ranks", "partition", "IER", "seconds", "ratio", "result");
  if (result.original_returned())
    fmt::print(kRow, "original", "", "", "", "", result.original.ier, four_digits(result.original.seconds),
               "", validity_of_original(result));
  else
    fmt::print(kRow, "original", "", "", "", "", "-", "-", "", describe(result.original, timeout));
  for (const OurRun& ours : result.ours) {
    const bool returned = ours.failure.empty();
    fmt::print(kRow, "pstripack", ours.abi, ours.threads, ours.ranks, ours.partition,
               returned ? std::to_string(ours.ier) : "-", returned ? four_digits(ours.seconds) : "-",
               returned && result.original_returned()
                   ? fmt::format("{:.2f}", result.original.seconds / ours.seconds)
                   : "",
               !returned                               ? ours.failure
               : &ours == &result.ours.front()         ? validity(result.ours_checked)
               : same_bytes(ours, result.ours.front()) ? "same bytes"
                                                       : "OTHER BYTES");
  }
  fmt::print("\n");

  if (result.meshes_compared) {
    const Differences& d = result.differences;
    fmt::print("triangles  {} and {}: {}\n", result.original_checked.triangles.size(),
               result.ours_checked.triangles.size(),
               d.none() ? "equal"
                        : fmt::format("{} only in the original, {} only in ours", d.original_triangles,
                                      d.our_triangles));
    fmt::print("boundary   {} and {} nodes: {}\n", result.original_boundary.size(),
               result.our_boundary.size(),
               result.original_boundary == result.our_boundary ? "equal" : "different");
    if (!d.none()) {
      fmt::print("\n{:<24} {:>8} {:>19} {:>10}\n", "reason of a difference", "places", "arcs: original only",
                 "ours only");
      for (std::size_t c = 0; c < kCauses; ++c)
        if (d.count[c].places + d.count[c].original_arcs + d.count[c].our_arcs > 0)
          fmt::print("{:<24} {:>8} {:>19} {:>10}\n", name(static_cast<Cause>(c)), d.count[c].places,
                     d.count[c].original_arcs, d.count[c].our_arcs);
    }
  }
  if (result.ier) fmt::print("{}: {}\n", name(result.ier->cause), result.ier->text);
}

}  // namespace

void print_decisions(const Result& result, const std::vector<Point>& points) {
  if (!result.differences.decisions.empty() || !result.broken_promises.empty()) fmt::print("\n");
  for (const Decision& d : result.differences.decisions) {
    fmt::print("{}: {}\n", name(d.cause), d.text);
    for (const auto node : d.nodes)
      fmt::print("  node {:<9} {:>24.17g} {:>24.17g} {:>24.17g}\n", node + 1, points[node].x, points[node].y,
                 points[node].z);
  }
  for (const std::string& line : result.broken_promises) fmt::print("WE ARE WRONG: {}\n", line);
}

void print(const Result& result, const std::vector<Point>& points, double timeout) {
  print_table(result, timeout);
  print_decisions(result, points);
  fmt::print("\nverdict    {}\n", verdict_of(result));
}

}  // namespace comparison
