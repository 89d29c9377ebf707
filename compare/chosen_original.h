#pragma once
// The original chosen by --original and --original-abi, or the one that the build found.

#include <string>

#include "original.h"

namespace comparison {

struct OriginalChoice {
  std::string file, abi;  ///< abi: empty to detect it
};

struct ChosenOriginal {
  legacy_stripack::Original original;
  std::string name;  ///< for people: with its ABI
};
/// Detects the ABI by calling TRMESH. If that fails, uses reals of `real_bytes`, the caller's kind, and says
/// so on stderr, unless an ABI was chosen. Throws std::runtime_error if there is no original, or if it has
/// another ABI than the chosen one. `timeout`: seconds for any call.
ChosenOriginal open_original(const OriginalChoice& choice, double timeout, int real_bytes = 8);

}  // namespace comparison
