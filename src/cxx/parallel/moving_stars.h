#pragma once
// A triangulation whose nodes stay on the ranks that bring them and move a little: docs/parallel.md, "Warm
// start".

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/workspace.h"
#include "mesh/flips.h"
#include "mesh/sample_of_stars.h"
#include "parallel/communicator.h"
#include "parallel/local_nodes.h"
#include "parallel/local_numbers.h"
#include "parallel/number_table.h"
#include "parallel/relocation.h"
#include "parallel/return_rings.h"

namespace pstripack {

/// A sample of these stars; this rank brings all their neighbours. Throws std::bad_alloc.
template <class Int>
SampleOfStars sample_of(const LocalNodes& nodes, const Stars<Int>& stars);

/// The stars of the nodes that this rank brings, and where the nodes are; with those of the other ranks, a
/// mesh without a boundary.
class MovingStars {
 public:
  /// From the stars of these nodes, which may have moved since. Null, on every rank, if the mesh has a
  /// boundary or all ranks together have more nodes outside than nodes. Collective. Throws AgreedFailure.
  template <class Int>
  static std::unique_ptr<MovingStars> make(const LocalNodes& nodes, const Stars<Int>& stars,
                                           Communicator& ranks);
  /// The same for stars that are way.stars(). It takes less time on a rank that has the MovingStars of the
  /// last call; these are used up.
  template <class Int>
  static std::unique_ptr<MovingStars> make(const LocalNodes& nodes, const Stars<Int>& stars,
                                           Communicator& ranks, std::unique_ptr<MovingStars> last,
                                           const Relocation& way);

  /// Makes them the stars in the Delaunay triangulation of the same nodes at their current positions, and
  /// returns true. Returns false where MovingMesh::repair() would. The result is the same on every rank.
  /// Collective. Throws AgreedFailure. After false or a throw the stars must be discarded.
  bool repair(const LocalNodes& nodes, Communicator& ranks, Confirm confirm = Confirm::nothing);
  std::size_t flips() const { return mesh_->flips() - flips_of_others_; }  ///< the sum of all ranks' counts
  int rounds() const { return rounds_; }                                   ///< exchanges of flips
  std::size_t halo() const { return outside_.size(); }

  /// After repair(): updates the stars that were given to make(), and returns the nodes whose rings have
  /// changed. Throws std::bad_alloc.
  template <class Int>
  std::vector<LocalNode> update(const LocalNodes& nodes, Stars<Int>& stars);

  SampleOfStars sample() const;  ///< as sample_of()

 private:
  /// A node of any rank.
  struct Address {
    RankOfNode rank;
    LocalNode node;  ///< there
    bool operator==(const Address& other) const { return rank == other.rank && node == other.node; }
    std::uint64_t key() const { return std::uint64_t{rank} << 32 | node; }
  };
  struct Corner {
    Address address;
    GlobalNumber number;
    Point point;
  };
  /// The corners a, b, c, d of MovingMesh::Quadrangle. It is proposed by a rank that has a.
  struct Flip {
    Corner corner[4];
  };
  /// A triangle, and a direction inside it.
  struct Mark {
    Address corner[3];
    Point towards;
  };
  /// A node that is a neighbour of nodes here, or was one.
  struct Outside {
    Address address;
    GlobalNumber number;
    std::uint32_t arcs;  ///< to nodes here
  };

  MovingStars(std::size_t ranks, RankNumber me)
      : me_(static_cast<RankOfNode>(me)), send_(ranks), receive_(ranks) {}
  /// begin(moving): what moving.begin() or moving.begin_with() returns.
  template <class Int, class Begin>
  static std::unique_ptr<MovingStars> make(const LocalNodes& nodes, const Stars<Int>& stars,
                                           Communicator& ranks, const Begin& begin);
  template <class Int>
  Parcels begin(const LocalNodes& nodes, const Stars<Int>& stars, const Parcels& wanted);
  template <class Int>
  Parcels begin_with(MovingStars& last, const Relocation& way, const LocalNodes& nodes,
                     const Stars<Int>& stars, const Parcels& wanted);
  Parcels find_wanted(const Parcels& wanted, const NumberTable<MeshNode>& local);
  void enter_outside(const std::vector<Record>& outside, std::size_t n, NumberTable<MeshNode>& local);
  void sort_outside();
  bool move_nodes(const LocalNodes& nodes, Communicator& ranks, Confirm confirm);
  std::optional<MovingMesh::Mark> agree_on_mark(Communicator& ranks);
  bool propose(const LocalNodes& nodes, std::vector<Flip>& flips);
  bool flip_all(const Parcels& flips);
  bool flip_one(const Flip& flip);
  bool meet(const Corner& one, const Corner& other);
  MeshNode find(const Address& address) const;
  Address address_of(MeshNode v) const {
    return v < mesh_->size() ? Address{me_, v} : outside_[v - mesh_->size()].address;
  }

  const RankOfNode me_;
  RankNumber first_with_nodes_ = 0;
  std::optional<Stay> stay_;
  std::optional<MovingMesh> mesh_;
  std::vector<Outside> outside_;  ///< by OutsideNode
  /// Neighbours among outside_ by number; none after these have changed.
  std::optional<std::vector<OutsideNode>> by_number_;
  std::vector<std::vector<LocalNode>> send_;       ///< to each rank: the nodes whose places it is told
  std::vector<std::vector<OutsideNode>> receive_;  ///< from each rank: the nodes whose places it tells
  std::size_t come_ = 0;             ///< nodes that have come since the mesh was laid out along its curve
  std::size_t replaced_ = 0;         ///< entries of rings that update() has written
  std::size_t flips_of_others_ = 0;  ///< flips that another rank counts
  int rounds_ = 0;
};

}  // namespace pstripack
