// shrink INPUT PATTERN [SECONDS]: removes nodes as long as the original's behaviour (see behaviour.h) still
// matches the regular expression PATTERN and the beginning of ours is unchanged. Prints a point file for
// tests/data. INPUT is a name of inputs.h or such a file. This is delta debugging (Zeller, Hildebrandt: ddmin): no
// single node of the result can be removed, but smaller sets may exist.

#include <cstdio>
#include <exception>
#include <regex>
#include <stdexcept>
#include <string>

#include "behaviour.h"
#include "inputs.h"
#include "support/data_file.h"

namespace {

Nodes nodes_of(const std::string& name) {
  for (const Input& input : generated_inputs())
    if (input.name == name) return input.nodes();
  return nodes_in(name);
}

Nodes without(const Nodes& nodes, std::size_t begin, std::size_t end) {
  Nodes rest(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(begin));
  rest.insert(rest.end(), nodes.begin() + static_cast<std::ptrdiff_t>(end), nodes.end());
  return rest;
}

/// Removes smaller and smaller pieces until no single node can be removed.
template <class Fails>
Nodes shrunk(Nodes nodes, const Fails& fails) {
  for (std::size_t piece = nodes.size() / 2; piece > 0;) {
    bool any = false;
    for (std::size_t begin = 0; begin < nodes.size();) {
      const Nodes rest = without(nodes, begin, std::min(begin + piece, nodes.size()));
      if (fails(rest))
        nodes = rest, any = true;
      else
        begin += piece;
    }
    if (piece > 1 || !any) piece /= 2;
  }
  return nodes;
}

void shrink(const std::string& input, const std::regex& pattern, double seconds) {
  const Nodes nodes = nodes_of(input);
  const std::string code = our_behaviour(nodes).substr(0, 2);
  const auto fails = [&](const Nodes& some) {
    return our_behaviour(some).compare(0, code.size(), code) == 0 &&
           std::regex_search(original_behaviour(some, seconds), pattern);
  };
  if (!fails(nodes)) throw std::runtime_error("the original: " + original_behaviour(nodes, seconds));
  const Nodes few = shrunk(nodes, fails);
  std::printf("# %zu of %zu nodes.\n", few.size(), nodes.size());
  std::printf("# original: %s\n# ours: %s\n", original_behaviour(few, 5 * seconds).c_str(),
              our_behaviour(few).c_str());
  for (const auto& p : few) std::printf("%a %a %a\n", p.x, p.y, p.z);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 4) throw std::runtime_error("usage: shrink INPUT PATTERN [SECONDS]");
  shrink(argv[1], std::regex(argv[2]), argc == 4 ? std::stod(argv[3]) : 0.2);
} catch (const std::exception& e) {
  std::fprintf(stderr, "shrink: %s\n", e.what());
  return 1;
}
