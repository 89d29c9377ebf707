#pragma once
// Files that the ranks write one after another. No rank has all nodes in memory, but rank 0 those of formats
// that need the whole mesh.

#include <string>
#include <vector>

#include "files/mesh.h"
#include "files/output_file.h"
#include "files/writers.h"
#include "scvt/spread.h"

namespace program {

/// The nodes of this rank, one of equal slices, and the triangles whose smallest corner is one of them.
/// Collective. Throws NoTessellation, AgreedFailure.
files::MeshPart part_of(pstripack::Communicator& ranks, const pstripack::scvt::Neighbourhood& nodes);

/// The same without triangles.
files::MeshPart part_of(pstripack::Communicator& ranks, const std::vector<files::Point>& nodes);

/// The nodes of all ranks, on rank 0; none on the others. Collective. Throws AgreedFailure.
std::vector<files::Point> on_rank_0(pstripack::Communicator& ranks, const std::vector<files::Point>& nodes);

/// Writes the parts of all ranks into one file, on a file system that all ranks see. Only for formats that
/// hold parts. Collective. Throws NoTessellation, AgreedFailure.
void write_parts(pstripack::Communicator& ranks, const std::string& file, files::Format format,
                 const files::MeshPart& part);

}  // namespace program
