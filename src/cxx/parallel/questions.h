#pragma once
// How the questions and answers of patches travel between ranks.

#include <cstddef>
#include <vector>

#include "parallel/divide.h"
#include "parallel/patches.h"

namespace pstripack {

/// What the patches here have and others lack.
struct Questions {
  Questions() = default;
  Questions(const std::vector<std::vector<Question>>& of_patches, const PatchRanges& patches);
  std::vector<std::vector<Question>> to_rank;
  std::size_t count = 0;
  OnAny exist;  ///< here, or on any rank once these have agreed
};

/// The answers of all ranks to the questions of this one. Patches take in the corners of all questions before
/// they answer any. Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Parcels answers_to(const Questions& questions, Patches<Int>& patches, Communicator& ranks, int threads);

/// The patches here take in the answers. Throws HiddenNode, std::bad_alloc.
template <class Int>
void learn(Patches<Int>& patches, const Questions& questions, const Parcels& answers, int threads);

}  // namespace pstripack
