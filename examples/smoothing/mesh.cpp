// Smooths a noisy field on a distributed mesh: ten times, each value becomes the mean of those of the point
// and its neighbours. The neighbours that other ranks have come by pstripack_mesh_exchange. Any number of
// ranks prints the same.
//
// $ mpicxx mesh.cpp -o smoothing $(pkg-config --cflags --libs pstripack_mpi)
// $ mpirun -n 4 ./smoothing
#include <pstripack_mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

void stop_unless(bool is_good) {
  if (!is_good) MPI_Abort(MPI_COMM_WORLD, 1);
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);

  // This rank's part of a spiral from pole to pole. The field is z, and noise between -1 and 1.
  const std::int64_t n = 1000;
  std::vector<std::int64_t> number;
  std::vector<double> xyz, field;
  for (std::int64_t i = 1 + n * rank / ranks; i <= n * (rank + 1) / ranks; ++i) {
    const double z = 1 - (2 * i - 1) / double(n), angle = 2.399963229728653 * i;
    number.push_back(i);
    xyz.insert(xyz.end(),
               {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z});
    field.push_back(z + (i * 7919 % 2001 - 1000) / 1000.0);
  }

  pstripack_mesh* mesh;
  std::uint64_t fingerprint;
  stop_unless(pstripack_mesh_create(MPI_COMM_WORLD, &mesh) == 0);
  stop_unless(pstripack_mesh_triangulate(mesh, std::int64_t(number.size()), xyz.data(), number.data()) == 0);
  stop_unless(pstripack_mesh_check(mesh, &fingerprint) == 0);

  // Neighbours in local numbers, from 1: own points, then those of the halo.
  std::int64_t own, arcs, triangles, halo;
  pstripack_mesh_sizes(mesh, &own, &arcs, &triangles, &halo);
  std::vector<std::int64_t> begin(own + 1);
  std::vector<std::int32_t> neighbour(arcs);
  stop_unless(pstripack_mesh_local_stars(mesh, begin.data(), neighbour.data()) == 0);

  const auto noise = [&] {
    double most = 0;
    for (std::int64_t i = 0; i < own; ++i) most = std::max(most, std::fabs(field[i] - xyz[3 * i + 2]));
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return most;
  };
  const double before = noise();
  field.resize(own + halo);
  for (int sweep = 0; sweep < 10; ++sweep) {
    stop_unless(pstripack_mesh_exchange(mesh, field.data(), 1, field.data() + own) == 0);
    std::vector<double> smooth(own + halo);
    for (std::int64_t i = 0; i < own; ++i) {
      double sum = field[i];
      for (std::int64_t k = begin[i]; k < begin[i + 1]; ++k) sum += field[std::abs(neighbour[k]) - 1];
      smooth[i] = sum / double(1 + begin[i + 1] - begin[i]);
    }
    field.swap(smooth);
  }
  const double after = noise();
  if (rank == 0) std::printf("%d nodes, largest noise %.6f, after 10 sweeps %.6f\n", int(n), before, after);
  pstripack_mesh_free(mesh);
  MPI_Finalize();
}
