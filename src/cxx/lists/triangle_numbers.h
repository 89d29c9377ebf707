#pragma once
// The numbers of the triangles of a triangulation, and the triangle on the left of each arc.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel_for.h"
#include "base/workspace.h"
#include "lists/rings.h"

namespace pstripack {

/// Triangles are numbered by their smallest corner a, then in the order of its ring. The ring of a is enough
/// to know these numbers; the rings of the other two corners are anywhere in memory, and looking each of them
/// up takes most of the time. Instead, for every arc from a to a larger b, a message goes to b with the
/// numbers on both sides:
///
///              b
///            / | \               left  = (a,b,c), 0 if c < a
///           c  |  d              right = (a,d,b), 0 if d < a
///            \ | /
///              a
///
/// Messages are collected by blocks of nodes. A block, its rings and its numbers fit into the second cache
/// while its messages are read.
template <class Int, FirstPair pairs>
class TriangleNumbers {
 public:
  /// Counts the triangles. Does all allocation: 48 bytes per node (Int = int32_t) and 4 KB per block of
  /// nodes. Throws std::bad_alloc.
  TriangleNumbers(const Rings<Int>& rings, int threads) : rings_(rings), threads_(threads) {
    constexpr int most_bits = 12;
    const std::size_t enough_blocks = 8 * static_cast<std::size_t>(threads);
    while (block_bits_ < most_bits && nodes() >> block_bits_ > enough_blocks) ++block_bits_;
    blocks_ = block_of(rings.size()) + 1;

    before_.resize(blocks_ + 1, 0);
    std::vector<std::size_t> messages(static_cast<std::size_t>(threads), 0);
    parallel_pieces(blocks_, threads_, [&](std::size_t begin, std::size_t end, int piece) {
      for (std::size_t block = begin; block < end; ++block)
        messages[static_cast<std::size_t>(piece)] += count(block);
    });
    for (std::size_t block = 0; block < blocks_; ++block) before_[block + 1] += before_[block];
    std::size_t chunks = 0;
    for (const std::size_t of_thread : messages) {
      outboxes_.push_back({std::vector<std::size_t>(blocks_, 0), chunks, 0});
      chunks += of_thread / in_a_chunk + blocks_;
    }
    message_ = BlockArray<Message>(chunks * in_a_chunk);
    older_ = BlockArray<std::size_t>(chunks);
  }

  Int count() const { return before_.back(); }

  /// left[arc] = offset + the number, from 1, of the triangle left of the arc; 0 if there is none. Calls
  /// numbered(begin, end, t) when that is done for the nodes begin+1..end, whose triangles are t+1, ...: for
  /// all nodes, in blocks, on any thread. False if a neighbour does not list the node, or the neighbours of
  /// different nodes do not form the same triangles; numbers in left are right or 0 or those of other
  /// triangles.
  template <class Numbered>
  bool write(Int offset, Int* left, const Numbered& numbered) {
    parallel_pieces(blocks_, threads_, [&](std::size_t begin, std::size_t end, int piece) {
      for (std::size_t block = begin; block < end; ++block)
        send(block, offset + before_[block], left, outboxes_[static_cast<std::size_t>(piece)]);
    });
    std::atomic<bool> complete{true};
    std::atomic<std::uint64_t> seen{0};
    std::atomic<Int> arcs{0};  // with a triangle on the left
    parallel_pieces(blocks_, threads_, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t block = begin; block < end; ++block) {
        const std::size_t first = first_node(block), last = first_node(block + 1);
        for (const Outbox& outbox : outboxes_)
          if (!receive(outbox.newest[block], left, seen)) complete = false;
        if (!agree(first_arc(first), first_arc(last), left, arcs)) complete = false;
        numbered(first, last, offset + before_[block]);
      }
    });
    std::uint64_t sent = 0;
    for (const Outbox& outbox : outboxes_) sent += outbox.corners;
    return complete && arcs == 3 * count() && seen == sent;
  }

 private:
  static constexpr std::size_t in_a_chunk = 256;
  struct Message {
    Int to, from, left, right;
  };
  /// What one thread sends. The messages to one block are in a chain of chunks, all full but the newest.
  struct Outbox {
    std::vector<std::size_t> newest;  ///< by block: one after its newest message; 0 if there is none
    std::size_t unused;               ///< the next chunk
    std::uint64_t corners;            ///< sum of t (d + 3 b) over the triangles t = (a,d,b) sent, modulo 2^64
  };

  std::size_t nodes() const { return static_cast<std::size_t>(rings_.size()); }
  std::size_t block_of(Int node) const { return (static_cast<std::size_t>(node) - 1) >> block_bits_; }
  /// The number of nodes before the block.
  std::size_t first_node(std::size_t block) const { return std::min(block << block_bits_, nodes()); }
  /// The number of arcs of that many nodes.
  Int first_arc(std::size_t nodes) const { return nodes > 0 ? rings_.end(static_cast<Int>(nodes)) : 0; }

  static Int ones(unsigned byte) {
    static constexpr auto counts = [] {
      std::array<unsigned char, 256> bits{};
      for (unsigned i = 1; i < 256; ++i) bits[i] = static_cast<unsigned char>(bits[i / 2] + i % 2);
      return bits;
    }();
    return counts[byte];
  }

  /// The number of triangles whose smallest corner is a.
  Int triangles_at(Int a) const {
    Int count = 0;
    for (Int arc = rings_.begin(a); arc < rings_.end(a); ++arc) count += rings_.is_smallest(a, arc);
    return count;
  }

  /// Counts the triangles of a block; returns the number of messages that it sends.
  std::size_t count(std::size_t block) {
    Int triangles = 0, messages = 0;
    const auto last = static_cast<Int>(first_node(block + 1));
    for (Int a = static_cast<Int>(first_node(block)) + 1; a <= last; ++a) {
      if (rings_.is_small(a)) {
        const auto arcs = rings_.arcs_of(a);
        triangles += ones(arcs.triangles);
        messages += ones(arcs.greater);
      } else {
        triangles += triangles_at(a);
        for (Int arc = rings_.begin(a); arc < rings_.end(a); ++arc) messages += rings_.target(arc) > a;
      }
    }
    before_[block + 1] = triangles;
    return static_cast<std::size_t>(messages);
  }

  /// Enters the triangles of a block, t before them, at their smallest corners and sends them to the others.
  void send(std::size_t block, Int t, Int* left, Outbox& outbox) {
    const std::size_t first = first_node(block), last = first_node(block + 1);
    std::fill(left + first_arc(first), left + first_arc(last), Int{0});
    for (Int a = static_cast<Int>(first) + 1; a <= static_cast<Int>(last); ++a) {
      const Int begin = rings_.begin(a), end = rings_.end(a);
      const bool small = rings_.is_small(a);
      const auto arcs = small ? rings_.arcs_of(a) : typename Rings<Int>::Arcs{};
      const Int count = small ? ones(arcs.triangles) : triangles_at(a);
      constexpr bool last_first = pairs == FirstPair::last_and_first;
      const bool closes = rings_.is_smallest(a, end - 1);
      const Int at_last = closes ? t + (last_first ? 1 : count) : 0;
      Int number = t + (last_first && closes), right = at_last, d = rings_.target(end - 1);
      const auto send_to = [&](Int arc, bool smallest) {
        number += smallest;
        const Int b = rings_.target(arc);
        const Int on_left = arc == end - 1 ? at_last : smallest ? number : 0;
        left[arc] = on_left;
        put({b, a, on_left, right}, outbox);
        outbox.corners += product(right, d) + 3 * product(right, b);
        right = on_left;
        d = b;
      };
      if (small) {
        for (unsigned greater = arcs.greater; greater != 0; greater &= greater - 1) {
          const int i = __builtin_ctz(greater);
          send_to(begin + i, (arcs.triangles >> i & 1) != 0);
        }
      } else {
        for (Int arc = begin; arc < end; ++arc)
          if (rings_.target(arc) > a) send_to(arc, rings_.is_smallest(a, arc));
      }
      t += count;
    }
  }

  static std::uint64_t product(Int i, Int j) {
    return static_cast<std::uint64_t>(i) * static_cast<std::uint64_t>(j);
  }

  void put(const Message& message, Outbox& outbox) {
    std::size_t& newest = outbox.newest[block_of(message.to)];
    if (newest % in_a_chunk == 0) {
      older_[outbox.unused] = newest;
      newest = outbox.unused++ * in_a_chunk;
    }
    message_[newest++] = message;
  }

  /// Reads a chain of messages.
  bool receive(std::size_t newest, Int* left, std::atomic<std::uint64_t>& seen) const {
    bool complete = true;
    std::uint64_t corners = 0;  // as in Outbox: t d as the ring of b has it, 3 t b as the ring of d has it
    for (std::size_t end = newest, chunk; end != 0; end = older_[chunk]) {
      chunk = (end - 1) / in_a_chunk;
      for (std::size_t i = chunk * in_a_chunk; i < end; ++i) {
        constexpr std::size_t ahead = 8;
        const Int soon = rings_.begin(message_[std::min(i + ahead, end - 1)].to);
        rings_.prefetch(soon);
        __builtin_prefetch(left + soon, 1);

        const Message& m = message_[i];
        const Int arc = rings_.arc_back(m.from, m.to);
        if (arc == Rings<Int>::none) {
          complete = false;
          continue;
        }
        const Int before = rings_.before(m.to, arc);
        Int &of_right = left[arc], &of_left = left[before];
        of_left = std::max(of_left, m.left);
        of_right = std::max(of_right, m.right);
        corners += product(m.right, rings_.target(rings_.after(m.to, arc))) +
                   3 * product(m.left, rings_.target(before));
      }
    }
    seen += corners;
    return complete;
  }

  /// True if those of the arcs begin..end-1 have a triangle on the left that LIST gives one; adds their
  /// number to `arcs`. Every triangle is entered three times, so the sum shows whether two were entered at
  /// one arc.
  bool agree(Int begin, Int end, const Int* left, std::atomic<Int>& arcs) const {
    Int entered = 0, differ = 0;
    for (Int arc = begin; arc < end; ++arc) {
      entered += left[arc] != 0;
      differ += (left[arc] != 0) != (rings_.entry(arc) > 0);
    }
    arcs += entered;
    return differ == 0;
  }

  const Rings<Int>& rings_;
  int threads_;
  int block_bits_ = 4;  // a block has 2^block_bits_ nodes
  std::size_t blocks_;
  std::vector<Int> before_;  // the number of triangles before each block
  std::vector<Outbox> outboxes_;
  BlockArray<Message> message_;
  BlockArray<std::size_t> older_;  // by chunk: one after the last message of the chunk before it in its chain
};

}  // namespace pstripack
