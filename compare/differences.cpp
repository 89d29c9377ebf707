#include "differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "determinant.h"
#include "only_in.h"

namespace comparison {
namespace {

using pstripack::index_t;
using pstripack::Triangle;
using pstripack::Triangles;

// Directed arcs u->v of a set of triangles, each with the triangle on its left.
class Arcs {
 public:
  struct Side {
    std::size_t triangle;
    index_t opposite;
  };

  explicit Arcs(const Triangles& triangles) {
    side_.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (int i = 0; i < 3; ++i)
        side_.emplace(key(triangles[t][i], triangles[t][(i + 1) % 3]), Side{t, triangles[t][(i + 2) % 3]});
  }

  const Side* left_of(index_t u, index_t v) const {
    const auto found = side_.find(key(u, v));
    return found == side_.end() ? nullptr : &found->second;
  }
  bool has(index_t u, index_t v) const { return left_of(u, v) || left_of(v, u); }

 private:
  static std::uint64_t key(index_t u, index_t v) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(u)) << 32 | static_cast<std::uint32_t>(v);
  }
  std::unordered_map<std::uint64_t, Side> side_;
};

// Calls f(u, v, triangle) for the three directed arcs of every triangle.
template <class F>
void for_each_side(const Triangles& triangles, F f) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) f(triangles[t][i], triangles[t][(i + 1) % 3], t);
}

constexpr int kUndecided = -1;

class Classifier {
 public:
  Classifier(const std::vector<Point>& points, const Mesh& original, const Mesh& ours, double epsilon,
             std::size_t show)
      : points_(points), original_(original), ours_(ours), epsilon_(epsilon), show_(show) {}

  Differences run() {
    theirs_only_ = only_in(original_.triangles, ours_.triangles);
    ours_only_ = only_in(ours_.triangles, original_.triangles);
    result_.original_triangles = theirs_only_.size();
    result_.our_triangles = ours_only_.size();
    if (result_.none()) return std::move(result_);

    using pstripack::Defect;
    const Defect defect = original_.verdict.defect;
    if (!ours_.verdict) {
      blame_all(Cause::ours_wrong, "our mesh: " + ours_.verdict.message);
    } else if (defect == Defect::malformed || defect == Defect::not_manifold) {
      blame_all(Cause::original_wrong, "the lists of the original: " + original_.verdict.message);
    } else {
      const Arcs theirs(theirs_only_), own(ours_only_);
      find_places(theirs, own);
      judge_triangles();
      judge_arcs_of_the_original(theirs, own);
      judge_the_rest(theirs, own);
    }
    std::stable_sort(result_.decisions.begin(), result_.decisions.end(),
                     [](const Decision& a, const Decision& b) { return a.cause > b.cause; });
    return std::move(result_);
  }

 private:
  // For a result that is not a mesh: everything has this cause.
  void blame_all(Cause cause, const std::string& text) {
    result_.count[static_cast<std::size_t>(cause)].places = 1;
    result_.decisions.push_back({cause, {}, text, "", ""});
  }

  // Two differing triangles belong to one place if they share an arc that only one mesh has, or if they lie
  // in different meshes on the same side of an arc of both.
  void find_places(const Arcs& theirs, const Arcs& own) {
    const std::size_t offset = theirs_only_.size();
    boost::disjoint_sets_with_storage<> set(offset + ours_only_.size());
    for_each_side(theirs_only_, [&](index_t u, index_t v, std::size_t t) {
      if (const auto* same = own.left_of(u, v)) set.union_set(t, offset + same->triangle);
      if (const auto* other = theirs.left_of(v, u); other && !own.has(u, v))
        set.union_set(t, other->triangle);
    });
    for_each_side(ours_only_, [&](index_t u, index_t v, std::size_t t) {
      if (const auto* other = own.left_of(v, u); other && !theirs.has(u, v))
        set.union_set(offset + t, offset + other->triangle);
    });
    place_.resize(offset + ours_only_.size());
    for (std::size_t t = 0; t < place_.size(); ++t) place_[t] = set.find_set(t);
    cause_of_place_.assign(place_.size(), kUndecided);
  }

  std::size_t place_of_theirs(std::size_t t) const { return place_[t]; }
  std::size_t place_of_ours(std::size_t t) const { return place_[theirs_only_.size() + t]; }

  // `describe` is called only if its text will be shown: making the text takes longer than the decision.
  template <class Describe>
  void blame(std::size_t place, Cause cause, std::vector<index_t> nodes, const Determinant* det,
             Describe describe) {
    cause_of_place_[place] = std::max(cause_of_place_[place], static_cast<int>(cause));
    if (described_[static_cast<std::size_t>(cause)]++ >= show_) return;
    result_.decisions.push_back(
        {cause, std::move(nodes), describe(), det ? det->value() : "", det ? det->bound(epsilon_) : ""});
  }

  // A clockwise triangle of the original is its error. A triangle of ours at the original's boundary was left
  // out by its LEFT.
  void judge_triangles() {
    for (std::size_t t = 0; t < theirs_only_.size(); ++t) {
      const auto [a, b, c] = theirs_only_[t];
      const Determinant det = left_test(points_[a], points_[b], points_[c]);
      if (det.sign() > 0) continue;
      blame(place_of_theirs(t), Cause::original_wrong, {a, b, c}, &det, [&, a = a, b = b, c = c] {
        return fmt::format("triangle {} {} {} of the original is {}: exact det(a,b,c) = {}", a + 1, b + 1,
                           c + 1, det.sign() < 0 ? "inverted" : "flat", det.value());
      });
    }
    std::vector<bool> has_triangle_of_original(place_.size());
    for (std::size_t t = 0; t < theirs_only_.size(); ++t) has_triangle_of_original[place_of_theirs(t)] = true;
    for (std::size_t t = 0; t < ours_only_.size(); ++t) {
      if (has_triangle_of_original[place_of_ours(t)]) continue;
      const auto [a, b, c] = ours_only_[t];
      const Determinant det = left_test(points_[a], points_[b], points_[c]);
      const bool small = det.within_rounding(epsilon_);
      blame(place_of_ours(t), small ? Cause::rounding : Cause::original_wrong, {a, b, c}, &det,
            [&, a = a, b = b, c = c] {
              return fmt::format(
                  "the original lacks triangle {} {} {} at its boundary: exact det(a,b,c) = {}, "
                  "rounding of its LEFT {}",
                  a + 1, b + 1, c + 1, det.value(), det.bound(epsilon_));
            });
    }
  }

  // An arc that only the original has: tests whether the opposite node on one side lies in the circle of the
  // other side, on it, or outside.
  void judge_arcs_of_the_original(const Arcs& theirs, const Arcs& own) {
    for_each_side(theirs_only_, [&](index_t u, index_t v, std::size_t t) {
      const auto* left = theirs.left_of(u, v);
      const auto* right = theirs.left_of(v, u);
      if (!right || u > v || own.has(u, v)) return;
      if (const auto cause = judge(place_of_theirs(t), u, v, left->opposite, right->opposite))
        ++result_.count[static_cast<std::size_t>(*cause)].original_arcs;
      else
        undecided_arcs_.push_back(t);
    });
  }

  // The cause of an arc u-v of the original with opposite nodes l and r. None if the arc is locally Delaunay:
  // then it differs only because of another arc nearby.
  std::optional<Cause> judge(std::size_t place, index_t u, index_t v, index_t l, index_t r) {
    const Point &pu = points_[u], &pv = points_[v], &pl = points_[l], &pr = points_[r];
    const Determinant det = swap_test(pu, pv, pl, pr);
    const bool by_directions = ours_.verdict.lengths == pstripack::Lengths::directions;
    const int decisive = by_directions ? pstripack::orientation_of_directions(pu, pv, pl, pr) : det.sign();
    if (decisive < 0) return std::nullopt;
    const Cause cause = decisive == 0                      ? Cause::exact_tie
                        : by_directions && det.sign() <= 0 ? Cause::directions
                        : det.within_rounding(epsilon_)    ? Cause::rounding
                                                           : Cause::original_wrong;
    blame(place, cause, {u, v, l, r}, &det, [&] {
      std::string text =
          fmt::format("arc {} - {} of the original, opposite nodes {} and {}: exact determinant {}", u + 1,
                      v + 1, l + 1, r + 1, det.value());
      if (cause == Cause::directions) text += "; locally Delaunay as given, not on the directions";
      if (cause == Cause::rounding) text += "; rounding of its test " + det.bound(epsilon_);
      if (cause == Cause::original_wrong)
        text += "; not locally Delaunay, the rounding of its test is only " + det.bound(epsilon_);
      return text;
    });
    return cause;
  }

  // Arcs and triangles without a cause get that of their place. Our mesh passes every exact check, so the
  // original's must fail one in each place; if none is found, the contradiction counts against us.
  void judge_the_rest(const Arcs& theirs, const Arcs& own) {
    for (std::size_t t = 0; t < place_.size(); ++t) {
      const std::size_t place = place_[t];
      if (cause_of_place_[place] != kUndecided) continue;
      const bool of_original = t < theirs_only_.size();
      const auto [a, b, c] = of_original ? theirs_only_[t] : ours_only_[t - theirs_only_.size()];
      const bool original_fails = !original_.verdict;
      blame(place, original_fails ? Cause::original_wrong : Cause::ours_wrong, {a, b, c}, nullptr,
            [&, a = a, b = b, c = c] {
              return fmt::format("triangle {} {} {} is only in {}", a + 1, b + 1, c + 1,
                                 of_original ? "the original" : "ours") +
                     (original_fails ? "; original: " + original_.verdict.message
                                     : ", and no exact check decides against the original");
            });
    }
    for (std::size_t t = 0; t < place_.size(); ++t)
      if (place_[t] == t) ++count_of_place(t).places;
    for (const std::size_t t : undecided_arcs_) ++count_of_place(place_of_theirs(t)).original_arcs;
    for_each_side(ours_only_, [&](index_t u, index_t v, std::size_t t) {
      if (u < v && own.left_of(v, u) && !theirs.has(u, v)) ++count_of_place(place_of_ours(t)).our_arcs;
    });
  }

  Count& count_of_place(std::size_t t) {
    return result_.count[static_cast<std::size_t>(cause_of_place_[place_[t]])];
  }

  const std::vector<Point>& points_;
  const Mesh& original_;
  const Mesh& ours_;
  double epsilon_;
  std::size_t show_;
  Triangles theirs_only_, ours_only_;
  std::vector<std::size_t> place_;  // per triangle, those of theirs_only_ before ours_only_: a representative
  std::vector<int> cause_of_place_;  // at representatives: the strongest cause, or kUndecided
  std::vector<std::size_t> undecided_arcs_;
  std::array<std::size_t, kCauses> described_{};  // number of decisions of each cause, shown or not
  Differences result_;
};

}  // namespace

const char* name(Cause cause) {
  static const char* const names[kCauses] = {"exact tie", "within its rounding", "directions (lengths)",
                                             "the original is wrong", "WE ARE WRONG"};
  return names[static_cast<std::size_t>(cause)];
}

const char* identifier(Cause cause) {
  static const char* const names[kCauses] = {"exact_tie", "rounding", "directions", "original_wrong",
                                             "ours_wrong"};
  return names[static_cast<std::size_t>(cause)];
}

Differences differences(const std::vector<Point>& points, const Mesh& original, const Mesh& ours,
                        double epsilon, std::size_t show) {
  return Classifier(points, original, ours, epsilon, show).run();
}

// At an inner node each neighbour ends one triangle and begins another. At a boundary node the first
// neighbour only begins one and the last only ends one.
std::vector<index_t> boundary_nodes(const Triangles& triangles) {
  index_t n = 0;
  for (const Triangle& t : triangles) n = std::max({n, t[0] + 1, t[1] + 1, t[2] + 1});
  std::vector<std::int64_t> balance(static_cast<std::size_t>(n));
  for_each_side(triangles, [&](index_t u, index_t v, std::size_t) {
    balance[u] += v;
    balance[v] -= u;
  });
  std::vector<index_t> nodes;
  for (index_t k = 0; k < n; ++k)
    if (balance[k] != 0) nodes.push_back(k);
  return nodes;
}

}  // namespace comparison
