#pragma once
// MPI for ranks that are coroutines of one thread: as much of it as src/cxx/mpi needs for a distributed mesh.
// Nothing runs at once. A rank runs until it has to wait for a message; MPI_Testall returns when all is done.

#include <cstdint>
#include <functional>

#define MPI_VERSION 3

using MPI_Comm = int;  // the group of all ranks, or of this rank alone
using MPI_Fint = int;
using MPI_Request = int;
using MPI_Errhandler = int;
enum : int {
  MPI_COMM_NULL = -1,
  MPI_COMM_WORLD,
  MPI_COMM_SELF,
  MPI_SUCCESS = 0,
  MPI_ERRORS_RETURN = 0,
  MPI_INFO_NULL = 0,
  MPI_COMM_TYPE_SHARED = 0,
  MPI_BYTE = 0,
  MPI_BOR = 0,
  MPI_MAX_ERROR_STRING = 80
};
constexpr std::nullptr_t MPI_STATUSES_IGNORE = nullptr;
inline void* const MPI_IN_PLACE = nullptr;

int MPI_Comm_rank(MPI_Comm comm, int* rank);
int MPI_Comm_size(MPI_Comm comm, int* size);
int MPI_Isend(const void* bytes, int size, int type, int to, int tag, MPI_Comm comm, MPI_Request* request);
int MPI_Irecv(void* bytes, int size, int type, int from, int tag, MPI_Comm comm, MPI_Request* request);
int MPI_Ibcast(void* bytes, int size, int type, int root, MPI_Comm comm, MPI_Request* request);
int MPI_Testall(int count, MPI_Request* requests, int* done, std::nullptr_t);
[[noreturn]] int MPI_Abort(MPI_Comm comm, int code);

inline int MPI_Comm_dup(MPI_Comm comm, MPI_Comm* copy) { return *copy = comm, MPI_SUCCESS; }
inline int MPI_Comm_free(MPI_Comm*) { return MPI_SUCCESS; }
inline int MPI_Comm_get_errhandler(MPI_Comm, MPI_Errhandler* handler) { return *handler = 0, MPI_SUCCESS; }
inline int MPI_Comm_set_errhandler(MPI_Comm, MPI_Errhandler) { return MPI_SUCCESS; }
inline int MPI_Errhandler_free(MPI_Errhandler*) { return MPI_SUCCESS; }
/// Each rank has a machine of its own.
inline int MPI_Comm_split_type(MPI_Comm, int, int, int, MPI_Comm* machine) {
  return *machine = MPI_COMM_SELF, MPI_SUCCESS;
}
inline int MPI_Iallreduce(const void*, void*, int, int, int, MPI_Comm, MPI_Request* request) {
  return *request = -1, MPI_SUCCESS;  // of MPI_COMM_SELF only
}
inline int MPI_Initialized(int* flag) { return *flag = 1, MPI_SUCCESS; }
inline int MPI_Finalized(int* flag) { return *flag = 0, MPI_SUCCESS; }
inline MPI_Fint MPI_Comm_c2f(MPI_Comm comm) { return comm; }
inline MPI_Comm MPI_Comm_f2c(MPI_Fint comm) { return comm; }
inline int MPI_Comm_test_inter(MPI_Comm, int* flag) { return *flag = 0, MPI_SUCCESS; }
inline int MPI_Error_string(int, char* text, int* length) { return *text = 0, *length = 0, MPI_SUCCESS; }

namespace many_ranks {

struct Traffic {
  std::int64_t messages = 0, bytes = 0;
};
/// What this rank has sent so far.
Traffic sent();

/// Runs body() on so many ranks.
void run(int ranks, const std::function<void()>& body);

}  // namespace many_ranks
