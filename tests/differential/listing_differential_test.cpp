// TRPRNT, TRLPRT: every row, column and page break. The wording is our own: of texts only the numbers behind
// "=" and their positions are compared.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "differential/differential.h"
#include "differential/routines.h"
#include "support/fortran_unit.h"
#include "support/text_calls.h"

using namespace differential;

namespace {

constexpr int unit = 77;

bool is_wording(const std::string& record) {
  for (std::size_t i = 0; i + 1 < record.size(); ++i)  // two consecutive letters, except in NaN and Infinity
    if (std::isalpha(record[i]) && std::isalpha(record[i + 1]) && record.find("NaN") == std::string::npos &&
        record.find("Inf") == std::string::npos)
      return true;
  return false;
}

/// The part of a record that is compared. Numbers: all, with E for D. Texts: the blanks before them and the
/// fields behind each "=".
std::string essence(std::string record) {
  if (!is_wording(record)) {
    for (std::size_t i = 1; i < record.size(); ++i)
      if (record[i] == 'D' && std::isdigit(record[i - 1])) record[i] = 'E';
    return record;
  }
  std::string fields;
  for (std::size_t at = record.find('='); at != std::string::npos; at = record.find('=', at + 1)) {
    const std::size_t digit = record.find_first_not_of(' ', at + 1),
                      end = record.find_first_not_of("0123456789", digit);
    fields += record.substr(at, end - at);
  }
  return fields.empty() ? "words" : std::to_string(record.find_first_not_of(' ')) + fields;
}

/// The first record in which two listings differ; "" if they are equal.
std::string difference(const std::string& ours, const std::string& original) {
  const std::vector<std::string> a = lines(ours), b = lines(original);
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    if (essence(a[i]) != essence(b[i]))
      return "record " + std::to_string(i + 1) + ": '" + a[i] + "', original '" + b[i] + "'";
  return a.size() == b.size() ? ""
                              : std::to_string(a.size()) + " records, original " + std::to_string(b.size());
}

/// Replaces coordinates of some nodes by numbers that are hard to print. The triangulation stays as it is.
NodeSet with_hard_numbers(NodeSet nodes) {
  constexpr double numbers[] = {0.0,
                                -0.0,
                                1e-310,
                                -1e-100,
                                0.1234565,
                                0.9999995,
                                0.99999949,
                                1e99,
                                -9.9999996e9,
                                1 / 3e100,
                                std::nan(""),
                                9.9999995e99,
                                std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < nodes.x.size() && i < std::size(numbers); ++i) nodes.y[i] = numbers[i];
  return nodes;
}

/// The differential sets, sets of sizes up to the limits, and nodes with up to 399 neighbours.
std::vector<NodeSet> listed_sets() {
  std::vector<NodeSet> sets = node_sets();
  std::mt19937_64 bits(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const int n : {7, 60, 120, 5000, 9999}) {
    NodeSet set;
    set.name = "random " + std::to_string(n);
    while (set.n() < n) {
      const double x = uniform(bits), y = uniform(bits), z = uniform(bits),
                   r = std::sqrt(x * x + y * y + z * z);
      if (r > 1 || r < 0.1) continue;
      set.x.push_back(x / r), set.y.push_back(y / r), set.z.push_back(z / r);
    }
    sets.push_back(std::move(set));
  }
  for (int n = 4; n <= 400; n = n < 20 ? n + 1 : n + 19) {
    NodeSet set;
    set.name = "wheel " + std::to_string(n);
    for (int i = 0; i < n; ++i) {  // the hub first or last, both hemispheres
      const double angle = 2 * std::acos(-1.0) * i / (n - 1), z = n % 2 == 0 ? 0.3 : -0.3,
                   r = std::sqrt(1 - z * z);
      const bool hub = n % 3 == 0 ? i == 0 : i == n - 1;
      set.x.push_back(hub ? 0 : r * std::cos(angle));
      set.y.push_back(hub ? 0 : r * std::sin(angle));
      set.z.push_back(hub ? 1 : z);
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

/// The coordinates rounded to single precision, and the original's lists for these.
struct SingleNodes {
  explicit SingleNodes(NodeSet& nodes) : x(round(nodes.x)), y(round(nodes.y)), z(round(nodes.z)) {}
  static std::vector<float> round(std::vector<double>& values) {
    std::vector<float> single(values.begin(), values.end());
    values.assign(single.begin(), single.end());
    return single;
  }
  std::vector<float> x, y, z;
};

void* symbol_of_r4(const char* name) {
  static void* const library = dlopen(STRIPACK_R4, RTLD_NOW | RTLD_LOCAL);
  void* const symbol = library != nullptr ? dlsym(library, name) : nullptr;
  if (symbol == nullptr) throw std::runtime_error(dlerror());
  return symbol;
}

}  // namespace

TEST(Differential, TRPRNT) {
  const Result result = compare_all(listed_sets(), [](const NodeSet& set) -> std::string {
    int ier;
    const Lists lists = triangulated_by_original(set, ier);
    if (ier != 0) return "";
    const NodeSet nodes = set.n() % 5 == 0 ? with_hard_numbers(set) : set;
    const int n = nodes.n();
    for (const int iflag : {-1, 0, 1}) {
      const std::string original = written_to_unit(unit, [&] {
        cstrprnt_(&n, nodes.x.data(), nodes.y.data(), nodes.z.data(), &iflag, lists.list.data(),
                  lists.lptr.data(), lists.lend.data(), &unit);
      });
      const std::string ours =
          text_of(pstripack_trprnt_r8(n, nodes.x.data(), nodes.y.data(), nodes.z.data(), iflag,
                                      lists.list.data(), lists.lptr.data(), lists.lend.data(), 0));
      if (const std::string found = difference(ours, original); !found.empty())
        return "IFLAG = " + std::to_string(iflag) + ", " + found;
    }
    return "";
  });
  expect_equal(result, 60);
}

TEST(Differential, TRLPRT) {
  const Result result = compare_all(listed_sets(), [](const NodeSet& set) -> std::string {
    int ier;
    const Lists lists = triangulated_by_original(set, ier);
    if (ier != 0) return "";
    const NodeSet nodes = set.n() % 5 == 0 ? with_hard_numbers(set) : set;
    const int n = nodes.n();
    for (const int nrow : {6, 9}) {
      std::vector<int> ltri(static_cast<std::size_t>(nrow * 2 * n));
      int nt;
      cstrlist_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), &nrow, &nt, ltri.data(), &ier);
      for (const int iflag : {-1, 0, 1}) {
        const std::string original = written_to_unit(unit, [&] {
          cstrlprt_(&n, nodes.x.data(), nodes.y.data(), nodes.z.data(), &iflag, &nrow, &nt, ltri.data(),
                    &unit);
        });
        const std::string ours = text_of(pstripack_trlprt_r8(
            n, nodes.x.data(), nodes.y.data(), nodes.z.data(), iflag, nrow, nt, ltri.data(), 0));
        if (const std::string found = difference(ours, original); !found.empty())
          return "IFLAG = " + std::to_string(iflag) + ", NROW = " + std::to_string(nrow) + ", " + found;
      }
    }
    return "";
  });
  expect_equal(result, 60);
}

TEST(Differential, TRPRNT_outOfRange) {
  const double none = 0;
  const int no_list = 0;
  for (const int n : {-4, 2, 10000, 99999})
    for (const int iflag : {-1, 0, 1})
      EXPECT_EQ(
          difference(
              text_of(pstripack_trprnt_r8(n, &none, &none, &none, iflag, &no_list, &no_list, &no_list, 0)),
              written_to_unit(
                  unit,
                  [&] { cstrprnt_(&n, &none, &none, &none, &iflag, &no_list, &no_list, &no_list, &unit); })),
          "")
          << n;
}

TEST(Differential, TRLPRT_outOfRange) {
  const double none = 0;
  const int no_column = 0;
  constexpr int cases[][3] = {{2, 6, 1}, {-10, 6, 1}, {7, 5, 8},     {7, 7, 8},
                              {7, 9, 0}, {7, 9, -1},  {7, 6, 10000}, {7, 6, 99999}};
  for (const auto& [n, nrow, nt] : cases)
    for (const int iflag : {-1, 0, 1})
      EXPECT_EQ(
          difference(text_of(pstripack_trlprt_r8(n, &none, &none, &none, iflag, nrow, nt, &no_column, 0)),
                     written_to_unit(unit,
                                     [&, n = n, nrow = nrow, nt = nt] {
                                       cstrlprt_(&n, &none, &none, &none, &iflag, &nrow, &nt, &no_column,
                                                 &unit);
                                     })),
          "")
          << n << " " << nrow << " " << nt;
}

// Calls the Fortran routines of libstripack_r4, which print to LOUT; the original gets the same numbers in
// REAL*8.
TEST(Differential, TRPRNT_r4) {
  std::vector<NodeSet> sets;
  for (const NodeSet& set : listed_sets())
    if (sets.size() < 300 && set.n() % 3 == 0) sets.push_back(set);
  const Result result = compare_all(sets, [](NodeSet nodes) -> std::string {
    const SingleNodes single(nodes);
    int ier;
    const Lists lists = triangulated_by_original(nodes, ier);
    if (ier != 0) return "";
    const int n = nodes.n();
    const auto trprnt =
        reinterpret_cast<void (*)(const int*, const float*, const float*, const float*, const int*,
                                  const int*, const int*, const int*, const int*)>(symbol_of_r4("trprnt_"));
    for (const int iflag : {-1, 0, 1}) {
      const auto ours = [&](const int& lout) {
        trprnt(&n, single.x.data(), single.y.data(), single.z.data(), &iflag, lists.list.data(),
               lists.lptr.data(), lists.lend.data(), &lout);
      };
      const std::string original = written_to_unit(unit, [&] {
        cstrprnt_(&n, nodes.x.data(), nodes.y.data(), nodes.z.data(), &iflag, lists.list.data(),
                  lists.lptr.data(), lists.lend.data(), &unit);
      });
      const std::string to_unit = written_to_unit(unit, [&] { ours(unit); });
      if (const std::string found = difference(to_unit, original); !found.empty()) return found;
      for (const int no_unit : {-1, 100})
        if (written_to_stdout([&] { ours(no_unit); }) != to_unit) return "LOUT out of range";
    }
    return "";
  });
  expect_equal(result, 10);
}

TEST(Differential, TRLPRT_r4) {
  std::vector<NodeSet> sets;
  for (const NodeSet& set : listed_sets())
    if (sets.size() < 300 && set.n() % 3 == 1) sets.push_back(set);
  const Result result = compare_all(sets, [](NodeSet nodes) -> std::string {
    const SingleNodes single(nodes);
    int ier, nt;
    const Lists lists = triangulated_by_original(nodes, ier);
    if (ier != 0) return "";
    const int n = nodes.n(), nrow = n % 2 == 0 ? 6 : 9, iflag = 0, no_unit = 100;
    std::vector<int> ltri(static_cast<std::size_t>(nrow * 2 * n));
    cstrlist_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), &nrow, &nt, ltri.data(), &ier);
    const auto trlprt =
        reinterpret_cast<void (*)(const int*, const float*, const float*, const float*, const int*,
                                  const int*, const int*, const int*, const int*)>(symbol_of_r4("trlprt_"));
    const auto ours = [&](const int& lout) {
      trlprt(&n, single.x.data(), single.y.data(), single.z.data(), &iflag, &nrow, &nt, ltri.data(), &lout);
    };
    const std::string original = written_to_unit(unit, [&] {
      cstrlprt_(&n, nodes.x.data(), nodes.y.data(), nodes.z.data(), &iflag, &nrow, &nt, ltri.data(), &unit);
    });
    const std::string to_unit = written_to_unit(unit, [&] { ours(unit); });
    if (written_to_stdout([&] { ours(no_unit); }) != to_unit) return "LOUT out of range";
    return difference(to_unit, original);
  });
  expect_equal(result, 10);
}
