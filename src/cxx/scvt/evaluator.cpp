#include "scvt/evaluator.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "base/workspace.h"
#include "geometry/predicates.h"
#include "lists/limits.h"
#include "scvt/caller_agreement.h"
#include "scvt/errors.h"
#include "trmesh/trmesh.h"

namespace pstripack::scvt {
namespace {

/// Moves three generators that are not on one great circle to the front of `order`; false if there are none.
bool put_corners_in_front(std::vector<std::size_t>& order, const std::vector<Point>& generators) {
  for (std::size_t second = 1; second < order.size(); ++second) {
    const Point &a = generators[0], &b = generators[second];
    for (std::size_t third = 0; third < order.size(); ++third)
      if (left(a, b, generators[third]) != 0) {
        std::swap(order[1], order[second]);
        std::swap(order[2], *std::find(order.begin(), order.end(), third));
        return true;
      }
    // All generators lie on the great circle through a and b, or a and b are parallel.
    if (cross(a, minus(b, a)) != Point{0, 0, 0}) return false;
  }
  return false;
}

TrmeshResult call_trmesh(const std::vector<Point>& nodes, std::vector<std::int32_t>& list,
                         std::vector<std::int32_t>& lptr, std::vector<std::int32_t>& lend) {
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
                                                true},
                                               &way);
  // Later calls begin with this mesh, and need less memory.
  if (way.cost.maximum.flips < 0) free_idle_blocks();
  return result;
}

/// Turns the lists of the generators in another order, of which generator order[i] is the i-th, into those
/// in their own order.
void renumber(const std::vector<std::size_t>& order, std::vector<std::int32_t>& list,
              std::vector<std::int32_t>& lend) {
  const std::size_t n = order.size();
  std::vector<std::size_t> place(n);
  for (std::size_t i = 0; i < n; ++i) place[order[i]] = i;
  std::vector<std::int32_t> new_list, new_lend;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = place[k], begin = new_list.size();
    for (auto j = static_cast<std::size_t>(i == 0 ? 0 : lend[i - 1]); j < static_cast<std::size_t>(lend[i]);
         ++j)
      new_list.push_back(static_cast<std::int32_t>(order[static_cast<std::size_t>(list[j]) - 1]) + 1);
    const auto ring = new_list.begin() + static_cast<std::ptrdiff_t>(begin);
    std::rotate(ring, std::min_element(ring, new_list.end()), new_list.end());
    new_lend.push_back(static_cast<std::int32_t>(new_list.size()));
  }
  list = std::move(new_list);
  lend = std::move(new_lend);
}

}  // namespace

NeighbourLists triangulate(const std::vector<Point>& generators, std::vector<std::int32_t>& list,
                           std::vector<std::int32_t>& lptr, std::vector<std::int32_t>& lend) {
  const std::size_t n = generators.size();
  if (n < 4) throw BadGenerators("a tessellation needs at least 4 generators, here are " + std::to_string(n));
  if (n > static_cast<std::size_t>(most_nodes<std::int32_t>()))
    throw BadGenerators("at most " + std::to_string(most_nodes<std::int32_t>()) + " generators, here are " +
                        std::to_string(n) + ": more need MPI ranks");
  std::vector<std::size_t> order;  // empty: as given
  TrmeshResult result = call_trmesh(generators, list, lptr, lend);
  if (result.ier == -2) {
    order.resize(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    if (!put_corners_in_front(order, generators)) throw GeneratorsInHemisphere();
    std::vector<Point> nodes;
    for (const std::size_t i : order) nodes.push_back(generators[i]);
    result = call_trmesh(nodes, list, lptr, lend);
  }
  const auto number = [&](std::int64_t node) {
    return order.empty() ? node : static_cast<std::int64_t>(order[static_cast<std::size_t>(node) - 1]) + 1;
  };
  if (result.ier > 0) {
    const auto [first, second] = std::minmax({number(result.node), number(result.other)});
    throw CoincidentGenerators(first, second);
  }
  if (result.ier == -5)
    throw BadGenerators("generator " + std::to_string(number(result.node)) + " has no direction");
  const auto ends_at_boundary = [&](std::int32_t slot) {
    return list[static_cast<std::size_t>(slot) - 1] < 0;
  };
  if (std::any_of(lend.begin(), lend.end(), ends_at_boundary)) throw GeneratorsInHemisphere();
  if (!order.empty()) renumber(order, list, lend);
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
  return {generators.data(), numbers_.data(), stars, {}};
}

}  // namespace pstripack::scvt
