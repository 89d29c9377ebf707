#pragma once
// The catalogue's sets of nodes, by name.

#include <functional>
#include <string>
#include <vector>

#include "support/lists.h"

struct Input {
  std::string name;  ///< an identifier
  std::function<Nodes()> nodes;
};

/// All generated sets. The files of tests/data are further sets; each holds its own record.
const std::vector<Input>& generated_inputs();
