#pragma once
// Polygons with holes, cut along a line.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace files {

/// The parts of a polygon on the inner side of a straight line. `rings`: its outlines and holes, all with the
/// interior on their left; so are those of the parts.
///
///          exit   entry  exit   entry     The chains of inner corners end at exits. From each exit, the
///       ----<------>------<------>----    border of its part goes along the line, interior on the left, to
///           |      |      |      |        an entry. Interior and exterior alternate along the line; so the
///           '------'      '------'        k-th exit goes to the k-th entry, counted in this direction, and
///       (here the interior is above)      this remains a pairing where rounding exchanges two of them.
///
/// inside(corner); cross(p, q, leaves): where the side from p to q crosses the line, to leave the inner side
/// or to enter it; along(corner): grows in that direction.
template <class Corner, class Inside, class Cross, class Along>
std::vector<std::vector<Corner>> cut_rings(const std::vector<std::vector<Corner>>& rings,
                                           const Inside& inside, const Cross& cross, const Along& along) {
  std::vector<std::vector<Corner>> parts, chains;
  for (const std::vector<Corner>& ring : rings) {
    const std::size_t n = ring.size();
    std::vector<char> is_inside(n);
    for (std::size_t i = 0; i < n; ++i) is_inside[i] = inside(ring[i]);
    std::size_t start = 0;
    while (start < n && (is_inside[start] || !is_inside[(start + 1) % n])) ++start;
    if (start == n) {
      if (n > 0 && is_inside[0]) parts.push_back(ring);
      continue;
    }
    for (std::size_t i = start; i < start + n; ++i) {
      const Corner &p = ring[i % n], &q = ring[(i + 1) % n];
      const bool from = is_inside[i % n], to = is_inside[(i + 1) % n];
      if (from) chains.back().push_back(p);
      if (!from && to) chains.push_back({cross(p, q, false)});
      if (from && !to) chains.back().push_back(cross(p, q, true));
    }
  }
  std::vector<std::size_t> exits(chains.size()), entries(chains.size()), next(chains.size());
  std::iota(exits.begin(), exits.end(), std::size_t{0});
  entries = exits;
  std::sort(exits.begin(), exits.end(),
            [&](std::size_t a, std::size_t b) { return along(chains[a].back()) < along(chains[b].back()); });
  std::sort(entries.begin(), entries.end(), [&](std::size_t a, std::size_t b) {
    return along(chains[a].front()) < along(chains[b].front());
  });
  for (std::size_t k = 0; k < chains.size(); ++k) next[exits[k]] = entries[k];
  for (std::size_t first = 0; first < chains.size(); ++first) {
    std::vector<Corner> part;
    for (std::size_t k = first; !chains[k].empty(); k = next[k]) {
      part.insert(part.end(), chains[k].begin(), chains[k].end());
      chains[k].clear();
    }
    if (!part.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace files
