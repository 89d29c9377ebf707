#pragma once
// LIST, LPTR and LEND from stars that are spread over ranks; each rank has those of consecutive nodes.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lists/list_pieces.h"
#include "mpi/mpi_communicator.h"
#include "parallel/agreement.h"
#include "parallel/local_nodes.h"
#include "trmesh/call.h"

namespace pstripack {

/// Which ranks have the arrays of a call.
enum class Arrays {
  on_every_rank,
  on_one_rank,
  shared  ///< all ranks, on one machine, have the same memory; only rank 0 writes lnew
};

/// Writes the lists of all nodes. Rank r contributes the rings of the nodes [begin[r], begin[r+1]). root:
/// the rank that has the arrays, for Arrays::on_one_rank. Collective. Throws AgreedFailure, having written
/// nothing.
template <class Int>
void gather_lists(MpiCommunicator& ranks, const RingTable<Int>& rings, const std::vector<std::size_t>& begin,
                  Arrays arrays, int root, const ListArrays& lists) {
  const auto& [list, lptr, lend, lnew] = lists;
  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<std::size_t>(ranks.rank());
  const std::size_t n = begin[size], first = begin[me], count = begin[me + 1] - first;
  const bool has_arrays = arrays != Arrays::on_one_rank || root == ranks.rank();

  // Allocate all memory first, so that nothing is written if a rank runs out of it.
  BlockArray<std::int32_t> list_piece, lend_piece;
  std::vector<std::size_t> slot_bytes, node_bytes;
  auto arcs = static_cast<std::int64_t>(rings.arcs());
  int piece_threads = 1, lptr_threads = 1;
  in_agreement(ranks, [&] {
    piece_threads = threads_for(count);
    if (has_arrays) lptr_threads = threads_for(n);
    slot_bytes.resize(size + 1);
    node_bytes.resize(size + 1);
    if (!has_arrays) {
      list_piece = BlockArray<std::int32_t>(static_cast<std::size_t>(arcs));
      lend_piece = BlockArray<std::int32_t>(count);
    }
  });
  const std::int64_t* const arcs_of_rank = ranks.all_gather_one(arcs);
  for (std::size_t r = 0; r < size; ++r) {
    slot_bytes[r + 1] = slot_bytes[r] + static_cast<std::size_t>(arcs_of_rank[r]) * sizeof *list;
    node_bytes[r + 1] = begin[r + 1] * sizeof *lend;
  }
  const std::size_t slot = slot_bytes[me] / sizeof *list;
  if (arrays == Arrays::shared) {
    write_piece(rings, slot, list + slot, lend + first, piece_threads);
    write_lptr(lend + first, count, slot, lptr, piece_threads);
    ranks.all_min(&arcs, 1);  // waits until all ranks have written their pieces
  } else if (arrays == Arrays::on_every_rank) {
    write_piece(rings, slot, list + slot, lend + first, piece_threads);
    ranks.all_gather_in_place(lend, node_bytes);
    ranks.all_gather_in_place(list, slot_bytes);
    write_lptr(lend, n, 0, lptr, lptr_threads);
  } else if (has_arrays) {
    ranks.start_gather(nullptr, 0, lend, node_bytes, root);
    write_piece(rings, slot, list + slot, lend + first, piece_threads);
    ranks.finish();
    ranks.start_gather(nullptr, 0, list, slot_bytes, root);
    write_lptr(lend, n, 0, lptr, lptr_threads);  // while LIST is being received
    ranks.finish();
  } else {
    write_piece(rings, slot, list_piece.data(), lend_piece.data(), piece_threads);
    ranks.start_gather(lend_piece.data(), count * sizeof *lend, nullptr, node_bytes, root);
    ranks.start_gather(list_piece.data(), static_cast<std::size_t>(arcs) * sizeof *list, nullptr, slot_bytes,
                       root);
    ranks.finish();
  }
  if (has_arrays && (arrays != Arrays::shared || me == 0))
    *lnew = static_cast<std::int32_t>(slot_bytes[size] / sizeof *list) + 1;
}

}  // namespace pstripack
