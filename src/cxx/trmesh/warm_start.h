#pragma once
// A call of TRMESH that starts from the mesh of an earlier one: docs/internals/design.md, "Warm start".

#include <cstddef>
#include <cstdint>
#include <memory>

#include "geometry/predicates.h"
#include "mesh/flips.h"
#include "parallel/cost.h"
#include "trmesh/call.h"
#include "trmesh/patience.h"

namespace pstripack {

struct CachedMesh;
struct LastMesh;

/// The warm start of one call with the nodes nodes[0..n-1]. The object owns the mesh of an earlier call, if
/// one is cached whose sample fits these nodes; the destructor puts it back. May be used from any thread;
/// never waits.
class WarmStart {
 public:
  /// confirm: see MovingMesh::repair().
  WarmStart(const NodeArrays& nodes, std::size_t n, Confirm confirm = Confirm::nothing);
  ~WarmStart();
  WarmStart(const WarmStart&) = delete;
  WarmStart& operator=(const WarmStart&) = delete;

  /// True if there is a mesh from which find_mesh can start.
  bool is_prepared() const;

  /// Makes the mesh of the nodes from the earlier one. False if the call must be cold.
  bool find_mesh(ParallelCost* cost) noexcept;
  /// After find_mesh(): writes the canonical lists, the same as those of a cold call.
  void write(const ListArrays& lists, ParallelCost* cost) noexcept;
  /// Both. If it returns false it has written nothing.
  bool write_lists(const ListArrays& lists, ParallelCost* cost) noexcept {
    const bool found = find_mesh(cost);
    if (found) write(lists, cost);
    return found;
  }

  /// To be called after a cold call, with its lists. Caches what a later call may need.
  void remember(const ListArrays& lists) noexcept;

 private:
  MovingMesh::Moved move_nodes(CachedMesh& cached) const;
  void take_sample(const std::int32_t* list, const std::int32_t* lend) noexcept;

  const NodeArrays nodes_;
  const std::size_t n_;
  const Confirm confirm_;
  std::unique_ptr<LastMesh> last_;
  Patience patience_;  ///< for a mesh first cached by this call
};

}  // namespace pstripack
