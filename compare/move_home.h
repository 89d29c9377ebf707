#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpi/distributed_mesh.h"
#include "parallel/parcels.h"

constexpr auto nobody = [](std::int64_t) { return false; };

/// Moves the points to their home ranks; points for which are_away(number) is true go to the next rank.
/// Collective.
template <class AreAway>
void move_home(pstripack::MpiCommunicator& ranks, const pstripack::DistributedMesh& mesh,
               std::vector<pstripack::Point>& points, std::vector<std::int64_t>& numbers,
               const AreAway& are_away) {
  struct Item {
    pstripack::Point point;
    std::int64_t number;
  };
  std::vector<std::int32_t> home(points.size());
  mesh.home(static_cast<std::int64_t>(points.size()), &points.data()->x, home.data());
  std::vector<std::vector<Item>> items(static_cast<std::size_t>(ranks.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::int32_t to = are_away(numbers[i]) ? (home[i] + 1) % ranks.size() : home[i];
    items[static_cast<std::size_t>(to)].push_back({points[i], numbers[i]});
  }
  const pstripack::Parcels here = ranks.exchange(pstripack::packed(items));
  points.clear();
  numbers.clear();
  for (const Item& item : pstripack::Items<Item>(here)) {
    points.push_back(item.point);
    numbers.push_back(item.number);
  }
}
