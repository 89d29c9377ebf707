#include "model.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "contenders.h"
#include "measuring.h"
#include "orders.h"

namespace benchmark {
namespace {

/// The nodes of each call are those of the first with other axes, written just before the pause.
double median_with_pauses(const Model& model) {
  const Nodes first(nodes_in_order(model.points, static_cast<std::size_t>(model.n), model.order));
  const Stripack library = ours();
  Lists lists(first.n());
  Samples samples;
  for (int call = 0; call <= model.calls; ++call) {
    Nodes nodes = first;
    if (call % 2 == 1) std::swap(nodes.x, nodes.y);
    if (call % 3 == 1) std::swap(nodes.y, nodes.z);
    for (double& z : nodes.z) z = call % 4 < 2 ? z : -z;
    std::this_thread::sleep_for(std::chrono::milliseconds(model.pause_ms));
    const auto start = Clock::now();
    library.trmesh(nodes, lists);
    if (call > 0) samples.add(seconds_since(start));
  }
  return samples.median();
}

}  // namespace

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
  if (model.pause_ms >= 0) peak = 0;
  const double seconds = model.pause_ms < 0 ? seconds_a_call(call, model.calls) : median_with_pauses(model);
  fmt::print("{} {}\n", seconds, *peak);
  return 0;
}

ModelFigures as_model(const std::string& self, const std::string& launcher, const Model& model) {
  const std::string command = fmt::format(
      "{} '{}' --be-the-model {} --model-points {} --model-order {} --model-nodes {} --model-pause {}",
      launcher, self, model.calls, model.points, model.order, model.n, model.pause_ms);
  FILE* const out = popen(command.c_str(), "r");
  ModelFigures figures, one;
  bool is_told = false;
  while (out != nullptr && std::fscanf(out, "%lf %lf", &one.seconds, &one.peak) == 2) {
    is_told = true;
    figures = {std::max(figures.seconds, one.seconds), std::max(figures.peak, one.peak)};
  }
  if (out == nullptr || pclose(out) != 0 || !is_told)
    throw std::runtime_error("the model failed or printed no figures: " + command);
  return figures;
}

}  // namespace benchmark
