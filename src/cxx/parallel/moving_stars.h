#pragma once
// A triangulation whose nodes stay on the ranks that bring them and move a little:
// docs/internals/parallel.md, "Warm start".

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/cached.h"
#include "mesh/flips.h"
#include "mesh/sample_of_stars.h"
#include "parallel/communicator.h"
#include "parallel/halo.h"
#include "parallel/local_nodes.h"
#include "parallel/local_numbers.h"
#include "parallel/node_ranges.h"
#include "parallel/number_table.h"
#include "parallel/relocation.h"
#include "parallel/return_rings.h"

namespace pstripack {

/// A sample of these stars; this rank, `me`, brings all their neighbours. Throws std::bad_alloc.
template <class Int>
SampleOfStars sample_of(const Stars<Int>& stars, const NodeRanges& ranges, RankNumber me);

/// The stars of the nodes that this rank brings, and where the nodes are; with those of the other ranks, a
/// mesh without a boundary.
class MovingStars : public CachedThing {
 public:
  /// From the stars of these nodes, which may have moved since; numbers in the stars are counted by `ranges`.
  /// Null, on every rank, if the mesh has a boundary or all ranks together have more nodes outside than
  /// nodes. If the stars are way->stars(), it takes less time on a rank that has the MovingStars of the last
  /// call; these are used up. Collective. Throws AgreedFailure.
  template <class Int>
  static std::unique_ptr<MovingStars> make(const LocalNodes& nodes, const NodeRanges& ranges,
                                           const Stars<Int>& stars, Communicator& ranks,
                                           std::unique_ptr<MovingStars> last = nullptr,
                                           const Relocation* way = nullptr);

  /// Makes them the stars in the Delaunay triangulation of the same nodes at their current positions, and
  /// returns true. Returns false where MovingMesh::repair() would. The result is the same on every rank.
  /// Collective. Throws AgreedFailure. After false or a throw the stars must be discarded.
  bool repair(const LocalNodes& nodes, Communicator& ranks, Confirm confirm = Confirm::nothing);
  std::size_t flips() const { return mesh_->flips() - flips_of_others_; }  ///< the sum of all ranks' counts
  int rounds() const { return rounds_; }                                   ///< exchanges of flips

  /// After repair(): updates the stars that were given to make(). Throws std::bad_alloc.
  template <class Int>
  void update(Stars<Int>& stars);

 private:
  using Corner = HaloNode;
  /// The corners a, b, c, d of MovingMesh::Quadrangle. It is proposed by a rank that has a.
  struct Flip {
    Corner corner[4];
  };
  /// A triangle, as counted numbers, and a direction inside it.
  struct Mark {
    GlobalNumber corner[3];
    Point towards;
  };
  /// A node that is a neighbour of nodes here, or was one.
  struct Outside {
    GlobalNumber counted, number;
    std::uint32_t arcs;  ///< to nodes here
  };

  /// What has been proposed to this rank in a round.
  struct Proposals {
    Parcels flips;
    std::vector<char> accepted;  ///< by this rank
    Parcels verdicts;            ///< of the other ranks
  };

  MovingStars(const NodeRanges& ranges, std::size_t size, RankNumber me, std::size_t outside);
  template <class Int>
  bool begin(const LocalNodes& nodes, const Stars<Int>& stars);
  template <class Int>
  void begin_with(MovingStars& last, const Relocation& way, const Stars<Int>& stars);
  bool move_nodes(const LocalNodes& nodes, Communicator& ranks, Confirm confirm);
  std::optional<MovingMesh::Mark> agree_on_mark(Communicator& ranks);
  bool propose(const LocalNodes& nodes, std::vector<Flip>& flips);
  std::vector<RankNumber> ranks_of(const Flip& flip) const;
  Parcels sent_to_corners(const std::vector<Flip>& flips) const;
  Parcels verdicts_on(Proposals& proposals) const;
  bool flip_all(const Proposals& proposals);
  bool flip_one(const Flip& flip);
  bool meet(const Corner& one, const Corner& other);
  bool is_here(GlobalNumber counted) const { return ranges_.is_of(me_, counted); }
  /// The node of the mesh here; kNobody if this rank does not know it.
  MeshNode find(GlobalNumber counted) const;
  GlobalNumber counted(MeshNode v) const {
    return v < mesh_->size() ? ranges_.number({me_, v}) : outside_[v - mesh_->size()].counted;
  }

  const NodeRanges ranges_;
  const std::size_t size_;  ///< number of ranks
  const RankOfNode me_;
  std::optional<CacheReservation> stay_;
  std::optional<MovingMesh> mesh_;
  std::vector<Outside> outside_;  ///< by OutsideNode
  /// Neighbours among outside_ by number, as in the stars that update() has written last; none at first, on
  /// all ranks, and after the neighbours have changed.
  std::optional<std::vector<OutsideNode>> by_number_;
  NumberTable<MeshNode> outside_by_counted_;  ///< numbers of outside_
  Halo halo_;
  std::size_t come_ = 0;             ///< nodes that have come since the mesh was laid out along its curve
  std::size_t replaced_ = 0;         ///< entries of rings that update() has written
  std::size_t flips_of_others_ = 0;  ///< flips that another rank counts
  int rounds_ = 0;
};

}  // namespace pstripack
