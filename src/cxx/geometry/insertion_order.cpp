#include "geometry/insertion_order.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "base/parallel_for.h"
#include "geometry/hilbert_curve.h"
#include "geometry/predicate_stages.h"

namespace pstripack {
namespace {

using hilbert::along_curve, hilbert::kLevels, hilbert::kSide, hilbert::kSwap;

// ---- the curve: over six faces of a cube, on each the one of hilbert_curve.h -----------------------

/// Where the ray through a node meets the cube: face 0..5, and (s,t) in [-1,1] there. Consecutive faces
/// join so that the curves on them make one curve.
struct OnCube {
  double s, t;
  int face;
};

OnCube on_cube(const Point& p) {
  // +x: (y,z)  +y: (-x,z)  +z: (-x,-y)  -x: (z,y)  -y: (z,-x)  -z: (-y,-x), all divided by |largest|
  // component; from tables, because a branch on random faces is mispredicted nearly always.
  static constexpr struct {
    std::int8_t s_axis, t_axis;
    double s_sign, t_sign;
  } face[6] = {{1, 2, 1, 1}, {0, 2, -1, 1}, {0, 1, -1, -1}, {2, 1, -1, -1}, {2, 0, -1, 1}, {1, 0, 1, 1}};
  const double v[3] = {p.x, p.y, p.z};
  const double a = std::fabs(p.x), b = std::fabs(p.y), c = std::fabs(p.z);
  const int largest = (b > a) | (c > (b > a ? b : a)) << 1;  // 0 x, 1 y, 2 or 3 z
  const int axis = largest > 2 ? 2 : largest;
  const int f = axis + 3 * std::signbit(v[axis]);
  const double inverse = 1 / std::fabs(v[axis]);
  if (!(inverse < 1e300))  // the inverse of a denormal overflows
    return {v[face[f].s_axis] / std::fabs(v[axis]) * face[f].s_sign,
            v[face[f].t_axis] / std::fabs(v[axis]) * face[f].t_sign, f};
  return {v[face[f].s_axis] * inverse * face[f].s_sign, v[face[f].t_axis] * inverse * face[f].t_sign, f};
}

/// The cell 0..cells-1 of a fraction in [0,1]. The factor puts 1 into the last cell.
std::uint32_t cell(double fraction, std::uint32_t cells) {
  return static_cast<std::uint32_t>(static_cast<int>(fraction * (static_cast<int>(cells) * (1 - 0x1p-40))));
}

// ---- sorting -----------------------------------------------------------------------------------
// An entry of 64 bits holds a key and, below it, the number of its node.

using Entry = std::uint64_t;
constexpr int kNodeBits = 29;  // leaves 35: 3 for the face, 2 x 15 for the cell

std::uint64_t key_of(Entry e) { return e >> kNodeBits; }
std::uint32_t node_of(Entry e) { return static_cast<std::uint32_t>(e & ((Entry{1} << kNodeBits) - 1)); }

/// Sorts n entries by their keys of key_bits bits. Returns the array that holds the result, `entries` or
/// `other`. A stable radix sort, least significant digit first, which alternates between the arrays; a
/// comparison sort for few entries.
Entry* sort(Entry* entries, Entry* other, std::size_t n, int key_bits) {
  const int passes = (key_bits + 11) / 12, digit_bits = (key_bits + passes - 1) / passes;
  const std::size_t digits = std::size_t{1} << digit_bits;
  if (8 * n < digits * static_cast<std::size_t>(passes)) {
    std::sort(entries, entries + n);
    return entries;
  }
  const int threads = threads_for(n);
  std::vector<std::size_t> next(digits * threads);  // [thread][digit]: where the thread puts its next entry
  for (int pass = 0; pass < passes; ++pass) {
    const int shift = kNodeBits + pass * digit_bits;
    const auto digit = [&](Entry e) { return (e >> shift) & (digits - 1); };
    const Entry* const from = entries;
    Entry* const to = other;
    std::fill(next.begin(), next.end(), 0);
    parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int t) {
      std::size_t* count = next.data() + digits * t;
      for (std::size_t i = first; i < last; ++i) ++count[digit(from[i])];
    });
    std::size_t sum = 0;
    for (std::size_t d = 0; d < digits; ++d)
      for (int t = 0; t < threads; ++t) sum += std::exchange(next[digits * t + d], sum);
    parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int t) {
      std::size_t* place = next.data() + digits * t;
      for (std::size_t i = first; i < last; ++i) to[place[digit(from[i])]++] = from[i];
    });
    std::swap(entries, other);
  }
  return entries;
}

// ---- isolated nodes ----------------------------------------------------------------------------

// An isolated node has no other node within 1/256 of the used length of the curve (for few nodes: within 16
// mean distances). In an even distribution no node is isolated.
constexpr std::size_t kEvenly = 16;
constexpr std::size_t kMostAlone = 256;

// ---- cells with many nodes ---------------------------------------------------------------------

constexpr std::size_t kCrowd = 16;  ///< cells with more nodes are refined

/// Points at equal distances in memory.
struct Points {
  const unsigned char* first;
  std::size_t stride;
  const Point& operator[](std::size_t i) const { return *reinterpret_cast<const Point*>(first + i * stride); }
};

/// A square on a face of the cube.
struct Square {
  double s0, t0, side;
  std::uint32_t cell_s(const OnCube& q, std::uint32_t cells) const { return cell((q.s - s0) / side, cells); }
  std::uint32_t cell_t(const OnCube& q, std::uint32_t cells) const { return cell((q.t - t0) / side, cells); }
};

struct Box {
  double s0 = 2, s1 = -2, t0 = 2, t1 = -2;
  void include(const OnCube& q) {
    s0 = std::min(s0, q.s), s1 = std::max(s1, q.s), t0 = std::min(t0, q.t), t1 = std::max(t1, q.t);
  }
  Square square() const { return {s0, t0, std::max(s1 - s0, t1 - t0)}; }
};

/// About 2^52 log2|v| plus a constant, with the sign of v: monotonic, with equal steps for equal ratios.
double logarithmic(double v) {
  std::int64_t bits;
  const double size = std::fabs(v);
  std::memcpy(&bits, &size, sizeof bits);
  return static_cast<double>(v < 0 ? -bits : bits);
}

/// True if [low, high] spans so many powers of two that equal parts would hardly separate them.
bool spans_scales(double low, double high) {
  constexpr double kOctave = 0x1p52, kOctaves = 32;
  return logarithmic(high) - logarithmic(low) > kOctaves * kOctave;
}

/// How the cells divide a square: into equal parts, or by exponent. The latter if most nodes lie in one of
/// the equal parts.
enum class Halving { equal, by_scale };

/// Orders the nodes of one cell, entries [first,last), along a curve through their bounding box.
///
/// Equal parts divide the side of a cell by at least 2^5 per level of recursion. Nodes that approach a
/// point with a coordinate 0 can span all scales of a double's exponent, and equal parts would need a level
/// for every few of them. Dividing by exponent separates all scales at once.
void refine(const Points& points, Entry* first, Entry* last, int depth, Halving division) {
  const std::size_t n = static_cast<std::size_t>(last - first);
  Buffer<OnCube> place(n);
  Box box;
  for (std::size_t k = 0; k < n; ++k) box.include(place[k] = on_cube(points[node_of(first[k])]));
  if (division == Halving::by_scale) {
    const bool s = spans_scales(box.s0, box.s1), t = spans_scales(box.t0, box.t1);
    const auto part = [](bool by_scale, double v, double low, double high) {
      if (!(high > low)) return 0.0;
      return by_scale ? (logarithmic(v) - logarithmic(low)) / (logarithmic(high) - logarithmic(low))
                      : (v - low) / (high - low);
    };
    if (s || t) {
      for (OnCube& q : place) q.s = part(s, q.s, box.s0, box.s1), q.t = part(t, q.t, box.t0, box.t1);
      box = {0, 1, 0, 1};
    }
  }
  const Square square = box.square();
  if (!(square.side > 0)) return;  // all directions are equal as doubles
  // Enough cells for few nodes in each; keys of 10, 20 or 30 bits.
  const int blocks = n < 8000 ? 1 : n < 8000000 ? 2 : 3;
  const std::uint32_t cells = 1u << (kLevels * blocks);
  Buffer<Entry> entries(2 * n);
  for (std::size_t k = 0; k < n; ++k)
    entries[k] = along_curve(square.cell_s(place[k], cells), square.cell_t(place[k], cells), blocks, 0)
                     << kNodeBits |
                 node_of(first[k]);
  const Entry* const sorted = sort(entries.data(), entries.data() + n, n, 2 * kLevels * blocks);
  std::copy(sorted, sorted + n, first);
  if (depth == 0) return;
  for (std::size_t i = 0, j; i < n; i = j) {
    for (j = i + 1; j < n && key_of(first[j]) == key_of(first[i]);) ++j;
    if (j - i > kCrowd)
      refine(points, first + i, first + j, depth - 1, 2 * (j - i) > n ? Halving::by_scale : Halving::equal);
  }
}

/// The square that the cells divide on each face: the bounding square of the nodes if all lie on one face,
/// else the whole face.
Square square_of_all(const Points& points, std::size_t n) {
  Box box;
  const int face = on_cube(points[0]).face;
  for (std::size_t i = 0; i < n; ++i) {
    const OnCube q = on_cube(points[i]);
    if (q.face != face) return {-1, -1, 2};
    box.include(q);
  }
  const Square square = box.square();
  return square.side > 0 ? square : Square{-1, -1, 2};
}

}  // namespace

std::size_t insertion_order(const Point* first_point, std::size_t n, std::uint32_t* order,
                            Workspace& workspace, std::size_t stride) {
  const Points points{reinterpret_cast<const unsigned char*>(first_point), stride};
  constexpr std::size_t kFew = 24;  // walks are short in any order
  if (n <= kFew) {
    std::iota(order, order + n, 0);
    return 0;
  }
  // Enough cells for few nodes in each if they are spread evenly. Keys of 20, 23 or 33 bits (20: the last
  // three bits dropped), sorted in two, two and three passes.
  const int blocks = n < 20000000 ? 2 : 3;
  const int dropped = n < 50000 ? 3 : 0;
  const std::uint32_t cells = blocks == 2 ? kSide * kSide : kSide * kSide * kSide;
  Entry* entries = workspace.for_phase<Entry>(n);
  Entry* const other = workspace.for_phase<Entry>(n);
  const int threads = threads_for(n);
  const Square square = square_of_all(points, n);
  std::vector<std::size_t> highest(static_cast<std::size_t>(threads));  // by rank, of each thread's nodes
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int thread) {
    std::size_t& high = highest[static_cast<std::size_t>(thread)] = first;
    for (std::size_t i = first; i < last; ++i) {
      if (lower_rank(points[high], points[i])) high = i;
      const OnCube q = on_cube(points[i]);
      const std::uint64_t along = along_curve(square.cell_s(q, cells), square.cell_t(q, cells), blocks,
                                              static_cast<std::uint16_t>(q.face & kSwap));
      entries[i] =
          (static_cast<std::uint64_t>(q.face) << (2 * kLevels * blocks) | along) >> dropped << kNodeBits | i;
    }
  });
  entries = sort(entries, other, n, 2 * kLevels * blocks + 3 - dropped);
  const std::uint64_t apart =
      (key_of(entries[n - 1]) - key_of(entries[0])) / std::min<std::size_t>(n / kEvenly, kMostAlone);
  std::uint64_t before = 0;
  std::vector<std::size_t> alone;
  for (std::size_t i = 0, j; i < n; i = j) {
    const std::uint64_t key = key_of(entries[i]);
    for (j = i + 1; j < n && key_of(entries[j]) == key;) ++j;
    if (j == i + 1 && (i == 0 || key - before > apart) && (j == n || key_of(entries[j]) - key > apart))
      alone.push_back(i);
    before = key;
    // Three levels by exponent and eleven in equal parts reach adjacent doubles.
    if (j - i > kCrowd) refine(points, entries + i, entries + j, 20, Halving::equal);
  }
  const auto is_lower = [&](std::size_t a, std::size_t b) { return lower_rank(points[a], points[b]); };
  const std::size_t high = *std::max_element(highest.begin(), highest.end(), is_lower);
  std::uint32_t* place_of_high = order;
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int) {
    auto next = std::lower_bound(alone.begin(), alone.end(), first);
    for (std::size_t i = first; i < last; ++i) {
      const bool is_alone = next != alone.end() && *next == i;
      std::uint32_t* const place = order + (is_alone ? next - alone.begin() : i + (alone.end() - next));
      *place = node_of(entries[i]);
      if (*place == high) place_of_high = place;
      next += is_alone;
    }
  });
  std::uint32_t* const end_of_alone = order + alone.size();
  if (place_of_high < end_of_alone) return alone.size();
  std::rotate(end_of_alone, place_of_high, place_of_high + 1);
  return alone.size() + 1;
}

}  // namespace pstripack
