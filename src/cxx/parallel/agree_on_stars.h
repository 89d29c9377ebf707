#pragma once
// The fourth phase if patches would ask each other about nearly all triangles: they agree on the stars of
// their nodes instead. Docs/parallel.md, "Agreement".

#include "parallel/certify.h"

namespace pstripack {

/// Certifies the patches, or sets certified.gave_up. Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
void agree_on_stars(Certified<Int>& certified, const Division& division, const Corners& corners,
                    Communicator& ranks, int threads);

}  // namespace pstripack
