#pragma once
// What patches ask each other about triangles that one of them lacks.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/partition.h"
#include "parallel/patch_hull.h"
#include "parallel/record.h"

namespace pstripack {

/// "You lack this triangle. Does any of your nodes lie above it?"
struct Question {
  Record corner[3];
  PatchNumber from, to;
};

/// One of the patches, and what it knows.
template <class Int>
struct PatchView {
  PatchNumber id;
  const Partition& partition;
  const PatchHull<Int>& hull;
  PatchNumber owner(HullNode v) const { return hull.is_own(v) ? id : partition.owner(hull.place(v)); }
};

/// The vertex of face t with the smallest number. Names of triangles begin there, so that each has one.
template <class Int>
std::uint32_t first_vertex(const PatchHull<Int>& hull, HullFace t) {
  const auto& vertex = hull.face(t).vertex;
  std::uint32_t first = 0;
  for (const std::uint32_t i : {1, 2})
    if (hull.number(vertex[i]) < hull.number(vertex[first])) first = i;
  return first;
}

/// A question about face t of the hull. The caller sets `to`.
template <class Int>
Question question_about(const PatchView<Int>& patch, HullFace t);

/// See Patch::answer. Throws HiddenNode, std::bad_alloc.
template <class Int>
std::vector<Record> answer(PatchHull<Int>& hull, const Question& question);

}  // namespace pstripack
