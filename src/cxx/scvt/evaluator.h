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

namespace pstripack::scvt {

/// Generators that are spread over ranks, or all here. All members are collective, and all ranks get the same
/// results and throw the same exceptions.
class Evaluator {
 public:
  virtual ~Evaluator() = default;
  /// The cells of this rank's generators (unit vectors). Each rank has the same number in every call. Throws
  /// BadDensity, BadGenerators, std::bad_alloc.
  virtual void evaluate(const std::vector<Point>& generators, Cells& cells) = 0;
  /// Sums over all ranks: each of the `count` sums becomes that of all ranks.
  virtual void add_up(ExactSum* sums, std::size_t count) = 0;
  /// The largest value of all ranks.
  virtual double largest(double value) = 0;
  /// Runs body() on every rank, where memory may run out: then all ranks throw.
  virtual void allocate(const std::function<void()>& body) { body(); }
};

/// All generators are here. The triangulation is that of TRMESH, on threads, with its warm start.
class LocalEvaluator final : public Evaluator {
 public:
  /// The density must outlive this.
  explicit LocalEvaluator(const Density& density) : density_(density) {}

  void evaluate(const std::vector<Point>& generators, Cells& cells) override;
  void add_up(ExactSum*, std::size_t) override {}
  double largest(double value) override { return value; }

  /// Of the last call of evaluate: LIST and LEND, canonical.
  NeighbourLists stars() const { return {lend_.size(), lend_.data(), list_.data()}; }

 private:
  const Density& density_;
  std::vector<std::int32_t> list_, lptr_, lend_;
};

/// Stars of generators that cover the sphere; lptr: room. Throws BadGenerators, std::bad_alloc.
NeighbourLists triangulate(const std::vector<Point>& generators, std::vector<std::int32_t>& list,
                           std::vector<std::int32_t>& lptr, std::vector<std::int32_t>& lend);

}  // namespace pstripack::scvt
