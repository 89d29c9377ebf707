#pragma once
// How the patches of all ranks ask each other, whatever it is.

#include <cstddef>
#include <vector>

#include "parallel/divide.h"
#include "parallel/patches.h"

namespace pstripack {

/// What the patches here want to know.
struct Questions {
  Questions() = default;
  Questions(const std::vector<Doubts>& of_patches, const PatchRanges& patches, std::size_t ranks);
  std::vector<std::vector<Question>> to_rank;
  std::size_t count = 0;
  // Here, or on any rank once these have agreed:
  OnAny about_triangles, about_arcs;
  OnAny have_grown;  ///< patches have taken in nodes since they asked last
  OnAny left_out;    ///< they have more questions than these
};

/// The answers of all ranks to the questions of this one. Patches take in the corners of all questions before
/// they answer any. Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Parcels answers_to(const Questions& questions, Patches<Int>& patches, Communicator& ranks, int threads);

/// The patches here take in the answers. Throws HiddenNode, std::bad_alloc.
template <class Int>
void learn(Patches<Int>& patches, const Questions& questions, const Parcels& answers, int threads);

}  // namespace pstripack
