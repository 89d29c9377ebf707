// TRMESH on nodes of any bits: it must return the documented code and a mesh that the tests' own judge finds
// correct, must not access memory outside the arrays, and must not change results if the code is negative.

#include <algorithm>

#include "input.h"
#include "support/expect.h"
#include "support/guarded.h"

namespace {

constexpr std::size_t kMostNodes = 24;

/// Calls TRMESH with arrays between inaccessible pages and nodes in read-only pages.
Mesh guarded_trmesh(const Nodes& nodes, Edge edge) {
  const Columns columns(nodes);
  Guarded<double> x(columns.x, edge), y(columns.y, edge), z(columns.z, edge);
  for (auto* component : {&x, &y, &z}) component->make_read_only();
  const std::size_t n = nodes.size(), slots = n < 3 ? 1 : 6 * n - 12;
  Guarded<std::int32_t> list(std::vector<std::int32_t>(slots, untouched), edge),
      lptr(std::vector<std::int32_t>(slots, untouched), edge),
      lend(std::vector<std::int32_t>(n, untouched), edge);
  Mesh m;
  m.lnew = untouched;
  m.ier = pstripack_trmesh(static_cast<std::int32_t>(n), x.data(), y.data(), z.data(), list.data(),
                           lptr.data(), lend.data(), &m.lnew);
  m.list.assign(list.data(), list.data() + slots);
  m.lptr.assign(lptr.data(), lptr.data() + slots);
  m.lend.assign(lend.data(), lend.data() + n);
  return m;
}

}  // namespace

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
