// Let A = a - p for the place p and a node a; |p| = |a| = 1.
//
// A barycentric weight is p.(B x C), and relative to |B| |C| it is right up to 13u: 2u and 2^-99 in each
// side, 4u for the products and 4u for the sums and p. So doubles suffice unless p sees the arc b-c at an
// angle below 4 or above 176 degrees.
//
// The area that a node q loses to p is that of a polygon:
//
//          v0     s       s and r: the nodes after and before q in the ring around p
//       w1 |              v0, v1: the circumcentres of p,q,s and p,r,q, on the border between p and q
//     p    |  q           w1, w2, ...: those of the lost triangles q,s,t; q,t,...; ...; q,...,r of the mesh
//       w2 |
//          v1     r
//
// It is the sum of the triangles v0, w, w', where w and w' are neighbours in the chain w1, w2, ..., v1: one
// for each arc from q to another neighbour t, and one for r. All circumcentres are normals n = (b-a) x (c-a),
// and two neighbours in the chain have an arc q-t in common, which is at right angles to both. By (a x b) x
// (b x c) = b det(a,b,c), for the triangles q,t1,t and q,t,t2 of w and w'
//
//     det(n0, n, n') = height of t below p,q,s * height of t2 below q,t1,t,
//
// where a height is the determinant of the differences of four nodes: positive because the mesh is Delaunay,
// with p in it, and without p. So the areas are products of positive numbers, each right relative to itself,
// divided by lengths of normals, and
//
//     tan(area/2) = det(n0, n, n') / (|n0| |n| |n'|) / (1 + the cosines between the normals).
//
// For small triangles the three differences are nearly in a plane. As p.A = -|A|^2 / 2, the height is
//
//     (|A|^2 p.(B x C) + |B|^2 p.(C x A) + |C|^2 p.(A x B)) / 2,
//
// with an error of some u |A| |B| |C| (|A| + |B| + |C|) at every scale.

#include "geometry/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/arithmetics.h"

namespace pstripack {
namespace {

using namespace arithmetics;

/// Largest error of a determinant, relative to itself: 13u where its sides have a sine of 1/16. That of a
/// barycentric weight is at most twice that.
constexpr double kOfDeterminant = 208 * u;
/// Largest errors in doubles: of all lost areas, relative to their sum, and of one, relative to itself. That
/// of a weight is at most twice the first. The bounds of the errors of heights are too large for less, at
/// triangles of usual shapes and with the time that there is.
constexpr double kOfAll = 0x1p-41, kOfLostArea = 0x1p-33;
/// The largest error of one, relative to itself, where doubles do not suffice.
constexpr double kOfMoreBits = 64 * u;

/// A side; `error` is relative to its length.
template <class T>
struct Side {
  Vector3<T> d;
  T square, size;
  double error;

  template <class Corner>
  static Side between(const Corner& to, const Corner& from) {
    using A = Arithmetic<T>;
    Side side;
    side.d = A::side(to, from);
    side.square = dot(side.d, side.d);
    side.size = A::square_root(side.square);
    if constexpr (std::is_same_v<T, double>)
      side.error = side.square >= 0x1p-90 ? 3 * u : 1;
    else
      side.error = A::kSide + std::ldexp(1, A::kApart) / A::value(side.size);
    return side;
  }
};

/// True if the side has at least as many digits as a double.
template <class T>
bool is_long_enough(const Side<T>& side) {
  return side.error <= 0x1p-51;
}

// ---- barycentric weights ------------------------------------------------------------------------------

/// det(place, b, c) * 2^-2e. False if it is not certain to be accurate enough; an error of `negligible` is
/// accurate enough.
template <class T>
bool find_determinant(const Direction& place, const Direction& b, const Direction& c, int exponent,
                      double negligible, double& det) {
  using A = Arithmetic<T>;
  const auto p = A::corner(place);
  const auto to_b = Side<T>::between(A::corner(b), p), to_c = Side<T>::between(A::corner(c), p);
  const T exact = dot(A::position(p), cross(to_b.d, to_c.d)), sides = to_b.size * to_c.size;
  const double error = to_b.error + to_c.error + 9 * A::kUnit;  // relative to the sides
  det = std::max(A::value(exact, -2 * exponent), 0.0);
  return is_long_enough(to_b) && is_long_enough(to_c) &&
         (error <= kOfDeterminant * A::value(exact / sides) || error * A::value(sides) <= negligible);
}

/// The sine of the angle between two directions.
double sine_between(const Direction& a, const Direction& b) {
  double sine = 0;
  with_enough_bits([&](auto zero) {
    using T = decltype(zero);
    using A = Arithmetic<T>;
    const auto side = Side<T>::between(A::corner(b), A::corner(a));
    const T rest = number<T>(4) - side.square;
    sine = A::value(side.size * A::square_root(rest)) / 2;
    return is_long_enough(side) && 4 * (side.error + A::kUnit) <= 8 * u * A::value(rest);
  });
  return sine;
}

/// The exponent of the unit in which a side's square does not underflow: 0 but for sides below 2^-100.
int exponent_for(const Direction& a, const Direction& b) {
  const Point d = difference(a, b);
  if (dot(d, d) >= 0x1p-90) return 0;
  const double length = arc_length(a, b);
  return length < 0x1p-100 ? std::max(std::ilogb(length), -500) : 0;
}

// ---- natural neighbours -------------------------------------------------------------------------------

/// The unit normal of a triangle with two sides from one corner; `error` is relative to the normal's length.
template <class T>
struct Normal {
  Vector3<T> n, unit;
  T inverse;  ///< 1 over the length of n
  double error;

  static Normal of(const Side<T>& a, const Side<T>& b) {
    using A = Arithmetic<T>;
    const Vector3<T> n = cross(a.d, b.d);
    const T inverse = number<T>(1) / A::square_root(dot(n, n));
    return {n,
            {n.x * inverse, n.y * inverse, n.z * inverse},
            inverse,
            A::value(a.size * b.size * inverse) * (a.error + b.error + 4 * A::kUnit) + 4 * A::kUnit};
  }
};

/// A height or an area, and the bound of its error.
template <class T>
struct Bounded {
  T value, error;
};

/// The height of three nodes, seen from a fourth; ab, bc, ca are the areas between the sides.
template <class T>
Bounded<T> height(const Side<T>& a, const Side<T>& b, const Side<T>& c, const T& ab, const T& bc,
                  const T& ca) {
  const double error = 2 * std::max({a.error, b.error, c.error}) + 7 * Arithmetic<T>::kUnit;
  return {number<T>(0.5) * (a.square * bc + b.square * ca + c.square * ab),
          number<T>(error) * (a.size * b.size * c.size) * (a.size + b.size + c.size)};
}

/// The place and the cavity around it.
template <class T>
class Star {
  using A = Arithmetic<T>;

 public:
  void see(const Direction& place, const Cavity& cavity) {
    const typename A::Corner p = A::corner(place);
    const Vector3<T> position = A::position(p);
    const auto area = [&](const Side<T>& v, const Side<T>& w) { return dot(position, cross(v.d, w.d)); };
    least_accurate_ = 0;
    const auto seen = [&](const Side<T>& side) -> const Side<T>& {
      least_accurate_ = std::max(least_accurate_, side.error);
      return side;
    };
    const auto& nodes = cavity.nodes;
    const std::size_t count = nodes.size();
    const auto between = [&](std::uint32_t to, std::uint32_t from) {
      return Side<T>::between(A::corner(*nodes[to].direction), A::corner(*nodes[from].direction));
    };

    side_.resize(count), normal_.resize(count), area_.resize(count);
    for (std::size_t j = 0; j < count; ++j)
      side_[j] = seen(Side<T>::between(A::corner(*nodes[j].direction), p));
    for (std::size_t j = 0; j < count; ++j) {
      normal_[j] = Normal<T>::of(side_[j], side_[nodes[j].next]);
      area_[j] = dot(position, normal_[j].n);
    }
    triangle_.resize(cavity.triangles.size());
    for (std::size_t k = 0; k < triangle_.size(); ++k) {
      const auto [a, b, c] = cavity.triangles[k];
      triangle_[k].normal = Normal<T>::of(seen(between(b, a)), seen(between(c, a)));
      triangle_[k].height = height(side_[a], side_[b], side_[c], area(side_[a], side_[b]),
                                   area(side_[b], side_[c]), area(side_[c], side_[a]));
    }

    lost_.assign(count, {number<T>(0), number<T>(0)});
    for (const auto& [q, t, left, right] : cavity.arcs) {
      const auto x = third(cavity.triangles[left], q, t), y = third(cavity.triangles[right], q, t);
      const typename A::Corner from = A::corner(*nodes[q].direction);
      const Vector3<T> at_q = A::position(from);
      const Side<T> to_y = seen(between(y, q)), to_t = seen(between(t, q)), to_x = seen(between(x, q));
      const Bounded<T> of_arc = height(to_y, to_t, to_x, dot(at_q, cross(to_y.d, to_t.d)),
                                       dot(at_q, cross(to_t.d, to_x.d)), dot(at_q, cross(to_x.d, to_y.d)));
      const Normal<T>&n = triangle_[left].normal, &m = triangle_[right].normal;
      const T area_qt = area(side_[q], side_[t]), cosine = dot(n.unit, m.unit);
      const auto see_node = [&](std::uint32_t node, std::uint32_t other, const T& area_of_arc) {
        const std::uint32_t next = nodes[node].next;
        const Bounded<T> of_node = height(side_[node], side_[next], side_[other], area_[node],
                                          area(side_[next], side_[other]), area_of_arc);
        add(of_node, of_arc, normal_[node], n, m, cosine, lost_[node]);
      };
      see_node(q, t, number<T>(-1) * area_qt);
      see_node(t, q, area_qt);
    }
    for (std::uint32_t r = 0; r < count; ++r) {
      const std::uint32_t q = nodes[r].next, s = nodes[q].next;
      const auto& [normal, of_triangle] = triangle_[nodes[r].triangle];
      const bool is_same = nodes[q].triangle == nodes[r].triangle;  // q is in this triangle only
      const Bounded<T> of_node =
          is_same ? of_triangle
                  : height(side_[q], side_[s], side_[r], area_[q], area(side_[s], side_[r]), area_[r]);
      add(of_node, of_triangle, normal_[q], normal, normal_[r], dot(normal.unit, normal_[r].unit), lost_[q]);
    }
  }

  /// The area that node j loses, and the bound of its error.
  const Bounded<T>& lost(std::size_t j) const { return lost_[j]; }
  /// False if a side has so few digits that the bounds do not hold.
  bool is_accurate() const { return least_accurate_ <= 0x1p-51; }

 private:
  static T absolute(const T& v) { return A::value(v) < 0 ? number<T>(-1) * v : v; }

  static std::uint32_t third(const std::array<std::uint32_t, 3>& corner, std::uint32_t a, std::uint32_t b) {
    return corner[0] ^ corner[1] ^ corner[2] ^ a ^ b;
  }

  /// Adds the area of the triangle with the corners n0, n, m, where det(n0, n, m) = x y. `cosine` is n.m.
  static void add(const Bounded<T>& x, const Bounded<T>& y, const Normal<T>& n0, const Normal<T>& n,
                  const Normal<T>& m, const T& cosine, Bounded<T>& area) {
    const T lengths = n0.inverse * n.inverse * m.inverse;
    const T numerator = x.value * y.value * lengths,
            denominator = (number<T>(1) + cosine) + (dot(n0.unit, n.unit) + dot(n0.unit, m.unit));
    const double errors =
        n0.error + n.error + m.error + 6 * A::kUnit;  // of the lengths; half of the denominator's
    const T size_x = absolute(x.value), size_y = absolute(y.value);
    const T error_of_numerator =
        (size_x * y.error + x.error * (size_y + y.error) + number<T>(errors) * (size_x * size_y)) * lengths;
    const T inverse = number<T>(1) / denominator, tangent = numerator * inverse;
    const double d = A::value(denominator);
    if (d > 1 && std::fabs(A::value(tangent)) < 0x1p-10) {  // the next term of the series is below 2^-60
      const T square = tangent * tangent, twice = number<T>(2) * tangent;
      area.value =
          area.value + twice * (number<T>(1) - square * (number<T>(1.0 / 3) - number<T>(0.2) * square));
      area.error = area.error + number<T>(2) * error_of_numerator * inverse +
                   number<T>(2 * errors + 8 * u) * absolute(twice);
      return;
    }
    const double c = A::value(numerator), angle = 2 * std::atan2(c, d);
    area.value = area.value + number<T>(angle);
    area.error =
        area.error + number<T>(2 * (std::fabs(d) * A::value(error_of_numerator) + std::fabs(c) * 2 * errors) /
                                   (c * c + d * d) +
                               8 * u * std::fabs(angle));
  }

  struct Triangle {
    Normal<T> normal;
    Bounded<T> height;  // of the place above it
  };
  std::vector<Side<T>> side_;      // from the place to the nodes
  std::vector<Normal<T>> normal_;  // of place, node j, next node
  std::vector<T> area_;            // of the same
  std::vector<Triangle> triangle_;
  std::vector<Bounded<T>> lost_;
  double least_accurate_ = 0;
};

/// Finds the areas anew that are to blame if the sum of all errors exceeds `most` or an error exceeds its own
/// bound.
[[gnu::noinline]] void add_bits(const Direction& place, Cavity& cavity, double most) {
  const std::size_t count = cavity.nodes.size();
  int exponent = 0;
  for (const Cavity::Node& node : cavity.nodes)
    exponent = std::min(exponent, exponent_for(place, *node.direction));
  std::vector<bool> open(count);
  for (std::size_t j = 0; j < count; ++j)
    open[j] =
        !(cavity.errors[j] <= std::min(most / static_cast<double>(count), kOfLostArea * cavity.weights[j]));
  for (double& area : cavity.weights) area = std::ldexp(area, -2 * exponent);
  with_more_bits([&](auto zero) {
    using A = Arithmetic<decltype(zero)>;
    Star<decltype(zero)> star;
    star.see(place, cavity);
    bool done = star.is_accurate();
    for (std::size_t j = 0; j < count; ++j)
      if (open[j]) {
        const auto& [area, error] = star.lost(j);
        cavity.weights[j] = A::value(area, -2 * exponent);
        open[j] = !(star.is_accurate() && A::value(error, -2 * exponent) <= kOfMoreBits * cavity.weights[j]);
        done = done && !open[j];
      }
    return done;
  });
}

}  // namespace

bool is_beyond(const Direction& place, const Direction& b, const Direction& from) {
  // The components at a right angle to b of the differences e, which is scaled against underflow, and f:
  // their product is e.f - (e.b) (f.b) with e.b = -|e|^2/2. What e.f loses by rounding is below 8u of |e|
  // |f|.
  Point e = accurate_difference(from, b);
  const Point f = accurate_difference(place, b);
  const double scale = 1 / std::max({std::fabs(e.x), std::fabs(e.y), std::fabs(e.z)}), ee = dot(e, e);
  e = {scale * e.x, scale * e.y, scale * e.z};
  return dot(e, f) - scale * ee * dot(f, f) / 4 <= 0;
}

void barycentric_weights(const Direction& place, const Corners& corner, double (&weight)[3]) {
  if (!find_ordinary_determinants(place, corner, weight)) {
    int exponent = 0;
    for (const Direction* c : corner) exponent = std::min(exponent, exponent_for(place, *c));
    double negligible = 0;
    for (const double w : weight) negligible += 0x1p-80 * std::max(w, 0.0);
    for (int k = 0; k < 3; ++k) {
      if (weight[k] > 0) {
        weight[k] = std::ldexp(weight[k], -2 * exponent);
        continue;
      }
      const Direction &b = *corner[(k + 1) % 3], &c = *corner[(k + 2) % 3];
      if (left(place.given, b.given, c.given) <= 0) {
        double of_b = sine_between(place, c), of_c = sine_between(place, b);
        if (is_beyond(place, b, c)) of_c = 0;
        if (is_beyond(place, c, b)) of_b = 0;
        weight[k] = 0, weight[(k + 1) % 3] = of_b / (of_b + of_c), weight[(k + 2) % 3] = of_c / (of_b + of_c);
        return;
      }
      with_more_bits([&](auto zero) {
        return find_determinant<decltype(zero)>(place, b, c, exponent, negligible, weight[k]);
      });
    }
  }
  divide_by_sum(weight);
}

void find_natural_weights(const Direction& place, Cavity& cavity) {
  thread_local Star<double> star;
  star.see(place, cavity);
  const std::size_t count = cavity.nodes.size();
  cavity.weights.resize(count), cavity.errors.resize(count);
  double all = 0, error_of_all = 0;  // `all`: what is certain
  bool are_right = star.is_accurate();
  for (std::size_t j = 0; j < count; ++j) {
    const auto& [area, error] = star.lost(j);
    cavity.weights[j] = area;
    cavity.errors[j] = star.is_accurate() ? error : std::numeric_limits<double>::infinity();
    if (error < area) all += area - error;
    error_of_all += error;
    are_right = are_right && error <= kOfLostArea * area;
  }
  if (!(are_right && error_of_all <= kOfAll * all)) add_bits(place, cavity, kOfAll * all);
  double sum = 0;
  for (const double w : cavity.weights) sum += w;
  for (double& w : cavity.weights) w /= sum;
}

}  // namespace pstripack
