#pragma once
// The triangles that a patch answers for and that other patches must have, too: docs/internals/parallel.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/patch_hull.h"
#include "parallel/patch_questions.h"

namespace pstripack {

/// A triangle in a list: the numbers of its corners, counterclockwise, the smallest first.
template <class Int>
using Listed = std::array<Int, 3>;

/// The list that another patch has sent.
template <class Int>
struct ListOfOther {
  PatchNumber from;
  const Listed<Int>* first;
  std::size_t count;
};

/// A patch answers for the front triangles of its hull that have a corner of its own. The list for another
/// patch has those that also have a corner of that patch.
template <class Int>
class PatchLists {
 public:
  /// The lists of the hull as it is now. Throws std::bad_alloc.
  void update(const PatchView<Int>& patch);
  /// The number of triangles in the list for each patch; empty before update().
  const std::vector<std::size_t>& counts() const { return counts_; }
  /// Calls visit(q, triangle) for each triangle of the list for each patch q.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Entry& e : entries_)
      for (const PatchNumber q : e.other)
        if (q != kNone) visit(q, e.triangle);
  }
  /// Calls visit(t) for each face t of the hull that is in a list.
  template <class Visit>
  void for_each_face(const Visit& visit) const {
    for (const Entry& e : entries_) visit(e.face);
  }
  /// Compares the lists with those that the other patches have sent. Returns the triangles that these lack,
  /// as questions to them. Throws std::bad_alloc.
  std::vector<Question> lacking(const PatchView<Int>& patch,
                                const std::vector<ListOfOther<Int>>& lists) const;

 private:
  static constexpr PatchNumber kNone = -1;
  struct Entry {
    Listed<Int> triangle;
    HullFace face;
    std::array<PatchNumber, 2> other;  ///< owners of its other corners, each once; then kNone
  };
  std::vector<Entry> entries_;
  std::vector<std::size_t> counts_;
  std::vector<PatchNumber> owner_;  ///< by hull node; kNone: not looked up yet
};

}  // namespace pstripack
