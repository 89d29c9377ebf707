// The routines that change a triangulation, on broken lists. Each must return, access nothing outside the
// arrays, and change nothing if its code promises so. For all kinds of numbers.
//
// Arrays have exactly the documented length and lie between inaccessible pages. SWAP, OPTIM and EDGE are told
// neither N nor LNEW and cannot detect a slot number that is too large, so they get none. Node numbers are
// arbitrary, except equal ones (see docs/api/optim.md) and those in the lists of the nodes that EDGE
// connects.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "point_sets.h"
#include "stripack/node_edit.h"
#include "support/cases.h"
#include "support/guarded.h"
#include "support/kinds.h"
#include "support/plain_lists.h"

using namespace pstripack;

namespace {

using point_sets::Random;

enum class Array { list, lptr, lend };
constexpr Array all_arrays[] = {Array::list, Array::lptr, Array::lend};

constexpr int kNodes = 9;

/// A canonical triangulation of kNodes random nodes in arrays for `room` nodes. It can be damaged and
/// restored.
template <class K>
class Arrays {
 public:
  using Real = typename K::Real;
  using Int = typename K::Int;

  Arrays(bool covers_sphere, Int room, ::Edge side)
      : list_(entries(6 * room - 12), side),
        lptr_(entries(6 * room - 12), side),
        lend_(entries(room), side),
        iwk_(entries(2 * room), side),
        x_(entries(room), side),
        y_(entries(room), side),
        z_(entries(room), side) {
    Random random(8);
    for (Int k = 0; k < room; ++k) {
      Point p;
      do p = random.direction();
      while (!covers_sphere && p.z < 0.3);
      for (const double coordinate : {p.x, p.y, p.z}) nodes_.push_back(static_cast<Real>(coordinate));
    }
    put_nodes();
    const PlainLists lists = plain_lists(kNodes, x_.data(), y_.data(), z_.data());
    right_lnew_ = static_cast<Int>(lists.slots + 1);
    for (const auto& [values, room_of_it] :
         {std::pair(&lists.list, list_.size()), {&lists.lptr, list_.size()}, {&lists.lend, lend_.size()}}) {
      right_.insert(right_.end(), values->begin(), values->end());
      right_.resize(right_.size() + room_of_it - values->size());
    }
    put_right();
  }

  Int slots() const { return right_lnew_ - 1; }
  Int& at(Array array, Int number) {
    return (array == Array::list ? list_ : array == Array::lptr ? lptr_ : lend_)[entries(number - 1)];
  }
  Nodes<Real> nodes() { return {x_.data(), y_.data(), z_.data()}; }
  Real* coordinates(int axis) { return (axis == 0 ? x_ : axis == 1 ? y_ : z_).data(); }
  Int* iwk() { return iwk_.data(); }
  EditedLists<Int> lists(Int n) { return {n, list_.data(), lptr_.data(), lend_.data(), &lnew}; }
  EditedLists<Int> untold() { return EditedLists<Int>::unbounded(list_.data(), lptr_.data(), lend_.data()); }

  void put_nodes() {
    for (std::size_t k = 0; k < x_.size(); ++k)
      x_[k] = nodes_[3 * k], y_[k] = nodes_[3 * k + 1], z_[k] = nodes_[3 * k + 2];
  }
  void put_right() { put(right_, right_lnew_); }

  /// Stores the current LIST, LPTR and LEND.
  const std::vector<Int>& remember() {
    auto to = std::copy(list_.data(), list_.data() + list_.size(), (remembered_ = right_).begin());
    to = std::copy(lptr_.data(), lptr_.data() + lptr_.size(), to);
    std::copy(lend_.data(), lend_.data() + lend_.size(), to);
    remembered_lnew_ = lnew;
    return remembered_;
  }
  void put_remembered() { put(remembered_, remembered_lnew_); }
  bool as_remembered() {
    const Int* const from = remembered_.data();
    const std::size_t count = list_.size();
    return lnew == remembered_lnew_ && same(list_, from) && same(lptr_, from + count) &&
           same(lend_, from + 2 * count);
  }
  /// True if LIST and LPTR differ only in slots that held one of four nodes, and LEND only for two nodes.
  bool differs_only_at(const Int (&node)[4], Int end1, Int end2) {
    const std::size_t count = list_.size();
    for (std::size_t s = 0; s < count; ++s) {
      const Int v = remembered_[s], was = v < -kNodes ? 0 : std::abs(v);
      if (std::find(node, node + 4, was) == node + 4 &&
          (list_[s] != remembered_[s] || lptr_[s] != remembered_[count + s]))
        return false;
    }
    for (Int k = 1; k <= static_cast<Int>(lend_.size()); ++k)
      if (k != end1 && k != end2 && at(Array::lend, k) != remembered_[2 * count + entries(k - 1)])
        return false;
    return true;
  }

  /// The neighbours of a node in the right triangulation.
  std::vector<Int> ring(Int node) const {
    const std::size_t count = list_.size();
    const Int last = right_[2 * count + entries(node - 1)];
    std::vector<Int> result;
    Int slot = last;
    do {
      slot = right_[count + entries(slot - 1)];
      result.push_back(std::abs(right_[entries(slot - 1)]));
    } while (slot != last);
    return result;
  }
  bool slot_is_of(Int slot, Int node) const {
    const std::size_t count = list_.size();
    Int s = right_[2 * count + entries(node - 1)];
    for (std::size_t i = ring(node).size(); i > 0 && s != slot; --i) s = right_[count + entries(s - 1)];
    return s == slot;
  }

  Int lnew = 0;

 private:
  static std::size_t entries(Int count) { return static_cast<std::size_t>(count); }
  static bool same(Guarded<Int>& array, const Int* from) {
    return std::equal(array.data(), array.data() + array.size(), from);
  }
  void put(const std::vector<Int>& values, Int end) {
    auto from = values.begin();
    for (Guarded<Int>* array : {&list_, &lptr_, &lend_}) {
      std::copy_n(from, array->size(), array->data());
      from += static_cast<std::ptrdiff_t>(array->size());
    }
    lnew = end;
  }

  Guarded<Int> list_, lptr_, lend_, iwk_;
  Guarded<Real> x_, y_, z_;
  std::vector<Real> nodes_;
  std::vector<Int> right_, remembered_;
  Int right_lnew_ = 0, remembered_lnew_ = 0;
};

/// Sets each entry to each wrong value and calls visit(array, number, value). Slot numbers beyond the arrays
/// are used only if `told`.
template <class K, class Visit>
void damage_each_entry(Arrays<K>& arrays, bool told, const Visit& visit) {
  using Int = typename K::Int;
  constexpr Int least = std::numeric_limits<Int>::min(), most = std::numeric_limits<Int>::max();
  const Int slots = arrays.slots(), array_end = 6 * kNodes - 12;
  for (const Array array : all_arrays) {
    std::vector<Int> values = {0, -1, least, least + 1};
    const Int most_right = array == Array::list ? kNodes : slots;
    for (Int v = 1; v <= most_right; ++v) values.push_back(v);
    if (array == Array::list)
      for (Int v = 1; v <= kNodes + 1; ++v) values.push_back(-v);
    if (told || array == Array::list)
      for (const Int v : {Int{kNodes + 1}, Int{kNodes + 2}, array_end + 1, 100 * array_end, most - 1, most})
        values.push_back(v);
    for (Int number = 1; number <= (array == Array::lend ? kNodes : slots); ++number)
      for (const Int value : values) {
        arrays.put_right();
        Int& entry = arrays.at(array, number);
        if (entry == value) continue;
        entry = value;
        visit(array, number, value);
      }
  }
}

/// The routines that are told N or LNEW.
enum Routine { insert_, intadd_, bdyadd_, covsph_, delnb_, delarc_, delnod_, addnod_, routines };
constexpr const char* names[] = {"INSERT", "INTADD", "BDYADD", "COVSPH",
                                 "DELNB",  "DELARC", "DELNOD", "ADDNOD"};
constexpr bool adds(int routine) { return routine <= covsph_ || routine == addnod_; }

template <class K>
int call(int routine, Arrays<K>& arrays, typename K::Int a, typename K::Int b, typename K::Int c) {
  using Int = typename K::Int;
  Int n = kNodes, lwk = n, slot;
  OptimFailure<Int> failure;
  const EditedLists<Int> lists = arrays.lists(n), one_more = arrays.lists(n + 1);
  switch (routine) {
    case insert_:
      return insert(a, b, one_more);
    case intadd_:
      return intadd(a, b, c, one_more);
    case bdyadd_:
      return bdyadd(a, b, one_more);
    case covsph_:
      return covsph(a, one_more);
    case delnb_:
      return delnb(a, b, lists, slot);
    case delarc_:
      return static_cast<int>(delarc(a, b, lists));
    case delnod_: {
      const int code = static_cast<int>(delnod(a, n, arrays.coordinates(0), arrays.coordinates(1),
                                               arrays.coordinates(2), lists, lwk, arrays.iwk(), failure));
      arrays.put_nodes();
      return code;
    }
    default:
      return static_cast<int>(addnod(a, arrays.nodes(), one_more));
  }
}

template <class K>
class EditBrokenLists : public testing::Test {
 public:
  /// Calls test(arrays) with nodes on the whole sphere and on a part of it.
  template <class Test>
  static void with_arrays(int room, const Test& test) {
    for (const ::Edge side : {::Edge::begin, ::Edge::end})
      for (const bool covers_sphere : {true, false}) {
        Arrays<K> arrays(covers_sphere, room, side);
        test(arrays);
      }
  }
};
TYPED_TEST_SUITE(EditBrokenLists, AllKinds);

/// True if EDGE promises not to change the lists when it returns this.
constexpr bool leaves_lists(EdgeStatus s) {
  return s != EdgeStatus::done && s != EdgeStatus::optim_failed && s != EdgeStatus::not_optimal;
}

}  // namespace

TYPED_TEST(EditBrokenLists, OneWrongEntryForRoutinesThatAreToldN) {
  using Int = typename TypeParam::Int;
  for (int routine = 0; routine < routines; ++routine) {
    int broken = 0, done = 0;
    this->with_arrays(adds(routine) ? kNodes + 1 : kNodes, [&](auto& arrays) {
      Random random(9);
      const auto any_node = [&] { return static_cast<Int>(1 + random.below(kNodes)); };
      damage_each_entry(arrays, true, [&](Array array, Int number, Int value) {
        arrays.remember();
        for (int i = 0; i < 6; ++i) {
          // A triangle or an arc, mostly; INSERT takes a slot.
          const Int a = any_node();
          const std::vector<Int> ring = arrays.ring(a);
          const std::size_t j = random.below(ring.size());
          const Int b = i == 0 ? any_node() : ring[j];
          const int code = call(routine, arrays, a, b, ring[(j + 1) % ring.size()]);
          broken += code == broken_lists, done += code == 0;
          ASSERT_TRUE(code != broken_lists || routine > covsph_ || arrays.as_remembered())
              << names[routine] << ", array " << static_cast<int>(array) << "(" << number << ") = " << value;
          arrays.put_remembered();
        }
      });
      // LNEW
      for (const Int end : {std::numeric_limits<Int>::min(), Int{-1}, Int{0}, Int{1}, Int{2}, arrays.slots(),
                            Int{6 * kNodes - 4}, std::numeric_limits<Int>::max()}) {
        arrays.put_right();
        arrays.lnew = end;
        if (routine != insert_) call(routine, arrays, Int{1}, arrays.ring(1)[0], arrays.ring(1)[1]);
      }
    });
    EXPECT_GT(done, 100) << names[routine];
    EXPECT_GT(broken, routine == insert_ ? -1 : 100) << names[routine];
  }
}

TYPED_TEST(EditBrokenLists, ManyWrongEntriesForRoutinesThatAreToldN) {
  using Int = typename TypeParam::Int;
  std::vector<int> broken(routines);
  for (const bool add : {false, true})
    this->with_arrays(add ? kNodes + 1 : kNodes, [&](auto& arrays) {
      Random random(5);
      const auto any = [&](Int least, Int most) {
        return least + static_cast<Int>(random.below(static_cast<std::size_t>(most - least + 1)));
      };
      const Int slots = arrays.slots();
      for (int i = 0; i < cases(10000); ++i) {
        arrays.put_right();
        for (Int damages = any(0, i % 2 == 0 ? 4 : 40); damages > 0; --damages) {
          const Array array = all_arrays[random.below(3)];
          arrays.at(array, any(1, array == Array::lend ? kNodes : slots)) =
              any(0, 7) == 0 ? any(-100, 100) : any(-1, slots + 2);
        }
        if (any(0, 9) == 0) arrays.lnew = any(-20, 60);
        const int routine = static_cast<int>(random.below(routines));
        // INSERT is told only LNEW, which must be right.
        if (adds(routine) == add && (routine != insert_ || arrays.lnew <= slots + 1))
          broken[static_cast<std::size_t>(routine)] +=
              call(routine, arrays, any(-1, kNodes + 2), any(-1, kNodes + 2), any(-1, kNodes + 2)) ==
              broken_lists;
      }
    });
  for (const int count : broken) EXPECT_GT(count, cases(100));
}

TYPED_TEST(EditBrokenLists, SWAPWritesNothingUnlessBothTrianglesAreThere) {
  using Int = typename TypeParam::Int;
  int broken = 0, done = 0, refused = 0;
  this->with_arrays(kNodes, [&](auto& arrays) {
    Random random(1);
    const auto test = [&](const Int(&node)[4]) {
      const auto [in1, in2, io1, io2] = node;
      arrays.remember();
      Int slot = 0;
      const int code = swap(in1, in2, io1, io2, arrays.untold(), slot);
      broken += code == broken_lists, done += slot > 0, refused += code == 0 && slot == 0;
      if (slot == 0)
        ASSERT_TRUE(arrays.as_remembered()) << in1 << " " << in2 << " " << io1 << " " << io2;
      else
        ASSERT_TRUE(arrays.differs_only_at(node, io1, io2)) << in1 << " " << in2 << " " << io1 << " " << io2;
      arrays.put_remembered();
    };
    const auto any_node = [&] { return static_cast<Int>(1 + random.below(kNodes)); };
    const auto with_any_nodes = [&] {
      test({any_node(), any_node(), any_node(), any_node()});
      for (Int u = 1; u <= kNodes; ++u) {
        const std::vector<Int> ring = arrays.ring(u);
        const std::size_t j = random.below(ring.size()), count = ring.size();
        test({ring[(j + 1) % count], ring[(j + count - 1) % count], u, ring[j]});
      }
    };
    arrays.put_right();
    for (int i = 0; i < 1000; ++i) with_any_nodes();
    damage_each_entry(arrays, false, [&](Array, Int, Int) { with_any_nodes(); });
    // LIST may be anything: SWAP does not use it for an index.
    for (int i = 0; i < cases(5000); ++i) {
      arrays.put_right();
      for (std::size_t damages = random.below(20); damages > 0; --damages) {
        const Array array = all_arrays[random.below(3)];
        const Int number = static_cast<Int>(1 + random.below(array == Array::lend ? kNodes : 20));
        arrays.at(array, number) = array == Array::list ? static_cast<Int>(random.below(4000)) - 2000
                                                        : static_cast<Int>(random.below(24)) - 1;
      }
      with_any_nodes();
    }
  });
  EXPECT_GT(broken, 1000);
  EXPECT_GT(done, 1000);
  EXPECT_GT(refused, 1000);
}

TYPED_TEST(EditBrokenLists, OPTIMFollowsNoNumberThatOneListAloneHas) {
  using Int = typename TypeParam::Int;
  int broken = 0, done = 0;
  this->with_arrays(kNodes, [&](auto& arrays) {
    damage_each_entry(arrays, false, [&](Array, Int, Int) {
      arrays.remember();
      for (Int u = 1; u <= kNodes; ++u)
        for (const Int v : arrays.ring(u)) {
          Int nit = 3;
          arrays.iwk()[0] = u, arrays.iwk()[1] = v;
          const OptimStatus status = optim(arrays.nodes(), Int{1}, arrays.untold(), nit, arrays.iwk());
          broken += status == OptimStatus::broken, done += status == OptimStatus::done;
          arrays.put_remembered();
        }
    });
  });
  EXPECT_GT(broken, 1000);
  EXPECT_GT(done, 1000);
}

TYPED_TEST(EditBrokenLists, EDGELeavesListsInWhichOneEntryIsWrongUnlessTheArcIsMade) {
  using Int = typename TypeParam::Int;
  int broken = 0, done = 0;
  this->with_arrays(kNodes, [&](auto& arrays) {
    damage_each_entry(arrays, false, [&](Array array, Int number, Int value) {
      arrays.remember();
      for (Int a = 1; a <= kNodes; ++a)
        for (Int b = 1; b <= kNodes; ++b) {
          if (array == Array::list && (value > kNodes || value < -kNodes) &&
              (arrays.slot_is_of(number, a) || arrays.slot_is_of(number, b)))
            continue;
          Int lwk = kNodes;
          OptimFailure<Int> failure;
          const EdgeStatus status = edge(a, b, arrays.nodes(), lwk, arrays.iwk(), arrays.untold(), failure);
          broken += status == EdgeStatus::broken, done += status == EdgeStatus::done;
          ASSERT_TRUE(!leaves_lists(status) || arrays.as_remembered())
              << "EDGE " << a << " " << b << ", array " << static_cast<int>(array) << "(" << number
              << ") = " << value << ", code " << static_cast<int>(status);
          arrays.put_remembered();
        }
    });
  });
  EXPECT_GT(broken, 1000);
  EXPECT_GT(done, 1000);
}

TYPED_TEST(EditBrokenLists, OPTIMAndEDGEReturnWhateverIsWrong) {
  // All numbers are within the arrays.
  using Int = typename TypeParam::Int;
  int broken[2] = {};
  this->with_arrays(kNodes, [&](auto& arrays) {
    Random random(6);
    const auto up_to = [&](Int most) {
      return static_cast<Int>(1 + random.below(static_cast<std::size_t>(most)));
    };
    const Int slots = arrays.slots();
    for (int i = 0; i < cases(20000); ++i) {
      arrays.put_right();
      for (Int damages = up_to(i % 2 == 0 ? 3 : 10); damages > 0; --damages) {
        const Array array = all_arrays[random.below(3)];
        arrays.at(array, up_to(array == Array::lend ? kNodes : slots)) =
            array == Array::list ? up_to(kNodes) * (random.below(4) == 0 ? -1 : 1) : up_to(slots);
      }
      arrays.remember();
      const Int a = up_to(kNodes), b = up_to(kNodes);
      for (int column = 0; column < 4; ++column) arrays.iwk()[column] = up_to(kNodes);
      Int nit = 3, lwk = kNodes;
      broken[0] += optim(arrays.nodes(), Int{2}, arrays.untold(), nit, arrays.iwk()) == OptimStatus::broken;
      arrays.put_remembered();
      OptimFailure<Int> failure;
      broken[1] +=
          edge(a, b, arrays.nodes(), lwk, arrays.iwk(), arrays.untold(), failure) == EdgeStatus::broken;
    }
  });
  for (const int count : broken) EXPECT_GT(count, 100);
}
