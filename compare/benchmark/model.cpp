#include "model.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "contenders.h"
#include "measuring.h"
#include "orders.h"
#include "pstripack.h"

namespace benchmark {
namespace {

/// The nodes of each call are those of the first with other axes, written just before the pause.
double median_with_pauses(const Model& model) {
  const Nodes first(comparison::nodes_in_order(model.points, static_cast<std::size_t>(model.n), model.order));
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

void width_at(std::int32_t n, const double* xyz, double* values, void*) {
  for (std::int32_t i = 0; i < n; ++i) values[i] = 45 + 15 * xyz[3 * i + 2];
}

double seconds_of_scvt(const Model& model) {
  const pstripack_density width{width_at, nullptr, 1};
  pstripack_scvt_options options{};
  options.bytes = sizeof options;
  options.widths = model.work == Work::widths;
  std::vector<double> x(static_cast<std::size_t>(model.n)), y(x), z(x);
  pstripack_scvt_result result;
  char message[200] = "";
  return seconds_of([&] {
    if (pstripack_scvt(model.n, x.data(), y.data(), z.data(), options.widths ? &width : nullptr, &options,
                       &result, message, sizeof message) != 0)
      throw std::runtime_error(message);
  });
}

}  // namespace

ModelFigures first_call(const Model& model, const legacy_stripack::Library* original) {
  std::vector<double> x, y, z;
  for (std::vector<double>* const v : {&x, &y, &z}) v->reserve(static_cast<std::size_t>(model.n));
  for (const pstripack::Point& p :
       comparison::nodes_in_order(model.points, static_cast<std::size_t>(model.n), model.order))
    x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  const auto array = [](std::size_t n) { return std::unique_ptr<int[]>(new int[n]); };
  const std::size_t slots = 6 * x.size() - 12;
  const auto list = array(slots), lptr = array(slots), lend = array(x.size()), near = array(x.size()),
             next = array(x.size());
  const std::unique_ptr<double[]> dist(new double[x.size()]);
  int lnew, ier = 0;
  const double seconds = seconds_of([&] {
    if (original != nullptr)
      original->trmesh(&model.n, x.data(), y.data(), z.data(), list.get(), lptr.get(), lend.get(), &lnew,
                       near.get(), next.get(), dist.get(), &ier);
    else
      ier =
          pstripack_trmesh(model.n, x.data(), y.data(), z.data(), list.get(), lptr.get(), lend.get(), &lnew);
  });
  if (ier != 0) throw std::runtime_error(fmt::format("TRMESH returned IER = {}", ier));
  return {seconds, bytes_in("/proc/self/status", "VmHWM:") / model.n};
}

namespace {

double seconds_of_reading(const Model& model) {
  const Nodes nodes(comparison::nodes_in_order(model.points, static_cast<std::size_t>(model.n), model.order));
  const Stripack library = ours();
  Lists lists(model.n);
  library.trmesh(nodes, lists);
  return seconds_a_call(model.work == Work::trlist ? Routine::trlist : Routine::crlist, library, nodes,
                        &lists, model.calls);
}

}  // namespace

int be_the_model(const Model& model) {
  if (model.work == Work::first) {
    const ModelFigures first = first_call(model, nullptr);
    fmt::print("{} {}\n", first.seconds, first.peak);
    return 0;
  }
  if (model.work != Work::trmesh) {
    const bool is_scvt = model.work == Work::scvt || model.work == Work::widths;
    fmt::print("{} 0\n", is_scvt ? seconds_of_scvt(model) : seconds_of_reading(model));
    return 0;
  }
  const Nodes nodes(comparison::nodes_in_order(model.points, static_cast<std::size_t>(model.n), model.order));
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
      "{} '{}' --be-the-model {} --model-points {} --model-order {} --model-nodes {} --model-pause {} "
      "--model-work {}",
      launcher, self, model.calls, model.points, model.order, model.n, model.pause_ms,
      static_cast<int>(model.work));
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
