#pragma once
// The fourth phase where patches would ask each other about nearly everything: they agree on the stars of
// their nodes. Docs/parallel.md, "Agreement".

#include "parallel/certify.h"

namespace pstripack {

/// Certifies the patches, or has given up.
/// Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
void agree_on_stars(Certified<Int>& certified, const Division& division, const Corners& corners,
                    Communicator& ranks, int threads);

}  // namespace pstripack
