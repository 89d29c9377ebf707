#pragma once
// Checks for tests of the C API.

#include <gtest/gtest.h>

#include "judge.h"
#include "point_sets.h"
#include "trmesh.h"

/// True if nothing of the mesh was written.
inline bool is_untouched(const Mesh& m) {
  const auto all = [](const std::vector<std::int32_t>& v) {
    for (const std::int32_t i : v)
      if (i != untouched) return false;
    return true;
  };
  return all(m.list) && all(m.lptr) && all(m.lend) && m.lnew == untouched;
}

/// IER = 0, canonical lists, nothing written behind them, accepted by the
/// library's validator and by the tests' own judge.
inline ::testing::AssertionResult is_correct(const Nodes& nodes, const Mesh& m) {
  if (m.ier != 0) return ::testing::AssertionFailure() << "IER = " << m.ier;
  const auto rings = rings_of(m);
  if (!rings) return ::testing::AssertionFailure() << "broken lists";
  if (!(canonical_lists(*rings, untouched) == m))
    return ::testing::AssertionFailure() << "lists not canonical, or written beyond LNEW-1";
  if (const std::string f = fault(nodes, *rings); !f.empty()) return ::testing::AssertionFailure() << f;
  if (const std::string v = verdict(nodes, m); !v.empty())
    return ::testing::AssertionFailure() << "judged correct, but refused by pstripack_validate: " << v;
  return ::testing::AssertionSuccess();
}

inline std::size_t boundary_nodes(const Mesh& m) {
  std::size_t count = 0;
  for (const std::int32_t last : m.lend) count += m.list[last - 1] < 0;
  return count;
}

/// For any finite input: the documented code (docs/api/ier.md), and lists or untouched arrays accordingly.
inline ::testing::AssertionResult is_as_promised(const Nodes& nodes, const Mesh& m) {
  const int ier = expected_ier(nodes);
  if (m.ier != ier) return ::testing::AssertionFailure() << "IER = " << m.ier << ", expected " << ier;
  if (ier == 0) return is_correct(nodes, m);
  if (ier < 0)
    return is_untouched(m) ? ::testing::AssertionSuccess()
                           : ::testing::AssertionFailure() << "outputs touched";
  std::size_t distinct = 0;  // nodes before the first that coincides with an earlier one
  for (std::size_t length = nodes.size(), low = 3; low <= length;) {
    const std::size_t middle = (low + length) / 2;
    if (expected_ier(Nodes(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(middle))) == 0)
      distinct = middle, low = middle + 1;
    else
      length = middle - 1;
  }
  const Nodes front(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(distinct));
  Mesh cut = m;
  cut.ier = 0;
  cut.lend.resize(distinct);
  cut.list.resize(6 * distinct - 12);
  cut.lptr.resize(6 * distinct - 12);
  for (std::size_t i = cut.list.size(); i < m.list.size(); ++i)
    if (m.list[i] != untouched || m.lptr[i] != untouched)
      return ::testing::AssertionFailure() << "slot " << i + 1 << " written";
  return is_correct(front, cut);
}

/// The same of what the library returns for them.
inline ::testing::AssertionResult is_as_promised(const Nodes& nodes) {
  return is_as_promised(nodes, trmesh(nodes));
}

/// In the given and in other random orders.
inline void expect_as_promised_in_any_order(Nodes nodes, const std::string& what, std::uint64_t others = 2) {
  EXPECT_TRUE(is_as_promised(nodes)) << what;
  for (std::uint64_t seed = 1; seed <= others; ++seed) {
    point_sets::shuffle(nodes, seed);
    EXPECT_TRUE(is_as_promised(nodes)) << what << ", shuffled, seed " << seed;
  }
}
