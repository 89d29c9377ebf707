// Sequences of moves of a few nodes: a mesh that follows them must equal the new triangulation bit for bit,
// or report that it cannot follow.

#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/predicates.h"
#include "input.h"
#include "support/follower.h"

namespace {

constexpr std::size_t kMostNodes = 24;

/// False for nodes without direction, which TRMESH refuses, and for nodes on one great circle, which the
/// kernel refuses.
bool can_be_triangulated(const Nodes& nodes) {
  return std::all_of(nodes.begin(), nodes.end(), pstripack::has_direction) &&
         pstripack::left(nodes[0], nodes[1], nodes[2]) != 0;
}

void move(Input& input, Nodes& nodes) {
  pstripack::Point& p = nodes[static_cast<std::size_t>(input.below(static_cast<int>(nodes.size())))];
  double* const component[] = {&p.x, &p.y, &p.z};
  double& c = *component[input.below(3)];
  const int kind = input.below(6);
  if (kind < 2) c = std::nextafter(c, kind == 0 ? 2 : -2);
  if (kind == 2) c = -c;
  if (kind == 3) p = general_direction(input);
  if (kind == 4) p = any_vector(input, nodes);
  if (kind == 5) {
    const auto towards = general_direction(input);
    p = plus(p, scaled(std::ldexp(1.0, -input.below(32)), towards));
    const double length = std::sqrt(pstripack::dot(p, p));
    p = {p.x / length, p.y / length, p.z / length};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const auto count = 6 + static_cast<std::size_t>(input.below(kMostNodes - 5));
  Nodes nodes;
  const bool are_general = input.below(2) == 0;
  while (nodes.size() < count)
    nodes.push_back(are_general ? general_direction(input) : any_vector(input, nodes));
  std::unique_ptr<Follower> follower;
  while (!input.empty()) {
    if (can_be_triangulated(nodes)) {
      const auto right = made_anew(nodes);
      const auto found = follower ? follower->follow(nodes) : std::nullopt;
      require(!found || right, "a mesh of nodes that have none");
      require(!found || *found == *right, "another mesh");
      if (!found) follower = right ? std::make_unique<Follower>(nodes, *right) : nullptr;
    } else if (follower && !follower->follow(nodes)) {
      follower = nullptr;  // else only nodes 1 to 3 are on one great circle
    }
    const int moves = 1 + input.below(4);
    for (int i = 0; i < moves; ++i) move(input, nodes);
  }
  return 0;
}
