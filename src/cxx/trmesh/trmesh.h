#pragma once

#include <cstdint>

#include "trmesh/call.h"
#include "trmesh/engine.h"

namespace pstripack {

/// STRIPACK's TRMESH with canonical lists and exact decisions (docs/differences.md). IER is 0, -1, -2, L > 0,
/// -4 or -5 (docs/api/ier.md). On a negative code nothing is written. Under PSTRIPACK_ORDER=original
/// (original_rules.h) nodes are inserted one by one on the calling thread, and the lists are the original's
/// if these are a correct triangulation; four nodes on one circle may then have either diagonal. Under
/// PSTRIPACK_ORDER=bitwise lists and IER are the original's if its IER is not negative and its lists are a
/// triangulation, correct or not. Throws std::bad_alloc, having written nothing.
///   way           how the call was carried out, and its cost, are stored there, if given
///   communicator  asked first, since its calls are collective; null: none
///   pool          asked if the call does not begin with an earlier mesh; null: none
TrmeshResult trmesh(const TrmeshCall& call, CallWay* way = nullptr, Engine* communicator = nullptr,
                    Engine* pool = nullptr);
/// The same by this process, always with canonical lists, whatever PSTRIPACK_ORDER is. Parallel.
TrmeshResult canonical_trmesh(const TrmeshCall& call, CallWay* way = nullptr);

/// The common path of every way to carry out a call: by one hull, on threads, by ranks. A Way has
///   std::optional<Coincidence> triangulate(std::size_t n)  of the first n nodes; the first coincidence
///   void write()                                           writes the lists of the last triangulation
/// If nodes L and M > L coincide, M the smallest such, the lists are those of nodes 1..M-1.
template <class Way>
TrmeshResult triangulate_and_write(std::int32_t n, Way& way) {
  TrmeshResult result{0};
  if (const auto first = way.triangulate(static_cast<std::size_t>(n))) {
    result = {static_cast<std::int32_t>(first->l), first->l, first->m};
    // Nodes 1..M-1 do not coincide, and the first three are not on one great circle: M > 3.
    way.triangulate(static_cast<std::size_t>(first->m) - 1);
  }
  way.write();
  return result;
}

}  // namespace pstripack
