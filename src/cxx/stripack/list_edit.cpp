#include "stripack/list_edit.h"

#include <cstdint>

namespace pstripack {
namespace {

/// Runs change(editor), which counts slots in the caller's LNEW.
template <class Int, class Change>
int edit(const EditedLists<Int>& lists, const Change& change) {
  return code_or_broken_lists([&] {
    change(CheckedEditor<Int>({lists, *lists.lnew}));
    return 0;
  });
}

}  // namespace

template <class Int>
int insert(Int k, Int lp, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.insert(k, lp); });
}

template <class Int>
int intadd(Int i1, Int i2, Int i3, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.add_inside(lists.n, i1, i2, i3); });
}

template <class Int>
int bdyadd(Int i1, Int i2, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.add_outside(lists.n, i1, i2); });
}

template <class Int>
int covsph(Int n0, const EditedLists<Int>& lists) {
  return edit(lists, [&](const auto& editor) { editor.cover_sphere(lists.n, n0); });
}

template <class Int>
int swap(Int in1, Int in2, Int io1, Int io2, const EditedLists<Int>& lists, Int& slot) {
  Int unknown = std::numeric_limits<Int>::max();
  return code_or_broken_lists([&] {
    slot = CheckedEditor<Int>({lists, unknown}).swap(in1, in2, io1, io2);
    return 0;
  });
}

template <class Int>
int delnb(Int n0, Int nb, const EditedLists<Int>& lists, Int& slot) {
  const Int n = lists.n;
  if (n0 < 1 || n0 > n || nb < 1 || nb > n || n < 3) {
    slot = no_such_node;
    return 0;
  }
  return edit(lists, [&](const auto& editor) { slot = editor.remove_neighbour(n0, nb); });
}

#define PSTRIPACK_LIST_EDIT(Int)                                        \
  template int insert(Int, Int, const EditedLists<Int>&);               \
  template int intadd(Int, Int, Int, const EditedLists<Int>&);          \
  template int bdyadd(Int, Int, const EditedLists<Int>&);               \
  template int covsph(Int, const EditedLists<Int>&);                    \
  template int swap(Int, Int, Int, Int, const EditedLists<Int>&, Int&); \
  template int delnb(Int, Int, const EditedLists<Int>&, Int&);
PSTRIPACK_LIST_EDIT(std::int32_t)
PSTRIPACK_LIST_EDIT(std::int64_t)
#undef PSTRIPACK_LIST_EDIT

}  // namespace pstripack
