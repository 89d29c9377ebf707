#pragma once
// The original that the options --original and --original-abi ask for, or the one that the build found.

#include <CLI/CLI.hpp>
#include <string>

#include "original.h"

namespace comparison {

struct OriginalChoice {
  std::string file, abi;  ///< abi: empty if it is to be found out
};
void add_original_options(CLI::App& app, OriginalChoice& choice);

struct ChosenOriginal {
  legacy_stripack::Original original;
  std::string name;  ///< for people: with its ABI
};
/// Finds out the ABI by calling TRMESH. Where that finds none it is called with reals of `real_bytes`, the
/// kind of whoever calls; unless they chose an ABI, and stderr says so. Throws std::runtime_error if
/// there is no original, or one of another ABI than was chosen. `timeout` is that of any call, in seconds.
ChosenOriginal open_original(const OriginalChoice& choice, double timeout, int real_bytes = 8);

}  // namespace comparison
