#pragma once
// The catalogue's sets of nodes by name, for the record of results.

#include <functional>
#include <string>
#include <vector>

#include "support/lists.h"

struct Input {
  std::string name;  ///< an identifier
  std::function<Nodes()> nodes;
};

/// All generated sets; those of tests/data are files with their own record.
const std::vector<Input>& generated_inputs();
