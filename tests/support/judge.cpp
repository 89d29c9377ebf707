#include "judge.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "reference_predicates.h"

namespace {

std::string at(const char* what, std::initializer_list<std::int32_t> nodes) {
  std::string text = what;
  for (const std::int32_t k : nodes) text += " " + std::to_string(k + 1);
  return text;
}

/// Position of neighbour b in the ring of a, or -1.
int find(const Rings& rings, std::int32_t a, std::int32_t b) {
  const auto& ring = rings.neighbours[a];
  const auto found = std::find(ring.begin(), ring.end(), b);
  return found == ring.end() ? -1 : static_cast<int>(found - ring.begin());
}

}  // namespace

std::string fault(const Nodes& nodes, const Rings& rings, exact::On on) {
  const std::int32_t n = static_cast<std::int32_t>(nodes.size());
  if (rings.neighbours.size() != nodes.size()) return "wrong number of nodes";
  std::int64_t arcs = 0, corners = 0, boundary = 0;
  for (std::int32_t k = 0; k < n; ++k) {
    const auto& ring = rings.neighbours[k];
    const std::int32_t degree = static_cast<std::int32_t>(ring.size());
    const bool open = rings.boundary[k];
    if (degree < (open ? 2 : 3)) return at("too few neighbours at node", {k});
    arcs += degree, corners += degree - open, boundary += open;
    // The first neighbour lies in the half-open sector from a to b of exactly one triangle of the star.
    int winds = 0, side = 0;  // side of the first neighbour, seen from k to a
    for (std::int32_t i = 0; i < degree; ++i) {
      const std::int32_t a = ring[i], b = ring[(i + 1) % degree];
      const int back = find(rings, a, k);
      if (back < 0) return at("arc one way only:", {k, a});
      if (open && i + 1 == degree) break;
      // The triangle k,a,b, seen from a: there b is followed by k.
      const auto& other = rings.neighbours[a];
      if (back == 0 && rings.boundary[a]) return at("triangle breaks off at its second corner:", {k, a, b});
      if (other[(back + other.size() - 1) % other.size()] != b) return at("triangle not closed:", {k, a, b});
      // Its other two corners see the same triangle, with the same determinant.
      if (k <= a && k <= b && exact::left(nodes[k], nodes[a], nodes[b]) <= 0)
        return at("triangle not counterclockwise:", {k, a, b});
      const int next_side = b == ring[0] ? 0 : exact::left(nodes[k], nodes[b], nodes[ring[0]]);
      winds += side >= 0 && next_side < 0;
      side = next_side;
      // The arc k,a has b on its left and, unless it is the first of a boundary node, d on its right.
      if (k < a && !(open && i == 0)) {
        const std::int32_t d = ring[(i + degree - 1) % degree];
        if (exact::above(on, nodes[k], nodes[a], nodes[b], nodes[d]) > 0)
          return at("not Delaunay:", {k, a, b, d});
      }
    }
    if (winds != 1) return at("the star winds not once at node", {k});
    if (open && exact::left(nodes[k], nodes[ring.front()], nodes[ring.back()]) < 0)
      return at("the boundary is not convex at node", {k});
  }
  const std::int64_t euler = n - arcs / 2 + corners / 3;
  if (euler != (boundary > 0 ? 1 : 2)) return "Euler number " + std::to_string(euler);
  std::vector<std::int32_t> reached{0};
  std::vector<char> seen(nodes.size(), 0);
  seen[0] = 1;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const std::int32_t b : rings.neighbours[reached[i]])
      if (!seen[b]) seen[b] = 1, reached.push_back(b);
  if (reached.size() != nodes.size()) return "not connected";
  return "";
}

exact::On lengths_call_for(const Nodes& nodes) {
  for (const auto& p : nodes) {
    const long double x = p.x, y = p.y, z = p.z, length = std::sqrt(x * x + y * y + z * z);
    if (!(std::fabs(length - 1) <= 1e-6L)) return exact::On::directions;
  }
  return exact::On::coordinates;
}

std::string fault(const Nodes& nodes, const Rings& rings) {
  std::string on_coordinates;
  if (lengths_call_for(nodes) == exact::On::coordinates) {
    on_coordinates = fault(nodes, rings, exact::On::coordinates);
    if (on_coordinates.empty()) return "";
    on_coordinates += "; on directions: ";
  }
  const std::string on_directions = fault(nodes, rings, exact::On::directions);
  return on_directions.empty() ? "" : on_coordinates + on_directions;
}

Faces brute_force(const Nodes& nodes, exact::On on) {
  const std::int32_t n = static_cast<std::int32_t>(nodes.size());
  Faces faces;
  const auto empty = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    for (std::int32_t d = 0; d < n; ++d)
      if (d != a && d != b && d != c && exact::above(on, nodes[a], nodes[b], nodes[c], nodes[d]) > 0)
        return false;
    return true;
  };
  for (std::int32_t a = 0; a < n; ++a)
    for (std::int32_t b = a + 1; b < n; ++b)
      for (std::int32_t c = b + 1; c < n; ++c) {
        const int sign = exact::left(nodes[a], nodes[b], nodes[c]);
        if (sign > 0 && empty(a, b, c)) faces.push_back({a, b, c});
        if (sign < 0 && empty(a, c, b)) faces.push_back({a, c, b});
      }
  sort_faces(faces);
  return faces;
}

int expected_ier(const Nodes& nodes) {
  if (nodes.size() < 3) return -1;
  if (exact::left(nodes[0], nodes[1], nodes[2]) == 0) return -2;
  // Equal directions have equal largest components of p/max|p| up to a few roundings: sort by a rounded key.
  std::unordered_map<std::int64_t, std::vector<std::size_t>> buckets;
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    const auto& p = nodes[m];
    const double largest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    const double key = (p.x / largest) * 3.1 + (p.y / largest) * 1.7 + (p.z / largest) * 0.9;
    const std::int64_t bucket = std::llround(key * 0x1p40);
    std::size_t first = m;
    for (std::int64_t b = bucket - 1; b <= bucket + 1; ++b)
      if (const auto found = buckets.find(b); found != buckets.end())
        for (const std::size_t l : found->second)
          if (l < first && exact::same_direction(nodes[l], p)) first = l;
    if (first != m) return static_cast<int>(first) + 1;
    buckets[bucket].push_back(m);
  }
  return 0;
}
