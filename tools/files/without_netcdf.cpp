// Replaces netcdf_meshes.cpp and netcdf_mpas.cpp in builds without NetCDF.

#include <stdexcept>

#include "files/writers.h"

namespace files {
namespace {

[[noreturn]] void refuse(const std::string& file) {
  throw std::runtime_error(file + ": a NetCDF file, which this build cannot write: build with libnetcdf-dev");
}

}  // namespace

void write_ugrid(OutputFile& file, const Faces&, const std::vector<Point>&, const std::vector<double>&,
                 const Notes&) {
  refuse(file.name());
}
void write_scrip(OutputFile& file, const Faces&, const Notes&) { refuse(file.name()); }
void write_esmf(OutputFile& file, const Faces&, const Notes&) { refuse(file.name()); }
void write_mpas(OutputFile& file, const Mesh&) { refuse(file.name()); }
void write_mpas(OutputFile& file, const MpasMesh&, const NodeValues&) { refuse(file.name()); }
bool is_mpas_mesh(const Nodes&) { return false; }
void write_mpas_area(OutputFile& file, const std::string&, const std::vector<std::int32_t>&, const Notes&) {
  refuse(file.name());
}
void write_netcdf_nodes(OutputFile& file, const std::vector<Point>&, const NodeValues&) {
  refuse(file.name());
}
void write_netcdf_field(OutputFile& file, const LonLat&, const Grid&, const Field&) { refuse(file.name()); }
void write_weights(OutputFile& file, const Weights&, const WeightsEnd&, const WeightsEnd&,
                   const std::string&) {
  refuse(file.name());
}

}  // namespace files
