#include "differential/differential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "child_process.h"
#include "original.h"

namespace differential {
namespace {

/// Uniform in [0,1), the same on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  int below(int n) { return static_cast<int>(uniform() * n); }

 private:
  std::mt19937_64 bits_;
};

void add(NodeSet& set, double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  set.x.push_back(x / length);
  set.y.push_back(y / length);
  set.z.push_back(z / length);
}

void add_degrees(NodeSet& set, double latitude, double longitude) {
  const double degree = std::acos(-1.0) / 180, cosine = std::cos(latitude * degree);
  set.x.push_back(cosine * std::cos(longitude * degree));
  set.y.push_back(cosine * std::sin(longitude * degree));
  set.z.push_back(std::sin(latitude * degree));
}

void shuffle(NodeSet& set, Random& random) {
  for (int i = set.n() - 1; i > 0; --i) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(random.below(i + 1));
    std::swap(set.x[a], set.x[b]);
    std::swap(set.y[a], set.y[b]);
    std::swap(set.z[a], set.z[b]);
  }
}

/// A size: mostly small, seldom large.
int some_size(Random& random) {
  const int choice = random.below(100);
  if (choice < 60) return 3 + random.below(20);
  if (choice < 90) return 10 + random.below(70);
  if (choice < 98) return 80 + random.below(120);
  return 200 + random.below(301);
}

void random_nodes(NodeSet& set, int n, double lowest_z, Random& random) {
  while (set.n() < n) {
    const double z = lowest_z + (1 - lowest_z) * random.uniform(),
                 angle = 2 * std::acos(-1.0) * random.uniform();
    const double radius = std::sqrt(1 - z * z);
    add(set, radius * std::cos(angle), radius * std::sin(angle), z);
  }
}

bool has(const NodeSet& set, double x, double y, double z) {
  for (std::size_t i = 0; i < set.x.size(); ++i)
    if (set.x[i] == x && set.y[i] == y && set.z[i] == z) return true;
  return false;
}

void lattice_nodes(NodeSet& set, int n, int reach, Random& random) {
  for (int tries = 0; set.n() < n && tries < 1000; ++tries) {
    const int v[3] = {random.below(2 * reach + 1) - reach, random.below(2 * reach + 1) - reach,
                      random.below(2 * reach + 1) - reach};
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) continue;
    NodeSet one;
    add(one, v[0], v[1], v[2]);
    if (!has(set, one.x[0], one.y[0], one.z[0])) add(set, v[0], v[1], v[2]);
  }
}

void global_grid(NodeSet& set, Random& random) {
  const int rows = 2 + random.below(6), columns = 3 + random.below(9);
  add_degrees(set, 90, 0);
  add_degrees(set, -90, 0);
  for (int i = 1; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) add_degrees(set, -90 + 180.0 * i / (rows + 1), 360.0 * j / columns);
}

void regional_grid(NodeSet& set, Random& random) {
  const int rows = 2 + random.below(4), columns = 2 + random.below(6), south = random.below(60) - 60,
            west = random.below(300) - 150;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) add_degrees(set, south + 5 * i, west + 5 * j);
}

void ring(NodeSet& set, int n, Random& random) {
  const double latitude = 160 * random.uniform() - 80;
  add_degrees(set, 90, 0);
  for (int j = 1; j < n; ++j) add_degrees(set, latitude, 360.0 * j / (n - 1));
}

void copies(NodeSet& set, Random& random) {
  const int n = set.n();
  for (int times = 1 + random.below(3); times > 0; --times) {
    const auto i = static_cast<std::size_t>(random.below(n));
    set.x.push_back(set.x[i]);
    set.y.push_back(set.y[i]);
    set.z.push_back(set.z[i]);
  }
}

std::vector<NodeSet> make_sets(int each) {
  static constexpr const char* kinds[] = {"random",    "half-sphere", "cap",         "lattice 1",
                                          "lattice 2", "lattice 3",   "global grid", "regional grid",
                                          "ring",      "copies"};
  constexpr int kinds_count = static_cast<int>(std::size(kinds));
  std::vector<NodeSet> sets;
  for (int i = 0; i < each; ++i)
    for (int kind = 0; kind < kinds_count; ++kind) {
      Random random(static_cast<unsigned>(1000 * i + kind));
      NodeSet set;
      const int n = some_size(random);
      switch (kind) {
        case 0:
          random_nodes(set, n, -1, random);
          break;
        case 1:
          random_nodes(set, n, 0, random);
          break;
        case 2:
          random_nodes(set, n, 0.999, random);
          break;
        case 3:
        case 4:
        case 5:
          lattice_nodes(set, 4 + random.below(kind == 3 ? 20 : 60), kind - 2, random);
          break;
        case 6:
          global_grid(set, random);
          break;
        case 7:
          regional_grid(set, random);
          break;
        case 8:
          ring(set, 4 + random.below(40), random);
          break;
        case 9:
          random_nodes(set, std::min(n, 60), i % 2 == 0 ? -1 : 0, random);
          copies(set, random);
          break;
      }
      if (kind >= 6 && i % 8 != 0) shuffle(set, random);
      set.name =
          std::string(kinds[kind]) + " " + std::to_string(i) + " (n = " + std::to_string(set.n()) + ")";
      sets.push_back(std::move(set));
    }
  return sets;
}

}  // namespace

const std::vector<NodeSet>& node_sets(int each) {
  static const std::vector<NodeSet> sets = make_sets(each);
  return sets;
}

Lists::Lists(int most)
    : list(static_cast<std::size_t>(6 * most), mark),
      lptr(static_cast<std::size_t>(6 * most), mark),
      lend(static_cast<std::size_t>(most), mark),
      lnew(mark) {}

const legacy_stripack::Library& second_original() {
  static const legacy_stripack::Original original(legacy_stripack::configured_original().value());
  return original.library();
}

Lists triangulated_by_original(const NodeSet& nodes, int& ier) {
  const int n = nodes.n();
  Lists lists(n + 60);  // room for nodes that a test adds
  std::vector<int> near(nodes.x.size()), next(nodes.x.size());
  std::vector<double> dist(nodes.x.size());
  second_original().trmesh(&n, nodes.x.data(), nodes.y.data(), nodes.z.data(), lists.list.data(),
                           lists.lptr.data(), lists.lend.data(), &lists.lnew, near.data(), next.data(),
                           dist.data(), &ier);
  return lists;
}

Result compare_all(const std::vector<NodeSet>& sets,
                   const std::function<std::string(const NodeSet&)>& compare, double limit) {
  constexpr std::size_t kRoom = 1000, kTogether = 50;
  const legacy_stripack::Shared<char> texts(kTogether * kRoom);  // the differences that a child found
  second_original();                                             // loaded once, not in every child
  Result result;
  const auto returns = [&](std::size_t first, std::size_t end) {
    const auto work = [&] {
      for (std::size_t k = first; k < end; ++k)
        std::snprintf(&texts[(k - first) * kRoom], kRoom, "%s", compare(sets[k]).c_str());
    };
    if (legacy_stripack::run_in_child(work, limit).outcome != legacy_stripack::Outcome::returned)
      return false;
    for (std::size_t k = first; k < end; ++k) {
      const char* const text = &texts[(k - first) * kRoom];
      ++result.compared;
      if (text[0] == '\0') continue;
      ++result.different;
      if (result.differences.size() < 20) result.differences.push_back(sets[k].name + ": " + text);
    }
    return true;
  };
  for (std::size_t first = 0; first < sets.size(); first += kTogether) {
    const std::size_t end = std::min(first + kTogether, sets.size());
    if (returns(first, end)) continue;
    for (std::size_t k = first; k < end; ++k)
      if (!returns(k, k + 1)) result.not_returned.push_back(sets[k].name);
  }
  return result;
}

void expect_equal(const Result& result, int most_lost) {
  EXPECT_EQ(result.different, 0);
  for (const std::string& difference : result.differences) ADD_FAILURE() << difference;
  EXPECT_LE(static_cast<int>(result.not_returned.size()), most_lost);
  for (std::size_t i = 0; i < result.not_returned.size() && i < 10; ++i)
    std::printf("did not return: %s\n", result.not_returned[i].c_str());
  std::printf("%d sets compared, %zu not returned\n", result.compared, result.not_returned.size());
}

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

double ulps(double a, double b) {
  if (same_bits(a, b) || a == b) return 0;
  if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
  const double larger = std::max(std::abs(a), std::abs(b));
  return std::abs(a - b) / (std::nextafter(larger, 2 * larger) - larger);
}

}  // namespace differential
