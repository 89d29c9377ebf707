#include "input.h"

#include <cmath>

#include "point_sets.h"

using pstripack::Point;

Point any_vector(Input& input, const Nodes& earlier) {
  const auto of_lattice = [&] {
    const auto component = [&] { return static_cast<double>(input.below(5) - 2); };
    const Point p{component(), component(), component()};
    return p == Point{0, 0, 0} ? Point{0, 0, 1} : p;
  };
  const auto changed = [&](const Point& p, const auto& change) {
    return Point{change(p.x), change(p.y), change(p.z)};
  };
  const int kind = input.below(8);
  if (kind == 0) return of_lattice();
  if (kind == 1) return point_sets::normalized(of_lattice());
  if (kind == 2)
    return changed(point_sets::normalized(of_lattice()), [&](double v) {
      const int steps = input.below(5) - 2;
      if (v == 0) return steps * 0x1p-53;
      for (int i = 0; i < std::abs(steps); ++i) v = std::nextafter(v, steps > 0 ? 2. : -2.);
      return v;
    });
  if (kind == 3)
    return changed(of_lattice(), [&](double v) { return std::ldexp(v, input.bits<std::int16_t>() % 1024); });
  if (kind == 4) return changed({}, [&](double) { return input.bits<double>(); });
  if (kind == 5) return general_direction(input);
  if (earlier.empty()) return {0, 0, 1};
  const Point& p = earlier[static_cast<std::size_t>(input.below(256)) % earlier.size()];
  return kind == 6 ? p : scaled(-1, p);
}

Point general_direction(Input& input) { return point_sets::Random(input.bits<std::uint16_t>()).direction(); }
