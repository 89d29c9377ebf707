// An MPI program for job_test.sh:
//
//   job comm           two calls of TRMESH in comm mode, one with nodes that coincide
//   job distributed    a distributed mesh, and its lists on rank 0
//   job calls N        TRMESH in comm mode for N nodes, forever; "call 2" on stdout
//   job meshes N       the same with a distributed mesh
//   job null_mesh N    the same, where rank 1 passes NULL in its second call
//   job messages N     messages that a rank sends at most in calls of a distributed mesh, on stdout
//   job ... N error    MPI fails on rank 1 once a file "fail" exists. (A file, since output can be lost when
//                      a rank aborts the job.)
//
// Exit code 0 if all results are right.

#include <dlfcn.h>
#include <mpi.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "distributions.h"
#include "point_sets.h"
#include "support/trmesh.h"

namespace {

bool mpi_fails = false;
int sent = 0;

bool in_comm_mode() {
  Nodes nodes = point_sets::make("random", 1000);
  if (pstripack_set_comm(MPI_COMM_WORLD) != 0 || !verdict(nodes, trmesh(nodes)).empty()) return false;
  nodes[70] = nodes[30];
  return trmesh(nodes).ier == 31;
}

bool distributed() {
  const Nodes nodes = point_sets::make("cap", 500);
  const OfMesh mesh;
  if (Part(nodes).triangulate(mesh) != 0) return false;
  Mesh m{room_for(nodes.size())};
  const int code = pstripack_mesh_gather(mesh, 0, m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
  return code == 0 && (rank_of() != 0 || verdict(nodes, m).empty());
}

/// Calls with the points at home; the third begins with the stars of the second.
bool messages(const Nodes& nodes) {
  Part part(nodes);
  const OfMesh mesh;
  const auto count = [&](const char* what, const auto& call) {
    sent = 0;
    if (call() != 0) MPI_Abort(MPI_COMM_WORLD, 1);
    int most;
    MPI_Reduce(&sent, &most, 1, MPI_INT, MPI_MAX, 0, MPI_COMM_WORLD);
    if (rank_of() == 0) std::printf("%s: %d messages on %d ranks\n", what, most, size_of());
  };
  const auto triangulate = [&] { return part.triangulate(mesh); };
  count("first call", triangulate);
  std::vector<std::int32_t> home(nodes.size());
  std::vector<double> xyz;
  for (const auto& p : nodes) xyz.insert(xyz.end(), {p.x, p.y, p.z});
  pstripack_mesh_home(mesh, static_cast<std::int64_t>(nodes.size()), xyz.data(), home.data());
  std::vector<std::size_t> here;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (home[i] == rank_of()) here.push_back(i);
  part = Part(nodes, here);
  count("points have moved home", triangulate);
  count("cold call", triangulate);
  count("warm call", triangulate);
  std::vector<double> halo(nodes.size());
  count("exchange", [&] { return pstripack_mesh_exchange(mesh, part.xyz.data(), 1, halo.data()); });
  return true;
}

template <class Call>
void for_ever(bool with_error, const Call& call) {
  for (int i = 1;; ++i) {
    mpi_fails = with_error && rank_of() == 1 && access("fail", F_OK) == 0;
    if (call() != 0) return;
    if (i == 2 && rank_of() == 0) std::puts("call 2");
    std::fflush(stdout);
  }
}

}  // namespace

/// Replaces MPI's function, or that of a library between.
int MPI_Testall(int count, MPI_Request* requests, int* flag, MPI_Status* statuses) {
  static auto* const next = reinterpret_cast<decltype(&MPI_Testall)>(dlsym(RTLD_NEXT, "MPI_Testall"));
  return mpi_fails ? MPI_ERR_OTHER : next(count, requests, flag, statuses);
}

/// Counts.
int MPI_Isend(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  static auto* const next = reinterpret_cast<decltype(&MPI_Isend)>(dlsym(RTLD_NEXT, "MPI_Isend"));
  ++sent;
  return next(bytes, count, type, to, tag, comm, request);
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const char* const action = argc > 1 ? argv[1] : "";
  const Nodes nodes = argc > 2 ? point_sets::make("random", std::strtoul(argv[2], nullptr, 10)) : Nodes();
  const bool with_error = argc > 3 && std::strcmp(argv[3], "error") == 0;
  bool right = false;
  if (std::strcmp(action, "comm") == 0) right = in_comm_mode();
  if (std::strcmp(action, "messages") == 0) right = messages(nodes);
  if (std::strcmp(action, "distributed") == 0) right = distributed();
  if (std::strcmp(action, "calls") == 0 && pstripack_set_comm(MPI_COMM_WORLD) == 0)
    for_ever(with_error, [&] { return trmesh(nodes).ier; });
  const bool with_null = std::strcmp(action, "null_mesh") == 0;
  if (with_null || std::strcmp(action, "meshes") == 0) {
    const Part part(nodes);
    const OfMesh mesh;
    bool is_null = false;
    for_ever(with_error, [&] {
      const std::int32_t code = part.triangulate(is_null ? nullptr : static_cast<pstripack_mesh*>(mesh));
      is_null = with_null && rank_of() == 1;
      return code;
    });
  }
  MPI_Finalize();
  return right ? 0 : 1;
}
