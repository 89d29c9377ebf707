/* PSTRIPACK: exact Delaunay triangulation of nodes on the sphere. C API of libpstripack.
 *
 * Every function may be called from any number of threads at once, none is collective, none writes to
 * stdout or ends the program. Arrays belong to the caller. Node numbers count from 1, as in STRIPACK.
 *
 * With PSTRIPACK_REPORT=1 in the environment when the library is loaded, each triangulation writes one line
 * to stderr, and the process a table at exit; with PSTRIPACK_REPORT=PATH to the end of that file.
 * With PSTRIPACK_CHECK=PATH its nodes and lists go to the end of that file; with PSTRIPACK_CHECK=lib:LIBRARY
 * the original runs beside the program and a log of every difference goes to stderr (stripack-compare).
 */
#ifndef PSTRIPACK_H
#define PSTRIPACK_H

#include <stdint.h>

#define PSTRIPACK_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

/* Error codes of pstripack_trmesh, as TRMESH's IER. L > 0: nodes L and M coincide, L < M, M the smallest. */
enum {
  PSTRIPACK_OK = 0,
  PSTRIPACK_TOO_FEW_NODES = -1,  /* n < 3 */
  PSTRIPACK_COLLINEAR = -2,      /* the first three nodes lie on one great circle */
  PSTRIPACK_EMPTY_MESH = -3,     /* distributed: there is no triangulation to ask */
  PSTRIPACK_TOO_MANY_NODES = -4, /* 6n-11 does not fit 32 bits */
  PSTRIPACK_BAD_COORDINATE = -5, /* a coordinate is not finite, or a vector is zero */
  PSTRIPACK_OUT_OF_MEMORY = -6,
  /* Of programs that use pstripack_mpi.h. */
  PSTRIPACK_RANKS_DISAGREE = -7, /* the ranks of a collective trmesh disagree in n or data */
  PSTRIPACK_BAD_COMM = -8,       /* no usable communicator, or no such rank; MPI not running */
  PSTRIPACK_COINCIDENT = -9,     /* distributed: two points in the same direction */
  PSTRIPACK_BAD_NUMBER = -10     /* distributed: a global number is below 1, or occurs twice */
};

/* "major.minor.patch" of the library that is loaded. */
PSTRIPACK_API const char* pstripack_version(void);

/* One line for an error code; never NULL. */
PSTRIPACK_API const char* pstripack_strerror(int ier);

/* The Delaunay triangulation of the n nodes (x,y,z)[0..n-1], which point at them from the centre of the
 * sphere, as canonical lists: `list`, `lptr` hold at least 6n-12 entries, `lend` n entries.
 * Written on success: slots 1..lnew-1 of list and lptr, lend, *lnew. For a result L > 0: the lists of
 * nodes 1..M-1. Otherwise nothing. Returns the error code. Codes below -2 also print one line on stderr.
 * Parallel (OpenMP) outside parallel regions. */
PSTRIPACK_API int32_t pstripack_trmesh(int32_t n, const double* x, const double* y, const double* z,
                                       int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew);
PSTRIPACK_API int32_t pstripack_trmesh_r4(int32_t n, const float* x, const float* y, const float* z,
                                          int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew);
/* For programs with 64-bit integers. The lists are made in 32 bits, in the caller's arrays, and widened
 * there: n has the same limit, and nothing is allocated for it. */
PSTRIPACK_API int64_t pstripack_trmesh_i8(int64_t n, const double* x, const double* y, const double* z,
                                          int64_t* list, int64_t* lptr, int64_t* lend, int64_t* lnew);

/* 0 if the lists are a correct triangulation of the nodes: well formed, every triangle counterclockwise,
 * every arc locally Delaunay (exact signs, ties by the rule), sphere or hull covered once. Otherwise the
 * number of the broken promise (> 0) or an error code (< 0); `message` (may be NULL) then holds at most
 * `length` bytes, the closing zero included, that say which nodes. `lnew` may be 0: not known. */
PSTRIPACK_API int32_t pstripack_validate(int32_t n, const double* x, const double* y, const double* z,
                                         const int32_t* list, const int32_t* lptr, const int32_t* lend,
                                         int32_t lnew, char* message, int32_t length);

/* 64 bits that depend on the set of triangles alone, not on the order of the lists; 0 if the lists are not
 * well formed or memory is out. */
PSTRIPACK_API uint64_t pstripack_fingerprint(int32_t n, const int32_t* list, const int32_t* lptr,
                                             const int32_t* lend);

#ifdef __cplusplus
}
#endif
#endif
