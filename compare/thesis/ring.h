#pragma once
// The processes; the method calls MPI only here.

#include <string>
#include <vector>

#include "thesis/stitch.h"

namespace thesis {

class Ring {
 public:
  Ring();  ///< starts MPI
  ~Ring();
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }

  void barrier() const;
  /// Sends `right` to the right neighbour and returns what the left neighbour sent. Waits for no other rank.
  Chain from_left(const Chain& right) const;
  /// Collective. Returns at the root the items of all ranks, in the order of the ranks, and where each rank's
  /// items begin; empty on other ranks.
  template <class Item>
  std::vector<Item> gather(const std::vector<Item>& mine, std::vector<std::size_t>& begin) const {
    begin = gather_sizes(mine.size());
    std::vector<Item> all(begin.empty() ? 0 : begin.back());
    gather(mine.data(), mine.size(), all.data(), begin, sizeof(Item));
    return all;
  }

 private:
  std::vector<std::size_t> gather_sizes(std::size_t mine) const;
  void gather(const void* mine, std::size_t size, void* all, const std::vector<std::size_t>& begin,
              std::size_t item_size) const;

  int rank_ = 0, size_ = 1;
};

}  // namespace thesis
