#include "lists/rings.h"

#include <atomic>

#include "base/parallel_for.h"

namespace pstripack {
namespace {

/// The number of i in 0..n-1 with fails(i). Without branches, so that compilers can vectorise the loop.
template <class Int, class Test>
Int failures(Int n, int threads, const Test& fails) {
  std::atomic<Int> sum{0};
  parallel_pieces(static_cast<std::size_t>(n), threads, [&](std::size_t first, std::size_t last, int) {
    Int failed = 0;
    for (Int i = static_cast<Int>(first); i < static_cast<Int>(last); ++i) failed += fails(i) ? 1 : 0;
    sum += failed;
  });
  return sum;
}

}  // namespace

template <class Int>
bool Rings<Int>::read(const ListsView<Int>& lists, int threads) {
  n_ = static_cast<Int>(lists.n);
  entry_ = lists.list;
  end_ = lists.lend;
  if (!are_rings(lists, threads) && !copy(lists)) return false;

  last_of_eight_ = arcs() - eight;
  const auto out_of_range = [n = n_, entry = entry_](Int arc) {
    return (entry[arc] < -n) | (entry[arc] > n) | (entry[arc] == 0);
  };
  if (failures(arcs(), threads, out_of_range) > 0) return false;
  if (failures(n_, threads, [this](Int i) { return degree(i + 1) > few_neighbours; }) > 0) tabulate_hubs();
  return true;
}

/// True if the ring of every node k is the slots LEND(k-1)+1..LEND(k), linked upwards and closed.
template <class Int>
bool Rings<Int>::are_rings(const ListsView<Int>& lists, int threads) const {
  const Int most = 6 * n_ - 12;
  const Int* const lend = lists.lend;
  const Int* const lptr = lists.lptr;
  const auto no_ring = [lend](Int i) { return lend[i] <= (i > 0 ? lend[i - 1] : 0); };
  if (failures(n_, threads, no_ring) > 0 || lend[n_ - 1] > most) return false;
  const auto open = [lend, lptr](Int i) { return lptr[lend[i] - 1] != (i > 0 ? lend[i - 1] : 0) + 1; };
  if (failures(n_, threads, open) > 0) return false;
  const auto not_upwards = [lptr](Int i) { return lptr[i] != i + 2; };
  return failures(lend[n_ - 1], threads, not_upwards) == n_;  // only the last slot of each ring
}

template <class Int>
bool Rings<Int>::copy(const ListsView<Int>& lists) {
  const Int most = 6 * n_ - 12;
  const auto in_range = [most](Int slot) { return slot >= 1 && slot <= most; };
  slot_ = Buffer<Int>(static_cast<std::size_t>(most));
  own_entry_ = Buffer<Int>(static_cast<std::size_t>(most));
  own_end_ = Buffer<Int>(lists.n);
  Int arc = 0;
  for (Int node = 1; node <= n_; ++node) {
    const Int last = lists.lend[node - 1];
    if (!in_range(last)) return false;
    Int slot = last;
    do {
      slot = lists.lptr[slot - 1];
      if (!in_range(slot) || arc == most) return false;
      slot_[arc] = slot;
      own_entry_[arc] = lists.list[slot - 1];
      ++arc;
    } while (slot != last);
    own_end_[node - 1] = arc;
  }
  entry_ = own_entry_.data();
  end_ = own_end_.data();
  return true;
}

/// Stores the arcs back for the arcs at hubs, which are nodes of many neighbours. For each such arc the
/// shorter of the two rings is searched. In a planar graph the sum over all arcs of the smaller degree is
/// O(n) (Chiba and Nishizeki 1985), however large the hubs are.
template <class Int>
void Rings<Int>::tabulate_hubs() {
  hub_back_ = Buffer<Int>(static_cast<std::size_t>(arcs()));
  std::fill(hub_back_.begin(), hub_back_.end(), none);
  for (Int hub = 1; hub <= n_; ++hub) {
    if (degree(hub) <= few_neighbours) continue;
    for (Int arc = begin(hub); arc < end(hub); ++arc) {
      const Int node = target(arc);
      if (degree(node) > degree(hub) || (degree(node) == degree(hub) && node >= hub)) continue;
      const Int opposite = find(hub, begin(node), end(node));
      if (opposite == none) continue;
      hub_back_[static_cast<std::size_t>(arc)] = opposite;
      hub_back_[static_cast<std::size_t>(opposite)] = arc;
    }
  }
}

template <class Int>
Int Rings<Int>::arc_back_far(Int a, Int b) const {
  if (degree(b) <= few_neighbours || degree(b) <= degree(a)) return find(a, begin(b), end(b));
  const Int arc = find(b, begin(a), end(a));
  return arc == none ? none : hub_back_[static_cast<std::size_t>(arc)];
}

template <class Int>
Int Rings<Int>::find(Int a, Int begin, Int end) const {
  for (; begin < end; ++begin)
    if (target(begin) == a) return begin;
  return none;
}

template class Rings<std::int32_t>;
template class Rings<std::int64_t>;

}  // namespace pstripack
