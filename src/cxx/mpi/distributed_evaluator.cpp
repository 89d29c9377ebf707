#include "mpi/distributed_evaluator.h"

#include <algorithm>
#include <array>
#include <string>

#include "parallel/agreement.h"
#include "scvt/caller_agreement.h"
#include "scvt/errors.h"

namespace pstripack::scvt {

void DistributedEvaluator::triangulate(const std::vector<Point>& generators) {
  const double* const xyz = generators.empty() ? nullptr : &generators[0].x;
  const std::int32_t code =
      mesh_.triangulate(static_cast<std::int64_t>(generators.size()), xyz, numbers_.data());
  switch (code) {
    case 0:
      return;
    case -2:
      throw GeneratorsInHemisphere();
    case -5:
      throw BadGenerators("generator " + std::to_string(mesh_.error_point(0)) + " has no direction");
    case -9:
      throw CoincidentGenerators(mesh_.error_point(0), mesh_.error_point(1));
    case -10:
      throw BadNumber(mesh_.error_point(0));
    default:
      throw AgreedFailure(code);
  }
}

void DistributedEvaluator::evaluate(const std::vector<Point>& generators, Cells& cells) {
  triangulate(generators);
  const std::size_t own = generators.size();
  OnAny have_boundary;
  in_agreement(
      mesh_.ranks(),
      [&] {
        numbers_of_halo_.resize(static_cast<std::size_t>(mesh_.halo()));
        points_.resize(own + numbers_of_halo_.size());
        begin_.resize(own + 1);
        end_.resize(own);
        neighbour_.resize(static_cast<std::size_t>(mesh_.arcs()));
        std::copy(generators.begin(), generators.end(), points_.begin());
        if (!numbers_of_halo_.empty()) mesh_.halo(numbers_of_halo_.data(), &points_[own].x);
        mesh_.local_stars(begin_.data(), neighbour_.data());
        std::transform(begin_.begin() + 1, begin_.end(), end_.begin(),
                       [](std::int64_t end) { return static_cast<std::int32_t>(end); });
        have_boundary.value =
            std::any_of(neighbour_.begin(), neighbour_.end(), [](std::int32_t node) { return node < 0; });
      },
      have_boundary);
  if (have_boundary.value) throw GeneratorsInHemisphere();
  in_agreement_with_caller(mesh_.ranks(), [&] {
    integrate(points_.data(), {own, end_.data(), neighbour_.data()}, density_, cells);
  });
}

void DistributedEvaluator::add_up(ExactSum* sums, std::size_t count) {
  constexpr std::size_t kTogether = 4;
  std::array<ExactSum::Words, kTogether> words;
  for (std::size_t at = 0; at < count; at += kTogether) {
    const std::size_t n = std::min(kTogether, count - at);
    for (std::size_t i = 0; i < n; ++i) words[i] = sums[at + i].words();
    mesh_.ranks().all_sum(words[0].data(), n * words[0].size());
    for (std::size_t i = 0; i < n; ++i) sums[at + i] = ExactSum::of(words[i]);
  }
}

double DistributedEvaluator::largest(double value) {
  LargestReal vote{value};
  agree(mesh_.ranks(), vote);
  return vote.value;
}

void DistributedEvaluator::allocate(const std::function<void()>& body) { in_agreement(mesh_.ranks(), body); }

}  // namespace pstripack::scvt
