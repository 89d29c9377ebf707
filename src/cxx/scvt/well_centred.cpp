#include "scvt/well_centred.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"
#include "geometry/measures.h"
#include "parallel/agreement.h"
#include "scvt/errors.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {
namespace {

/// Cosines of angles: triangles are bad if one is out of `least` to `most`; the others are what is aimed at,
/// so that few passes do.
struct Bounds {
  double least_wanted, most_wanted, least, most;
};
/// First no angle above 84 degrees, for which fewer generators move: where cells are rough, more would make
/// other triangles obtuse. Then 43.5 to 78.5 degrees.
constexpr Bounds kStages[] = {
    {0.12186934340514748, 1, 0.10452846326765346, 1},
    {0.21643961393810288, 0.7132504491541816, 0.19936793441719716, 0.7253743710122876}};
constexpr int kPatience = 15;  ///< passes without fewer bad triangles; 6 to 30 passes in all are usual

using Triangle = std::array<Point, 3>;

double cosine_at(const Triangle& t, std::size_t k) {
  const Point u = minus(t[(k + 1) % 3], t[k]), v = minus(t[(k + 2) % 3], t[k]);
  return dot(u, v) / std::sqrt(dot(u, u) * dot(v, v));
}

/// How corner 0 moves so that the cosine of the angle at corner k becomes `wanted`, to first order, if the
/// three corners move as little as they can: along its gradient.
///
///        k           cosine = u.v / (|u| |v|);  its gradient at the end of u is
///     u /.\ v        v / (|u| |v|) - cosine u / |u|^2,  likewise at the end of v,
///      /   \         and at k minus the sum of both.
Point step_of(const Triangle& t, std::size_t k, double wanted) {
  const Point u = minus(t[(k + 1) % 3], t[k]), v = minus(t[(k + 2) % 3], t[k]);
  const double uu = dot(u, u), vv = dot(v, v), size = std::sqrt(uu * vv), cosine = dot(u, v) / size;
  const Point at_u = minus(scaled(1 / size, v), scaled(cosine / uu, u));
  const Point at_v = minus(scaled(1 / size, u), scaled(cosine / vv, v));
  const Point at_k = scaled(-1, plus(at_u, at_v));
  const double length = (wanted - cosine) / (dot(at_u, at_u) + dot(at_v, at_v) + dot(at_k, at_k));
  return scaled(length, k == 0 ? at_k : k == 1 ? at_v : at_u);
}

/// What one pass finds: of this rank, then of all ranks.
struct Found {
  std::int64_t obtuse = 0, bad = 0;  // see Repair
  double excess = 0;                 // most that the cosine of an angle is out of bounds
  std::int64_t first =
      Smallest::kNone;   // smallest number of a corner of an obtuse triangle, else of a bad one
  Point place{0, 0, 0};  // its place
  void add(const Found& other) {
    if (std::pair(other.obtuse == 0, other.first) < std::pair(obtuse == 0, first))
      first = other.first, place = other.place;
    obtuse += other.obtuse;
    bad += other.bad;
    excess = std::max(excess, other.excess);
  }
};

class Repairer {
 public:
  Repairer(Evaluator& evaluator, std::vector<Point>& generators)
      : evaluator_(evaluator), generators_(generators) {
    evaluator_.allocate([this] {
      given_ = best_ = next_ = generators_;
      found_.resize(static_cast<std::size_t>(most_threads_for(10 * generators_.size())));
    });
  }

  Repair run() {
    Found best;
    for (const Bounds& bounds : kStages) {
      bounds_ = bounds;
      generators_ = best_;
      best = look();
      improve(best);
    }
    generators_ = best_;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < best_.size(); ++i) moved += best_[i] != given_[i];
    return {sum_of_all(evaluator_.ranks(), moved), best.obtuse, best.bad, best.place};
  }

 private:
  /// Moves from best_, at which look() was called last, to better ones.
  void improve(Found& best) {
    for (int passes = 1; best.bad > 0 && passes <= kPatience; ++passes) {
      std::swap(generators_, next_);
      Found found;
      try {
        found = look();
      } catch (const BadGenerators&) {  // far from centroidal: moved onto each other
        break;
      }
      const std::pair now(found.obtuse, found.bad), before(best.obtuse, best.bad);
      if (now > before || (now == before && found.excess >= best.excess)) continue;
      if (now < before) passes = 0;
      best = found;
      best_ = generators_;
    }
  }

  /// Triangulates the generators, and sets next_.
  Found look() {
    const Neighbourhood here = evaluator_.triangulate(generators_);
    std::fill(found_.begin(), found_.end(), Found{});
    const int threads = std::min(threads_for(10 * here.stars.count), static_cast<int>(found_.size()));
    parallel_pieces(here.stars.count, threads, [&](std::size_t first, std::size_t last, int piece) {
      Found& found = found_[static_cast<std::size_t>(piece)];
      for (std::size_t i = first; i < last; ++i) next_[i] = moved(here, i, found);
    });
    Found all;
    for (const Found& found : found_) all.add(found);
    const Parcels parcels = evaluator_.ranks().all_gather(&all, sizeof all);
    Found of_all_ranks;
    for (const Found& found : Items<Found>(parcels)) of_all_ranks.add(found);
    return of_all_ranks;
  }

  Point moved(const Neighbourhood& here, std::size_t i, Found& found) const {
    const std::size_t begin = here.stars.begin_of(i), end = here.stars.end_of(i);
    const auto neighbour = [&](std::size_t s) {
      return static_cast<std::size_t>(here.stars.neighbour[s]) - 1;
    };
    Point sum{0, 0, 0};
    bool moves = false;
    for (std::size_t s = begin; s < end; ++s) {
      const std::size_t j = neighbour(s), k = neighbour(s + 1 == end ? begin : s + 1);
      const Triangle triangle{here.points[i], here.points[j], here.points[k]};
      double excess = 0;
      for (std::size_t at = 0; at < 3; ++at) {
        const double cosine = cosine_at(triangle, at),
                     wanted = std::clamp(cosine, bounds_.least_wanted, bounds_.most_wanted);
        excess = std::max({excess, bounds_.least - cosine, cosine - bounds_.most});
        if (cosine == wanted) continue;
        sum = plus(sum, step_of(triangle, at, wanted));
        moves = true;
      }
      if (excess == 0 || here.numbers[j] < here.numbers[i] || here.numbers[k] < here.numbers[i]) continue;
      const Angles angles =
          angles_of(direction_of(triangle[0]), direction_of(triangle[1]), direction_of(triangle[2]));
      found.add({angles.are_acute ? 0 : 1, 1, excess, here.numbers[i], triangle[0]});
    }
    return moves ? normalized(plus(here.points[i], sum)) : here.points[i];
  }

  Evaluator& evaluator_;
  std::vector<Point>& generators_;
  std::vector<Point> next_, best_, given_;
  std::vector<Found> found_;  ///< by thread
  Bounds bounds_{};
};

}  // namespace

Repair make_well_centred(Evaluator& evaluator, std::vector<Point>& generators) {
  return Repairer(evaluator, generators).run();
}

}  // namespace pstripack::scvt
