// The C API over MPI: sets the default floating-point environment and turns exceptions into codes.

#include "capi/pstripack_mpi.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "base/floating_point.h"
#include "capi/hooks.h"
#include "capi/scvt_calls.h"
#include "mpi/collective_trmesh.h"
#include "mpi/distributed_evaluator.h"
#include "mpi/distributed_mesh.h"
#include "scvt/caller_agreement.h"
#include "scvt/tessellation.h"
#include "stripack/original/original_rules.h"

using namespace pstripack;

struct pstripack_mesh {
  explicit pstripack_mesh(MPI_Comm comm) : mesh(comm) {}
  DistributedMesh mesh;
  const pid_t process = getpid();
};

namespace {

bool mpi_is_running() {
  int initialised = 0, finalised = 0;
  MPI_Initialized(&initialised);
  MPI_Finalized(&finalised);
  return initialised && !finalised;
}

/// False before MPI_Init, after MPI_Finalize, in a forked child of `process`, which has no part in MPI, and
/// in a thread other than MPI's first if MPI provides less than `level`.
bool may_call_mpi(pid_t process, int level = MPI_THREAD_SERIALIZED) {
  if (process != getpid() || !mpi_is_running()) return false;
  int provided = MPI_THREAD_SINGLE, is_main = 0;
  MPI_Query_thread(&provided);
  if (provided >= level) return true;
  MPI_Is_thread_main(&is_main);
  return is_main;
}

/// Calls body() in the default floating-point environment. Returns its result, or the code of its exception.
template <class Body>
std::int32_t guarded(const Body& body) noexcept {
  try {
    return in_default_floating_point(body);
  } catch (...) {
    return code_of(std::current_exception());
  }
}

/// The same for collective work. An exception that the ranks have not agreed on would leave the others
/// waiting for ever, so it aborts the job. There should be none.
template <class Body>
std::int32_t guarded(MpiCommunicator& ranks, const Body& body) noexcept {
  return guarded([&] {
    try {
      return body();
    } catch (const AgreedFailure&) {
      throw;
    } catch (const std::exception& error) {
      ranks.abort("error", error.what());
    } catch (...) {
      ranks.abort("error", "unknown");
    }
  });
}

/// What pstripack_set_comm has set. Never destroyed: MPI may be finalised before or after static objects are
/// destroyed.
struct CommMode {
  std::mutex one_call_at_a_time;
  std::unique_ptr<MpiCommunicator> ranks;
  pid_t process = 0;
};
CommMode& comm_mode() {
  // Not on the heap: a rank without memory must still be able to tell the others.
  alignas(CommMode) static unsigned char memory[sizeof(CommMode)];
  static auto* const mode = new (memory) CommMode;
  return *mode;
}

/// The engine of comm mode. A call that it takes holds the mutex.
class CommEngine final : public Engine {
 public:
  bool takes(const TrmeshCall& call) noexcept override {
    CommMode& mode = comm_mode();
    if (call.by_direction || !may_call_mpi(mode.process, MPI_THREAD_MULTIPLE)) return false;
    mode.one_call_at_a_time.lock();
    if (mode.ranks == nullptr) mode.one_call_at_a_time.unlock();
    return mode.ranks != nullptr;
  }

  TrmeshResult carry_out(const TrmeshCall& call, CallWay* way) override {
    CommMode& mode = comm_mode();
    const std::lock_guard<std::mutex> lock(mode.one_call_at_a_time, std::adopt_lock);
    MpiCommunicator& ranks = *mode.ranks;
    if (way != nullptr) way->mode = CallWay::by_comm, way->ranks = ranks.size();
    TrmeshResult result{0};
    result.ier = guarded(ranks, [&] {
      result = collective_trmesh(ranks, Arrays::on_every_rank, call, way != nullptr ? &way->cost : nullptr);
      return result.ier;
    });
    result.is_silent = ranks.rank() != 0;
    return result;
  }
};
CommEngine comm_engine;

/// The first rank on which PSTRIPACK_ORDER differs from that of rank 0; -1 if there is none. They must agree,
/// because calls are not collective unless it is canonical. Collective.
int rank_with_another_order(MpiCommunicator& ranks) {
  const OriginalRules& rules = original_rules();
  const std::int64_t order = rules.follow ? 2 * rules.tolerance_in_epsilons + (rules.bitwise ? 1 : 0) : 0;
  return first_different(order, ranks).rank;
}

/// Writes the line of a code.
std::int32_t told_that(const char* routine, std::int32_t code, const char* text) {
  std::fprintf(stderr, "pstripack: %s: %s (IER = %d)\n", routine, text, static_cast<int>(code));
  return code;
}

/// The same for a code that STRIPACK does not have.
std::int32_t told(const char* routine, std::int32_t code) {
  return code < PSTRIPACK_COLLINEAR ? told_that(routine, code, pstripack_strerror(code)) : code;
}

constexpr const char* kNotFromHere = "MPI is not running, or must not be called by this thread or process";

/// Whether a rank can begin a collective call of the mesh. If not, writes a line.
bool can_begin(const pstripack_mesh* mesh, MeshCall call) {
  const char* const name = kNamesOfCalls[static_cast<int>(call)];
  if (mesh == nullptr && mpi_is_running()) {
    told_that(name, PSTRIPACK_EMPTY_MESH, "the mesh is NULL on this rank; others would wait for it");
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  if (mesh != nullptr && may_call_mpi(mesh->process)) return true;
  told_that(name, PSTRIPACK_BAD_COMM, kNotFromHere);
  return false;
}

struct Text {
  char text[200];
};

/// What is wrong with the number of points of a rank. The Fortran module passes the shape of an array
/// xyz(rows, columns) that is not xyz(3, n) as n = -1 - ((rows + 1) * 2^31 + columns).
Text text_of_count(const WrongArgument& n, const char* array_of_n) {
  const auto value = static_cast<long long>(n.value), shape = -(value + 1);
  Text line;
  if (value >= 0)
    std::snprintf(line.text, sizeof line.text, "rank %d: n = %lld: a rank may have at most %lld points",
                  n.rank, value, static_cast<long long>(kMostPoints) - 1);
  else if (shape >> 31 == 0)
    std::snprintf(line.text, sizeof line.text, "rank %d: n = %lld is below 0", n.rank, value);
  else
    std::snprintf(line.text, sizeof line.text, "rank %d: xyz is (%lld,%lld): must be (3,n), n the size of %s",
                  n.rank, (shape >> 31) - 1, shape & INT32_MAX, array_of_n);
  return line;
}

Text text_of_calls(const DistributedMesh& mesh) {
  Text line;
  std::snprintf(line.text, sizeof line.text, "some ranks have called %s, others %s",
                kNamesOfCalls[mesh.begun().first], kNamesOfCalls[mesh.begun().second]);
  return line;
}

/// Writes the line of a collective call on rank 0, `text` if it is not empty.
std::int32_t told_by_rank_0(DistributedMesh& mesh, MeshCall call, std::int32_t code, const Text& text) {
  const char* const name = kNamesOfCalls[static_cast<int>(call)];
  if (mesh.rank() != 0) return code;
  if (mesh.has_begun_different_calls()) return told_that(name, code, text_of_calls(mesh).text);
  return text.text[0] != 0 ? told_that(name, code, text.text) : told(name, code);
}

std::int32_t end_exchange(pstripack_mesh* handle, std::int64_t width, void* halo_values, bool is_newest) {
  if (!can_begin(handle, MeshCall::exchange)) return PSTRIPACK_BAD_COMM;
  DistributedMesh& mesh = handle->mesh;
  const std::int32_t code =
      guarded(mesh.ranks(), [&] { return mesh.end_exchange(width, halo_values, is_newest); });
  if (code != PSTRIPACK_BAD_SIZE) return told("mesh_exchange_end", code);
  return told_that("mesh_exchange_end", code, "width is not that with which the exchange has begun");
}

void end_comm_mode(CommMode& mode) {
  if (mode.ranks == nullptr) return;
  pstripack_set_trmesh_engine(nullptr);
  pstripack_leave_check_to_another_rank(0);
  mode.ranks.reset();
}

int at_mpi_finalize(MPI_Comm, int, void*, void*) {
  end_comm_mode(comm_mode());
  return MPI_SUCCESS;
}

/// Attributes of MPI_COMM_SELF are deleted at the beginning of MPI_Finalize, when everything still works.
void end_comm_mode_at_mpi_finalize() {
  static int key = MPI_KEYVAL_INVALID;
  if (key != MPI_KEYVAL_INVALID) return;
  MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, at_mpi_finalize, &key, nullptr);
  MPI_Comm_set_attr(MPI_COMM_SELF, key, nullptr);
}

/// Makes a T over comm. If a rank has no memory for it, all ranks throw. Collective.
template <class T>
std::unique_ptr<T> make_over(MPI_Comm comm) {
  void* const memory = ::operator new(sizeof(T), std::nothrow);
  if (memory == nullptr)
    MpiCommunicator(comm, MpiCommunicator::kLongestMessage, PSTRIPACK_OUT_OF_MEMORY);  // throws
  try {
    return std::unique_ptr<T>(new (memory) T(comm));
  } catch (...) {
    ::operator delete(memory);
    throw;
  }
}

/// Runs body(report), a call of a distributed mesh, and writes its line to the report of rank 0. Collective.
template <class Body>
std::int32_t reported(MpiCommunicator& ranks, CallReport::Mode mode, const Body& body) {
  if (ranks.rank() != 0 || !pstripack_report_is_wanted())
    return guarded(ranks, [&] { return body(nullptr); });
  return in_default_floating_point([&] {
    DistributedMesh::Report about;
    CallReport report;
    const double start = clock_seconds(CLOCK_MONOTONIC);
    report.ier = guarded(ranks, [&] { return body(&about); });
    report.seconds = clock_seconds(CLOCK_MONOTONIC) - start;
    report.mode = mode;
    report.ranks = ranks.size();
    report.n = about.points;
    report.nodes_in_mesh = report.ier == 0 ? about.points : 0;
    report.boundary_nodes = about.boundary_points;
    report.cost = about.cost;
    pstripack_add_to_report(&report);
    return report.ier;
  });
}

// ---- centroidal tessellations

/// The options of rank 0. Every rank checks them, so all throw the same. Collective.
pstripack_scvt_options checked_by_all(MpiCommunicator& ranks, const pstripack_scvt_options* given) {
  constexpr auto kSize = static_cast<std::int64_t>(sizeof(pstripack_scvt_options));
  pstripack_scvt_options mine{};
  const bool has_some = ranks.rank() == 0 && given != nullptr;
  if (has_some) {
    mine.bytes = given->bytes;
    const auto least = static_cast<std::int64_t>(sizeof mine.bytes);
    if (mine.bytes >= least) std::memcpy(&mine, given, static_cast<std::size_t>(std::min(mine.bytes, kSize)));
  }
  const Parcels all = ranks.all_gather(&mine, has_some ? sizeof mine : 0);
  const Items<pstripack_scvt_options> of_rank_0(all, 0);
  return checked(of_rank_0.size() == 0 ? nullptr : of_rank_0.begin());
}

/// Makes the progress procedure of rank 0 decide for all ranks.
void let_rank_0_decide(scvt::RunOptions& how, MpiCommunicator& ranks) {
  if (!how.progress) return;
  how.progress = [&ranks, tell = std::move(how.progress)](const scvt::Progress& progress) {
    OfRank0 goes_on(ranks, true);
    scvt::in_agreement_with_caller(
        ranks,
        [&] {
          if (ranks.rank() == 0) goes_on.value = tell(progress);
        },
        goes_on);
    return goes_on.value;
  };
}

/// The start of a run on all ranks. The constructor is collective.
struct StartOfRun {
  StartOfRun(MpiCommunicator& ranks, std::int64_t n, const double* xyz, const std::int64_t* number,
             const pstripack_scvt_options& options) {
    const std::int64_t* const counts = ranks.all_gather_one(n);
    std::int64_t total = 0;
    for (int r = 0; r < ranks.size(); ++r) {
      if (const std::int32_t code = code_of_rank_count(counts[r]); code != 0)
        throw Refusal{code, text_of_count({r, counts[r]}, "number").text};
      total += counts[r];
    }
    if (total < 4)
      throw Refusal{PSTRIPACK_TOO_FEW_NODES,
                    "a tessellation needs at least 4 generators, here are " + std::to_string(total)};
    in_agreement(ranks, [&] {
      how = run_options(options);
      let_rank_0_decide(how, ranks);
      if (n == 0) return;
      numbers.assign(number, number + n);
      state.generators.resize(numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i)
        state.generators[i] = scvt::unit_vector({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
    });
  }
  scvt::RunOptions how;
  std::vector<std::int64_t> numbers;
  scvt::State state;
};

/// Runs body(); aborts the job on std::bad_alloc. Only the text of an error is allocated without an
/// agreement of the ranks, and the others cannot know of that failure.
template <class Body>
void abort_without_memory(MpiCommunicator& ranks, const Body& body) {
  try {
    body();
  } catch (const std::bad_alloc&) {
    ranks.abort("error", pstripack_strerror(PSTRIPACK_OUT_OF_MEMORY));
  }
}

MPI_Comm communicator_of(MPI_Fint comm) { return mpi_is_running() ? MPI_Comm_f2c(comm) : MPI_COMM_NULL; }

}  // namespace

extern "C" {

int32_t pstripack_set_comm(MPI_Comm comm) {
  if (mpi_is_running() && !may_call_mpi(getpid()))
    return told_that("set_comm", PSTRIPACK_BAD_COMM, kNotFromHere);
  const std::int32_t code = guarded([&] {
    CommMode& mode = comm_mode();
    const std::lock_guard<std::mutex> lock(mode.one_call_at_a_time);
    if (comm == MPI_COMM_NULL) {
      end_comm_mode(mode);
      return 0;
    }
    auto ranks = make_over<MpiCommunicator>(comm);
    if (const int other = rank_with_another_order(*ranks); other >= 0) {
      if (ranks->rank() == 0)
        std::fprintf(stderr,
                     "pstripack: set_comm: PSTRIPACK_ORDER on rank %d is not that on rank 0 (IER = -7)\n",
                     other);
      return std::int32_t{PSTRIPACK_RANKS_DISAGREE};
    }
    end_comm_mode_at_mpi_finalize();
    mode.ranks = std::move(ranks);
    mode.process = getpid();
    pstripack_leave_check_to_another_rank(mode.ranks->rank() != 0);
    pstripack_set_trmesh_engine(&comm_engine);
    return 0;
  });
  return code == PSTRIPACK_RANKS_DISAGREE ? code : told("set_comm", code);
}

int32_t pstripack_set_comm_f(MPI_Fint comm) {
  int is_initialised = 0;
  MPI_Initialized(&is_initialised);
  if (!is_initialised)  // what the handle means is not known before
    return told_that("set_comm", PSTRIPACK_BAD_COMM, "called before MPI_Init");
  return pstripack_set_comm(communicator_of(comm));
}
void pstripack_set_comm_(const MPI_Fint* comm) { pstripack_set_comm_f(*comm); }
void pstripack_set_comm__(const MPI_Fint* comm) { pstripack_set_comm_f(*comm); }

int32_t pstripack_mesh_create(MPI_Comm comm, pstripack_mesh** mesh) {
  *mesh = nullptr;
  if (mpi_is_running() && !may_call_mpi(getpid()))
    return told_that("mesh_create", PSTRIPACK_BAD_COMM, kNotFromHere);
  return told("mesh_create", guarded([&] {
                *mesh = make_over<pstripack_mesh>(comm).release();
                return 0;
              }));
}

int32_t pstripack_mesh_create_f(MPI_Fint comm, pstripack_mesh** mesh) {
  return pstripack_mesh_create(communicator_of(comm), mesh);
}

void pstripack_mesh_free(pstripack_mesh* mesh) {
  if (mesh != nullptr && mpi_is_running() && !may_call_mpi(mesh->process)) return;
  delete mesh;
}

int32_t pstripack_mesh_triangulate(pstripack_mesh* mesh, int64_t n, const double* xyz,
                                   const int64_t* number) {
  if (!can_begin(mesh, MeshCall::triangulate)) return PSTRIPACK_BAD_COMM;
  const std::int32_t code =
      reported(mesh->mesh.ranks(), CallReport::distributed, [&](DistributedMesh::Report* report) {
        mesh->mesh.begin(MeshCall::triangulate);
        return mesh->mesh.triangulate(n, xyz, number, report);
      });
  const auto first = static_cast<long long>(mesh->mesh.error_point(0)),
             second = static_cast<long long>(mesh->mesh.error_point(1));
  Text line{};
  if (const WrongArgument& n = mesh->mesh.wrong_argument(); n.rank >= 0)
    line = text_of_count(n, "number");
  else if (second != 0)
    std::snprintf(line.text, sizeof line.text, "points %lld and %lld: %s", first, second,
                  pstripack_strerror(code));
  else if (first != 0 || code == PSTRIPACK_BAD_NUMBER)
    std::snprintf(line.text, sizeof line.text, "point %lld: %s", first, pstripack_strerror(code));
  return told_by_rank_0(mesh->mesh, MeshCall::triangulate, code, line);
}

void pstripack_mesh_error_points(const pstripack_mesh* mesh, int64_t* first, int64_t* second) {
  *first = mesh->mesh.error_point(0);
  *second = mesh->mesh.error_point(1);
}

int32_t pstripack_mesh_home(const pstripack_mesh* mesh, int64_t n, const double* xyz, int32_t* rank) {
  if (mesh->mesh.empty()) return PSTRIPACK_EMPTY_MESH;
  if (n < 0)
    return told_that("mesh_home", PSTRIPACK_BAD_SIZE, text_of_count({mesh->mesh.rank(), n}, "rank").text);
  const bool are_finite = in_default_floating_point([&] { return mesh->mesh.home(n, xyz, rank); });
  return told("mesh_home", are_finite ? PSTRIPACK_OK : PSTRIPACK_BAD_COORDINATE);
}

void pstripack_mesh_sizes(const pstripack_mesh* mesh, int64_t* points, int64_t* arcs, int64_t* triangles,
                          int64_t* halo) {
  const OwnStars& own = mesh->mesh.own();
  *points = static_cast<int64_t>(own.count());
  *arcs = static_cast<int64_t>(own.arcs());
  *triangles = own.triangles();
  *halo = static_cast<int64_t>(own.outside().size());
}

void pstripack_mesh_stars(const pstripack_mesh* mesh, int64_t* begin, int64_t* neighbour) {
  mesh->mesh.own().stars(begin, neighbour);
}

void pstripack_mesh_triangles(const pstripack_mesh* mesh, int64_t* corner) {
  mesh->mesh.own().triangles(corner);
}

void pstripack_mesh_halo(const pstripack_mesh* mesh, int64_t* number, double* xyz) {
  mesh->mesh.own().halo(number, xyz);
}

void pstripack_mesh_halo_owners(const pstripack_mesh* mesh, int32_t* rank, int32_t* local) {
  mesh->mesh.own().halo_owners(rank, local);
}

int32_t pstripack_mesh_local_stars(const pstripack_mesh* mesh, int64_t* begin, int32_t* neighbour) {
  mesh->mesh.own().local_stars(begin, neighbour);
  return 0;
}

int32_t pstripack_mesh_gather(pstripack_mesh* mesh, int32_t root, int32_t* list, int32_t* lptr, int32_t* lend,
                              int32_t* lnew) {
  if (!can_begin(mesh, MeshCall::gather)) return PSTRIPACK_BAD_COMM;
  const std::int32_t code =
      reported(mesh->mesh.ranks(), CallReport::distributed_gather, [&](DistributedMesh::Report* report) {
        mesh->mesh.begin(MeshCall::gather);
        return mesh->mesh.gather(root, {list, lptr, lend, lnew}, report);
      });
  Text line{};
  if (const WrongArgument& other = mesh->mesh.wrong_argument(); code == PSTRIPACK_RANKS_DISAGREE)
    std::snprintf(line.text, sizeof line.text, "root is %d on rank 0 and %d on rank %d",
                  static_cast<int>(root), static_cast<int>(other.value), other.rank);
  else if (code == PSTRIPACK_BAD_COMM)
    std::snprintf(line.text, sizeof line.text, "there is no rank %d", static_cast<int>(root));
  return told_by_rank_0(mesh->mesh, MeshCall::gather, code, line);
}

int32_t pstripack_mesh_exchange(pstripack_mesh* mesh, const void* values, int64_t width, void* halo_values) {
  const std::int32_t code = pstripack_mesh_exchange_begin(mesh, values, width);
  return code != 0 ? code : end_exchange(mesh, width, halo_values, true);
}

int32_t pstripack_mesh_exchange_begin(pstripack_mesh* handle, const void* values, int64_t width) {
  if (!can_begin(handle, MeshCall::exchange)) return PSTRIPACK_BAD_COMM;
  DistributedMesh& mesh = handle->mesh;
  const std::int32_t code = guarded(mesh.ranks(), [&] { return mesh.begin_exchange(values, width); });
  const WrongArgument& other = mesh.wrong_argument();
  const auto wrong = static_cast<long long>(other.value);
  Text line{};
  if (code == PSTRIPACK_BAD_SIZE)
    std::snprintf(line.text, sizeof line.text, "rank %d: width = %lld is below 1", other.rank, wrong);
  else if (code == PSTRIPACK_RANKS_DISAGREE)
    std::snprintf(line.text, sizeof line.text, "width is %lld on rank 0 and %lld on rank %d",
                  static_cast<long long>(width), wrong, other.rank);
  return told_by_rank_0(mesh, MeshCall::exchange, code, line);
}

int32_t pstripack_mesh_exchange_end(pstripack_mesh* mesh, int64_t width, void* halo_values) {
  return end_exchange(mesh, width, halo_values, false);
}

int32_t pstripack_mesh_check(pstripack_mesh* mesh, uint64_t* fingerprint) {
  if (!can_begin(mesh, MeshCall::check)) return PSTRIPACK_BAD_COMM;
  const std::int32_t code = guarded(mesh->mesh.ranks(), [&] { return mesh->mesh.check(fingerprint); });
  Text line{};
  if (const auto point = static_cast<long long>(mesh->mesh.error_point(0)); code == PSTRIPACK_BAD_LISTS)
    std::snprintf(line.text, sizeof line.text,
                  point != 0 ? "point %lld: its star is no cycle, or not that of its neighbours"
                             : "the triangles do not cover one sphere or disc",
                  point);
  return told_by_rank_0(mesh->mesh, MeshCall::check, code, line);
}

int32_t pstripack_mesh_scvt(pstripack_mesh* handle, int64_t n, double* xyz, const int64_t* number,
                            const pstripack_density* density, const pstripack_scvt_options* options,
                            pstripack_scvt_result* result, char* message, int32_t length) {
  if (handle == nullptr) can_begin(handle, MeshCall::scvt);
  DistributedMesh& mesh = handle->mesh;
  MpiCommunicator& ranks = mesh.ranks();
  if (!may_call_mpi(handle->process))
    return guarded_scvt(message, length, [] { throw Refusal{PSTRIPACK_BAD_COMM, kNotFromHere}; });
  const std::int32_t code = guarded_scvt(message, length, [&] {
    abort_without_memory(ranks, [&] {
      try {
        mesh.begin(MeshCall::scvt);
      } catch (const AgreedFailure& failure) {
        throw Refusal{failure.code, text_of_calls(mesh).text};
      }
      const pstripack_scvt_options chosen = checked_by_all(ranks, options);
      StartOfRun start(ranks, n, xyz, number, chosen);
      const DensityOfCaller values(density, chosen.widths != 0);
      scvt::DistributedEvaluator evaluator(mesh, values);
      evaluator.begin_with(start.numbers);
      scvt::Repair repair;
      const scvt::Result found = scvt::solve(evaluator, start.state, start.how, repair);
      evaluator.triangulate(start.state.generators);
      if (n > 0) std::memcpy(xyz, start.state.generators.data(), start.numbers.size() * sizeof(Point));
      if (result != nullptr)
        *result = {found.progress.energy, found.progress.gradient,
                   static_cast<double>(start.state.evaluations), static_cast<std::int32_t>(n),
                   reason_of(found.end, repair)};
    });
  });
  if (code == PSTRIPACK_OK) return code;
  if (!mesh.empty()) mesh.make_empty();  // an empty mesh must keep its error points
  return code;
}

}  // extern "C"
