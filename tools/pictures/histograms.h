#pragma once

#include <string>

#include "files/mesh.h"

namespace pictures {

/// Four histograms as SVG: smallest angles, lengths of arcs, areas of triangles, numbers of neighbours.
std::string histograms(const files::Mesh& mesh, const std::string& title, double width);

}  // namespace pictures
