// The measures of triangles and cells of directions.
//
// A triangle a,b,c of unit vectors is known by its sides: the differences of its corners. Its normal n is the
// cross product of the two shorter ones, so that nothing cancels but in a flat triangle. For the corner a
// between the sides e and f to the others:
//
//   circumcentre of the plane triangle   a + C,  C = n x (|f|^2 e - |e|^2 f) / 2|n|^2,  |C| = sin R
//   that on the sphere                   (a + C) / cos R, at an offset (C + (1 - cos R) a) / cos R from a
//   area                                 2 atan2(a.n, 1 + a.b + b.c + c.a)     (van Oosterom & Strackee 1983)
//
// The border between the cells of a and b crosses the arc a-b in its middle m, at a right angle. The
// circumcentre v lies on it, at the signed angle t from m:
//
//          v       sin t = tan h cot(c),  h half of the arc, cot(c) = (a-c).(b-c) / |n|
//         /|       cos t = cos R / cos h,  cos R = a.n / |n|
//        / |       tan(area of a m v / 2) = tan(h/2) tan(t/2)
//       a--m--b    (Napier's rules; for the first, the right triangle 0, a + C, middle of the chord a-b)
//
// So the area of a cell is a sum of differences of such areas, one for each neighbour. All are positive, and
// nothing larger is subtracted, however small the cell is. At the back of the hull the formulas hold, too:
// there cos R < 0.
//
// The ordinary triangles of measures.h, in doubles, where all roundings have one sign and all components are
// large. s is the sine of the angle at a.
//   sides    e and f: 2u of each component and 2^-98.5, together below 2.75u of their lengths if these are at
//            least 2^-45, and below 2.03u if at least 2^-40. Shorter ones have R < 2^-35.
//   n        by e and f at most 2 * 2.03u |e| |f|; by its products 1.16u |e| |f| (the vector with components
//            |e.y f.z| + |e.z f.y| is no longer than sqrt(4/3) |e| |f|), by their difference u |n|
//   area     det = a.n, with n's error, 3u |n| of the sum and u |n| of a: relative to itself 5.22u / (s c) +
//   5u /
//            c with c = cos R = det / |n|. s c >= 1/8 is required; by |g| <= 0.633 and s = |g| / 2 sin R that
//            makes c >= 0.367. So det has 41.8u + 13.6u. The denominator, above 3.7, has 1.8u, the quotient
//            u, the arc tangent or its series 2u: 61u. (Sides below 2^-40: 6.6u / s + 5u + 5u <= 63u.)
//   centre   Moving b by d moves C by at most |C| d / (|e| s), in the plane and with it; so e and f move it
//   by
//            4.06u / s of itself, 33u. n's own rounding, 1.16u / s + u, does as much, 10u, as n / |n|^2 is an
//            inversion. |f|^2 e - |e|^2 f = w has 4u (|e| + |f|) |e| |f| <= 4u |w| / sin(angle / 2), 64u, and
//            u. All other steps: less than 13u. So C has 121u (133u if sides are below 2^-40), and C / cos R
//            that times tan(R) / R of the radius, 1.1 up to 30 degrees and 1.66 up to 60. The square of sin R
//            has 102u; that moves the result along itself by 102u tan(R)^2 / 2 in addition, 32u of R at 30
//            degrees and 146u at 60. With 10u for the rest: 133u + 32u + 10u, and 201u + 146u + 10u.
// Where doubles do not suffice the normal has 32u, or has 8u / s <= 32u by its two shorter sides, for which
// sin(angle / 2) >= 1/2: C has less than 75u. The radius has the normal's 32u and 15u for the three lengths
// and the rest, times 1.66.
//
// Each function of an arithmetic T finds its result and a bound of its error; if that is too large, the next
// arithmetic tries.

#include "geometry/measures.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "geometry/arithmetics.h"

namespace pstripack {
namespace {

using namespace arithmetics;

constexpr double kPi = 3.14159265358979323846;
/// Largest error of a cell's area, relative to itself.
constexpr double kOfCell = 128 * u;

// ---- triangles --------------------------------------------------------------------------------------------

/// The index of the longest of three.
inline int longest_of(const double (&square)[3]) {
  return square[1] >= square[0] ? (square[2] > square[1] ? 2 : 1) : (square[2] > square[0] ? 2 : 0);
}

/// A triangle a,b,c. Doubles that begin with `size` are magnitudes for bounds, and lengths of sides are in
/// units of 2^exponent: 0 but for sides below 2^-100.
template <class T>
struct TriangleBySides {
  using A = Arithmetic<T>;
  Vector3<T> side[3];  ///< b-a, c-b, a-c
  Vector3<T> normal;   ///< (b-a) x (c-a)
  T across;            ///< its length
  int first, second;   ///< the two shorter sides; the second ends where the first begins
  int exponent = 0;
  double size[3], size_across;
  double error_of_normal;  ///< relative to its length
  double apart;            ///< 2^kApart in the unit of the sizes

  /// True if the lengths and the normal have relative errors below `most`.
  bool find(typename A::Corner a, typename A::Corner b, typename A::Corner c, double most) {
    side[0] = A::side(b, a), side[1] = A::side(c, b), side[2] = A::side(a, c);
    if constexpr (!std::is_same_v<T, double>) {
      exponent = std::max({exponent_of(side[0]), exponent_of(side[1]), exponent_of(side[2])});
      if (exponent > -100) exponent = 0;
    }
    double square[3];
    for (int k = 0; k < 3; ++k) {
      const Point s = as_point(side[k], -exponent);
      square[k] = dot(s, s);
      size[k] = square[k] > 0x1p-900 ? std::sqrt(square[k])  // else the square may underflow
                                     : A::value(A::square_root(dot(side[k], side[k])), -exponent);
    }
    first = (longest_of(square) + 2) % 3, second = (first + 2) % 3;
    normal = cross(side[second], side[first]);
    across = A::square_root(dot(normal, normal));
    size_across = A::value(across, -2 * exponent);
    apart = std::ldexp(1, A::kApart - exponent);
    const double p = size[first], q = size[second];
    error_of_normal = (p * q * (2 * A::kSide + 4 * A::kUnit) + apart * (p + q)) / size_across;
    return size_across > 0 && error_of_normal <= most && apart <= most * std::min(p, q);
  }

  /// Dot product of the sides to the other corners at corner k (a, b, c), and the bound of its error.
  T at(int k) const { return number<T>(-1) * dot(side[k], side[(k + 2) % 3]); }
  double error_of_at(int k) const {
    const double p = size[k], q = size[(k + 2) % 3];
    return p * q * (2 * A::kSide + 4 * A::kUnit) + apart * (p + q);
  }
  T cosine(typename A::Corner a) const { return dot(A::position(a), normal) / across; }
};

/// What a measure is where two directions coincide; no caller asks for it.
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double square_of(const Point& a) { return dot(a, a); }

/// False if the triangle is too small or too flat for the arithmetic T.
template <class T>
bool find_circumcircle(const Direction (&corner)[3], Circumcircle& circle) {
  using A = Arithmetic<T>;
  TriangleBySides<T> t;
  const auto a = A::corner(corner[0]);
  if (!t.find(a, A::corner(corner[1]), A::corner(corner[2]), 32 * u)) return false;
  const Direction& apex = corner[t.first];  // between the two shorter sides
  const Point e = as_point(t.side[t.first], -t.exponent), f = as_point(t.side[t.second], -t.exponent);
  const Point normal = as_point(t.normal, -2 * t.exponent);
  const double ee = square_of(e), ff = square_of(f), p = t.size[t.first], q = t.size[t.second];
  const double sine = std::ldexp(0.5 * p * q * t.size[(t.second + 2) % 3] / (t.size_across), t.exponent);
  const bool is_seen_from_behind = A::value(t.cosine(a)) < 0;
  const double sign = is_seen_from_behind ? -1 : 1;
  if (!(sine <= 0.87)) {  // beyond 60 degrees nothing is lost by a subtraction
    const Point n = scaled(sign / t.size_across, normal);
    const Point offset{(n.x - apex.high.x) - apex.low.x, (n.y - apex.high.y) - apex.low.y,
                       (n.z - apex.high.z) - apex.low.z};
    circle = {n, 2 * std::asin(std::sqrt(square_of(offset)) / 2)};
  } else {
    const double cosine = std::sqrt((1 - sine) * (1 + sine)), above = sine * sine / (1 + cosine);
    // C, in the unit of the sides: the side f leads to the apex, so f is -f here. Divided by |n| twice, whose
    // square may underflow.
    const Point c =
        scaled(0.5 / t.size_across, cross(scaled(1 / t.size_across, normal),
                                          {ff * e.x + ee * f.x, ff * e.y + ee * f.y, ff * e.z + ee * f.z}));
    const double unit = std::ldexp(1, t.exponent);
    const auto coordinate = [&](double high, double low, double in_plane) {
      return high + (low + (unit * in_plane + above * high) / cosine);
    };
    circle = {{coordinate(apex.high.x, apex.low.x, c.x), coordinate(apex.high.y, apex.low.y, c.y),
               coordinate(apex.high.z, apex.low.z, c.z)},
              std::asin(sine)};
  }
  if (is_seen_from_behind) circle = {scaled(-1, circle.centre), kPi - circle.radius};
  return true;
}

template <class T>
bool find_area(const Direction (&corner)[3], double& area) {
  using A = Arithmetic<T>;
  TriangleBySides<T> t;
  const auto a = A::corner(corner[0]), b = A::corner(corner[1]), c = A::corner(corner[2]);
  if (!t.find(a, b, c, 32 * u)) return false;
  const double det = A::value(dot(A::position(a), t.normal), -2 * t.exponent);
  const double error_of_det = (t.error_of_normal + 4 * A::kUnit) * t.size_across + u * std::fabs(det);
  if (t.exponent != 0) {  // the denominator is 4 up to rounding, and the arc tangent is its argument
    area = std::ldexp(det / 2, 2 * t.exponent);
    return error_of_det <= 32 * u * std::fabs(det);
  }
  // 1 + a.b + b.c + c.a = 4 - (sum of the squares of the chords) / 2
  T squares = number<T>(0);
  for (const auto& s : t.side) squares = squares + dot(s, s);
  const double denominator = A::value(number<T>(4) - number<T>(0.5) * squares);
  const double error_of_denominator =
      (4 - denominator) * (2 * A::kSide + 8 * A::kUnit) + t.apart + u * std::fabs(denominator);
  area = 2 * std::atan2(det, denominator);
  return 2 * (std::fabs(denominator) * error_of_det + std::fabs(det) * error_of_denominator) <=
         60 * u * std::fabs(area) * (det * det + denominator * denominator);
}

/// The angle at a corner is atan2(|n|, e.f) for its sides e and f, and |n| = |e| |f| sin(angle). So the error
/// is that of |n|, relative, times sin(angle) cos(angle), and that of e.f, relative to |e| |f|, times
/// sin(angle).
template <class T>
bool find_angles(const Direction& a, const Direction& b, const Direction& c, Angles& angles) {
  using A = Arithmetic<T>;
  TriangleBySides<T> t;
  if (!t.find(A::corner(a), A::corner(b), A::corner(c), 32 * u)) return false;
  angles.are_acute = true;
  bool is_certain = true;
  for (int k = 0; k < 3; ++k) {
    const double product = A::value(t.at(k), -2 * t.exponent), error = t.error_of_at(k);
    angles.at[k] = std::atan2(t.size_across, product);
    angles.are_acute = angles.are_acute && product > 0;
    is_certain =
        is_certain && std::fabs(product) > error && error <= 16 * u * t.size[k] * t.size[(k + 2) % 3];
  }
  return is_certain;
}

// ---- cells ------------------------------------------------------------------------------------------------

/// What the border between two cells needs of the triangle on one side of it.
template <class T>
struct Beside {
  T cot, cosine;      ///< of the angle opposite the arc between the nodes; of the circumradius
  Vector3<T> centre;  ///< the circumcentre
  double error_of_cot, error_of_cosine;
};

/// The arc from a node to a neighbour.
template <class T>
struct Arc {
  T tan_h, cos_h, tan_half;  ///< of half of it, and of a quarter
};

/// (x, z), z = y tan(h/2), where (x, y) is in the direction of the angle t/2.
template <class T>
struct HalfAngle {
  T x, z;
  double cosine, size_z, error;  ///< cos t; the magnitude of z; error of the angle of (x, z)
};

template <class T>
HalfAngle<T> half_angle(const Beside<T>& side, const Arc<T>& arc, double sign) {
  using A = Arithmetic<T>;
  const T sine = number<T>(sign) * arc.tan_h * side.cot, cosine = side.cosine / arc.cos_h;
  const double about = A::value(cosine);
  const T one = number<T>(1), x = about >= 0 ? one + cosine : sine * sine / (one - cosine);
  const T z = arc.tan_half * sine;
  const double size_x = A::value(x), size_z = A::value(z);
  const double error = A::value(arc.tan_half) * A::value(arc.tan_h) * side.error_of_cot +
                       (8 * A::kUnit + side.error_of_cosine / A::value(arc.cos_h)) * std::fabs(size_z);
  return {x, z, about, size_z, error * size_x / (size_x * size_x + size_z * size_z)};
}

/// The area of the triangle of a node at p and two circumcentres on its border with the neighbour at q;
/// `right` and `left` of the arc are the triangles. Adds a bound to `error`, which is infinite if p and q are
/// too nearly opposite.
template <class T>
double area_beside(typename Arithmetic<T>::Corner p, typename Arithmetic<T>::Corner q, const Beside<T>& right,
                   const Beside<T>& left, double& error) {
  using A = Arithmetic<T>;
  const auto half_length = [](const Vector3<T>& v) { return number<T>(0.5) * A::square_root(dot(v, v)); };
  const T one = number<T>(1), sin_h = half_length(A::side(q, p)), cos_h = half_length(A::sum(p, q));
  const double size = A::value(cos_h);
  if (size == 0) {  // opposite: every point of the border is at a right angle from p
    const Vector3<T>&from = right.centre, &to = left.centre;
    double angle = std::atan2(A::value(dot(A::position(p), cross(from, to))), A::value(dot(from, to)));
    if (angle < 0) angle += 2 * kPi;
    error += 4 * (right.error_of_cosine + left.error_of_cosine) + 8 * u * angle;
    return angle;
  }
  error += std::ldexp(8, A::kApart) / size;
  const Arc<T> arc{sin_h / cos_h, cos_h, sin_h / (one + cos_h)};
  const HalfAngle<T> from = half_angle(right, arc, -1), to = half_angle(left, arc, 1);
  double half = std::atan2(A::value(to.z * from.x - from.z * to.x), A::value(from.x * to.x + from.z * to.z));
  // The border passes the point opposite m: t jumps from pi to -pi.
  if (from.size_z > 0 && to.size_z < 0 && from.cosine + to.cosine < 1) half += kPi;
  error += 2 * (from.error + to.error) + 8 * u * std::fabs(half);
  return 2 * half;
}

/// False if the area is not certain to be accurate enough.
template <class T>
bool find_cell_area(const Direction& node, const Direction* ring, std::size_t count, double& area) {
  using A = Arithmetic<T>;
  TriangleBySides<T> t;
  Beside<T> left, right_of_next;
  const auto v = A::corner(node);
  const auto see_triangle = [&](std::size_t k) {
    if (!t.find(v, A::corner(ring[k]), A::corner(ring[k + 1 < count ? k + 1 : 0]), 0x1p-10)) return false;
    const T inverse = number<T>(1) / t.across;
    const Vector3<T> centre{t.normal.x * inverse, t.normal.y * inverse, t.normal.z * inverse};
    const auto beside = [&, cosine = dot(A::position(v), centre)](int corner) {
      const T cot = t.at(corner) * inverse;
      return Beside<T>{cot, cosine, centre,
                       t.error_of_at(corner) * A::value(inverse, 2 * t.exponent) +
                           (t.error_of_normal + 3 * A::kUnit) * std::fabs(A::value(cot)),
                       t.error_of_normal + 5 * A::kUnit};
    };
    left = beside(2);
    right_of_next = beside(1);
    return true;
  };
  if (!see_triangle(count - 1)) return false;
  double error = 0;
  area = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Beside<T> right = right_of_next;
    if (!see_triangle(k)) return false;
    area += area_beside<T>(v, A::corner(ring[k]), right, left, error);
  }
  return error <= kOfCell * area;
}

}  // namespace

Point difference_of_any_size(const Direction& b, const Direction& a) {
  Point d{0, 0, 0};
  if (same_direction(b.given, a.given)) return d;
  with_more_bits([&](auto zero) {
    using A = Arithmetic<decltype(zero)>;
    const auto side = A::side(A::corner(b), A::corner(a));
    d = as_point(side, 0);
    return A::kApart - exponent_of(side) <= -55;
  });
  return d;
}

double arc_length(const Direction& a, const Direction& b) {
  const Point d = difference(b, a);
  const double square = square_of(d);
  if (square >= 0x1p-90 && square <= 2) return 2 * std::asin(std::sqrt(square) / 2);
  if (square > 2) {  // pi minus the angle between a and -b
    const Point sum = as_point(Arithmetic<double>::sum(a, b), 0);
    return kPi - 2 * std::asin(std::sqrt(square_of(sum)) / 2);
  }
  double length = 0;
  if (same_direction(b.given, a.given)) return length;
  with_more_bits([&](auto zero) {
    using A = Arithmetic<decltype(zero)>;
    const auto side = A::side(A::corner(b), A::corner(a));
    const int exponent = exponent_of(side);
    length = std::ldexp(std::sqrt(square_of(as_point(side, -exponent))), exponent);
    return A::kApart - exponent <= -55;
  });
  return length;
}

Circumcircle circumcircle(const Direction& a, const Direction& b, const Direction& c) {
  const Direction corner[3] = {a, b, c};
  Circumcircle circle{{kNone, kNone, kNone}, kNone};
  with_enough_bits([&](auto zero) { return find_circumcircle<decltype(zero)>(corner, circle); });
  return circle;
}

double triangle_area(const Direction& a, const Direction& b, const Direction& c) {
  const Direction corner[3] = {a, b, c};
  double area = 0;
  if (find_ordinary_area(a, b, c, area)) return area;
  with_enough_bits([&](auto zero) { return find_area<decltype(zero)>(corner, area); });
  return area;
}

Angles angles_of(const Direction& a, const Direction& b, const Direction& c) {
  Angles angles{{0, 0, 0}, false};  // of nodes so nearly on one great circle that no arithmetic tells
  with_enough_bits([&](auto zero) { return find_angles<decltype(zero)>(a, b, c, angles); });
  return angles;
}

double cell_area(const Direction& v, const Direction* ring, std::size_t count) {
  double area = kNone;
  with_enough_bits([&](auto zero) { return find_cell_area<decltype(zero)>(v, ring, count, area); });
  return area >= std::numeric_limits<double>::min() ? area : kNone;
}

}  // namespace pstripack
