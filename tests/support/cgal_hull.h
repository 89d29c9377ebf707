#pragma once
// The convex hull by CGAL, exact on the coordinates as given.

#include "lists.h"

struct Hull {
  Faces faces;             ///< those with a positive determinant, sorted
  std::size_t hidden = 0;  ///< number of nodes that are not vertices of the hull
};

Hull cgal_hull(const Nodes& nodes);
