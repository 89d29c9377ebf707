#pragma once

#include "files/mesh.h"
#include "pictures/globe.h"
#include "pictures/mesh_picture.h"

namespace pictures {

/// The globe with what mesh_picture would draw; the view is the first one. Throws std::runtime_error as
/// mesh_picture does, but takes any number of nodes.
Globe mesh_globe(const files::Mesh& mesh, const MeshOptions& options);

}  // namespace pictures
