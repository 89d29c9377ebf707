// Millions of small sets of nodes: compares lists and codes of TRMESH bit by bit with those of brute force in
// exact arithmetic, and at intervals with CGAL.
//
//   small_sets [--first A] [--count B] [--threads T]
//
// Case number k is the same in every run: 3 to 12 points of a pool of 16 in random order, now and then one of
// them twice. Some thousand consecutive cases share a pool. The signs of its triples and fours are computed
// once, by tests/support/reference_predicates.h; the triangulation then consists of all triples that no node
// lies above. Prints failing cases with their nodes, and ends with code 1 if there are any.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>

#include "point_sets.h"
#include "small_pools.h"
#include "support/judge.h"
#include "support/reference_predicates.h"
#include "trmesh/trmesh.h"
#ifdef HAVE_CGAL
#include "support/cgal_hull.h"
#endif

namespace {

constexpr std::uint64_t kCasesOfPool = 4096, kCgalEvery = 64;
constexpr int kMostNodes = 12;

using Mask = std::uint16_t;  // points of a pool, a bit each
static_assert(kPoolSize == 8 * sizeof(Mask));
constexpr Mask bit(int i) { return static_cast<Mask>(1u << i); }

template <class T>
using Triples = std::array<std::array<std::array<T, kPoolSize>, kPoolSize>, kPoolSize>;

// ---- A pool and its signs ----

/// For each triple of points a, b, c: the points above their plane, with the tie rule, and further points in
/// the plane.
struct Fours {
  Triples<Mask> above{}, in_plane{};
};

struct Pool {
  explicit Pool(std::uint64_t number) : points(make_pool(number)) {
    for (int a = 0; a < kPoolSize; ++a) {
      if (!has_direction(points[a])) {
        without_direction |= bit(a);
        continue;
      }
      if (lengths_call_for({points[a]}) == exact::On::directions) not_unit |= bit(a);
      for (int b = 0; b < kPoolSize; ++b)
        if (has_direction(points[b]) && exact::same_direction(points[a], points[b])) coincident[a] |= bit(b);
    }
    for (int a = 0; a < kPoolSize; ++a)
      for (int b = 0; b < a; ++b)
        for (int c = 0; c < b; ++c) {
          if ((bit(a) | bit(b) | bit(c)) & without_direction) continue;
          const auto sign = static_cast<std::int8_t>(exact::left(points[a], points[b], points[c]));
          left[a][b][c] = left[b][c][a] = left[c][a][b] = sign;
          left[b][a][c] = left[a][c][b] = left[c][b][a] = static_cast<std::int8_t>(-sign);
        }
  }

  const Fours& fours(exact::On on) {
    auto& made = fours_[on == exact::On::directions];
    if (!made) fill(on, made.emplace());
    return *made;
  }

  Nodes points;
  Mask without_direction = 0, not_unit = 0;
  std::array<Mask, kPoolSize> coincident{};  ///< for each point: all points in its direction, itself included
  Triples<std::int8_t> left{};

 private:
  void fill(exact::On on, Fours& fours) const {
    for (int a = 0; a < kPoolSize; ++a)
      for (int b = 0; b < a; ++b)
        for (int c = 0; c < b; ++c)
          for (int d = 0; d < c; ++d) {
            if (!all_different(a, b, c, d)) continue;
            const Point &p = points[a], &q = points[b], &r = points[c], &s = points[d];
            const int sign = exact::orientation(on, p, q, r, s);
            set(fours, {a, b, c, d}, sign != 0 ? sign : exact::above(on, p, q, r, s), sign == 0);
          }
  }

  using Point = pstripack::Point;

  /// True if no set of nodes with a triangulation lacks one of these because of another.
  bool all_different(int a, int b, int c, int d) const {
    return !((bit(a) | bit(b) | bit(c) | bit(d)) & without_direction) &&
           !(coincident[a] & (bit(b) | bit(c) | bit(d))) && !(coincident[b] & (bit(c) | bit(d))) &&
           !(coincident[c] & bit(d));
  }

  /// sign: of the four points in the order of v.
  static void set(Fours& fours, const std::array<int, 4>& v, int sign, bool flat) {
    int p[4] = {0, 1, 2, 3};
    do {
      int inversions = 0;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) inversions += p[j] > p[i];
      const int a = v[p[0]], b = v[p[1]], c = v[p[2]], d = v[p[3]];
      if ((inversions % 2 == 0 ? sign : -sign) > 0) fours.above[a][b][c] |= bit(d);
      if (flat) fours.in_plane[a][b][c] |= bit(d);
    } while (std::next_permutation(p, p + 4));
  }

  std::optional<Fours> fours_[2];
};

// ---- A case, and what it must give ----

struct Case {
  int n;
  std::array<int, kMostNodes> point;  ///< of the pool
};

Case make_case(std::uint64_t number) {
  point_sets::Random random(number);
  Case drawn{3 + static_cast<int>(random.below(kMostNodes - 2)), {}};
  std::array<int, kPoolSize> order;
  for (int i = 0; i < kPoolSize; ++i) order[i] = i;
  for (int i = 0; i < drawn.n; ++i) {
    std::swap(order[i], order[i + random.below(kPoolSize - i)]);
    drawn.point[i] = order[i];
  }
  if (random.below(16) == 0) drawn.point[random.below(drawn.n)] = drawn.point[random.below(drawn.n)];
  return drawn;
}

/// The arrays of a call, followed by entries that it must not write.
struct Outputs {
  std::int32_t list[6 * kMostNodes], lptr[6 * kMostNodes], lend[kMostNodes + 1], lnew, ier, node, other;
  Outputs() { std::fill_n(reinterpret_cast<std::int32_t*>(this), sizeof *this / sizeof lnew, -987654321); }
  bool operator==(const Outputs& that) const { return std::memcmp(this, &that, sizeof *this) == 0; }
};

struct SmallFaces {
  std::array<std::array<int, 3>, 2 * kMostNodes> face;  ///< points of the pool, counterclockwise
  int count = 0;
};

/// All triples of `nodes` with a positive determinant and no other node above; drops triples beyond the
/// largest possible number.
SmallFaces brute_force(const Pool& pool, const Fours& fours, Mask nodes) {
  SmallFaces faces;
  const auto add = [&](int a, int b, int c) {
    if (!(fours.above[a][b][c] & nodes) && faces.count < 2 * kMostNodes)
      faces.face[faces.count++] = {a, b, c};
  };
  int member[kPoolSize], count = 0;
  for (int i = 0; i < kPoolSize; ++i)
    if (nodes & bit(i)) member[count++] = i;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        const int a = member[i], b = member[j], c = member[k], sign = pool.left[a][b][c];
        if (sign > 0) add(a, b, c);
        if (sign < 0) add(a, c, b);
      }
  return faces;
}

enum class Outcome { as_given, directions, hidden, collinear, coincident, without_direction, contradiction };
constexpr int kOutcomes = 7;

struct Expected {
  Outcome outcome;
  Outputs outputs;
  Mask nodes = 0;  ///< those in the triangulation
  exact::On on = exact::On::coordinates;
  SmallFaces faces;
};

/// Writes the canonical lists of these faces of the first `n` nodes. False if the faces do not fit together.
bool write_lists(const Case& drawn, int n, const SmallFaces& faces, Outputs& out) {
  std::array<int, kPoolSize> number;
  for (int i = 0; i < n; ++i) number[drawn.point[i]] = i;
  constexpr int none = -1;
  std::array<std::array<int, kMostNodes>, kMostNodes>
      next;  // next[v][a]: follows a counterclockwise around v
  for (auto& row : next) row.fill(none);
  for (int f = 0; f < faces.count; ++f)
    for (int i = 0; i < 3; ++i) {
      int& after = next[number[faces.face[f][i]]][number[faces.face[f][(i + 1) % 3]]];
      if (after != none) return false;
      after = number[faces.face[f][(i + 2) % 3]];
    }
  std::int32_t slot = 0;
  for (int v = 0; v < n; ++v) {
    unsigned starts = 0, ends = 0;  // neighbours with a successor; with a predecessor
    for (int a = 0; a < n; ++a)
      if (next[v][a] != none) {
        if (ends & (1u << next[v][a])) return false;
        starts |= 1u << a, ends |= 1u << next[v][a];
      }
    const unsigned open = starts & ~ends;  // the first neighbour of a boundary node
    if (starts == 0 || (open & (open - 1))) return false;
    const int first = __builtin_ctz(open != 0 ? open : starts);
    const std::int32_t begin = slot;
    unsigned met = 0;
    for (int a = first; a != none && !(met & (1u << a)); a = next[v][a]) {
      met |= 1u << a;
      out.list[slot] = a + 1;
      out.lptr[slot] = slot + 2;
      ++slot;
    }
    if (met != (starts | ends)) return false;
    out.lptr[slot - 1] = begin + 1;
    if (open != 0) out.list[slot - 1] *= -1;
    out.lend[v] = slot;
  }
  out.lnew = slot + 1;
  return true;
}

Expected expected(Pool& pool, const Case& drawn) {
  Expected result{};
  Outputs& out = result.outputs;
  out.node = out.other = 0;
  const auto ends = [&](Outcome outcome, int ier) {
    out.ier = ier;
    result.outcome = outcome;
    return result;
  };
  for (int i = 0; i < drawn.n; ++i)
    if (pool.without_direction & bit(drawn.point[i])) {
      out.node = i + 1;
      return ends(Outcome::without_direction, -5);
    }
  if (pool.left[drawn.point[0]][drawn.point[1]][drawn.point[2]] == 0) return ends(Outcome::collinear, -2);
  int n = 0;
  while (n < drawn.n && !(pool.coincident[drawn.point[n]] & result.nodes))
    result.nodes |= bit(drawn.point[n++]);

  Outcome outcome = pool.not_unit & result.nodes ? Outcome::directions : Outcome::as_given;
  const auto decided = [&](exact::On on) {
    result.on = on;
    result.faces = brute_force(pool, pool.fours(on), result.nodes);
    Mask shown = 0;
    for (int f = 0; f < result.faces.count; ++f)
      for (const int corner : result.faces.face[f]) shown |= bit(corner);
    return shown == result.nodes;
  };
  if (outcome == Outcome::as_given && !decided(exact::On::coordinates)) outcome = Outcome::hidden;
  if (outcome != Outcome::as_given && !decided(exact::On::directions)) outcome = Outcome::contradiction;
  if (!write_lists(drawn, n, result.faces, out)) outcome = Outcome::contradiction;
  if (outcome == Outcome::contradiction || n == drawn.n) return ends(outcome, 0);
  int l = 0;
  while (!(pool.coincident[drawn.point[n]] & bit(drawn.point[l]))) ++l;
  out.node = l + 1, out.other = n + 1;
  return ends(Outcome::coincident, l + 1);
}

Outputs call_trmesh(const Pool& pool, const Case& drawn) {
  double x[kMostNodes], y[kMostNodes], z[kMostNodes];
  for (int i = 0; i < drawn.n; ++i) {
    const pstripack::Point& p = pool.points[drawn.point[i]];
    x[i] = p.x, y[i] = p.y, z[i] = p.z;
  }
  Outputs out;
  const pstripack::TrmeshResult result =
      pstripack::trmesh({drawn.n, {x, y, z}, {out.list, out.lptr, out.lend, &out.lnew}});
  out.ier = result.ier;
  out.node = static_cast<std::int32_t>(result.node);
  out.other = static_cast<std::int32_t>(result.other);
  return out;
}

#ifdef HAVE_CGAL
/// The planes of the faces, each as the set of nodes in it, sorted. They do not depend on the diagonals of
/// facets.
std::vector<Mask> planes(const SmallFaces& faces, const Fours& fours, Mask nodes) {
  std::vector<Mask> result;
  for (int f = 0; f < faces.count; ++f) {
    const auto [a, b, c] = faces.face[f];
    result.push_back(static_cast<Mask>((fours.in_plane[a][b][c] & nodes) | bit(a) | bit(b) | bit(c)));
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// True if CGAL finds the same facets.
bool agrees_with_cgal(Pool& pool, const Case& drawn, const Expected& right) {
  Nodes nodes;
  for (int i = 0; i < drawn.n; ++i) nodes.push_back(pool.points[drawn.point[i]]);
  const Hull hull = cgal_hull(nodes);
  SmallFaces faces;
  for (const auto& [a, b, c] : hull.faces) {
    if (faces.count == 2 * kMostNodes) return false;
    faces.face[faces.count++] = {drawn.point[a], drawn.point[b], drawn.point[c]};
  }
  const Fours& fours = pool.fours(exact::On::coordinates);
  return hull.hidden == 0 && planes(faces, fours, right.nodes) == planes(right.faces, fours, right.nodes);
}
#endif

// ---- The run ----

struct Counts {
  std::uint64_t cases = 0, ties = 0, cgal = 0, of[kOutcomes] = {};
  void add(const Counts& more) {
    cases += more.cases, ties += more.ties, cgal += more.cgal;
    for (int i = 0; i < kOutcomes; ++i) of[i] += more.of[i];
  }
};

class Run {
 public:
  Run(std::uint64_t first, std::uint64_t count)
      : first_(first), end_(first + count), next_pool_(first / kCasesOfPool) {}

  /// True if all cases are right.
  bool on_threads(unsigned threads) {
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back([this] { work(); });
    work();
    for (auto& thread : others) thread.join();
    print("");
    return wrong_ == 0;
  }

 private:
  void work() {
    for (std::uint64_t number; wrong_ < 10 && (number = next_pool_++) * kCasesOfPool < end_;) {
      Pool pool(number);
      Counts counts;
      const std::uint64_t begin = std::max(first_, number * kCasesOfPool),
                          end = std::min(end_, (number + 1) * kCasesOfPool);
      for (std::uint64_t k = begin; k < end; ++k) check(k, pool, counts);
      const std::lock_guard<std::mutex> lock(mutex_);
      const std::uint64_t before = counts_.cases;
      counts_.add(counts);
      if (before / kProgress != counts_.cases / kProgress) print("so far: ");
    }
  }

  void check(std::uint64_t number, Pool& pool, Counts& counts) {
    const Case drawn = make_case(number);
    const Expected right = expected(pool, drawn);
    ++counts.cases;
    ++counts.of[static_cast<int>(right.outcome)];
    if (right.outcome == Outcome::contradiction) return fail(number, pool, drawn, right, "brute force");
    if (!(call_trmesh(pool, drawn) == right.outputs)) return fail(number, pool, drawn, right, "TRMESH");
    if (right.faces.count == 0) return;
    const Fours& fours = pool.fours(right.on);
    bool tie = false, flat = false;
    for (int f = 0; f < right.faces.count; ++f) {
      const auto [a, b, c] = right.faces.face[f];
      const int others = __builtin_popcount(fours.in_plane[a][b][c] & right.nodes);
      tie = tie || others > 0;
      flat = flat || others + 3 == drawn.n;
    }
    counts.ties += tie;
#ifdef HAVE_CGAL
    // A flat hull has no facets.
    if (number % kCgalEvery != 0 || right.outcome != Outcome::as_given || flat) return;
    ++counts.cgal;
    if (!agrees_with_cgal(pool, drawn, right)) fail(number, pool, drawn, right, "CGAL");
#endif
  }

  void fail(std::uint64_t number, const Pool& pool, const Case& drawn, const Expected& right,
            const char* who) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++wrong_;
    std::printf("case %" PRIu64 " (%s): %s is wrong; expected IER = %d, found %d\n", number,
                pool_family(number / kCasesOfPool), who, right.outputs.ier, call_trmesh(pool, drawn).ier);
    for (int i = 0; i < drawn.n; ++i) {
      const pstripack::Point& p = pool.points[drawn.point[i]];
      std::printf("  %a %a %a\n", p.x, p.y, p.z);
    }
    std::fflush(stdout);
  }

  void print(const char* what) const {
    const auto of = [&](Outcome outcome) { return counts_.of[static_cast<int>(outcome)]; };
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    std::printf("%s%" PRIu64 " cases from %" PRIu64 ": decided as given %" PRIu64 ", on directions %" PRIu64
                ", on directions because hidden %" PRIu64 ", IER -2 %" PRIu64 ", L %" PRIu64 ", -5 %" PRIu64
                "; with ties %" PRIu64 "; with CGAL %" PRIu64 "; wrong %d; %.0f s\n",
                what, counts_.cases, first_, of(Outcome::as_given), of(Outcome::directions),
                of(Outcome::hidden), of(Outcome::collinear), of(Outcome::coincident),
                of(Outcome::without_direction), counts_.ties, counts_.cgal, wrong_.load(), seconds.count());
    std::fflush(stdout);
  }

  static constexpr std::uint64_t kProgress = 1000000;
  const std::uint64_t first_, end_;
  std::atomic<std::uint64_t> next_pool_;
  std::atomic<int> wrong_{0};
  std::mutex mutex_;
  Counts counts_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"TRMESH of small degenerate sets of nodes against brute force and CGAL"};
  std::uint64_t first = 0, count = 1000000;
  unsigned threads = 1;
  app.add_option("--first", first, "number of the first case")->capture_default_str();
  app.add_option("--count", count, "number of cases")->capture_default_str();
  app.add_option("--threads", threads)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return Run(first, count).on_threads(threads) ? 0 : 1;
}
