#pragma once
// pstripack_trmesh with C++ containers.

#include <utility>
#include <vector>

#include "capi/pstripack.h"
#include "columns.h"
#include "guarded.h"
#include "lists.h"

struct Mesh : Lists {
  std::int32_t ier = 0;
};

inline Mesh trmesh(const Nodes& nodes) {
  const Columns c(nodes);
  Mesh m{room_for(nodes.size())};
  m.ier = pstripack_trmesh(static_cast<std::int32_t>(nodes.size()), c.x.data(), c.y.data(), c.z.data(),
                           m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
  return m;
}

/// The same in single precision.
inline Mesh trmesh_r4(const Nodes& nodes) {
  const Columns<float> c(nodes);
  Mesh m{room_for(nodes.size())};
  m.ier = pstripack_trmesh_r4(static_cast<std::int32_t>(nodes.size()), c.x.data(), c.y.data(), c.z.data(),
                              m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
  return m;
}

/// The same with guarded arrays and nodes in read-only pages, by the function for these integers. Numbers
/// beyond 32 bits, which no correct call returns, become 0.
template <class Int = std::int32_t>
Mesh guarded_trmesh(const Nodes& nodes, Edge edge) {
  const Columns c(nodes);
  Guarded<double> x(c.x, edge), y(c.y, edge), z(c.z, edge);
  for (auto* component : {&x, &y, &z}) component->make_read_only();
  Mesh m{room_for(nodes.size())};
  const auto of_int = [](const std::vector<std::int32_t>& v) { return std::vector<Int>(v.begin(), v.end()); };
  Guarded<Int> list(of_int(m.list), edge), lptr(of_int(m.lptr), edge), lend(of_int(m.lend), edge),
      lnew(of_int({m.lnew}), edge);
  const auto call = [&](const auto& trmesh) {
    return trmesh(static_cast<Int>(nodes.size()), x.data(), y.data(), z.data(), list.data(), lptr.data(),
                  lend.data(), lnew.data());
  };
  const auto narrow = [](Int wide) {
    const auto value = static_cast<std::int32_t>(wide);
    return value == wide ? value : 0;
  };
  if constexpr (sizeof(Int) == 8)
    m.ier = narrow(call(pstripack_trmesh_i8));
  else
    m.ier = call(pstripack_trmesh);
  for (auto [from, to] : {std::pair(&list, &m.list), std::pair(&lptr, &m.lptr), std::pair(&lend, &m.lend)})
    for (std::size_t i = 0; i < from->size(); ++i) (*to)[i] = narrow((*from)[i]);
  m.lnew = narrow(lnew[0]);
  return m;
}

inline Mesh trmesh_i8(const Nodes& nodes, Edge edge = Edge::end) {
  return guarded_trmesh<std::int64_t>(nodes, edge);
}

/// The library's own verdict; empty if valid.
inline std::string verdict(const Nodes& nodes, const Lists& lists) {
  const Columns c(nodes);
  char message[256] = "";
  const std::int32_t code = pstripack_validate(static_cast<std::int32_t>(nodes.size()), c.x.data(),
                                               c.y.data(), c.z.data(), lists.list.data(), lists.lptr.data(),
                                               lists.lend.data(), lists.lnew, message, sizeof message);
  return code == 0 ? "" : "code " + std::to_string(code) + ": " + message;
}
