#pragma once
// pstripack_trmesh with C++ containers.

#include <utility>
#include <vector>

#include "capi/pstripack.h"
#include "columns.h"
#include "guarded.h"
#include "lists.h"

constexpr std::int32_t untouched = -987654321;  // value of all entries before the call

struct Mesh : Lists {
  std::int32_t ier = 0;
};

/// Arrays of exactly 6n-12 and n entries, not yet written.
inline Mesh room_for(std::size_t n) {
  Mesh m;
  m.list.assign(n < 3 ? 1 : 6 * n - 12, untouched);
  m.lptr = m.list;
  m.lend.assign(n, untouched);
  m.lnew = untouched;
  return m;
}

inline Mesh trmesh(const Nodes& nodes) {
  const Columns c(nodes);
  Mesh m = room_for(nodes.size());
  m.ier = pstripack_trmesh(static_cast<std::int32_t>(nodes.size()), c.x.data(), c.y.data(), c.z.data(),
                           m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
  return m;
}

/// The same in single precision.
inline Mesh trmesh_r4(const Nodes& nodes) {
  const Columns<float> c(nodes);
  Mesh m = room_for(nodes.size());
  m.ier = pstripack_trmesh_r4(static_cast<std::int32_t>(nodes.size()), c.x.data(), c.y.data(), c.z.data(),
                              m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
  return m;
}

/// The same by the function for 64-bit integers, with guarded arrays. Numbers beyond 32 bits, which no
/// correct call returns, become 0.
inline Mesh trmesh_i8(const Nodes& nodes, Edge edge = Edge::end) {
  const Columns c(nodes);
  const std::size_t n = nodes.size(), slots = n < 3 ? 1 : 6 * n - 12;
  Guarded<std::int64_t> list(std::vector<std::int64_t>(slots, untouched), edge);
  Guarded<std::int64_t> lptr(std::vector<std::int64_t>(slots, untouched), edge);
  Guarded<std::int64_t> lend(std::vector<std::int64_t>(n, untouched), edge);
  std::int64_t lnew = untouched;
  const std::int64_t ier = pstripack_trmesh_i8(static_cast<std::int64_t>(n), c.x.data(), c.y.data(),
                                               c.z.data(), list.data(), lptr.data(), lend.data(), &lnew);
  const auto narrow = [](std::int64_t wide) {
    const auto value = static_cast<std::int32_t>(wide);
    return value == wide ? value : 0;
  };
  Mesh m;
  for (auto [from, to] : {std::pair(&list, &m.list), std::pair(&lptr, &m.lptr), std::pair(&lend, &m.lend)})
    for (std::size_t i = 0; i < from->size(); ++i) to->push_back(narrow((*from)[i]));
  m.lnew = narrow(lnew);
  m.ier = narrow(ier);
  return m;
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
