#pragma once
// Energy and gradient of generators that are distributed over ranks.

#include <cstdint>
#include <vector>

#include "mpi/distributed_mesh.h"
#include "scvt/evaluator.h"

namespace pstripack::scvt {

/// Triangulates by a distributed mesh. The results have the same bits as those of LocalEvaluator for the
/// generators in the order of their numbers.
class DistributedEvaluator final : public Evaluator {
 public:
  /// Mesh and density must outlive the evaluator.
  DistributedEvaluator(DistributedMesh& mesh, const Density& density) : Evaluator(density), mesh_(mesh) {}

  Communicator& ranks() override { return mesh_.ranks(); }
  void begin_with(const std::vector<std::int64_t>& numbers) override;
  std::vector<std::int32_t> homes(const std::vector<Point>& generators) override;
  /// Sets the mesh to that of the generators.
  Neighbourhood triangulate(const std::vector<Point>& generators) override;

  /// Each triangulation fills the report, as DistributedMesh::triangulate does. Null: none.
  void report_to(DistributedMesh::Report* report) { report_ = report; }

 private:
  void triangulate_mesh(const std::vector<Point>& generators);

  DistributedMesh& mesh_;
  DistributedMesh::Report* report_ = nullptr;
  std::size_t own_ = 0;  ///< number of generators of this rank
  // Own generators, then neighbours that other ranks have.
  std::vector<std::int64_t> numbers_;
  std::vector<Point> points_;
  std::vector<std::int64_t> begin_;
  std::vector<std::int32_t> end_, neighbour_;
};

}  // namespace pstripack::scvt
