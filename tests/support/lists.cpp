#include "lists.h"

#include <algorithm>
#include <cstdlib>
#include <map>

std::optional<Rings> rings_of(const Lists& lists) {
  const std::int64_t n = static_cast<std::int64_t>(lists.nodes()), slots = std::int64_t{lists.lnew} - 1;
  if (slots < 1 || slots > static_cast<std::int64_t>(std::min(lists.list.size(), lists.lptr.size())))
    return {};
  std::vector<char> used(static_cast<std::size_t>(slots) + 1, 0);
  std::int64_t visited = 0;
  Rings rings;
  for (std::int64_t k = 1; k <= n; ++k) {
    const std::int64_t last = lists.lend[k - 1];
    if (last < 1 || last > slots) return {};
    std::vector<std::int32_t> ring;
    bool boundary = false;
    std::int64_t slot = last;
    do {
      slot = lists.lptr[slot - 1];
      if (slot < 1 || slot > slots || used[slot]) return {};
      used[slot] = 1;
      ++visited;
      std::int64_t neighbour = lists.list[slot - 1];
      if (neighbour < 0) {
        if (slot != last) return {};
        boundary = true;
        neighbour = -neighbour;
      }
      if (neighbour < 1 || neighbour > n || neighbour == k) return {};
      ring.push_back(static_cast<std::int32_t>(neighbour - 1));
    } while (slot != last);
    std::vector<std::int32_t> sorted = ring;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
    if (!boundary) std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
    rings.neighbours.push_back(ring);
    rings.boundary.push_back(boundary);
  }
  if (visited != slots) return {};
  return rings;
}

Lists canonical_lists(const Rings& rings, std::int32_t filler) {
  const std::size_t n = rings.neighbours.size();
  Lists lists;
  for (std::size_t k = 0; k < n; ++k) {
    const std::int32_t first = static_cast<std::int32_t>(lists.list.size()) + 1;
    for (const std::int32_t neighbour : rings.neighbours[k]) {
      lists.list.push_back(neighbour + 1);
      lists.lptr.push_back(static_cast<std::int32_t>(lists.lptr.size()) + 2);
    }
    lists.lptr.back() = first;
    if (rings.boundary[k]) lists.list.back() = -lists.list.back();
    lists.lend.push_back(static_cast<std::int32_t>(lists.list.size()));
  }
  lists.lnew = static_cast<std::int32_t>(lists.list.size()) + 1;
  const std::size_t size = std::max(lists.list.size(), 6 * n - 12);
  lists.list.resize(size, filler);
  lists.lptr.resize(size, filler);
  return lists;
}

Faces faces_of(const Rings& rings) {
  Faces faces;
  for (std::size_t k = 0; k < rings.neighbours.size(); ++k) {
    const auto& ring = rings.neighbours[k];
    for (std::size_t i = rings.boundary[k] ? 1 : 0; i < ring.size(); ++i) {
      const std::int32_t a = ring[i == 0 ? ring.size() - 1 : i - 1], b = ring[i],
                         node = static_cast<std::int32_t>(k);
      if (node < a && node < b) faces.push_back({node, a, b});
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::optional<Rings> rings_of(std::size_t nodes, const Faces& faces) {
  std::vector<std::map<std::int32_t, std::int32_t>> next(nodes);  // counterclockwise around each node
  for (const auto& f : faces)
    for (int i = 0; i < 3; ++i)
      if (!next[f[i]].emplace(f[(i + 1) % 3], f[(i + 2) % 3]).second) return {};
  Rings rings;
  for (const auto& star : next) {
    if (star.empty()) return {};
    std::map<std::int32_t, int> arrivals;
    for (const auto& arc : star)
      if (++arrivals[arc.second] > 1) return {};
    std::int32_t first = star.begin()->first;  // the smallest, or the one that nothing leads to
    bool boundary = false;
    for (const auto& arc : star)
      if (arrivals.count(arc.first) == 0) {
        first = arc.first;
        boundary = true;
      }
    std::vector<std::int32_t> ring{first};
    for (auto arc = star.find(first); arc != star.end() && ring.size() <= star.size();
         arc = star.find(arc->second))
      ring.push_back(arc->second);
    if (!boundary) {
      if (ring.back() != first) return {};
      ring.pop_back();
    }
    if (ring.size() != star.size() + (boundary ? 1 : 0)) return {};
    rings.neighbours.push_back(ring);
    rings.boundary.push_back(boundary);
  }
  return rings;
}

void sort_faces(Faces& faces) {
  for (auto& f : faces) std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  std::sort(faces.begin(), faces.end());
}
