#include "mpi/distributed_evaluator.h"

#include <algorithm>
#include <string>

#include "parallel/agreement.h"
#include "scvt/errors.h"

namespace pstripack::scvt {

void DistributedEvaluator::begin_with(const std::vector<std::int64_t>& numbers) {
  in_agreement(ranks(), [&] { numbers_ = numbers; });
  own_ = numbers.size();
}

std::vector<std::int32_t> DistributedEvaluator::homes(const std::vector<Point>& generators) {
  triangulate_mesh(generators);
  std::vector<std::int32_t> homes;
  in_agreement(ranks(), [&] {
    homes.resize(generators.size());
    if (!homes.empty()) mesh_.home(static_cast<std::int64_t>(homes.size()), &generators[0].x, homes.data());
  });
  return homes;
}

void DistributedEvaluator::triangulate_mesh(const std::vector<Point>& generators) {
  const double* const xyz = generators.empty() ? nullptr : &generators[0].x;
  const std::int32_t code =
      mesh_.triangulate(static_cast<std::int64_t>(generators.size()), xyz, numbers_.data(), report_, true);
  switch (code) {
    case PSTRIPACK_OK:
      return;
    case PSTRIPACK_COLLINEAR:
      throw GeneratorsInHemisphere();
    case PSTRIPACK_BAD_COORDINATE:
      throw BadGenerators("generator " + std::to_string(mesh_.error_point(0)) + " is zero or not finite");
    case PSTRIPACK_COINCIDENT:
      throw CoincidentGenerators(mesh_.error_point(0), mesh_.error_point(1));
    case PSTRIPACK_BAD_NUMBER:
      throw BadGenerators("the generators' number " + std::to_string(mesh_.error_point(0)) +
                              (mesh_.error_point(0) < 1 ? " is below 1" : " occurs twice"),
                          code);
    default:
      throw AgreedFailure(code);
  }
}

Neighbourhood DistributedEvaluator::triangulate(const std::vector<Point>& generators) {
  triangulate_mesh(generators);
  Neighbourhood here;
  OnAny have_boundary;
  in_agreement(
      ranks(),
      [&] {
        const OwnStars& stars = mesh_.own();
        const std::size_t halo = stars.outside().size();
        numbers_.resize(own_ + halo);
        points_.resize(own_ + halo);
        begin_.resize(own_ + 1);
        end_.resize(own_);
        neighbour_.resize(stars.arcs());
        std::copy(generators.begin(), generators.end(), points_.begin());
        if (halo > 0) stars.halo(&numbers_[own_], &points_[own_].x);
        stars.local_stars(begin_.data(), neighbour_.data());
        std::transform(begin_.begin() + 1, begin_.end(), end_.begin(),
                       [](std::int64_t end) { return static_cast<std::int32_t>(end); });
        here = {points_.data(),
                numbers_.data(),
                {own_, end_.data(), neighbour_.data()},
                points_.size(),
                &stars.halo()};
        have_boundary.value =
            std::any_of(neighbour_.begin(), neighbour_.end(), [](std::int32_t node) { return node < 0; });
      },
      have_boundary);
  if (have_boundary.value) throw GeneratorsInHemisphere();
  return here;
}

}  // namespace pstripack::scvt
