#pragma once
// Energy and gradient of generators, on one process or on many ranks.

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

/// Evaluates generators: all on this process, or a part on each rank. All members except ranks(),
/// density(), scaled() and scale_anew() are collective; they have the same results and throw the same
/// exceptions on all ranks.
class Evaluator {
 public:
  /// The density must outlive the evaluator.
  explicit Evaluator(const Density& density) : scaled_(density) {}
  virtual ~Evaluator() = default;
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  virtual Communicator& ranks() = 0;
  const Density& density() const { return scaled_.density(); }
  /// What evaluate() integrates: until scale_anew() is called the density as it is.
  const ScaledDensity& scaled() const { return scaled_; }
  /// Makes the next evaluate() scale the density by its largest value at the generators.
  void scale_anew() { is_scaled_ = false; }

  /// Sets the global numbers of this rank's generators.
  virtual void begin_with(const std::vector<std::int64_t>& numbers) = 0;
  /// The rank to which each of this rank's generators should move, so that neighbours are on one rank.
  /// Throws what triangulate() throws.
  virtual std::vector<std::int32_t> homes(const std::vector<Point>& generators) = 0;
  /// The stars of this rank's generators (unit vectors), which may have moved. The result is valid until
  /// the next call. Throws BadGenerators, std::bad_alloc, AgreedFailure.
  virtual Neighbourhood triangulate(const std::vector<Point>& generators) = 0;

  /// The same, and the integrals over their cells. Throws also BadDensity and what the density throws.
  virtual Neighbourhood evaluate(const std::vector<Point>& generators, Cells& cells);
  /// Replaces each of the `count` sums by its sum over all ranks.
  void add_up(ExactSum* sums, std::size_t count);
  /// The largest of the values of all ranks, which must not be negative.
  double largest(double value);
  /// Throws GeneratorsTooNear for the first generator whose cell, evaluated last, is not good.
  [[noreturn]] void refuse(const Neighbourhood& here, const Cells& cells);
  /// Runs body() on every rank. If memory runs out on any of them, all ranks throw.
  void allocate(const std::function<void()>& body);

 private:
  ScaledDensity scaled_;
  bool is_scaled_ = true;
};

/// All generators are on this process, with the numbers 1, 2, ... They are triangulated by TRMESH, on
/// threads, with its warm start.
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
  const Halo no_halo_{};
  std::vector<std::int64_t> numbers_;
  std::vector<std::int32_t> list_, lptr_, lend_;
};

/// The stars of all generators, in `list` and `lend`; lptr is work space. Throws BadGenerators,
/// std::bad_alloc.
NeighbourLists triangulate(const std::vector<Point>& generators, std::vector<std::int32_t>& list,
                           std::vector<std::int32_t>& lptr, std::vector<std::int32_t>& lend);

}  // namespace pstripack::scvt
