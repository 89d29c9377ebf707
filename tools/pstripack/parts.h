#pragma once
// Files that ranks write together: each its part, one after the other. No rank has all in memory.

#include <string>
#include <vector>

#include "files/mesh.h"
#include "files/output_file.h"
#include "files/writers.h"
#include "scvt/spread.h"

namespace program {

/// The nodes of this rank, which has one of equal slices, and the triangles of which such a node is the
/// smallest corner. Collective. Throws NoTessellation, AgreedFailure.
files::MeshPart part_of(pstripack::Communicator& ranks, const pstripack::scvt::Neighbourhood& nodes);

/// The same without triangles.
files::MeshPart part_of(pstripack::Communicator& ranks, const std::vector<files::Point>& nodes);

/// Writes the parts of all ranks, which see one file system. Formats that hold parts. Collective. Throws
/// NoTessellation, AgreedFailure.
void write_parts(pstripack::Communicator& ranks, const std::string& file, files::Format format,
                 const files::MeshPart& part);

}  // namespace program
