/* PSTRIPACK: exact Delaunay triangulation of nodes on the sphere. C API of libpstripack.
 *
 * Every function may be called from any number of threads at once; none is collective, except trmesh in
 * comm mode (pstripack_mpi.h); none writes to stdout or ends the program. Arrays belong to the caller. Node
 * numbers count from 1, as in STRIPACK.
 *
 * Environment variables, read when the library is loaded:
 *   PSTRIPACK_REPORT=1           a line on stderr for each triangulation, and a table at exit
 *   PSTRIPACK_REPORT=PATH        the same, at the end of that file
 *   PSTRIPACK_CHECK=PATH         nodes and lists of each triangulation, at the end of that file
 *   PSTRIPACK_CHECK=lib:LIBRARY  the original in LIBRARY runs beside the program (stripack-compare), and a
 *                                log of every difference goes to stderr
 */
#ifndef PSTRIPACK_H
#define PSTRIPACK_H

#include <stdint.h>

#define PSTRIPACK_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

/* Error codes: CODE(name, value, meaning), the only table of them; docs/api/make-api.py reads it. Each
 * function below names the codes that it returns. A result L > 0 of TRMESH means that nodes L and M > L
 * coincide, where M is the smallest such number. STRIPACK's routines return these codes too, beside those
 * that the original has: -1, -2 and numbers above 0, which each routine's page explains. */
#define PSTRIPACK_CODES(CODE)                                                                              \
  CODE(PSTRIPACK_OK, 0, "success")                                                                         \
  CODE(PSTRIPACK_TOO_FEW_NODES, -1, "fewer than three nodes, or fewer than four generators")               \
  CODE(PSTRIPACK_COLLINEAR, -2,                                                                            \
       "the first three nodes, or all of a distributed mesh, lie on one great circle")                     \
  CODE(PSTRIPACK_EMPTY_MESH, -3, "the mesh is empty, or no exchange of its values is under way")           \
  CODE(PSTRIPACK_TOO_MANY_NODES, -4, "too many nodes: 6N-11 does not fit the integers")                    \
  CODE(PSTRIPACK_BAD_COORDINATE, -5, "a coordinate is not finite, or all are zero")                        \
  CODE(PSTRIPACK_OUT_OF_MEMORY, -6, "out of memory")                                                       \
  CODE(PSTRIPACK_RANKS_DISAGREE, -7,                                                                       \
       "the ranks of a collective call disagree in N, in the coordinates, in PSTRIPACK_ORDER, in root, "   \
       "in values a point, or in what they call")                                                          \
  CODE(PSTRIPACK_BAD_COMM, -8,                                                                             \
       "not a communicator that can be used: null, freed, an inter-communicator, no such rank, or MPI is " \
       "not running")                                                                                      \
  CODE(PSTRIPACK_COINCIDENT, -9, "two points lie in the same direction")                                   \
  CODE(PSTRIPACK_BAD_NUMBER, -10,                                                                          \
       "a node number is below 1, occurs twice, or is too large for what was asked")                       \
  CODE(PSTRIPACK_BAD_DENSITY, -11,                                                                         \
       "the density is not positive, not finite or varies too much at some place, or a result is beyond "  \
       "the largest double")                                                                               \
  CODE(PSTRIPACK_HEMISPHERE, -12, "the generators lie in one hemisphere")                                  \
  CODE(PSTRIPACK_BAD_LISTS, -13, "the lists are not those of a triangulation of these nodes")              \
  CODE(PSTRIPACK_BAD_OPTION, -14, "an option has a value that is not allowed")                             \
  CODE(PSTRIPACK_NONE_LEFT, -15, "all nodes are in NPTS already")                                          \
  CODE(PSTRIPACK_NO_EDGE, -16,                                                                             \
       "the arc cannot be made: nodes lie on it, up to rounding, or triangles overlap")                    \
  CODE(PSTRIPACK_BAD_SIZE, -100, "arrays of different sizes, or too short, or a size below 0")

enum {
#define PSTRIPACK_CODE(name, value, meaning) name = value,
  PSTRIPACK_CODES(PSTRIPACK_CODE)
#undef PSTRIPACK_CODE
};

/* The version "major.minor.patch" of the library that is loaded. */
PSTRIPACK_API const char* pstripack_version(void);

/* One line of text for an error code, without a newline; never NULL. Do not free it. */
PSTRIPACK_API const char* pstripack_strerror(int ier);

/* Frees the memory that the library keeps in this process for the next call (PSTRIPACK_KEEP bounds it):
 * blocks of arrays, and the mesh from which a warm start would begin. Meshes and communicators that the
 * program holds stay. May be called at any time, by any thread. */
PSTRIPACK_API void pstripack_release_memory(void);

/* The Delaunay triangulation of n nodes, as canonical lists.
 *   n           number of nodes, 3 to 357,913,943
 *   x, y, z     in: n coordinates each; vectors from the centre of the sphere to the nodes, of any length
 *   list, lptr  out: arrays of at least 6n-12 entries; slots 1..lnew-1 are written
 *   lend        out: n entries
 *   lnew        out: one past the last slot in use
 * Returns 0, -1, -2, -4, -5, -6, in comm mode (pstripack_mpi.h) also -7, or L > 0: then the lists are
 * those of nodes 1..M-1. After a negative code nothing is written. Codes below -2 also print one line on
 * stderr. Parallel (OpenMP) outside parallel regions. */
PSTRIPACK_API int32_t pstripack_trmesh(int32_t n, const double* x, const double* y, const double* z,
                                       int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew);
PSTRIPACK_API int32_t pstripack_trmesh_r4(int32_t n, const float* x, const float* y, const float* z,
                                          int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew);
/* For programs with 64-bit integers. n has the same limit: the lists are made with 32 bits in the caller's
 * arrays and widened there. */
PSTRIPACK_API int64_t pstripack_trmesh_i8(int64_t n, const double* x, const double* y, const double* z,
                                          int64_t* list, int64_t* lptr, int64_t* lend, int64_t* lnew);

/* The Delaunay triangulation of the directions of n nodes, as canonical lists. Arguments and result are those
 * of pstripack_trmesh, which takes coordinates as given where all lengths are 1 up to 1e-6. The two differ
 * only where nodes are so close, or so nearly on one circle, that the rounding of lengths matters. This uses
 * the threads of this process, never ranks; PSTRIPACK_ORDER does not matter. For quantities that are
 * computed from a mesh this is the mesh to use. */
PSTRIPACK_API int32_t pstripack_delaunay(int32_t n, const double* x, const double* y, const double* z,
                                         int32_t* list, int32_t* lptr, int32_t* lend, int32_t* lnew);

/* Validates lists as of pstripack_trmesh or pstripack_delaunay. Returns 0 if they are a correct triangulation
 * of the nodes: well formed, every triangle counterclockwise, every arc locally Delaunay (exact signs, ties
 * by the rule), sphere or hull covered once. Otherwise returns the number of the violated property (> 0), or
 * -1, -4 or -6.
 *   lnew     0 if it is not known
 *   message  out, may be NULL: the defect and the nodes; at most `length` bytes, including the closing zero
 */
PSTRIPACK_API int32_t pstripack_validate(int32_t n, const double* x, const double* y, const double* z,
                                         const int32_t* list, const int32_t* lptr, const int32_t* lend,
                                         int32_t lnew, char* message, int32_t length);

/* A hash of 64 bits that depends on the set of triangles alone, not on the order of the lists. 0 if the
 * lists are not well formed or there is not enough memory. */
PSTRIPACK_API uint64_t pstripack_fingerprint(int32_t n, const int32_t* list, const int32_t* lptr,
                                             const int32_t* lend);

/* ---- Centroidal Voronoi tessellations of the sphere (SCVT) ----
 *
 * In a centroidal tessellation each generator is at the centroid of its Voronoi cell with respect to a
 * density. The energy of generators g is the sum over their cells of the integral of density times |p-g|^2.
 * The results have the same bits for any number of threads. On an error nothing is written except `message`
 * (may be NULL). It then holds at most `length` bytes, the closing zero included: what is wrong, with node
 * numbers or places, and what to do. */

/* Sets values[i] to the density at the unit vector xyz[3i], xyz[3i+1], xyz[3i+2], for i = 0..n-1; n is 1 to
 * 65536. The density must be positive and finite, and depend on the place alone: not on n, nor on earlier
 * calls. The width of cells is proportional to density^(-1/4). Called in the default floating-point
 * environment. In C++ an exception ends the run with PSTRIPACK_BAD_DENSITY. */
typedef void (*pstripack_density_procedure)(int32_t n, const double* xyz, double* values, void* user);

/* A density. A null pointer to it, or in `at`, means the constant density 1. */
typedef struct {
  pstripack_density_procedure at;
  void* user;         /* passed on to `at` */
  int32_t any_thread; /* 0: only the thread that called the library calls `at`, and does the integrals alone.
                         1: any number of threads of the library call `at` at once: faster. */
} pstripack_density;

/* The progress of a run, after each step. */
typedef struct {
  int64_t generators;  /* number of generators of the level */
  int64_t evaluations; /* number of triangulations with integrals, on this level */
  double gradient;     /* root mean square over generators of the distance to the centroid of the cell, in
                          units of sqrt(4 pi / generators) */
  double energy;
} pstripack_scvt_progress;
/* Called by the thread that called the library. If it does not return 0 the run ends with
 * PSTRIPACK_SCVT_STOPPED. */
typedef int32_t (*pstripack_scvt_progress_procedure)(const pstripack_scvt_progress* progress, void* user);

/* pstripack_scvt_options.start */
enum {
  PSTRIPACK_SCVT_BY_NUMBER = 0, /* the front from 3000 generators on, else levels */
  PSTRIPACK_SCVT_RANDOM = 1,    /* n random generators */
  PSTRIPACK_SCVT_GIVEN = 2,     /* the generators passed in */
  PSTRIPACK_SCVT_LEVELS = 3,    /* few random generators, refined level by level to n */
  PSTRIPACK_SCVT_FRONT = 4      /* an advancing front, which is nearly centroidal already; uses no seed */
};
/* pstripack_scvt_options.method */
enum {
  PSTRIPACK_SCVT_NEWTON = 0, /* quasi-Newton (L-BFGS) after a few steps of Lloyd's method */
  PSTRIPACK_SCVT_LLOYD = 1   /* Lloyd's method: each generator moves to the centroid of its cell */
};
/* pstripack_scvt_result.reason */
enum {
  PSTRIPACK_SCVT_CONVERGED = 0,
  PSTRIPACK_SCVT_EVALUATIONS = 1, /* most_evaluations were made */
  PSTRIPACK_SCVT_STOPPED = 2,     /* by the progress procedure */
  PSTRIPACK_SCVT_STALLED = 3,     /* the energy falls no further: rounding, or a density with jumps */
  /* With well_centred: triangles are left that do not hold their circumcentre, whatever the end was. */
  PSTRIPACK_SCVT_NOT_WELL_CENTRED = 4
};

/* A field that is 0 means the default; a null pointer to the struct means the defaults of all fields. */
typedef struct {
  int64_t bytes;                              /* sizeof(pstripack_scvt_options) */
  int32_t start;                              /* default: PSTRIPACK_SCVT_BY_NUMBER */
  int32_t method;                             /* default: PSTRIPACK_SCVT_NEWTON */
  double tolerance;                           /* largest gradient of a converged run; default: 1e-5 */
  int64_t most_evaluations;                   /* on each level; default: 100000 */
  int64_t seed;                               /* of the random generators; default: 1 */
  pstripack_scvt_progress_procedure progress; /* default: none */
  void* user;                                 /* passed on to `progress` */
  int32_t widths;       /* 1: the density procedure returns widths of cells instead, in any unit, since n is
                           given; pstripack_scvt_cells tells a good n. Default: 0 */
  int32_t well_centred; /* 1: in the end a few generators move, until all triangles hold their circumcentre
                           strictly. Default: 0 */
} pstripack_scvt_options;

typedef struct {
  double energy;
  double gradient;    /* as in pstripack_scvt_progress */
  double evaluations; /* of all levels, each weighted by its number of generators over n */
  int32_t generators; /* n; fewer if the progress procedure stopped the run before the last level */
  int32_t reason;     /* why the run ended: PSTRIPACK_SCVT_CONVERGED, ... */
} pstripack_scvt_result;

/* A whole run: finds n generators for the density.
 *   x, y, z  out: n entries each; the generators, unit vectors, in entries 0..result->generators-1. In,
 *            only with PSTRIPACK_SCVT_GIVEN: the generators to start from, vectors of any length
 *   density, options, result   may be NULL
 * Parallel (OpenMP) outside parallel regions; on this process alone, also in comm mode and under
 * pstripack-run. Returns 0, whatever the reason to end; -1 (n < 4), -4, -5, -6, -9, -11, -12 or -14. */
PSTRIPACK_API int32_t pstripack_scvt(int32_t n, double* x, double* y, double* z,
                                     const pstripack_density* density, const pstripack_scvt_options* options,
                                     pstripack_scvt_result* result, char* message, int32_t length);

/* How many cells have these widths: the integral of 1/(sqrt(3)/2 width^2) over a sphere of this radius, in
 * the unit of the widths. It is right to about 1e-5 of itself, 1e-4 where widths jump; features narrower
 * than half a degree may be missed. That number of generators, with options.widths = 1, has these widths.
 *   width   as a density; NULL: 1 everywhere
 *   cells   out: one value
 * Returns 0, -6, -11 or -14. */
PSTRIPACK_API int32_t pstripack_scvt_cells(const pstripack_density* width, double radius, double* cells,
                                           char* message, int32_t length);

/* One step, for programs with a loop of their own: integrals over the cells of n generators.
 *   x, y, z           in: the generators, n vectors of any length
 *   list, lptr, lend  in: their triangulation, as from TRMESH; the lists need not be canonical
 *   xc, yc, zc        out: n entries each; centroids of the cells, unit vectors, to which Lloyd's method
 *                     moves the generators; may be the arrays x, y, z
 *   mass              out: n entries; integral of the density over each cell; may be NULL
 *   energy            out: one value, the energy of all cells; may be NULL
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
