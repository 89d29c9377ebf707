#pragma once
// `stripack-compare run`: compares the original and PSTRIPACK on many sets of nodes.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "chosen_original.h"
#include "commands.h"
#include "files/nodes.h"

namespace comparison {

struct RunOptions {
  std::vector<std::string> points;  ///< families; "all": point_sets::families(); file:PATH
  std::vector<std::string> files;
  files::ReadOptions read;  ///< how the files are read
  std::size_t n = 10000;
  std::uint64_t seed = 1;
  std::vector<std::string> orders{"given"}, precisions, abis;  // precisions, abis: empty if not chosen
  std::vector<int> threads{1}, ranks{1};
  std::vector<std::string> partitions{"bisection"};
  OriginalChoice original;
  double timeout = 120;
  int repeats = 3;
  std::optional<std::size_t> show;
  std::string json, csv, junit, plot;
};

/// Runs all cases and writes the requested files. Throws std::exception for errors that end with exit code 2.
ExitCode run(const RunOptions& options);

}  // namespace comparison
