// TRMESH on nodes of any bits: it must return the documented code and a mesh that the tests' own judge finds
// correct, must not access memory outside the arrays, and must not change results if the code is negative.

#include <algorithm>

#include "input.h"
#include "support/expect.h"

constexpr std::size_t kMostNodes = 24;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const Edge edge = input.below(2) == 0 ? Edge::begin : Edge::end;
  Nodes nodes;
  while (!input.empty() && nodes.size() < kMostNodes) nodes.push_back(any_vector(input, nodes));
  const Mesh m = guarded_trmesh(nodes, edge);
  if (nodes.size() >= 3 && !std::all_of(nodes.begin(), nodes.end(), pstripack::has_direction)) {
    require(m.ier == -5 && is_untouched(m), "a node without a direction: IER = " + std::to_string(m.ier));
    return 0;
  }
  const auto result = is_as_promised(nodes, m);
  require(result, result.message());
  for (const Mesh& again : {trmesh(nodes), trmesh_i8(nodes, edge)})
    require(again.ier == m.ier && again == m, "another result in another call");
  return 0;
}
