/* PSTRIPACK over MPI. C API of libpstripack_mpi.
 *
 * Two ways to use it:
 *   comm mode    pstripack_set_comm(comm) makes every trmesh of the program collective over comm;
 *   distributed  a pstripack_mesh: each rank brings its own points and gets their stars.
 * "Collective": every rank of the communicator must call it, in the same order. Collective functions
 * return the same code on every rank. On an error they write nothing, do not abort, and print nothing on
 * stdout. Only if MPI itself fails (a lost process), one line on stderr names rank and phase, and
 * MPI_Abort ends the job.
 * A killed rank is reported by mpirun. The library handles no signal.
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

/* Starts comm mode. Collective over comm (an intra-communicator), and over the communicator set before,
 * which comm replaces. From then on trmesh, in all its forms, is collective over a duplicate of comm:
 * every rank calls it with the same arguments and gets the lists. Ranks that are not in comm do not call
 * this function; their calls of trmesh remain their own. MPI_COMM_NULL ends comm mode, as MPI_Finalize
 * does. MPI must be running. Only one thread of a rank may call trmesh at a time. Calls from a thread
 * other than the one that initialised MPI are not collective, unless MPI provides MPI_THREAD_MULTIPLE; nor
 * are calls in a forked child. Returns 0, -6, -7 (the ranks have different values of PSTRIPACK_ORDER) or
 * -8. Errors also print one line on stderr, and the communicator set before stays. */
PSTRIPACK_API int32_t pstripack_set_comm(MPI_Comm comm);
/* The same with a Fortran handle (integer, or the MPI_VAL of a type(MPI_Comm)). */
PSTRIPACK_API int32_t pstripack_set_comm_f(MPI_Fint comm);
/* The same for Fortran programs without the module: CALL PSTRIPACK_SET_COMM(COMM), INTEGER COMM. */
PSTRIPACK_API void pstripack_set_comm_(const MPI_Fint* comm);
PSTRIPACK_API void pstripack_set_comm__(const MPI_Fint* comm); /* as -fsecond-underscore calls it */

/* A distributed mesh: points that stay on their ranks, and the stars of each rank's own points. Its
 * collective functions return -8, having done nothing, where MPI must not be called: after MPI_Finalize, in a
 * forked child, and in threads other than MPI's first, unless MPI provides MPI_THREAD_SERIALIZED. If ranks
 * call different ones, all get -7, and the mesh is empty. If a rank passes NULL for a mesh, which the others
 * would wait for, the job ends, with a line on stderr. */
typedef struct pstripack_mesh pstripack_mesh;

/* Creates an empty mesh over a duplicate of comm; *mesh = NULL on an error. Collective. Returns 0, -6 or
 * -8. */
PSTRIPACK_API int32_t pstripack_mesh_create(MPI_Comm comm, pstripack_mesh** mesh);
PSTRIPACK_API int32_t pstripack_mesh_create_f(MPI_Fint comm, pstripack_mesh** mesh);

/* Frees a mesh. Collective, unless MPI_Finalize was called already. NULL is allowed, on all ranks. */
PSTRIPACK_API void pstripack_mesh_free(pstripack_mesh* mesh);

/* Triangulates the points of all ranks together. Collective.
 *   n         in: number of points of this rank, 0 <= n < 2^29
 *   xyz       in: 3n coordinates, point after point (Fortran: xyz(3,n)): vectors from the centre of the
 *             sphere
 *   number    in: n global numbers of 64 bits, at least 1, each once over all ranks, in any order
 * Points that are close together should be on one rank (pstripack_mesh_home): then little is sent. The
 * result does not depend on the distribution of the points, nor on the number of ranks or threads. Returns
 * 0, -1 (fewer than three points in all), -2 (all on one great circle), -4 (n too large), -5, -6, -9, -10 or
 * -100 (n < 0). After an error the mesh is empty. If there are several errors, the code is the first of -100
 * or -4, -1, -10 (below 1), -5, -10 (twice), -2, -9; -6 may occur at any time. */
PSTRIPACK_API int32_t pstripack_mesh_triangulate(pstripack_mesh* mesh, int64_t n, const double* xyz,
                                                 const int64_t* number);

/* After -5, -9, -10, -13: the global numbers of the points that the error is about, the smallest such;
 * *second is 0 if there is only one. The same on every rank. After any other code both are 0. Not collective.
 */
PSTRIPACK_API void pstripack_mesh_error_points(const pstripack_mesh* mesh, int64_t* first, int64_t* second);

/* Sets rank[i], i = 0..n-1, to the rank (from 0) that should own the point xyz[3i..3i+2], so that each
 * rank's points lie close together and all ranks have about the same number. The partition is that of the
 * last pstripack_mesh_triangulate. Points that have been moved to these ranks keep them in later calls,
 * until a rank has an eighth more points than when the patches were cut. Not collective. Returns 0, or -3
 * (empty mesh), -5 or -100 (n < 0), having written nothing. */
PSTRIPACK_API int32_t pstripack_mesh_home(const pstripack_mesh* mesh, int64_t n, const double* xyz,
                                          int32_t* rank);

/* Sizes of this rank's part of the mesh; all 0 for an empty mesh. Not collective.
 *   points     out: own points, n of the last pstripack_mesh_triangulate
 *   arcs       out: number of entries of all stars
 *   triangles  out: number of triangles whose smallest corner is an own point
 *   halo       out: number of points of other ranks that are neighbours of own points */
PSTRIPACK_API void pstripack_mesh_sizes(const pstripack_mesh* mesh, int64_t* points, int64_t* arcs,
                                        int64_t* triangles, int64_t* halo);

/* The stars of this rank's points in global numbers: the neighbours of point i (from 0, as passed in) are
 * neighbour[begin[i]] ... neighbour[begin[i+1]-1], counterclockwise, as in LIST: an interior point starts
 * with its smallest neighbour; a boundary point starts with its first boundary neighbour and ends with the
 * negated number of the last. begin: points+1 entries, neighbour: arcs entries. Not collective. */
PSTRIPACK_API void pstripack_mesh_stars(const pstripack_mesh* mesh, int64_t* begin, int64_t* neighbour);

/* The triangles whose smallest corner is a point of this rank; so every triangle of the mesh is on exactly
 * one rank. corner: 3 * triangles entries, global numbers, counterclockwise, the smallest first. Not
 * collective. */
PSTRIPACK_API void pstripack_mesh_triangles(const pstripack_mesh* mesh, int64_t* corner);

/* The halo: points of other ranks that are neighbours of own points, by increasing number.
 * number: `halo` entries; xyz: 3 * halo coordinates as their owners passed them. Not collective. */
PSTRIPACK_API void pstripack_mesh_halo(const pstripack_mesh* mesh, int64_t* number, double* xyz);

/* Who has each halo point, in the order of pstripack_mesh_halo, so that ranks can exchange values of their
 * points without a search: rank[j] (from 0) has it, as its own point local[j] (from 1, as passed in there).
 * rank and local: `halo` entries. Not collective. */
PSTRIPACK_API void pstripack_mesh_halo_owners(const pstripack_mesh* mesh, int32_t* rank, int32_t* local);

/* The stars in local numbers, from 1: own points 1..points as passed in, then the halo points in the order
 * of pstripack_mesh_halo. Otherwise as pstripack_mesh_stars. Not collective. Returns 0. */
PSTRIPACK_API int32_t pstripack_mesh_local_stars(const pstripack_mesh* mesh, int64_t* begin,
                                                 int32_t* neighbour);

/* Sends values of points to the ranks that have the points in their halo. Collective.
 *   values       in: width * points values of 8 bytes, doubles or integers, point after point (Fortran:
 *                values(width, points))
 *   width        number of values a point, at least 1, the same on every rank
 *   halo_values  out: width * halo values, in the order of pstripack_mesh_halo
 * Since the triangulation every rank knows what travels: only width is agreed on. Returns 0, -3 (empty
 * mesh), -6, -7 (another width on some rank), -8 or -100 (width < 1 on some rank). After an error nothing is
 * written. */
PSTRIPACK_API int32_t pstripack_mesh_exchange(pstripack_mesh* mesh, const void* values, int64_t width,
                                              void* halo_values);

/* The same in two parts, with other work between them. _begin copies the values and starts to send them; it
 * is collective, with the codes above. _end waits for the values of the oldest exchange under way and writes
 * them. Every rank calls it; on a rank with another width it returns -100, and -3 if no exchange is under
 * way. Any number may be under way. A triangulation, a tessellation or the end of the mesh ends them without
 * values. */
PSTRIPACK_API int32_t pstripack_mesh_exchange_begin(pstripack_mesh* mesh, const void* values, int64_t width);
PSTRIPACK_API int32_t pstripack_mesh_exchange_end(pstripack_mesh* mesh, int64_t width, void* halo_values);

/* Compares the stars of all ranks with each other: every star is a cycle, every triangle stands in the stars
 * of its three corners, and all triangles cover one sphere or disc (Euler's formula). Collective. fingerprint
 * out, may be NULL: a hash of 64 bits that depends on the set of triangles alone. If the numbers are 1..N,
 * that of pstripack_fingerprint. Returns 0, -3 (empty mesh), -6, -8, or -13: then pstripack_mesh_error_points
 * tells the smallest number of a point with a wrong star, 0 if only Euler's formula fails. */
PSTRIPACK_API int32_t pstripack_mesh_check(pstripack_mesh* mesh, uint64_t* fingerprint);

/* Gathers the canonical lists of the whole mesh on rank `root`, or on every rank if root = -1. The global
 * numbers must be 1..N, where N is the number of all points. list, lptr (6N-12 entries), lend (N entries),
 * lnew: out, as of pstripack_trmesh, on the ranks that get the lists; may be NULL on others. Collective.
 * Returns 0, -3 (empty mesh), -4 (6N-11 does not fit 32 bits), -6, -7 (`root` is not the same on all ranks),
 * -8 (no rank `root`) or -10 (the numbers are not 1..N). After an error nothing is written. */
PSTRIPACK_API int32_t pstripack_mesh_gather(pstripack_mesh* mesh, int32_t root, int32_t* list, int32_t* lptr,
                                            int32_t* lend, int32_t* lnew);

/* A centroidal tessellation of the generators of all ranks, which stay on their ranks: no rank holds them
 * all. As pstripack_scvt with PSTRIPACK_SCVT_GIVEN; the result has the same bits, whatever the
 * distribution. Collective.
 *   n, xyz, number    as in pstripack_mesh_triangulate: the generators to start from, vectors of any
 *                     length; on return xyz holds the generators found, unit vectors
 *   density           the same on every rank; called for places near the rank's generators
 *   options           those of rank 0 are used on all ranks, except `start` and `seed`, which have no
 *                     effect; those of other ranks are ignored. Rank 0 calls `progress`
 *   result            may be NULL; the same on every rank, except `generators`, which is n
 *   message, length   as in pstripack_scvt
 * Points that are close together should be on one rank (pstripack_mesh_home). Afterwards the mesh is that
 * of the generators. Returns the same on every rank: 0, whatever the reason to end; -1 (fewer than 4
 * generators in all), -4, -5, -6, -9 to -12, -14 or -100. After an error the mesh is empty, and nothing
 * is written except `message`. A C++ exception of the density or of `progress` becomes
 * PSTRIPACK_BAD_DENSITY. A rank that runs out of memory between two triangulations aborts the job, with a
 * line on stderr. */
PSTRIPACK_API int32_t pstripack_mesh_scvt(pstripack_mesh* mesh, int64_t n, double* xyz, const int64_t* number,
                                          const pstripack_density* density,
                                          const pstripack_scvt_options* options,
                                          pstripack_scvt_result* result, char* message, int32_t length);

#ifdef __cplusplus
}
#endif
#endif
