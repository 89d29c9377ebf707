#pragma once
// The numbers of the triangles of a triangulation, and the triangle on the left of each arc.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/parallel_for.h"
#include "lists/block_mail.h"
#include "lists/rings.h"

namespace pstripack {

/// Triangles are numbered by their smallest corner a, then in the order of the ring of a, so the ring of a
/// alone determines these numbers. The rings of the other two corners are anywhere in memory; looking each
/// of them up would take most of the time. Instead, for every arc from a to a larger b, a sends b a message
/// with the numbers of the triangles on both sides:
///
///              b
///            / | \               left  = (a,b,c), 0 if c < a
///           c  |  d              right = (a,d,b), 0 if d < a
///            \ | /
///              a
template <class Int, FirstPair pairs>
class TriangleNumbers {
 public:
  /// Counts the triangles and allocates all memory: 60 bytes per node (Int = int32_t) at most. Throws
  /// std::bad_alloc.
  TriangleNumbers(const Rings<Int>& rings, int threads)
      : rings_(rings), threads_(threads), blocks_(static_cast<std::size_t>(rings.size()), threads) {
    before_.resize(blocks_.count() + 1, 0);
    std::vector<std::size_t> messages(static_cast<std::size_t>(threads), 0);
    parallel_pieces(blocks_.count(), threads_, [&](std::size_t begin, std::size_t end, int piece) {
      for (std::size_t block = begin; block < end; ++block)
        messages[static_cast<std::size_t>(piece)] += count(block);
    });
    for (std::size_t block = 0; block < blocks_.count(); ++block) before_[block + 1] += before_[block];
    mail_.emplace(blocks_.count(), messages);
  }

  Int count() const { return before_.back(); }

  /// Sets left[arc] = offset + the number, from 1, of the triangle left of the arc; 0 if there is none.
  /// When the nodes begin+1..end are done, whose triangles are t+1, ..., it calls numbered(begin, end, t)
  /// on any thread. False if a neighbour of a node does not list the node, or if the rings of different
  /// nodes do not have the same triangles; entries of `left` may then be 0 or numbers of other triangles.
  template <class Numbered>
  bool write(Int offset, Int* left, const Numbered& numbered) {
    std::atomic<std::uint64_t> sent{0};
    parallel_pieces(blocks_.count(), threads_, [&](std::size_t begin, std::size_t end, int piece) {
      typename Mail::Outbox outbox(*mail_, static_cast<std::size_t>(piece));
      for (std::size_t block = begin; block < end; ++block)
        sent += send(block, offset + before_[block], left, outbox);
    });
    std::atomic<bool> complete{true};
    std::atomic<std::uint64_t> seen{0};
    std::atomic<Int> arcs{0};  // arcs with a triangle on the left
    parallel_pieces(blocks_.count(), threads_, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t block = begin; block < end; ++block) {
        const std::size_t first = blocks_.first(block), last = blocks_.first(block + 1);
        mail_->for_each_chunk(block, [&](const Message* message, const Message* last_message) {
          if (!receive(message, last_message, left, seen)) complete = false;
        });
        if (!agree(first_arc(first), first_arc(last), left, arcs)) complete = false;
        numbered(first, last, offset + before_[block]);
      }
    });
    return complete && arcs == 3 * count() && seen == sent;
  }

 private:
  struct Message {
    Int to, from, left, right;
  };
  using Mail = BlockMail<Message>;

  /// The number of arcs of the first `nodes` nodes.
  Int first_arc(std::size_t nodes) const { return nodes > 0 ? rings_.end(static_cast<Int>(nodes)) : 0; }

  Int triangles_at(Int a) const {
    Int count = 0;
    for (Int arc = rings_.begin(a); arc < rings_.end(a); ++arc) count += rings_.is_smallest(a, arc);
    return count;
  }

  /// Counts the triangles of a block; returns the number of messages that it sends.
  std::size_t count(std::size_t block) {
    Int triangles = 0, messages = 0;
    const auto last = static_cast<Int>(blocks_.first(block + 1));
    for (Int a = static_cast<Int>(blocks_.first(block)) + 1; a <= last; ++a) {
      if (rings_.is_small(a)) {
        const auto arcs = rings_.arcs_of(a);
        triangles += ones<Int>(arcs.triangles);
        messages += ones<Int>(arcs.greater);
      } else {
        triangles += triangles_at(a);
        for (Int arc = rings_.begin(a); arc < rings_.end(a); ++arc) messages += rings_.target(arc) > a;
      }
    }
    before_[block + 1] = triangles;
    return static_cast<std::size_t>(messages);
  }

  /// Enters the numbers of the triangles of a block (t is the number before the first) at their smallest
  /// corners, and sends them to the other corners. Returns the sum of randomised(t) (d + 3 b) over the
  /// triangles t = (a,d,b) sent, modulo 2^64.
  std::uint64_t send(std::size_t block, Int t, Int* left, typename Mail::Outbox& outbox) {
    std::uint64_t corners = 0;
    const std::size_t first = blocks_.first(block), last = blocks_.first(block + 1);
    std::fill(left + first_arc(first), left + first_arc(last), Int{0});
    for (Int a = static_cast<Int>(first) + 1; a <= static_cast<Int>(last); ++a) {
      const Int begin = rings_.begin(a), end = rings_.end(a);
      const bool small = rings_.is_small(a);
      const auto arcs = small ? rings_.arcs_of(a) : typename Rings<Int>::Arcs{};
      const Int count = small ? ones<Int>(arcs.triangles) : triangles_at(a);
      constexpr bool last_first = pairs == FirstPair::last_and_first;
      const bool closes = rings_.is_smallest(a, end - 1);
      const Int at_last = closes ? t + (last_first ? 1 : count) : 0;
      Int number = t + (last_first && closes), right = at_last, d = rings_.target(end - 1);
      const auto send_to = [&](Int arc, bool smallest) {
        number += smallest;
        const Int b = rings_.target(arc);
        const Int on_left = arc == end - 1 ? at_last : smallest ? number : 0;
        left[arc] = on_left;
        outbox.put(blocks_.of(static_cast<std::size_t>(b)), {b, a, on_left, right});
        corners += randomised(right) * static_cast<std::uint64_t>(d + 3 * std::int64_t{b});
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
    return corners;
  }

  bool receive(const Message* begin, const Message* end, Int* left, std::atomic<std::uint64_t>& seen) const {
    bool complete = true;
    std::uint64_t corners = 0;  // the sum of send(), with d from the ring of b, and b from the ring of d
    for (const Message* message = begin; message < end; ++message) {
      constexpr std::ptrdiff_t ahead = 8;
      const Int soon = rings_.begin(message[std::min(ahead, end - message - 1)].to);
      rings_.prefetch(soon);
      __builtin_prefetch(left + soon, 1);

      const Message& m = *message;
      const Int arc = rings_.arc_back(m.from, m.to);
      if (arc == Rings<Int>::none) {
        complete = false;
        continue;
      }
      const Int before = rings_.before(m.to, arc);
      Int &of_right = left[arc], &of_left = left[before];
      of_left = std::max(of_left, m.left);
      of_right = std::max(of_right, m.right);
      corners += randomised(m.right) * static_cast<std::uint64_t>(rings_.target(rings_.after(m.to, arc))) +
                 randomised(m.left) * static_cast<std::uint64_t>(3 * std::int64_t{rings_.target(before)});
    }
    seen += corners;
    return complete;
  }

  /// True if, among the arcs begin..end-1, exactly those have a triangle on the left to which LIST gives
  /// one. Adds their number to `arcs`: every triangle is entered three times, so the sum over all blocks
  /// shows whether two were entered at one arc.
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
  const NodeBlocks blocks_;
  std::vector<Int> before_;  // by block: the number of triangles before it
  std::optional<Mail> mail_;
};

}  // namespace pstripack
