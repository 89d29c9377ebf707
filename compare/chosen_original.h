#pragma once
// The original that the options --original and --original-abi ask for, or the one that the build found.

#include <CLI/CLI.hpp>
#include <string>

#include "original.h"

namespace comparison {

struct OriginalChoice {
  std::string file, abi = "r8";
};
void add_original_options(CLI::App& app, OriginalChoice& choice);

struct ChosenOriginal {
  legacy_stripack::Original original;
  std::string name;  ///< for people
};
/// Throws std::runtime_error if there is none, or if its TRMESH answers to another ABI.
ChosenOriginal open_original(const OriginalChoice& choice);

}  // namespace comparison
