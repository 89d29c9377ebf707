// Named after the routine that is compared.

#include <gtest/gtest.h>

#include "differential/differential.h"
#include "differential/routines.h"

using namespace differential;

TEST(Differential, BNODES) {
  const Result result = compare_all(node_sets(), [](const NodeSet& nodes) -> std::string {
    int ier;
    const Lists lists = triangulated_by_original(nodes, ier);
    if (ier != 0) return "";
    const int n = nodes.n();
    std::vector<int> ours(nodes.x.size(), Lists::mark), theirs = ours;
    int counts[3], original_counts[3];
    bnodes_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), ours.data(), counts, counts + 1,
            counts + 2);
    csbnodes_(&n, lists.list.data(), lists.lptr.data(), lists.lend.data(), theirs.data(), original_counts,
              original_counts + 1, original_counts + 2);
    if (ours != theirs) return "NODES";
    for (int i = 0; i < 3; ++i)
      if (counts[i] != original_counts[i]) return "NB, NA or NT";
    return "";
  });
  expect_equal(result, 60);
}
