#pragma once
// A triangulation whose points and stars are distributed over ranks: the implementation of pstripack_mesh
// in the C API.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/cached.h"
#include "mpi/mpi_communicator.h"
#include "mpi/numbering.h"
#include "mpi/own_stars.h"
#include "parallel/moving_stars.h"
#include "parallel/relocation.h"
#include "parallel/triangulate.h"
#include "trmesh/call.h"
#include "trmesh/patience.h"

namespace pstripack {

/// The collective functions of the C API.
enum class MeshCall : int { triangulate, gather, scvt, exchange, check };
constexpr const char* kNamesOfCalls[] = {"mesh_triangulate", "mesh_gather", "mesh_scvt", "mesh_exchange",
                                         "mesh_check"};

/// See capi/pstripack_mpi.h for the meaning of the members. Those marked "Collective" throw AgreedFailure,
/// having changed none of the caller's arrays.
class DistributedMesh {
 public:
  /// Collective. Throws what MpiCommunicator's constructor throws.
  explicit DistributedMesh(MPI_Comm comm) : ranks_(comm) {}

  MpiCommunicator& ranks() { return ranks_; }
  int rank() const { return ranks_.rank(); }

  /// Begins a call: the messages of different calls never match. If not all ranks begin the same, the mesh
  /// becomes empty and all throw. The same message agrees on the votes. Collective. Throws AgreedFailure.
  template <class... Votes>
  void begin(MeshCall call, Votes&... votes) {
    constexpr std::size_t kValues = 8;  // the same number in all calls
    static_assert(2 + sizeof...(Votes) <= kValues);
    Smallest first{static_cast<std::int64_t>(call)};
    Largest last{first.value};
    std::int64_t values[kValues] = {first.encode(), last.encode(), votes.encode()...};
    ranks_.set_tag(0);
    ranks_.all_min(values, kValues);
    ranks_.set_tag(1 + static_cast<int>(call));
    const std::int64_t* value = values;
    first.decode(*value++), last.decode(*value++);
    begun_ = {static_cast<int>(first.value), static_cast<int>(last.value)};
    if (has_begun_different_calls()) {
      make_empty();
      throw AgreedFailure(PSTRIPACK_RANKS_DISAGREE);
    }
    (votes.decode(*value++), ...);
  }
  /// After begin(): the calls, the first and the last of MeshCall.
  std::pair<int, int> begun() const { return begun_; }
  bool has_begun_different_calls() const { return begun_.first != begun_.second; }

  struct Report {
    std::int64_t points = 0, boundary_points = 0;  ///< of all ranks; 0 if not known
    GroupCost cost;
  };

  /// Returns the result code. If it is not 0, and after AgreedFailure, the mesh is empty. report: if rank 0
  /// passes one, it is filled on every rank that passes one. by_direction, the same on every rank: the mesh
  /// of the directions, whatever the lengths. Collective.
  std::int32_t triangulate(std::int64_t n, const double* xyz, const std::int64_t* number,
                           Report* report = nullptr, bool by_direction = false);

  /// True if there was no triangulation yet, or the last one failed.
  bool empty() const { return total_ == 0; }
  /// Makes the mesh empty, as a triangulation that fails. Collective.
  void make_empty() {
    clear();
    homes_.reset();
  }
  std::int64_t error_point(int i) const { return error_point_[i]; }
  /// After PSTRIPACK_BAD_SIZE and PSTRIPACK_TOO_MANY_NODES of triangulate(): its n. After
  /// PSTRIPACK_RANKS_DISAGREE of gather(): its root.
  const WrongArgument& wrong_argument() const { return wrong_argument_; }

  const OwnStars& own() const { return own_; }
  /// Sets rank[i] to the home of each of n points. If one is zero or not finite returns false, having written
  /// nothing. The mesh must not be empty. Not collective.
  bool home(std::int64_t n, const double* xyz, std::int32_t* rank) const;

  /// Gathers the lists. Returns the result code. root: the rank that has the arrays, or kEveryRank; ranks
  /// that disagree in it get PSTRIPACK_RANKS_DISAGREE. `report` is filled if triangulate() has filled one.
  /// Collective.
  static constexpr std::int32_t kEveryRank = -1;
  std::int32_t gather(std::int32_t root, const ListArrays& lists, Report* report = nullptr);

  /// Begins to send `width` values of 8 bytes of each point here to the ranks that have it in their halo. All
  /// ranks pass the same width. Returns the result code. Collective.
  std::int32_t begin_exchange(const void* values, std::int64_t width);
  /// Waits for the values of an exchange under way, the oldest or the newest, and writes them. Returns
  /// PSTRIPACK_EMPTY_MESH if there is none, PSTRIPACK_BAD_SIZE if it has another width.
  std::int32_t end_exchange(std::int64_t width, void* halo_values, bool is_newest);
  /// Compares the stars with each other. Returns the result code. Collective.
  std::int32_t check(std::uint64_t* fingerprint);

 private:
  std::int32_t triangulate_points(const LocalNodes& points, bool numbers_are_known, Report* report,
                                  ParallelCost& cost);
  template <class Int>
  std::int32_t triangulate_into(const LocalNodes& points, const Numbering& numbering, ParallelCost& cost);
  Coincidence first_coincidence_of(const CoincidentPairs& counted, const LocalNodes& points,
                                   const NodeRanges& ranges);
  /// True if this rank's points have the same numbers as in the last call, in the same order.
  bool has_numbers_of_last(const LocalNodes& points) const;
  bool begin_with_last(const LocalNodes& points, Report* report, ParallelCost& cost);
  /// Whether the points of this rank are at home there, and not too many.
  bool are_at_home(const LocalNodes& points) const { return homes_->are_home_to(points, ranks_.rank()); }
  std::optional<Relocation> relocation_to(const LocalNodes& points, OnAll& fits);
  void relocate(Relocation& relocation, const LocalNodes& points);
  bool move_stars(std::unique_ptr<MovingStars> moving, std::optional<Relocation> relocation,
                  const LocalNodes& points, ParallelCost& cost);
  std::int32_t gather_stars(std::int32_t root, const ListArrays& lists);
  void report_on(ParallelCost& mine, std::int64_t sent_before, Report* report);
  void clear();
  /// Without writing values.
  void end_exchanges() {
    if (!exchanges_.empty()) ranks_.finish();
    exchanges_.clear();
  }

  std::vector<Halo::Transfer> exchanges_;  ///< under way, in the order in which they have begun
  MpiCommunicator ranks_;                  ///< waits for them when it is destroyed
  std::pair<int, int> begun_{0, 0};
  bool by_direction_ = false;  ///< in this call of triangulate()
  std::int64_t error_point_[2] = {0, 0};
  WrongArgument wrong_argument_;
  std::int64_t total_ = 0;          ///< points of all ranks
  bool is_reported_ = false;        ///< rank 0 wants reports; the same on every rank
  bool numbers_are_dense_ = false;  ///< the global numbers are 1..total
  OwnStars own_;
  std::unique_ptr<Homes> homes_;  ///< of the last triangulation; the next may use them; null if it failed

  /// Cached for the next call, in case it has the same numbers.
  struct ForNext {
    Cached<MovingStars> moving;           ///< of the last call, if it was a warm start
    std::optional<SampleOfStars> sample;  ///< of this rank's stars; none if there was no memory
    bool wants_sample = false;            ///< the last call had the same numbers as the call before it
    bool are_at_home = false;             ///< as are_at_home() returned in the last call
  } next_;
  Patience patience_;  ///< the same on every rank
};

}  // namespace pstripack
