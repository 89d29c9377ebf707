#pragma once
// The original named by --original and --original-abi, or the one that the build found.

#include <string>

#include "original.h"

namespace comparison {

struct OriginalChoice {
  std::string file, abi;  ///< abi: empty: detect it
};

struct ChosenOriginal {
  legacy_stripack::Original original;
  std::string name;  ///< name and ABI for messages
};
/// Detects the ABI by calling TRMESH, unless one was chosen. If that fails, uses reals of `real_bytes`, the
/// caller's kind, and reports so on stderr. Throws std::runtime_error if there is no original, or if its ABI
/// is not the chosen one. `timeout`: seconds for any call.
ChosenOriginal open_original(const OriginalChoice& choice, double timeout, int real_bytes = 8);

}  // namespace comparison
