#pragma once
// A globe to turn: one HTML file with the mesh and the script globe.js.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pictures/coasts.h"
#include "pictures/shading.h"

namespace pictures {

/// Coast lines of globes are as fine as those of a picture of this radius, in degrees: readers look closer.
constexpr double kGlobeDetail = 20;

struct Globe {
  std::string title;
  int first_number = 1;                 ///< of nodes and triangles, for readers
  std::vector<double> lon, lat;         ///< of the nodes, in degrees
  std::vector<std::int32_t> triangles;  ///< corners from 0, counterclockwise, smallest first, in its order
  bool cells = false;                   ///< the faces are cells; else triangles
  Shading shading;                      ///< of the faces
  std::string value_name, value_unit;   ///< of the values that readers see
  std::vector<double> numbers;          ///< one for each node; empty: none
  std::vector<std::string> words;       ///< in place of numbers
  Lines coasts;
  std::optional<std::array<double, 2>>
      centre;                    ///< of the first view: longitude, latitude; none: of the nodes
  std::optional<double> radius;  ///< of the first view, in degrees; none: all nodes
};

extern const char* const kGlobeHtml;  ///< the text of globe.html, with globe.js in it

/// The HTML file. It needs no other file and no network.
std::string globe_page(const Globe& globe);

}  // namespace pictures
