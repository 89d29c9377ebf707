#pragma once
// The catalogue's sets of nodes by name, for the record of what was made of them.

#include <functional>
#include <string>
#include <vector>

#include "support/lists.h"

struct Input {
  std::string name;  ///< an identifier
  std::function<Nodes()> nodes;
};

/// All that are generated; those of tests/data are files with a record of their own.
const std::vector<Input>& generated_inputs();
