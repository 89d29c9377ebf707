#include "scvt/evaluator.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/workspace.h"
#include "capi/pstripack.h"
#include "lists/limits.h"
#include "scvt/caller_agreement.h"
#include "scvt/errors.h"
#include "trmesh/trmesh.h"

namespace pstripack::scvt {
namespace {

TrmeshResult call_trmesh(const std::vector<Point>& nodes, std::vector<std::int32_t>& list,
                         std::vector<std::int32_t>& lptr, std::vector<std::int32_t>& lend,
                         bool starts_anywhere) {
  const std::size_t n = nodes.size();
  // The level before had fewer generators: its blocks and meshes are of no use here.
  if (!lend.empty() && lend.size() != n) free_cached_blocks();
  list.resize(6 * n - 12);
  lptr.resize(6 * n - 12);
  lend.resize(n);
  std::int32_t lnew = 0;
  CallWay way;
  const TrmeshResult result = canonical_trmesh({static_cast<std::int32_t>(n),
                                                NodeArrays(nodes.data()),
                                                {list.data(), lptr.data(), lend.data(), &lnew},
                                                true,
                                                starts_anywhere},
                                               &way);
  // Later calls begin with this mesh, and need less memory.
  if (way.cost.maximum.flips < 0) free_idle_blocks();
  return result;
}

}  // namespace

NeighbourLists triangulate(const std::vector<Point>& generators, std::vector<std::int32_t>& list,
                           std::vector<std::int32_t>& lptr, std::vector<std::int32_t>& lend) {
  const std::size_t n = generators.size();
  if (n < 4) throw BadGenerators("a tessellation needs at least 4 generators, here are " + std::to_string(n));
  if (n > static_cast<std::size_t>(most_nodes<std::int32_t>()))
    throw BadGenerators("at most " + std::to_string(most_nodes<std::int32_t>()) + " generators, here are " +
                        std::to_string(n) + ": more need MPI ranks");
  TrmeshResult result = call_trmesh(generators, list, lptr, lend, false);
  try {
    if (result.ier == PSTRIPACK_COLLINEAR) result = call_trmesh(generators, list, lptr, lend, true);
  } catch (const std::domain_error&) {
    throw GeneratorsInHemisphere();
  }
  if (result.ier > 0) throw CoincidentGenerators(result.node, result.other);
  if (result.ier == PSTRIPACK_BAD_COORDINATE)
    throw BadGenerators("generator " + std::to_string(result.node) + " is zero or not finite");
  const auto ends_at_boundary = [&](std::int32_t slot) {
    return list[static_cast<std::size_t>(slot) - 1] < 0;
  };
  if (std::any_of(lend.begin(), lend.end(), ends_at_boundary)) throw GeneratorsInHemisphere();
  return {n, lend.data(), list.data()};
}

Neighbourhood Evaluator::evaluate(const std::vector<Point>& generators, Cells& cells) {
  const Neighbourhood here = triangulate(generators);
  if (!is_scaled_) {
    LargestReal most;
    in_agreement_with_caller(
        ranks(), [&] { most.value = largest_value(density(), generators); }, most);
    scaled_ = ScaledDensity(density(), most.value);
    is_scaled_ = true;
  }
  in_agreement_with_caller(ranks(), [&] { integrate(here.points, here.stars, scaled_, cells); });
  return here;
}

void Evaluator::refuse(const Neighbourhood& here, const Cells& cells) {
  const NeighbourLists& stars = here.stars;
  Smallest first, second;
  std::size_t bad = stars.count;
  for (std::size_t i = 0; i < stars.count; ++i)
    if (!is_good(cells, i) && (bad == stars.count || here.numbers[i] < here.numbers[bad])) bad = i;
  if (bad < stars.count) first.value = here.numbers[bad];
  agree(ranks(), first);
  if (!first.exists()) throw BadGenerators("the gradient of the energy is not finite");
  if (bad < stars.count && here.numbers[bad] == first.value)
    second.value = here.numbers[nearest_neighbour(here.points, stars, bad)];
  agree(ranks(), second);
  throw GeneratorsTooNear(first.value, second.value);
}

void Evaluator::add_up(ExactSum* sums, std::size_t count) {
  if (ranks().size() == 1) return;
  constexpr std::size_t kTogether = 4;
  std::array<ExactSum::Words, kTogether> words;
  for (std::size_t at = 0; at < count; at += kTogether) {
    const std::size_t n = std::min(kTogether, count - at);
    for (std::size_t i = 0; i < n; ++i) words[i] = sums[at + i].words();
    ranks().all_sum(words[0].data(), n * words[0].size());
    for (std::size_t i = 0; i < n; ++i) sums[at + i] = ExactSum::of(words[i]);
  }
}

double Evaluator::largest(double value) {
  LargestReal vote{value};
  agree(ranks(), vote);
  return vote.value;
}

void Evaluator::allocate(const std::function<void()>& body) { in_agreement_with_caller(ranks(), body); }

Neighbourhood LocalEvaluator::triangulate(const std::vector<Point>& generators) {
  const NeighbourLists stars = scvt::triangulate(generators, list_, lptr_, lend_);
  if (numbers_.size() != stars.count) {
    numbers_.resize(stars.count);
    std::iota(numbers_.begin(), numbers_.end(), std::int64_t{1});
  }
  return {generators.data(), numbers_.data(), stars, stars.count, &no_halo_};
}

}  // namespace pstripack::scvt
