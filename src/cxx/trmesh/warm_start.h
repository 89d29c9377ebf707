#pragma once
// A call of TRMESH that begins with the mesh of an earlier one: docs/design.md, "Warm start".

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "parallel/cost.h"
#include "trmesh/call.h"
#include "trmesh/patience.h"

namespace pstripack {

struct KeptMesh;
struct LastMesh;

/// One call with the nodes nodes[0..n-1]. While it lives it has the mesh of an earlier call for itself, if
/// one is remembered that fits these nodes. Safe from any thread; nobody waits.
class WarmStart {
 public:
  WarmStart(const NodeArrays& nodes, std::size_t n);
  ~WarmStart();
  WarmStart(const WarmStart&) = delete;
  WarmStart& operator=(const WarmStart&) = delete;

  /// True if write_lists has a mesh to begin with.
  bool is_prepared() const;

  /// Writes the canonical lists of the nodes, the same that any other way leads to, and returns true; or
  /// returns false, has written nothing, and the call has to go the cold way.
  bool write_lists(const ListArrays& lists, ParallelCost* cost) noexcept;

  /// After the cold way: these are the lists of the nodes. Keeps what a later call may need.
  void remember(const ListArrays& lists) noexcept;

 private:
  std::pair<bool, bool> move_nodes(KeptMesh& kept) const;
  void take_sample(const std::int32_t* list, const std::int32_t* lend) noexcept;

  const NodeArrays nodes_;
  const std::size_t n_;
  std::unique_ptr<LastMesh> last_;
  Patience patience_;  ///< of a mesh that begins with this call
};

/// Those of this process that no call has for itself. True if there were any.
bool forget_last_meshes() noexcept;

}  // namespace pstripack
