#pragma once

namespace pictures {

/// A place in the picture in pixels, to the right and down.
struct Place {
  double x, y;
};

}  // namespace pictures
