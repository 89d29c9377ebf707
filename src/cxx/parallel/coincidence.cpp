#include "parallel/coincidence.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace pstripack {

Coincidence first_coincidence(const CoincidentPairs& pairs) {
  std::vector<GlobalNumber> node;  // those that coincide with another, by number
  node.reserve(2 * pairs.size());
  for (const auto& [a, b] : pairs) {
    assert(a != b);
    node.push_back(a);
    node.push_back(b);
  }
  std::sort(node.begin(), node.end());
  node.erase(std::unique(node.begin(), node.end()), node.end());
  const auto index = [&](GlobalNumber number) {
    return static_cast<std::size_t>(std::lower_bound(node.begin(), node.end(), number) - node.begin());
  };

  // Union-find; the root of a set is its smallest node.
  std::vector<std::size_t> above(node.size());
  for (std::size_t i = 0; i < above.size(); ++i) above[i] = i;
  const auto root = [&](std::size_t i) {
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
  };
  for (const auto& [a, b] : pairs) {
    const std::size_t i = root(index(a)), j = root(index(b));
    above[std::max(i, j)] = std::min(i, j);
  }
  // The first node that is not the first of its set.
  for (std::size_t i = 0;; ++i)
    if (root(i) != i) return {value_of(node[root(i)]), value_of(node[i])};
}

}  // namespace pstripack
