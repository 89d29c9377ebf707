#include "stripack/triangle_list.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "base/parallel_for.h"
#include "base/workspace.h"
#include "lists/block_mail.h"
#include "lists/rings.h"
#include "stripack/list_queries.h"

namespace pstripack {
namespace {

// Method. Triangles are numbered by their smallest corner, then in the order of its ring. For a triangle t
// = (a,b,c) with a smallest, let m be the smaller and M the larger of b and c. Each side has the number of
// the corner opposite: 0 is b-c, 1 is c-a, 2 is a-b.
//
//          M              Every arc is treated at its smaller end. The ring of a determines the numbers of
//        / | \            those triangles at a-b and a-c whose smallest corner is a. About any other one
//       a  |  d           a has received a message from its smallest corner. In the same way a sends m a
//        \ | /            message that t is left (or right) of the arc from m to M. When m has all its
//          m              messages, it notes for t which triangle is on the other side of m-M.
//
// These notes come from nodes greater than a. So the blocks of nodes read their messages from the last
// block to the first, and can write the columns of their triangles at once. If several threads read blocks,
// the columns are completed after all blocks are read.
//
// All rings must have the same triangles. When m receives a message it checks the third corner; the largest
// corner gets no message. Both checks compare sums of hashes, modulo 2^64: the sum over the rings of the
// smallest corners with the sum over the rings of the others.
template <class Int>
class TriangleList {
 public:
  TriangleList(const ListsView<Int>& lists, int rows)
      : rows_(rows),
        threads_(threads_for(lists.n)),
        blocks_(lists.n, threads_),
        readable_(rings_.read(lists, threads_)) {}

  TriangleListStatus write(Int& nt, Int* ltri) {
    if (!readable_) return TriangleListStatus::broken_lists;
    Workspace space(bytes());
    lay_out(space);
    // Several threads must count the messages first; one thread can count while it sends.
    std::vector<std::size_t> messages(index(threads_), threads_ == 1 ? index(most_triangles()) : 0);
    before_[0] = 0;
    if (threads_ > 1) {
      for_blocks([&](std::size_t block, int piece) {
        before_[block + 1] = look_at(block);
        messages[index(piece)] += index(before_[block + 1]);
      });
      for (std::size_t block = 0; block < blocks_.count(); ++block) before_[block + 1] += before_[block];
      if (before_[blocks_.count()] > most_triangles()) return TriangleListStatus::broken_lists;
    }
    BlockMail<Message> mail(blocks_.count(), messages);
    parallel_pieces(blocks_.count(), threads_, [&](std::size_t begin, std::size_t end, int piece) {
      typename BlockMail<Message>::Outbox outbox(mail, index(piece));
      for (std::size_t block = begin; block < end && complete_; ++block) {
        if (threads_ == 1) before_[block + 1] = before_[block] + look_at(block);
        if (before_[block + 1] > most_triangles())
          complete_ = false;  // LTRI would be overrun
        else
          send(block, outbox);
      }
    });
    if (!complete_) return TriangleListStatus::broken_lists;
    const Int total = before_[blocks_.count()];
    if (entries_ != 3 * total || !count_numbered_arcs()) return TriangleListStatus::broken_lists;

    for_blocks([&](std::size_t block, int) {
      if (!complete_) return;
      number(block);
      mail.for_each_chunk(block, [&](Message* begin, Message* end) { receive(block, begin, end); });
      if (!complete_) return;
      mail.for_each_chunk(block,
                          [&](const Message* begin, const Message* end) { note_beyond(block, begin, end); });
      if (rows_ == 3) write_columns<3>(block, ltri);
      if (rows_ == 6) write_columns<6>(block, ltri);
      if (rows_ == 9) write_columns<9>(block, ltri);
      if (threads_ > 1) return;
      if (rows_ == 9) count_arcs(block);
      complete_columns(block, ltri);
    });
    if (!complete_ || difference_ != 0) return TriangleListStatus::broken_lists;
    if (threads_ > 1) {
      for (std::size_t block = blocks_.count(); rows_ == 9 && block-- > 0;) count_arcs(block);
      for_blocks([&](std::size_t block, int) { complete_columns(block, ltri); });
    }
    nt = total;
    return TriangleListStatus::done;
  }

 private:
  static constexpr FirstPair pairs = FirstPair::first_and_second;
  static constexpr Int far_ahead = 64;  ///< distance of prefetching, in arcs or triangles
  using Number = std::make_unsigned_t<Int>;
  /// A side of a triangle: 4 * triangle + 0, 1 or 2; 0 = none.
  using Side = Number;
  struct Message {
    Int to, larger;
    Number half;  ///< 2 * triangle, plus 1 if the triangle is right of the arc from `to` to `larger`
  };
  using Claims = typename Rings<Int>::Claims;

  Int most_triangles() const { return 2 * rings_.size() - 4; }
  std::size_t nodes() const { return index(rings_.size()); }
  Int first_arc(std::size_t block) const {
    const std::size_t nodes = blocks_.first(block);
    return nodes > 0 ? rings_.end(static_cast<Int>(nodes)) : 0;
  }
  /// The arc that left_[0] stands for: one thread has only one block at a time in left_.
  Int offset(std::size_t block) const { return threads_ == 1 ? first_arc(block) : 0; }

  /// Size of left_, in arcs. All arrays except the messages take 44 bytes per node (Int = int32_t, 9 rows).
  std::size_t left_size() const {
    Int most = 0;
    for (std::size_t block = 0; block < blocks_.count(); ++block)
      most = std::max(most, first_arc(block + 1) - first_arc(block));
    return index(threads_ == 1 ? most : rings_.arcs());
  }
  std::size_t bytes() const {
    const std::size_t triangles = index(most_triangles()) + 1;
    return left_size() * sizeof(Number) + nodes() * sizeof(Claims) + (blocks_.count() + 1) * sizeof(Int) +
           triangles * (sizeof(Side) + (rows_ == 9 ? sizeof(Number) : 0));
  }
  void lay_out(Workspace& space) {
    const std::size_t triangles = index(most_triangles()) + 1;
    left_ = space.for_call<Number>(left_size());
    claims_ = space.for_call<Claims>(nodes());
    before_ = space.for_call<Int>(blocks_.count() + 1);
    beyond_ = space.for_call<Side>(triangles);
    if (rows_ == 9) arcs_ = space.for_call<Number>(triangles);
  }

  /// Calls work(block, thread) for all blocks. Each thread takes its blocks from the last to the first.
  template <class Work>
  void for_blocks(const Work& work) const {
    parallel_pieces(blocks_.count(), threads_, [&](std::size_t begin, std::size_t end, int piece) {
      for (std::size_t block = end; block-- > begin;) work(block, piece);
    });
  }
  template <class Visit>
  void for_each_triangle(std::size_t block, const Visit& visit) const {
    rings_.template for_each_arc<pairs>(
        blocks_.first(block), blocks_.first(block + 1), [this](Int a) { return claims_[a - 1].smallest; },
        [this](Int a, Int p) { return rings_.is_smallest(a, p); }, visit);
  }

  /// Notes the triangles in the rings of a block. Returns the number of triangles whose smallest corner is
  /// in the block.
  Int look_at(std::size_t block) {
    Int triangles = 0, entries = 0, last_negative = 0;
    const Int begin = first_arc(block), end = first_arc(block + 1);
    for (Int arc = begin; arc < end; ++arc) entries += rings_.entry(arc) > 0;
    const auto last = static_cast<Int>(blocks_.first(block + 1));
    for (Int a = static_cast<Int>(blocks_.first(block)) + 1; a <= last; ++a) {
      last_negative += (rings_.entry(rings_.end(a) - 1) < 0) & (rings_.degree(a) > 1);
      if (rings_.is_small(a)) {
        claims_[a - 1] = rings_.claims_of(a);
        triangles += ones<Int>(claims_[a - 1].smallest);
      } else {
        for (Int arc = rings_.begin(a); arc < rings_.end(a); ++arc) triangles += rings_.is_smallest(a, arc);
      }
    }
    entries_ += entries;
    if (end - begin - entries != last_negative) has_bare_arcs_ = true;
    return triangles;
  }

  /// Sets arcs_left_ to the number of arcs that have a triangle. False if an arc a-b without triangles, a <
  /// b, is not listed by b.
  bool count_numbered_arcs() {
    Int bare = 0;
    for (Int a = 1; has_bare_arcs_ && a <= rings_.size(); ++a)
      for (Int arc = rings_.begin(a); arc < rings_.end(a); ++arc) {
        if (rings_.entry(arc) > 0 || rings_.entry(rings_.before(a, arc)) > 0) continue;
        const Int b = rings_.target(arc);
        if (b > a && rings_.arc_back(a, b) == Rings<Int>::none) return false;
        ++bare;
      }
    arcs_left_ = static_cast<Number>(rings_.arcs() - bare) / 2;
    return true;
  }

  /// Hash of the counterclockwise triangle (x,y,z) with x largest.
  static std::uint64_t hash(Int x, Int y, Int z) {
    const std::uint64_t sum = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u +
                              static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu +
                              static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u;
    return sum * (sum >> 32);
  }

  /// Sends the messages of the triangles of a block. Without branches, because they would be unpredictable.
  void send(std::size_t block, typename BlockMail<Message>::Outbox& outbox) {
    std::uint64_t sum = 0;
    auto t = static_cast<Number>(before_[block]);
    for_each_triangle(block, [&](Int a, Int p, Int q) {
      ++t;
      const Int b = rings_.entry(p), c = rings_.target(q);
      const Int is_right = c < b, m = std::min(b, c), larger = std::max(b, c);
      const Int after_larger = either(is_right, m, a), before_larger = m ^ a ^ after_larger;
      outbox.put(blocks_.of(index(m)), {m, larger, 2 * t + static_cast<Number>(is_right)});
      sum += hash(larger, after_larger, before_larger) + randomised(t) * static_cast<std::uint64_t>(a);
    });
    rings_.template for_each_arc<pairs>(
        blocks_.first(block), blocks_.first(block + 1), [this](Int x) { return claims_[x - 1].largest; },
        [this](Int x, Int p) { return rings_.is_largest(x, p); },
        [&](Int x, Int p, Int q) { sum -= hash(x, rings_.entry(p), rings_.target(q)); });
    difference_ += sum;
  }

  /// Fills left_ for a block. By arc: 2 * the triangle left of the arc, plus 1 if the arc's node is the
  /// smallest corner of the triangle; 0 = none. This function enters the triangles with the 1, receive()
  /// the others.
  void number(std::size_t block) {
    auto t = static_cast<Number>(before_[block]);
    const Int skip = offset(block), end = first_arc(block + 1);  // beyond it another thread may write
    const auto last = static_cast<Int>(blocks_.first(block + 1));
    for (Int a = static_cast<Int>(blocks_.first(block)) + 1; a <= last; ++a) {
      const Int ring = rings_.begin(a);
      rings_.prefetch(ring + far_ahead);  // for receive(), which needs the rings in any order
      Number* const left = left_ + (ring - skip);
      if (rings_.is_small(a) && ring + 2 * eight <= end) {  // later nodes overwrite the excess
        Number* eight_of_ring = left;
        unsigned bits = claims_[a - 1].smallest;
        for (Int arcs = rings_.degree(a); arcs > 0; arcs -= eight, bits >>= eight, eight_of_ring += eight) {
          put_twice(2 * t + 1, ranks_of_bits[bits & 255], eight_of_ring);
          t += ones_of_bits[bits & 255];
        }
      } else {
        for (Int arc = ring; arc < rings_.end(a); ++arc) {
          const bool smallest = rings_.is_smallest(a, arc);
          t += smallest;
          left[arc - ring] = smallest ? 2 * t + 1 : 0;
        }
      }
    }
  }

  /// Enters the triangles of messages in left_. Replaces `to` in each message by the arc with the triangle
  /// on the other side on its left.
  void receive(std::size_t block, Message* begin, Message* end) {
    bool complete = true;
    std::uint64_t sum = 0;
    Number* const left = left_;
    const Int skip = offset(block);
    for (Message* message = begin; message < end; ++message) {
      constexpr std::ptrdiff_t ahead = 16;
      rings_.prefetch(rings_.begin(std::min(message + ahead, end - 1)->to));
      Message& m = *message;
      const Int arc = rings_.arc_back(m.larger, m.to);
      if (arc == Rings<Int>::none) {
        complete = false;
        break;
      }
      const Int before = rings_.before(m.to, arc), after = rings_.after(m.to, arc);
      const Int is_right = static_cast<Int>(m.half & 1);
      const Int at = either(is_right, before, arc), third = either(is_right, before, after);
      Number& here = left[at - skip];
      complete = complete & (here == 0) & (rings_.entry(at) > 0);
      here = m.half & ~Number{1};
      sum -= randomised(m.half / 2) * static_cast<std::uint64_t>(rings_.target(third));
      m.to = either(is_right, arc, before);
    }
    if (!complete) complete_ = false;
    difference_ += sum;
  }

  void note_beyond(std::size_t block, const Message* begin, const Message* end) {
    const Number* const left = left_;
    const Int skip = offset(block);
    for (const Message* m = begin; m < end; ++m) {
      const Number beyond = left[m->to - skip];
      // If the smallest corner of that triangle is the message's node, the arc is side 2 of it if t is
      // right of the arc, side 1 if t is left.
      beyond_[m->half / 2] = 2 * (beyond & ~Number{1}) + ((beyond & 1) << (m->half & 1));
    }
  }

  /// Writes rows 1-3, 5 and 6 of the triangles of a block. For count_arcs it also sets, in arcs_, a bit for
  /// each of rows 5 and 6 whose triangle has a smaller number.
  template <int rows>
  void write_columns(std::size_t block, Int* ltri) {
    const Number* const left = left_;
    const Int skip = offset(block);
    Int t = before_[block];
    Int* column = ltri + index(t) * rows;
    for_each_triangle(block, [&](Int a, Int p, Int q) {
      ++t;
      column[0] = a;
      column[1] = rings_.entry(p);
      column[2] = rings_.target(q);
      if (rows > 3) {
        const auto opposite_b = static_cast<Int>(left[q - skip] / 2);
        const auto opposite_c = static_cast<Int>(left[rings_.before(a, p) - skip] / 2);
        column[4] = opposite_b;
        column[5] = opposite_c;
        if (rows > 6) arcs_[t] = Number{opposite_b < t} + 2 * Number{opposite_c < t};
      }
      column += rows;
    });
  }

  /// An arc is numbered with the later of its two triangles, or with its only one. On return arcs_[t] is 4
  /// * the number of arcs numbered before triangle t, plus a bit for each of the sides 0 and 1 of t whose
  /// arc is numbered with t. To be called for the blocks from the last to the first.
  void count_arcs(std::size_t block) {
    for (Int t = before_[block + 1]; t > before_[block]; --t) {
      const Number others = arcs_[t], first = beyond_[t] / 4 < static_cast<Number>(t);
      arcs_left_ -= first + (others & 1) + (others >> 1);
      arcs_[t] = 4 * arcs_left_ + first + 2 * (others & 1);
    }
  }

  /// Writes row 4 and rows 7-9.
  void complete_columns(std::size_t block, Int* ltri) const {
    for (Int t = before_[block] + 1; t <= before_[block + 1]; ++t) {
      const Side beyond = beyond_[t];
      if (rows_ == 6) ltri[6 * index(t) - 3] = static_cast<Int>(beyond / 4);
      if (rows_ < 9) continue;
      __builtin_prefetch(&arcs_[beyond_[std::min(t + far_ahead, before_[block + 1])] / 4]);
      Int* const column = ltri + 9 * (index(t) - 1);
      column[3] = static_cast<Int>(beyond / 4);
      column[6] = arc_number(t, 0, column[3], beyond % 4);
      // Side 2 and side 1: the triangle beyond has a larger number only if its smallest corner is a, too.
      column[7] = arc_number(t, 1, column[4], 2);
      column[8] = arc_number(t, 2, column[5], 1);
    }
  }

  /// The number of the arc that is side `side` of triangle t and side `other` of the triangle `beyond`.
  Int arc_number(Int t, Number side, Int beyond, Number other) const {
    const bool is_later = beyond > t;
    const Number arcs = arcs_[either<Int>(is_later, beyond, t)], s = either<Number>(is_later, other, side);
    const Number before = arcs & ((Number{1} << s) - 1);  // two bits; the number of 1s is before - before / 2
    return static_cast<Int>(arcs / 4 + 1 + before - before / 2);
  }

  /// first ? yes : no, without a branch.
  template <class T>
  static T either(T first, T yes, T no) {
    return no ^ ((T{0} - first) & (no ^ yes));
  }
  static std::size_t index(Int i) { return static_cast<std::size_t>(i); }

  int rows_;
  int threads_;
  NodeBlocks blocks_;
  Rings<Int> rings_;
  Claims* claims_ = nullptr;                  // by node with a small ring
  Int* before_ = nullptr;                     // by block: the number of triangles before it; then their total
  Number* left_ = nullptr;                    // by arc: see number()
  Side* beyond_ = nullptr;                    // by triangle: the side of another triangle that is its side 0
  Number* arcs_ = nullptr;                    // by triangle: see count_arcs; only if rows = 9
  Number arcs_left_ = 0;                      // arcs still to be numbered
  std::atomic<Int> entries_{0};               // entries of LIST with a triangle on the left
  std::atomic<std::uint64_t> difference_{0};  // sum over smallest corners minus sum over the others
  std::atomic<bool> complete_{true}, has_bare_arcs_{false};
  bool readable_;
};

}  // namespace

template <class Int>
TriangleListStatus triangle_list(const ListsView<Int>& lists, int rows, Int& nt, Int* ltri) {
  nt = 0;
  if (static_cast<Int>(lists.n) < 3 || (rows != 3 && rows != 6 && rows != 9))
    return TriangleListStatus::bad_argument;
  return TriangleList<Int>(lists, rows).write(nt, ltri);
}

template <class Int>
BoundaryCounts<Int> boundary_nodes(const ListsView<Int>& lists, Int* nodes) {
  const ListReader<Int> reader(lists);
  const Int n = reader.size();
  const Int start = reader.first_boundary_node();
  if (start == 0) return {0, 3 * n - 6, 2 * n - 4};
  Int count = 0, node = start;
  do {
    nodes[count++] = node;
    node = reader.first_neighbour(node);
  } while (node != start && count < n);
  const Int triangles = 2 * n - count - 2;
  return {count, triangles + n - 1, triangles};
}

#define PSTRIPACK_TRIANGLE_LIST(Int)                                                 \
  template TriangleListStatus triangle_list(const ListsView<Int>&, int, Int&, Int*); \
  template BoundaryCounts<Int> boundary_nodes(const ListsView<Int>&, Int*);
PSTRIPACK_TRIANGLE_LIST(std::int32_t)
PSTRIPACK_TRIANGLE_LIST(std::int64_t)

}  // namespace pstripack
