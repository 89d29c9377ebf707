#include "lists/rings.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "base/parallel_for.h"

namespace pstripack {
namespace {

template <class Int, class Test>
bool all_of(Int n, int threads, const Test& test) {
  std::atomic<bool> all{true};
  parallel_pieces(static_cast<std::size_t>(n), threads, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i)
      if (!test(static_cast<Int>(i))) {
        all = false;
        return;
      }
  });
  return all;
}

}  // namespace

template <class Int>
bool Rings<Int>::read(const ListsView<Int>& lists, int threads) {
  n_ = static_cast<Int>(lists.n);
  entry_ = lists.list;
  end_ = lists.lend;
  if (!are_rings(lists, threads) && !copy(lists)) return false;

  const auto in_range = [this](Int arc) {
    const Int node = entry(arc);
    return node >= -n_ && node <= n_ && node != 0;
  };
  if (!all_of(arcs(), threads, in_range)) return false;
  if (!all_of(n_, threads, [this](Int i) { return degree(i + 1) <= few_neighbours; })) tabulate_hubs();
  return true;
}

/// True if the ring of every node k is the slots LEND(k-1)+1..LEND(k), linked upwards and closed.
template <class Int>
bool Rings<Int>::are_rings(const ListsView<Int>& lists, int threads) const {
  const Int most = 6 * n_ - 12;
  return all_of(n_, threads, [&lists, most](Int i) {
    const Int before = i > 0 ? lists.lend[i - 1] : 0, last = lists.lend[i];
    if (before < 0 || before >= last || last > most) return false;
    bool linked = lists.lptr[last - 1] == before + 1;
    for (Int slot = before + 1; slot < last; ++slot) linked &= lists.lptr[slot - 1] == slot + 1;
    return linked;
  });
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

/// For the arcs between a hub, a node of many neighbours, and any other node: the shorter of the two rings
/// is searched. The sum over the arcs of a planar graph of the smaller degree is O(n) (Chiba and Nishizeki
/// 1985), however large the hubs are.
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

template class Rings<std::int32_t>;
template class Rings<std::int64_t>;

}  // namespace pstripack
