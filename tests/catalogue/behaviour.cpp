#include "behaviour.h"

#include <algorithm>
#include <cmath>

#include "original.h"
#include "support/judge.h"
#include "support/reference_predicates.h"
#include "support/trmesh.h"

namespace {

struct Counts {
  std::size_t arcs = 0, triangles = 0, boundary = 0, inverted = 0, flat = 0, not_delaunay = 0, not_convex = 0;
};

bool symmetric(const Rings& rings) {
  for (std::size_t k = 0; k < rings.neighbours.size(); ++k)
    for (const std::int32_t j : rings.neighbours[k]) {
      const auto& other = rings.neighbours[static_cast<std::size_t>(j)];
      if (std::find(other.begin(), other.end(), static_cast<std::int32_t>(k)) == other.end()) return false;
    }
  return true;
}

Counts count(const Nodes& nodes, const Rings& rings, exact::On on) {
  Counts c;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto& ring = rings.neighbours[k];
    const bool open = rings.boundary[k];
    c.arcs += ring.size();  // each arc counts twice
    c.boundary += open;
    c.not_convex += open && exact::left(nodes[k], nodes[ring.front()], nodes[ring.back()]) < 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t node = k, a = ring[i], b = ring[(i + 1) % ring.size()],
                        d = ring[(i + ring.size() - 1) % ring.size()];
      const bool last = open && i + 1 == ring.size(), first = open && i == 0;
      if (!last && node < a && node < b) {
        const int sign = exact::left(nodes[k], nodes[a], nodes[b]);
        ++c.triangles, c.inverted += sign < 0, c.flat += sign == 0;
      }
      if (!last && !first && node < a)
        c.not_delaunay += exact::orientation(on, nodes[k], nodes[a], nodes[b], nodes[d]) > 0;
    }
  }
  return c;
}

bool are_directions(const Nodes& nodes) {
  return std::all_of(nodes.begin(), nodes.end(), [](const auto& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
           (p.x != 0 || p.y != 0 || p.z != 0);
  });
}

std::string some(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::string behaviour(const Nodes& nodes, int ier, const Lists& lists) {
  const std::string code = std::to_string(ier);
  if (ier != 0 || !are_directions(nodes)) return code;
  const auto rings = rings_of(lists);
  if (!rings || !symmetric(*rings)) return code + ": broken lists";
  Counts c = count(nodes, *rings, lengths_call_for(nodes));
  if (c.not_delaunay > 0)  // lengths near 1 may hide a node: then directions decide
    c.not_delaunay = std::min(c.not_delaunay, count(nodes, *rings, exact::On::directions).not_delaunay);
  std::string text = code + ": " + some(c.triangles, "triangle", "triangles") + ", " +
                     some(c.boundary, "boundary node", "boundary nodes");
  if (c.inverted > 0) text += ", " + std::to_string(c.inverted) + " inverted";
  if (c.flat > 0) text += ", " + std::to_string(c.flat) + " flat";
  if (c.not_delaunay > 0) text += ", " + some(c.not_delaunay, "arc", "arcs") + " not Delaunay";
  if (c.not_convex > 0) text += ", not convex at " + some(c.not_convex, "node", "nodes");
  const auto euler =
      static_cast<std::int64_t>(nodes.size() + c.triangles) - static_cast<std::int64_t>(c.arcs / 2);
  if (euler != (c.boundary > 0 ? 1 : 2)) text += ", Euler number " + std::to_string(euler);
  return text;
}

std::string our_behaviour(const Nodes& nodes) {
  const Mesh m = trmesh(nodes);
  return behaviour(nodes, m.ier, m);
}

std::string original_behaviour(const Nodes& nodes, double time_limit) {
  using namespace legacy_stripack;
  static const Original original(configured_original().value());
  const Triangulation t = original.triangulate(nodes, time_limit);
  if (t.outcome == Outcome::timed_out) return "does not return";
  if (t.outcome != Outcome::returned) return "crashes";
  Lists lists;
  lists.list = t.list, lists.lptr = t.lptr, lists.lend = t.lend, lists.lnew = t.lnew;
  return behaviour(nodes, t.ier, lists);
}
