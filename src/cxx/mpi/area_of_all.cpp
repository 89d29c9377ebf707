#include "mpi/area_of_all.h"

#include <unistd.h>

namespace pstripack {

SharedArea area_of_all(MPI_Comm machine, std::size_t size) {
  int rank = 0;
  MPI_Comm_rank(machine, &rank);
  SharedArea area = rank == 0 ? SharedArea::create(size) : SharedArea();
  int place[2] = {getpid(), area.file().get()};
  MPI_Bcast(place, 2, MPI_INT, 0, machine);
  if (rank != 0 && place[1] >= 0) area = SharedArea::map_of(place[0], place[1]);
  MPI_Barrier(machine);  // rank 0 must keep the file open until all have mapped it
  area.close_file();
  return area;
}

}  // namespace pstripack
