#pragma once
// Energy and gradient of generators, whoever has them.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/point.h"
#include "scvt/cells.h"
#include "scvt/density.h"
#include "scvt/exact_sum.h"
#include "scvt/spread.h"

namespace pstripack::scvt {

/// Where generators are evaluated: here, or on ranks that have some of them each. All members but ranks() and
/// density() are collective, and all ranks get the same results and throw the same exceptions.
class Evaluator {
 public:
  /// The density must outlive this.
  explicit Evaluator(const Density& density) : density_(density) {}
  virtual ~Evaluator() = default;
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  virtual Communicator& ranks() = 0;
  const Density& density() const { return density_; }

  /// From now on this rank has the generators with these numbers.
  virtual void begin_with(const std::vector<std::int64_t>& numbers) = 0;
  /// The rank where each of this rank's generators should be, so that neighbours are together. Throws as
  /// triangulate().
  virtual std::vector<std::int32_t> homes(const std::vector<Point>& generators) = 0;
  /// This rank's generators (unit vectors), which may have moved, and their stars, until the next call.
  /// Throws BadGenerators, std::bad_alloc, AgreedFailure.
  virtual Neighbourhood triangulate(const std::vector<Point>& generators) = 0;

  /// The same, and their cells. Throws BadDensity, what the density throws, and as triangulate().
  virtual Neighbourhood evaluate(const std::vector<Point>& generators, Cells& cells);
  /// Sums over all ranks: each of the `count` sums becomes that of all ranks.
  void add_up(ExactSum* sums, std::size_t count);
  /// The largest value of all ranks, of values that are not negative.
  double largest(double value);
  /// Runs body() on every rank, where memory may run out: then all ranks throw.
  void allocate(const std::function<void()>& body);

 private:
  const Density& density_;
};

/// All generators are here, with the numbers 1, 2, ... The triangulation is that of TRMESH, on threads, with
/// its warm start.
class LocalEvaluator : public Evaluator {
 public:
  using Evaluator::Evaluator;

  Communicator& ranks() override { return alone_; }
  void begin_with(const std::vector<std::int64_t>&) override {}
  std::vector<std::int32_t> homes(const std::vector<Point>& generators) override {
    return std::vector<std::int32_t>(generators.size());
  }
  Neighbourhood triangulate(const std::vector<Point>& generators) override;

 private:
  SingleProcess alone_;
  std::vector<std::int64_t> numbers_;
  std::vector<std::int32_t> list_, lptr_, lend_;
};

/// Stars of generators that cover the sphere; lptr: room. Throws BadGenerators, std::bad_alloc.
NeighbourLists triangulate(const std::vector<Point>& generators, std::vector<std::int32_t>& list,
                           std::vector<std::int32_t>& lptr, std::vector<std::int32_t>& lend);

}  // namespace pstripack::scvt
