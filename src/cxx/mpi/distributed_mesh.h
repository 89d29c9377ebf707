#pragma once
// A triangulation whose points and stars stay on their ranks: what pstripack_mesh of the C API is.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/kept.h"
#include "mpi/mpi_communicator.h"
#include "parallel/moving_stars.h"
#include "parallel/triangulate.h"
#include "trmesh/call.h"

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
  std::int64_t points() const { return static_cast<std::int64_t>(count_); }
  std::int64_t arcs() const { return arcs_; }
  std::int64_t triangles() const;
  std::int64_t halo() const { return static_cast<std::int64_t>(outside().size()); }

  /// The rank that is home to each of n points; false if one has no direction, having written nothing.
  bool home(std::int64_t n, const double* xyz, std::int32_t* rank) const;
  void stars(std::int64_t* begin, std::int64_t* neighbour) const;
  void triangles(std::int64_t* corner) const;
  void halo(std::int64_t* number, double* xyz) const;
  /// Throws std::bad_alloc, having written nothing.
  void local_stars(std::int64_t* begin, std::int32_t* neighbour) const;

  /// Collective. root: the rank that has the arrays, or kEveryRank. `report` is filled if triangulate() has
  /// filled one.
  static constexpr std::int32_t kEveryRank = -1;
  std::int32_t gather(std::int32_t root, const ListArrays& lists, Report* report = nullptr);

 private:
  struct Numbering;
  struct ThreeOfEach;
  std::int32_t triangulate_points(std::int64_t n, const Point* points, const std::int64_t* number,
                                  Report* report, ParallelCost& cost);
  bool begin_with_last(std::int64_t n, const Point* points, const std::int64_t* number, Report* report,
                       ParallelCost& cost);
  template <class Int>
  bool move_stars(const LocalNodes& nodes, Stars<Int>& stars, std::unique_ptr<MovingStars> moving,
                  ParallelCost& cost);
  std::int32_t gather_stars(std::int32_t root, const ListArrays& lists);
  Numbering look_at(std::int64_t n, const Point* points, const std::int64_t* number, bool wants_report);
  std::int64_t first_repeated(const std::int64_t* number, std::size_t n, const Numbering& numbering);
  std::int64_t search_repeated(const std::int64_t* number, std::size_t n);
  bool find_corners(const Point* points, std::size_t n, const std::int64_t* number, ThreeOfEach& sample,
                    Point (&corners)[3], std::int64_t (&numbers)[3]);
  template <class Int>
  std::int32_t triangulate_into(Stars<Int>& stars, const Point* points, std::size_t n,
                                const std::int64_t* number, const Numbering& numbering, ParallelCost& cost);
  void report_on(ParallelCost& mine, std::int64_t sent_before, Report* report);
  void clear();
  /// Calls visit(i, count, first) for each own point: its neighbours are first[0..count-1].
  template <class Visit>
  void for_each_star(const Visit& visit) const {
    numbers_are_short_ ? for_each_star(short_stars_, visit) : for_each_star(long_stars_, visit);
  }
  template <class Int, class Visit>
  void for_each_star(const Stars<Int>& stars, const Visit& visit) const {
    constexpr std::size_t kAhead = 16;  // they lie in the order of the patches
    for (std::size_t i = 0; i < count_; ++i) {
      if (i + kAhead < count_) stars.of_node.prefetch(i + kAhead);
      const Ring<Int> ring = stars.of_node[i];
      visit(i, static_cast<std::size_t>(ring.count), ring.begin);
    }
  }

  const std::vector<Record>& outside() const {
    return numbers_are_short_ ? short_stars_.outside : long_stars_.outside;
  }

  MpiCommunicator ranks_;
  std::int64_t error_point_[2] = {0, 0};
  std::int64_t total_ = 0;          ///< points of all ranks
  bool is_reported_ = false;        ///< rank 0 wants reports, and all know it
  bool numbers_are_short_ = true;   ///< they fit 32 bits
  bool numbers_are_dense_ = false;  ///< they are 1..total
  std::size_t count_ = 0;           ///< own points
  std::int64_t arcs_ = 0;           ///< neighbours of them all
  std::unique_ptr<Workspace> memory_;
  std::int64_t* number_ = nullptr;  ///< of the own points
  Stars<std::int32_t> short_stars_;
  Stars<std::int64_t> long_stars_;
  // For the next call, if it has the same numbers on each rank:
  Kept<MovingStars> moving_;             ///< of the last call, if that began with them, too
  std::optional<SampleOfStars> sample_;  ///< on this rank, if there is memory for it
  /// How many calls must find that the stars of the call before fit before one begins with them. More, where
  /// such stars turned out not to fit in the end. The same on every rank, as is how many have found it.
  int patience_ = 1, patient_ = 0;
  bool were_at_home_ = false;     ///< nearly all points here, when homes_ were made
  bool wants_sample_ = false;     ///< the last call had the same numbers as the one before
  std::unique_ptr<Homes> homes_;  ///< of the last triangulation, which the next may keep; null: it failed
};

}  // namespace pstripack
