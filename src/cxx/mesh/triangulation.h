#pragma once
// Triangles of a mesh; canonical form and fingerprint of a set of triangles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/predicates.h"

namespace pstripack {

/// Three node indices (from 0), counterclockwise seen from outside the sphere.
using Triangle = std::array<index_t, 3>;
using Triangles = std::vector<Triangle>;

/// Canonical form: every triangle starts with its smallest index, triangles in increasing order.
/// Two triangulations of the same nodes are equal if and only if their canonical forms are.
void make_canonical(Triangles& triangles);

/// A hash of 64 bits that depends on the set of triangles only, not on their order or their first corners.
/// Different sets have equal fingerprints with a probability of about 2^-64.
std::uint64_t fingerprint(const Triangle* triangles, std::size_t count);
inline std::uint64_t fingerprint(const Triangles& t) { return fingerprint(t.data(), t.size()); }

}  // namespace pstripack
