#pragma once
// Energy and gradient of generators that stay on their ranks.

#include <cstdint>
#include <vector>

#include "mpi/distributed_mesh.h"
#include "scvt/evaluator.h"

namespace pstripack::scvt {

/// The triangulations are those of a distributed mesh. The results have the bits that LocalEvaluator gives
/// the generators in the order of their numbers.
class DistributedEvaluator final : public Evaluator {
 public:
  /// Both must outlive this.
  DistributedEvaluator(DistributedMesh& mesh, const Density& density) : Evaluator(density), mesh_(mesh) {}

  Communicator& ranks() override { return mesh_.ranks(); }
  void begin_with(const std::vector<std::int64_t>& numbers) override;
  std::vector<std::int32_t> homes(const std::vector<Point>& generators) override;
  /// The mesh becomes that of the generators.
  Neighbourhood triangulate(const std::vector<Point>& generators) override;

 private:
  void triangulate_mesh(const std::vector<Point>& generators);

  DistributedMesh& mesh_;
  std::size_t own_ = 0;  ///< generators of this rank
  // Own generators, then neighbours that other ranks have.
  std::vector<std::int64_t> numbers_;
  std::vector<Point> points_;
  std::vector<std::int64_t> begin_;
  std::vector<std::int32_t> end_, neighbour_;
};

}  // namespace pstripack::scvt
