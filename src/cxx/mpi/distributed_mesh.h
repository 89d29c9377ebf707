#pragma once
// A triangulation whose points and stars stay on their ranks: what pstripack_mesh of the C API is.

#include <cstdint>
#include <memory>
#include <optional>

#include "base/kept.h"
#include "mpi/mpi_communicator.h"
#include "mpi/numbering.h"
#include "mpi/own_stars.h"
#include "parallel/moving_stars.h"
#include "parallel/relocation.h"
#include "parallel/triangulate.h"
#include "trmesh/call.h"
#include "trmesh/patience.h"

namespace pstripack {

/// See capi/pstripack_mpi.h for what the members mean. "Collective" ones throw AgreedFailure, having left
/// the caller's arrays as they were.
class DistributedMesh {
 public:
  /// Collective; as MpiCommunicator.
  explicit DistributedMesh(MPI_Comm comm) : ranks_(comm) {}

  MpiCommunicator& ranks() { return ranks_; }

  /// What a call was about, and what it cost all ranks.
  struct Report {
    std::int64_t points = 0, boundary_points = 0;  ///< of all ranks, as far as known
    GroupCost cost;
  };

  /// Collective. The result code; after one that is not 0 the mesh is empty. Throws AgreedFailure, too.
  /// If rank 0 passes `report`, that is filled, and those of the other ranks that pass one.
  std::int32_t triangulate(std::int64_t n, const double* xyz, const std::int64_t* number,
                           Report* report = nullptr);

  /// Empty: no triangulation yet, or the last one failed.
  bool empty() const { return total_ == 0; }
  /// As after a triangulation that failed. Collective.
  void make_empty() {
    clear();
    homes_.reset();
  }
  std::int64_t error_point(int i) const { return error_point_[i]; }

  /// Of the last triangulation.
  const OwnStars& own() const { return own_; }
  /// The rank that is home to each of n points; false if one has no direction, having written nothing.
  bool home(std::int64_t n, const double* xyz, std::int32_t* rank) const;

  /// Collective. root: the rank that has the arrays, or kEveryRank. `report` is filled if triangulate() has
  /// filled one.
  static constexpr std::int32_t kEveryRank = -1;
  std::int32_t gather(std::int32_t root, const ListArrays& lists, Report* report = nullptr);

 private:
  std::int32_t triangulate_points(const LocalNodes& points, Report* report, ParallelCost& cost);
  template <class Int>
  std::int32_t triangulate_into(const LocalNodes& points, const Numbering& numbering, ParallelCost& cost);
  bool begin_with_last(const LocalNodes& points, Report* report, ParallelCost& cost);
  bool are_at_home(const LocalNodes& points, std::int64_t all) const;
  std::optional<Relocation> relocation_to(const LocalNodes& points, OnAll& fits);
  void relocate(const Relocation& relocation, const LocalNodes& points);
  bool move_stars(std::unique_ptr<MovingStars> moving, std::optional<Relocation> relocation,
                  const LocalNodes& points, ParallelCost& cost);
  std::int32_t gather_stars(std::int32_t root, const ListArrays& lists);
  void report_on(ParallelCost& mine, std::int64_t sent_before, Report* report);
  void clear();

  MpiCommunicator ranks_;
  std::int64_t error_point_[2] = {0, 0};
  std::int64_t total_ = 0;          ///< points of all ranks
  bool is_reported_ = false;        ///< rank 0 wants reports, and all know it
  bool numbers_are_dense_ = false;  ///< they are 1..total
  OwnStars own_;
  std::unique_ptr<Homes> homes_;  ///< of the last triangulation, which the next may keep; null: it failed

  /// For the next call, if it has the same numbers.
  struct ForNext {
    Kept<MovingStars> moving;             ///< of the last call, if that began with them, too
    std::optional<SampleOfStars> sample;  ///< on this rank, if there is memory for it
    bool wants_sample = false;            ///< the last call had the numbers of the one before
    bool are_at_home = false;             ///< nearly all points here, and not too many
  } next_;
  Patience patience_;  ///< the same on every rank
};

}  // namespace pstripack
