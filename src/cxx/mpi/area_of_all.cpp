#include "mpi/area_of_all.h"

namespace pstripack {

SharedArea area_of_all(MPI_Comm machine, std::size_t size) {
  int rank = 0;
  MPI_Comm_rank(machine, &rank);
  SharedArea area = rank == 0 ? SharedArea::create(size) : SharedArea();
  SharedArea::Name name = area.name();
  MPI_Bcast(name.text, sizeof name.text, MPI_CHAR, 0, machine);
  if (rank != 0 && name.text[0] != '\0') area = SharedArea::map(name.text);
  MPI_Barrier(machine);  // rank 0 must keep the file open until all have mapped it
  area.close_file();
  return area;
}

}  // namespace pstripack
