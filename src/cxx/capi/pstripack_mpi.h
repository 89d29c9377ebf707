/* PSTRIPACK over MPI. C API of libpstripack_mpi.
 *
 * Two ways to use it:
 *   comm mode    pstripack_set_comm(comm) makes every trmesh of the program collective over comm;
 *   distributed  a pstripack_mesh: each rank brings its own points and gets their stars.
 * "Collective": every rank of the communicator calls it, in the same order. Errors are the same on every
 * rank; nothing is written on an error, nothing aborts, nothing goes to stdout. Only if MPI itself fails (a
 * lost process), one line on stderr names rank and phase, and MPI_Abort ends the job. Of a killed rank MPI
 * mostly tells nothing: mpirun ends the others by SIGTERM, and one of those on the machine of the lost rank
 * prints that line first. For that SIGTERM has a handler as long as comm mode or a mesh lasts, on more than
 * one rank of a machine, unless the program has set one before.
 */
#ifndef PSTRIPACK_MPI_H
#define PSTRIPACK_MPI_H

#if defined(__cplusplus) && !defined(MPI_VERSION) /* MPI's C API is enough: without its C++ library */
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#endif
#include <mpi.h>
#include <stdint.h>

#include "pstripack.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Comm mode. Collective over comm (an intra-communicator), and over the one set before. From then on trmesh,
 * in all its forms, is collective over a duplicate of comm: every rank of it calls with the same arguments
 * and gets the lists. Ranks that are not in comm set nothing and go on alone. A comm set before is replaced;
 * MPI_COMM_NULL ends comm mode, as MPI_Finalize does.
 * MPI must be running. One thread of a rank at a time calls trmesh; calls from another thread than the one
 * that initialised MPI are not collective unless MPI provides MPI_THREAD_MULTIPLE, and neither are calls in a
 * forked child. Returns 0, -6 or -8, which also print one line on stderr; the comm set before then stays. */
PSTRIPACK_API int32_t pstripack_set_comm(MPI_Comm comm);
/* The same with a Fortran handle (integer, or the MPI_VAL of a type(MPI_Comm)). */
PSTRIPACK_API int32_t pstripack_set_comm_f(MPI_Fint comm);
/* The same for Fortran programs without the module: CALL PSTRIPACK_SET_COMM(COMM), INTEGER COMM. */
PSTRIPACK_API void pstripack_set_comm_(const MPI_Fint* comm);
PSTRIPACK_API void pstripack_set_comm__(const MPI_Fint* comm); /* as -fsecond-underscore calls it */

/* A distributed mesh: points that stay on their ranks, and the stars of each rank's own points. */
typedef struct pstripack_mesh pstripack_mesh;

/* An empty mesh over a duplicate of comm, *mesh = NULL on error. Collective. 0, -6 or -8. */
PSTRIPACK_API int32_t pstripack_mesh_create(MPI_Comm comm, pstripack_mesh** mesh);
PSTRIPACK_API int32_t pstripack_mesh_create_f(MPI_Fint comm, pstripack_mesh** mesh);

/* Frees it. Collective, unless MPI_Finalize was called already. NULL is allowed, on all ranks. */
PSTRIPACK_API void pstripack_mesh_free(pstripack_mesh* mesh);

/* Triangulates the points of all ranks together. Collective.
 *   n         points of this rank, 0 <= n < 2^29
 *   xyz       3n coordinates, point after point (Fortran: xyz(3,n)): vectors from the centre
 *   number    n global numbers, from 1, each once over all ranks, in any order; 64 bits
 * Points that are close together should be on one rank (pstripack_mesh_home): then little is sent.
 * The answer does not depend on how the points are distributed, on the number of ranks or threads.
 * Returns 0, -1 (fewer than three points in all), -2 (all on one great circle), -4 (n < 0 or too large), -5,
 * -6, -9 or -10. After an error the mesh is empty. Of several errors the one is returned that comes first in
 * -4, -1, -10 (below 1), -5, -10 (twice), -2, -9; -6 may come at any time. */
PSTRIPACK_API int32_t pstripack_mesh_triangulate(pstripack_mesh* mesh, int64_t n, const double* xyz,
                                                 const int64_t* number);

/* After -5, -9, -10: the global numbers of the points that the error is about, the smallest ones (the second
 * 0 where there is one only), the same on every rank; else 0. Not collective. */
PSTRIPACK_API void pstripack_mesh_error_points(const pstripack_mesh* mesh, int64_t* first, int64_t* second);

/* The rank that would be home to each of n points, so that each rank's points lie close together and all
 * ranks have about as many; from the points of the last pstripack_mesh_triangulate. Not collective. 0, -3
 * if the mesh is empty, or -5, having written nothing. rank: n entries, from 0. Points that have been sent
 * there stay at home in later calls, until some rank has an eighth more than its share. */
PSTRIPACK_API int32_t pstripack_mesh_home(const pstripack_mesh* mesh, int64_t n, const double* xyz,
                                          int32_t* rank);

/* Sizes of this rank's part. Not collective. All 0 for an empty mesh.
 *   points     own points, n of the last call
 *   arcs       entries of all stars
 *   triangles  triangles of this rank
 *   halo       points of other ranks that are neighbours of own points */
PSTRIPACK_API void pstripack_mesh_sizes(const pstripack_mesh* mesh, int64_t* points, int64_t* arcs,
                                        int64_t* triangles, int64_t* halo);

/* The stars of this rank's points in global numbers: the neighbours of point i (from 0, as passed in) are
 * neighbour[begin[i]] ... neighbour[begin[i+1]-1], counterclockwise, as in LIST: an interior point starts
 * with its smallest neighbour; a boundary point starts with its first boundary neighbour and ends with the
 * negated number of the last. begin: points+1 entries, neighbour: arcs entries. Not collective. */
PSTRIPACK_API void pstripack_mesh_stars(const pstripack_mesh* mesh, int64_t* begin, int64_t* neighbour);

/* The triangles whose smallest corner is a point of this rank: every triangle of the mesh on exactly one
 * rank. corner: 3 triangles entries, global numbers, counterclockwise, the smallest first. Not collective. */
PSTRIPACK_API void pstripack_mesh_triangles(const pstripack_mesh* mesh, int64_t* corner);

/* The halo: points of other ranks that are neighbours of own points, by increasing number.
 * number: halo entries; xyz: 3 halo coordinates as their owners passed them. Not collective. */
PSTRIPACK_API void pstripack_mesh_halo(const pstripack_mesh* mesh, int64_t* number, double* xyz);

/* The stars in local numbers, from 1: own points 1..points as passed in, then the halo points in the order of
 * pstripack_mesh_halo. Otherwise as pstripack_mesh_stars. Not collective. 0, or -6 with nothing written. */
PSTRIPACK_API int32_t pstripack_mesh_local_stars(const pstripack_mesh* mesh, int64_t* begin,
                                                 int32_t* neighbour);

/* The canonical lists of the whole mesh on rank `root`, or on every rank for root = -1; the numbers must be
 * 1..N, N = all points. list, lptr (6N-12 entries), lend (N), lnew: as TRMESH, written on those ranks only,
 * may be NULL on others. Collective. 0, -3 (empty mesh), -4 (6N-11 does not fit 32 bits), -6, -8 (no rank
 * `root`), -10 (numbers are not 1..N); then nothing is written. */
PSTRIPACK_API int32_t pstripack_mesh_gather(pstripack_mesh* mesh, int32_t root, int32_t* list, int32_t* lptr,
                                            int32_t* lend, int32_t* lnew);

/* A centroidal tessellation of the generators of all ranks, which stay on their ranks: no rank holds them
 * all. Collective. As pstripack_scvt with PSTRIPACK_SCVT_GIVEN, and the same bits, whatever the distribution.
 *   n, xyz, number    as of pstripack_mesh_triangulate: the generators to start from, vectors of any length;
 *                     xyz becomes the generators found, unit vectors
 *   density           the same on every rank; called for places near the rank's generators
 *   options           rank 0's, for all (NULL on others), but for `start` and `seed`; it calls `progress`
 *   result            may be NULL; the same on every rank but for `generators`, which is n
 *   message, length   as of pstripack_scvt
 * Points that are close together should be on one rank (pstripack_mesh_home). Afterwards the mesh is that of
 * the generators. Returns the same on every rank: 0, for every reason to end; -1 (fewer than 4 in all), -4,
 * -5, -6, -9, -10, -11, -12 or -14; after an error the mesh is empty, and nothing is written but `message`.
 * What the density or `progress` throws in C++ is PSTRIPACK_BAD_DENSITY. A rank that runs out of memory
 * between two triangulations aborts the job, with a line on stderr. */
PSTRIPACK_API int32_t pstripack_mesh_scvt(pstripack_mesh* mesh, int64_t n, double* xyz, const int64_t* number,
                                          const pstripack_density* density,
                                          const pstripack_scvt_options* options,
                                          pstripack_scvt_result* result, char* message, int32_t length);

#ifdef __cplusplus
}
#endif
#endif
