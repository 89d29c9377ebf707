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

/* Error codes of pstripack_trmesh, as TRMESH's IER. L > 0: nodes L and M coincide, L < M, M the smallest.
 * The functions below say which codes are theirs. */
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
  PSTRIPACK_COINCIDENT = -9,     /* distributed, scvt: two points in the same direction */
  PSTRIPACK_BAD_NUMBER = -10,    /* distributed: a global number is below 1, or occurs twice */
  /* Of the functions pstripack_scvt*. */
  PSTRIPACK_BAD_DENSITY = -11, /* the density is not positive, or not finite, at some place */
  PSTRIPACK_HEMISPHERE = -12,  /* the generators lie in one hemisphere */
  PSTRIPACK_BAD_LISTS = -13, /* the lists are not those of a triangulation of the sphere by the generators */
  PSTRIPACK_BAD_OPTION = -14 /* an option has no such value */
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

/* ---- Centroidal Voronoi tessellations of the sphere (SCVT) ----
 *
 * Generators, each at the centroid of its Voronoi cell with respect to a density. Their energy is the sum
 * over the cells of the integral of density times |p - generator|^2. The results have the same bits for any
 * number of threads. On an error nothing is written but `message` (may be NULL), which then holds at most
 * `length` bytes, the closing zero included: what is wrong, with node numbers or places, and what to do. */

/* values[i] = the density at the unit vector xyz[3i], xyz[3i+1], xyz[3i+2], for i = 0..n-1, 1 <= n <= 65536.
 * It must be positive and finite, and depend on the place alone: not on n, nor on earlier calls. Cells are
 * about density^(-1/4) wide. Called in the default floating-point environment. In C++: an exception ends the
 * run with PSTRIPACK_BAD_DENSITY. */
typedef void (*pstripack_density_procedure)(int32_t n, const double* xyz, double* values, void* user);

/* A density. Where functions take a pointer to it, NULL stands for 1 everywhere. */
typedef struct {
  pstripack_density_procedure at;
  void* user;         /* passed on to `at` */
  int32_t any_thread; /* 0: only the thread that called the library calls `at`, and does the integrals alone.
                         1: any number of threads of the library call `at` at once: faster. */
} pstripack_density;

/* After each step of a run: where it stands. */
typedef struct {
  int64_t generators;  /* of the level */
  int64_t evaluations; /* triangulations with integrals, on this level */
  double gradient;     /* root mean square over generators of the distance to the centroid of the cell, in
                          units of sqrt(4 pi / generators) */
  double energy;
} pstripack_scvt_progress;
/* Called by the thread that called the library. Not 0: the run ends with PSTRIPACK_SCVT_STOPPED. */
typedef int32_t (*pstripack_scvt_progress_procedure)(const pstripack_scvt_progress* progress, void* user);

/* pstripack_scvt_options.start */
enum {
  PSTRIPACK_SCVT_BY_NUMBER = 0, /* the front from 3000 generators on, else levels */
  PSTRIPACK_SCVT_RANDOM = 1,    /* n random generators */
  PSTRIPACK_SCVT_GIVEN = 2,     /* the generators passed in */
  PSTRIPACK_SCVT_LEVELS = 3,    /* few random generators, refined level by level to n */
  PSTRIPACK_SCVT_FRONT = 4      /* an advancing front, which is nearly centroidal already; without a seed */
};
/* pstripack_scvt_options.method */
enum {
  PSTRIPACK_SCVT_NEWTON = 0, /* quasi-Newton (L-BFGS) after a few steps of Lloyd's method */
  PSTRIPACK_SCVT_LLOYD = 1   /* Lloyd's method: each generator moves to the centroid of its cell */
};
/* pstripack_scvt_result.reason */
enum {
  PSTRIPACK_SCVT_CONVERGED = 0,
  PSTRIPACK_SCVT_EVALUATIONS = 1, /* as many as allowed */
  PSTRIPACK_SCVT_STOPPED = 2,     /* by the progress procedure */
  PSTRIPACK_SCVT_STALLED = 3      /* the energy falls no further: rounding, or a density with jumps */
};

/* 0 in a field, and all fields by NULL, stands for the default. */
typedef struct {
  int64_t bytes;                              /* sizeof(pstripack_scvt_options) */
  int32_t start;                              /* default: PSTRIPACK_SCVT_BY_NUMBER */
  int32_t method;                             /* default: PSTRIPACK_SCVT_NEWTON */
  double tolerance;                           /* of the gradient; default: 1e-5 */
  int64_t most_evaluations;                   /* on each level; default: 100000 */
  int64_t seed;                               /* of the random generators; default: 1 */
  pstripack_scvt_progress_procedure progress; /* default: none */
  void* user;                                 /* passed on to `progress` */
} pstripack_scvt_options;

typedef struct {
  double energy;
  double gradient;    /* as of pstripack_scvt_progress */
  double evaluations; /* of all levels, each counted by its share of n */
  int32_t generators; /* n; fewer if the progress procedure stopped the run before the last level */
  int32_t reason;     /* why it ended */
} pstripack_scvt_result;

/* A whole run: n generators for the density, as unit vectors, in (x,y,z)[0..result->generators-1]. With
 * PSTRIPACK_SCVT_GIVEN the run starts from (x,y,z), vectors of any length. Parallel (OpenMP) outside parallel
 * regions; on this process alone, also in comm mode and under pstripack-run. result: may be NULL.
 * Returns 0, for every reason to end; -1 (n < 4), -4, -5, -6, -9, -11, -12 or -14. */
PSTRIPACK_API int32_t pstripack_scvt(int32_t n, double* x, double* y, double* z,
                                     const pstripack_density* density, const pstripack_scvt_options* options,
                                     pstripack_scvt_result* result, char* message, int32_t length);

/* One step, for programs with a loop of their own: the cells of n generators (vectors of any length), whose
 * triangulation `list`, `lptr`, `lend` are, as of TRMESH, in any order.
 *   xc, yc, zc  centroids of the cells, unit vectors: where Lloyd's method moves the generators; or x, y, z
 *   mass        integral of the density over each cell; may be NULL
 *   energy      of all cells; may be NULL
 * Returns 0, -1 (n < 4), -4, -5, -6, -11, -12 or -13. */
PSTRIPACK_API int32_t pstripack_scvt_step(int32_t n, const double* x, const double* y, const double* z,
                                          const int32_t* list, const int32_t* lptr, const int32_t* lend,
                                          const pstripack_density* density, double* xc, double* yc,
                                          double* zc, double* mass, double* energy, char* message,
                                          int32_t length);

#ifdef __cplusplus
}
#endif
#endif
