#pragma once
// The fourth phase by one protocol: patches compare lists of the triangles that both answer for, until all
// lists match. Docs/parallel.md.

#include "parallel/certify.h"

namespace pstripack {

/// Certifies the patches, or sets certified.gave_up: after too many rounds, if a rank has more than `most`
/// triangles that others lack, or if nodes coincide. Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
void agree_on_lists(Certified<Int>& certified, const Division& division, Communicator& ranks, int threads,
                    std::size_t most);

}  // namespace pstripack
