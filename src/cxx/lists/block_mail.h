#pragma once
// Messages between the nodes of a triangulation, collected by blocks of nodes. The reason: a node's
// neighbours may be anywhere in memory, and looking each of them up would dominate the time. While the
// messages of a block are read, its rings and the data of its arcs fit into the second-level cache.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/workspace.h"

namespace pstripack {

/// The nodes 1..n in blocks, several for each thread.
class NodeBlocks {
 public:
  NodeBlocks(std::size_t nodes, int threads) : nodes_(nodes) {
    constexpr int most_bits = 12;
    const std::size_t enough = 8 * static_cast<std::size_t>(threads);
    while (bits_ < most_bits && nodes >> bits_ > enough) ++bits_;
  }
  std::size_t count() const { return of(nodes_) + 1; }
  std::size_t of(std::size_t node) const { return (node - 1) >> bits_; }
  /// The number of nodes before the block.
  std::size_t first(std::size_t block) const { return std::min(block << bits_, nodes_); }

 private:
  std::size_t nodes_;
  int bits_ = 4;  // a block has 2^bits_ nodes
};

/// Messages of several senders, one per thread. The messages of one sender to one block form a chain of
/// chunks, of which only the newest may be partly filled.
template <class Message>
class BlockMail {
 public:
  /// Room for messages[s] messages of each sender s, to `blocks` blocks. Throws std::bad_alloc.
  BlockMail(std::size_t blocks, const std::vector<std::size_t>& messages)
      : blocks_(blocks),
        senders_(messages.size()),
        in_a_chunk_(chunk_for(blocks, messages)),
        space_(bytes(messages)) {
    first_chunk_ = space_.for_call<std::size_t>(senders_ + 1);
    first_chunk_[0] = 0;
    for (std::size_t s = 0; s < senders_; ++s) first_chunk_[s + 1] = first_chunk_[s] + chunks(messages[s]);
    newest_ = space_.for_call<std::size_t>(senders_ * blocks);
    std::fill(newest_, newest_ + senders_ * blocks, std::size_t{0});
    older_ = space_.for_call<std::size_t>(first_chunk_[senders_]);
    message_ = space_.for_call<Message>(first_chunk_[senders_] * in_a_chunk_);
  }

  /// The sending end of one sender. Construct it once per sender.
  class Outbox {
   public:
    Outbox(BlockMail& mail, std::size_t sender)
        : newest_(mail.newest_ + sender * mail.blocks_),
          older_(mail.older_),
          message_(mail.message_),
          in_a_chunk_(mail.in_a_chunk_),
          unused_(mail.first_chunk_[sender]) {}
    void put(std::size_t block, const Message& message) {
      std::size_t& newest = newest_[block];
      if ((newest & (in_a_chunk_ - 1)) == 0) {
        older_[unused_] = newest;
        newest = unused_++ * in_a_chunk_;
      }
      // The hardware prefetcher follows only few chains.
      constexpr std::size_t two_lines_on = 128 / sizeof(Message);
      __builtin_prefetch(message_ + newest + two_lines_on, 1);
      message_[newest++] = message;
    }

   private:
    std::size_t* const newest_;
    std::size_t* const older_;
    Message* const message_;
    const std::size_t in_a_chunk_;
    std::size_t unused_;  // the next chunk
  };

  /// Calls read(begin, end) for the messages to the block, chunk by chunk.
  template <class Read>
  void for_each_chunk(std::size_t block, const Read& read) {
    for (std::size_t s = 0; s < senders_; ++s)
      for (std::size_t end = newest_[s * blocks_ + block], chunk; end != 0; end = older_[chunk]) {
        chunk = (end - 1) / in_a_chunk_;
        read(message_ + chunk * in_a_chunk_, message_ + end);
      }
  }

 private:
  /// Number of messages in a chunk, a power of two. Long chunks are read fastest, but the newest chunk of
  /// each chain may be nearly empty. So the newest chunks of all chains take at most a quarter of the room
  /// of all messages.
  static std::size_t chunk_for(std::size_t blocks, const std::vector<std::size_t>& messages) {
    constexpr std::size_t least = 16, most = 1024;
    const std::size_t all = std::accumulate(messages.begin(), messages.end(), std::size_t{0});
    std::size_t chunk = least;
    while (chunk < most && messages.size() * blocks * 2 * chunk <= all / 4) chunk *= 2;
    return chunk;
  }
  std::size_t chunks(std::size_t messages) const { return messages / in_a_chunk_ + blocks_; }
  std::size_t bytes(const std::vector<std::size_t>& messages) const {
    std::size_t all = 0;
    for (const std::size_t of_sender : messages) all += chunks(of_sender);
    return all * (in_a_chunk_ * sizeof(Message) + sizeof(std::size_t)) +
           (messages.size() * (blocks_ + 1) + 1) * sizeof(std::size_t);
  }

  std::size_t blocks_, senders_, in_a_chunk_;
  Workspace space_;
  std::size_t* first_chunk_;  // by sender, and the end
  std::size_t* newest_;       // by sender and block: index after the newest message; 0 if there is none
  std::size_t* older_;        // by chunk: index after the last message of the previous chunk of the chain
  Message* message_;
};

}  // namespace pstripack
