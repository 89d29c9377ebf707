#pragma once
// The rings of a hull, by the tests' own code.

#include "lists.h"
#include "mesh/delaunay.h"

/// Of `nodes` nodes, none of which coincide.
inline Rings rings_of_hull(const pstripack::Hull& hull, std::size_t nodes) {
  Faces faces;
  for (std::size_t t = 0; t < hull.face_count; ++t) {
    const auto& v = hull.faces[t].vertex;
    const auto node = [&](int i) { return static_cast<std::int32_t>(hull.order[v[i]]); };
    if (hull.front(t)) faces.push_back({node(0), node(1), node(2)});
  }
  return *rings_of(nodes, faces);
}
