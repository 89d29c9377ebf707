// stripack-compare lists: the LIST, LPTR, LEND of two files.

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "commands.h"
#include "list_files.h"
#include "lists/adjacency_lists.h"
#include "mesh/triangulation.h"
#include "only_in.h"

namespace comparison {
namespace {

using pstripack::Triangle;
using pstripack::Triangles;

enum class Verdict { same_bytes, same_triangles, different };

struct Pair {
  Verdict verdict;
  std::string text;
};

/// The triangles of a result, or the reason why there are none.
struct MeshOfLists {
  Triangles triangles;
  std::string defect;
};
MeshOfLists mesh_of(const Call& call) {
  const Lists& lists = call.run.lists;
  const pstripack::ListsView<std::int32_t> view{call.nodes, lists.list.data(), lists.lptr.data(),
                                                lists.lend.data(), lists.lnew};
  MeshOfLists mesh;
  if (const auto verdict = pstripack::check_lists(view); !verdict) {
    mesh.defect = verdict.message;
  } else {
    mesh.triangles = pstripack::triangles_of(view);
    pstripack::make_canonical(mesh.triangles);
  }
  return mesh;
}

std::string describe(const Triangles& triangles, const char* where) {
  if (triangles.empty()) return fmt::format("none only in {}", where);
  const Triangle& t = triangles.front();
  return fmt::format("{} only in {} ({} {} {}{})", triangles.size(), where, t[0] + 1, t[1] + 1, t[2] + 1,
                     triangles.size() > 1 ? ", ..." : "");
}

Pair compare(const Call& a, const Call& b) {
  if (a.n != b.n) return {Verdict::different, fmt::format("n = {} in A, {} in B", a.n, b.n)};
  if (a.has_returned != b.has_returned)
    return {Verdict::different, fmt::format("no result in {}", a.has_returned ? "B" : "A")};
  if (!a.has_returned) return {Verdict::same_bytes, "no result in either"};
  if (a.run.ier != b.run.ier)
    return {Verdict::different, fmt::format("IER = {} in A, {} in B", a.run.ier, b.run.ier)};
  const ByteComparison bytes = compare_bytes(a.run.lists, a.nodes, b.run.lists, b.nodes);
  std::string text;
  if (!a.points.empty() && !b.points.empty()) {
    const auto other =
        std::mismatch(a.points.begin(), a.points.end(), b.points.begin(), [](auto& p, auto& q) {
          return p.x == q.x && p.y == q.y && p.z == q.z;
        }).first;
    if (other != a.points.end())
      text = fmt::format("OTHER NODES, the first is {}; ", other - a.points.begin() + 1);
  }
  if (bytes.different == 0) return {Verdict::same_bytes, text + "same bytes"};

  text += fmt::format("{} entries differ, first {}; ", bytes.different, bytes.first);
  const MeshOfLists in_a = mesh_of(a), in_b = mesh_of(b);
  if (!in_a.defect.empty() || !in_b.defect.empty()) {
    if (!in_a.defect.empty()) text += "A is no triangulation: " + in_a.defect;
    if (!in_b.defect.empty())
      text += (in_a.defect.empty() ? "B is no triangulation: " : "; nor is B: ") + in_b.defect;
    return {Verdict::different, text};
  }
  if (in_a.triangles == in_b.triangles) return {Verdict::same_triangles, text + "the same triangles"};
  return {Verdict::different, text + "triangles: " + describe(only_in(in_a.triangles, in_b.triangles), "A") +
                                  ", " + describe(only_in(in_b.triangles, in_a.triangles), "B")};
}

}  // namespace

int compare_lists(const ListsOptions& options) {
  const auto next_of_a = calls_of(options.a), next_of_b = calls_of(options.b);
  std::size_t count[3] = {}, missing = 0, number = 0;
  for (;;) {
    const std::optional<Call> a = next_of_a(), b = next_of_b();
    if (!a && !b) break;
    ++number;
    if (!a || !b) {
      if (missing++ == 0) fmt::print("call {}: only in {}\n", number, a ? "A" : "B");
      continue;
    }
    const Pair pair = compare(*a, *b);
    ++count[static_cast<std::size_t>(pair.verdict)];
    fmt::print("call {}: n = {}: {}\n", number, a->n, pair.text);
  }
  if (number == 0) throw std::runtime_error("no call in " + options.a + " nor in " + options.b);
  fmt::print(
      "{} call{}: {} same bytes, {} same triangles in other lists, {} different, {} only in one file\n",
      number, number == 1 ? "" : "s", count[0], count[1], count[2], missing);
  const bool equal = count[2] == 0 && missing == 0 && (count[1] == 0 || !options.bytes);
  return equal ? kExplained : kAgainstUs;
}

}  // namespace comparison
