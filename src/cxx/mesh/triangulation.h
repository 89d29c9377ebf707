#pragma once
// Triangles of a mesh; canonical form and fingerprint of a set of triangles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/splitmix64.h"
#include "geometry/predicates.h"

namespace pstripack {

/// Three node indices (from 0), counterclockwise seen from outside the sphere.
using Triangle = std::array<index_t, 3>;
using Triangles = std::vector<Triangle>;

/// Canonical form: every triangle starts with its smallest index, triangles in increasing order.
/// Two triangulations of the same nodes are equal if and only if their canonical forms are.
void make_canonical(Triangles& triangles);

/// Of three nodes, in this order.
inline std::uint64_t hash_of_triangle(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return splitmix64(splitmix64(splitmix64(0x9e3779b97f4a7c15u + a) + b) + c);
}
/// hashes: the sum of those of `count` triangles, which start with their smallest index.
inline std::uint64_t fingerprint_of(std::uint64_t hashes, std::uint64_t count) {
  return splitmix64(splitmix64(count) + hashes);
}
/// A hash of 64 bits that depends on the set of triangles only, not on their order or their first corners.
/// Different sets have equal fingerprints with a probability of about 2^-64.
std::uint64_t fingerprint(const Triangle* triangles, std::size_t count);
inline std::uint64_t fingerprint(const Triangles& t) { return fingerprint(t.data(), t.size()); }

}  // namespace pstripack
