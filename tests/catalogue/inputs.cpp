#include "inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "point_sets.h"

namespace {

using namespace point_sets;
using pstripack::Point;

const Point ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};
constexpr double inf = std::numeric_limits<double>::infinity(),
                 not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 tiny = std::numeric_limits<double>::denorm_min();

Point minus(const Point& p) { return {-p.x, -p.y, -p.z}; }

Nodes family(const std::string& name, std::size_t n) { return make(name, n); }

Nodes scaled(Nodes nodes, double s) {
  for (Point& p : nodes) p = {s * p.x, s * p.y, s * p.z};
  return nodes;
}

Nodes shuffled(Nodes nodes) {
  shuffle(nodes, 1);
  return nodes;
}

Nodes reversed(Nodes nodes) {
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

Nodes sorted(Nodes nodes, double Point::*by) {
  std::stable_sort(nodes.begin(), nodes.end(),
                   [by](const Point& a, const Point& b) { return a.*by < b.*by; });
  return nodes;
}

/// The nodes with node number k, from 1, replaced by `node`.
Nodes with(Nodes nodes, std::size_t k, const Point& node) {
  nodes[k - 1] = node;
  return nodes;
}

/// The nodes with node m moved to the place of node l.
Nodes with_duplicate(Nodes nodes, std::size_t l, std::size_t m) {
  nodes[m - 1] = nodes[l - 1];
  return nodes;
}

Nodes parallel(std::size_t n, double latitude) {
  Nodes nodes;
  for (std::size_t i = 0; i < n; ++i)
    nodes.push_back(from_degrees(360 * static_cast<double>(i) / static_cast<double>(n), latitude));
  return nodes;
}

Nodes joined(Nodes a, const Nodes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Nodes meridian(std::size_t n, double longitude) {
  Nodes nodes;
  for (std::size_t i = 0; i < n; ++i) {
    const Point p = from_degrees(0, 360 * static_cast<double>(i) / static_cast<double>(n));
    nodes.push_back({p.x * cos_degrees(longitude), p.x * sin_degrees(longitude), p.z});
  }
  return nodes;
}

/// Rows from south to north without poles, west to east.
Nodes rows(int count, int columns) {
  Nodes nodes;
  for (int j = 1; j <= count; ++j)
    for (int i = 0; i < columns; ++i)
      nodes.push_back(from_degrees(360.0 * i / columns, -90 + 180.0 * j / (count + 1)));
  return nodes;
}

Nodes with_poles(Nodes nodes) {
  nodes.insert(nodes.begin(), {0, 0, -1});
  nodes.push_back(ez);
  return nodes;
}

Nodes cube_directions() {
  Nodes nodes;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) nodes.push_back(normalized({double(x), double(y), double(z)}));
  return nodes;
}

/// Neighbours one ulp apart.
Nodes pairs_of_one_ulp(std::size_t pairs) {
  Nodes nodes = family("random", pairs);
  for (std::size_t k = 0; k < pairs; ++k) {
    Point p = nodes[k];
    p.x = std::nextafter(p.x, 2);
    nodes.push_back(p);
  }
  return nodes;
}

Nodes noisy_lengths(std::size_t n, double noise) {
  Nodes nodes = family("random", n);
  Random random(1);
  for (Point& p : nodes) p = scaled({p}, 1 + noise * random.uniform(-1, 1))[0];
  return nodes;
}

Nodes equator_with_denormal_heights() {
  Nodes nodes = parallel(100, 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k].z = (static_cast<double>(k * k % 7) - 3) * tiny;
  return nodes;
}

Nodes random_behind(const Nodes& first) { return joined(first, family("random", 50)); }

}  // namespace

const std::vector<Input>& generated_inputs() {
  const auto of = [](const std::string& name, std::size_t n) { return [=] { return family(name, n); }; };
  static const std::vector<Input> inputs = {
      // Small and special
      {"no_node", [] { return Nodes{}; }},
      {"one_node", [] { return Nodes{ex}; }},
      {"two_nodes",
       [] {
         return Nodes{ex, ey};
       }},
      {"three_nodes",
       [] {
         return Nodes{ex, ey, ez};
       }},
      {"three_nodes_clockwise",
       [] {
         return Nodes{ex, ez, ey};
       }},
      {"three_nodes_two_equal",
       [] {
         return Nodes{ex, ex, ey};
       }},
      {"three_nodes_all_equal",
       [] {
         return Nodes{ex, ex, ex};
       }},
      {"three_nodes_two_opposite",
       [] {
         return Nodes{ex, minus(ex), ey};
       }},
      {"four_nodes_around_the_centre",
       [] {
         return Nodes{ex, ey, ez, normalized({-1, -1, -1})};
       }},
      {"four_nodes_on_one_side",
       [] {
         return Nodes{ex, ey, ez, normalized({1, 1, 1})};
       }},
      {"cube_directions", cube_directions},
      {"cube_directions_shuffled", [] { return shuffled(cube_directions()); }},
      {"octahedron", [] { return Nodes{ex, ey, ez, minus(ex), minus(ey), minus(ez)}; }},
      {"icosahedron", of("icosahedral", 12)},
      {"first_three_on_a_great_circle",
       [] {
         return random_behind({ex, normalized({1, 1, 0}), ey});
       }},
      {"first_three_poles_first",
       [] {
         return random_behind({ez, minus(ez), ex});
       }},
      {"equator", [] { return parallel(100, 0); }},
      {"meridian_37_of_100", [] { return meridian(100, 37); }},
      {"tilted_great_circle", of("strip:1e-30", 100)},
      {"equator_and_both_poles",
       [] {
         return joined(parallel(100, 0), {ez, minus(ez)});
       }},
      {"equator_and_both_poles_mixed", [] { return with_poles(parallel(100, 0)); }},
      {"small_circle_at_60", [] { return parallel(100, 60); }},
      {"strip_1e_9", of("strip:1e-9", 100)},
      {"strip_1e_15", of("strip:1e-15", 100)},
      {"equator_with_node_1_off_by_1e_15", [] { return with(parallel(100, 0), 1, from_degrees(0, 6e-14)); }},
      {"hemisphere", of("hemisphere", 1000)},
      {"hemisphere_with_rim", of("hemisphere-rim", 1000)},
      {"cap_of_1_degree", of("cap", 1000)},
      {"cap_1e_6", of("cap:1e-6", 1000)},
      {"cap_1e_8", of("cap:1e-8", 1000)},
      {"cap_1e_7_of_20000", of("cap:1e-7", 20000)},
      {"box", of("box", 2500)},
      {"box_shuffled", [] { return shuffled(family("box", 2500)); }},
      {"antipodal_clusters", of("antipodal", 1000)},
      {"boundary_with_opposite_nodes",
       [] {
         return Nodes{ez, ex, normalized({1, 1, 1}), minus(ez), normalized({1, -1, 0.5})};
       }},

      // Duplicates and near-duplicates
      {"duplicate_50_99", [] { return with_duplicate(family("random", 120), 50, 99); }},
      {"duplicate_2_5", [] { return with_duplicate(family("random", 120), 2, 5); }},
      {"duplicate_1_4", [] { return with_duplicate(family("random", 120), 1, 4); }},
      {"duplicate_of_a_boundary_node",  // the easternmost of 60 northern nodes
       [] { return with_duplicate(sorted(family("hemisphere", 60), &Point::z), 1, 50); }},
      {"duplicates_the_whole_set_twice", [] { return joined(family("random", 500), family("random", 500)); }},
      {"duplicate_1_2", [] { return with_duplicate(family("random", 50), 1, 2); }},
      {"duplicates_all_equal",
       [] {
         return Nodes(50, Point{0.6, 0, 0.8});
       }},
      {"duplicate_but_for_minus_zero",
       [] {
         return with(with(family("random", 50), 11, {1, 0.0, 0.0}), 31, {1, -0.0, 0.0});
       }},
      {"same_direction_twice_as_long",
       [] {
         const Nodes nodes = family("random", 50);
         return with(nodes, 31, scaled(nodes, 2)[10]);
       }},
      {"pairs_1e_7", of("pairs:1e-7", 2000)},
      {"pairs_1e_10", of("pairs:1e-10", 2000)},
      {"pairs_1e_13", of("pairs:1e-13", 2000)},
      {"pairs_1e_15", of("pairs:1e-15", 2000)},
      {"pairs_of_one_ulp", [] { return pairs_of_one_ulp(500); }},

      // Lattices, orders, densities
      {"grid_17_rows_of_36", [] { return with_poles(rows(17, 36)); }},
      {"grid_179_rows_of_360", [] { return with_poles(rows(179, 360)); }},
      {"grid_10_rows_of_36_reversed", [] { return reversed(with_poles(rows(10, 36))); }},
      {"grid_10_rows_of_20_reversed", [] { return reversed(with_poles(rows(10, 20))); }},
      {"cubed_sphere_4", of("cubed-sphere", 6 * 4 * 4)},
      {"cubed_sphere_5", of("cubed-sphere", 6 * 5 * 5)},
      {"cubed_sphere_8", of("cubed-sphere", 6 * 8 * 8)},
      {"cubed_sphere_9", of("cubed-sphere", 6 * 9 * 9)},
      {"cubed_sphere_10", of("cubed-sphere", 6 * 10 * 10)},
      {"cubed_sphere_16", of("cubed-sphere", 6 * 16 * 16)},
      {"cubed_sphere_20", of("cubed-sphere", 6 * 20 * 20)},
      {"cubed_sphere_30", of("cubed-sphere", 6 * 30 * 30)},
      {"cubed_sphere_64", of("cubed-sphere", 6 * 64 * 64)},
      {"fibonacci", of("fibonacci", 3000)},
      {"healpix", of("healpix", 3072)},
      {"reduced_gaussian", of("reduced-gaussian", 3000)},
      {"tripolar", of("tripolar", 3000)},
      {"ring_of_500_and_its_centre", of("ring", 501)},
      {"icosahedral_2562", of("icosahedral", 2562)},
      {"random_by_x", [] { return sorted(family("random", 5000), &Point::x); }},
      {"random_by_z", [] { return sorted(family("random", 5000), &Point::z); }},
      {"dense_cap_1e_5", of("dense-cap:1e-5", 4000)},
      {"dense_cap_1e_6", of("dense-cap:1e-6", 4000)},
      {"dense_cap_1e_7", of("dense-cap:1e-7", 4000)},
      {"variable_1e4", of("variable:1e4", 20000)},
      {"variable_1e6", of("variable:1e6", 20000)},

      // Numbers
      {"nan_among_the_first_three",
       [] {
         return with(family("random", 20), 2, {not_a_number, 0, 0});
       }},
      {"nan_behind_them",
       [] {
         return with(family("random", 20), 8, {not_a_number, 0, 0});
       }},
      {"infinity",
       [] {
         return with(family("random", 20), 8, {inf, 0, 0});
       }},
      {"zero_vector_among_the_first_three",
       [] {
         return with(family("random", 20), 2, {0, 0, 0});
       }},
      {"zero_vector_behind_them",
       [] {
         return with(family("random", 20), 8, {0, 0, 0});
       }},
      {"denormal_vector",
       [] {
         return with(family("random", 20), 8, {tiny, 2 * tiny, -tiny});
       }},
      {"denormal_heights", equator_with_denormal_heights},
      {"one_vector_of_1e308",
       [] {
         return with(family("random", 20), 8, {1e308, -1e308, 1e308});
       }},
      {"one_vector_of_1e_200",
       [] {
         return with(family("random", 20), 8, {1e-200, -1e-200, 1e-200});
       }},
      {"radius_2", [] { return scaled(family("random", 500), 2); }},
      {"radius_6371229", [] { return scaled(family("random", 500), 6371229); }},
      {"radius_noise_1e_3", [] { return noisy_lengths(1000, 1e-3); }},
      {"radius_noise_1e_7", [] { return noisy_lengths(1000, 1e-7); }},
      {"single_precision_100000", of("single", 100000)},
  };
  return inputs;
}
