#include "model.h"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <stdexcept>

#include "contenders.h"
#include "measuring.h"
#include "orders.h"

namespace benchmark {

int be_the_model(const Model& model) {
  const Nodes nodes(nodes_in_order(model.points, static_cast<std::size_t>(model.n), model.order));
  const Stripack library = ours();
  Lists lists(nodes.n());
  std::optional<double> peak;
  const auto call = [&] {
    if (peak)
      library.trmesh(nodes, lists);
    else
      peak = peak_bytes([&] { library.trmesh(nodes, lists); }) / nodes.n();
  };
  const double seconds = seconds_a_call(call, model.calls);
  fmt::print("{} {}\n", seconds, *peak);
  return 0;
}

ModelFigures as_model(const std::string& self, const std::string& launcher, const Model& model) {
  const std::string command =
      fmt::format("{} '{}' --be-the-model {} --model-points {} --model-order {} --model-nodes {}", launcher,
                  self, model.calls, model.points, model.order, model.n);
  FILE* const out = popen(command.c_str(), "r");
  ModelFigures figures;
  const bool is_told = out != nullptr && std::fscanf(out, "%lf %lf", &figures.seconds, &figures.peak) == 2;
  if (out == nullptr || pclose(out) != 0 || !is_told)
    throw std::runtime_error("the model failed or printed no figures: " + command);
  return figures;
}

}  // namespace benchmark
