#pragma once
// Energy and gradient of generators that stay on their ranks.

#include <cstdint>
#include <functional>
#include <vector>

#include "mpi/distributed_mesh.h"
#include "scvt/evaluator.h"

namespace pstripack::scvt {

/// The triangulations are those of a distributed mesh. The results have the bits that LocalEvaluator gives
/// the generators in the order of their numbers.
class DistributedEvaluator final : public Evaluator {
 public:
  /// Of generators with these global numbers, in each call. All must outlive this.
  DistributedEvaluator(DistributedMesh& mesh, const std::vector<std::int64_t>& numbers,
                       const Density& density)
      : mesh_(mesh), numbers_(numbers), density_(density) {}

  /// Throws AgreedFailure, too, and what the density throws as a Failure.
  void evaluate(const std::vector<Point>& generators, Cells& cells) override;
  void add_up(ExactSum* sums, std::size_t count) override;
  double largest(double value) override;
  void allocate(const std::function<void()>& body) override;

  /// Each triangulation fills the report, as DistributedMesh::triangulate does. Null: none.
  void report_to(DistributedMesh::Report* report) { report_ = report; }

  /// The mesh becomes that of the generators. Collective. Throws BadGenerators, AgreedFailure.
  void triangulate(const std::vector<Point>& generators);

 private:
  DistributedMesh& mesh_;
  const std::vector<std::int64_t>& numbers_;
  const Density& density_;
  DistributedMesh::Report* report_ = nullptr;
  // In local numbers: own generators, then neighbours that other ranks have.
  std::vector<Point> points_;
  std::vector<std::int64_t> begin_, numbers_of_halo_;
  std::vector<std::int32_t> end_, neighbour_;
};

}  // namespace pstripack::scvt
