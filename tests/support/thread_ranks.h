#pragma once
// Ranks that are threads of one process, to test code for ranks without MPI.

#include <pthread.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <thread>
#include <vector>

#include "parallel/communicator.h"

/// Runs body(ranks) on `size` ranks at once.
class ThreadRanks {
 public:
  using Body = std::function<void(pstripack::Communicator&)>;

  static void run(int size, const Body& body) {
    ThreadRanks group(size);
    std::vector<std::thread> threads;
    for (int r = 0; r < size; ++r)
      threads.emplace_back([&group, &body, r] {
        Rank rank(group, r);
        body(rank);
      });
    for (auto& t : threads) t.join();
  }

 private:
  explicit ThreadRanks(int size) : size_(size), posted_(static_cast<std::size_t>(size)) {
    pthread_barrier_init(&all_here_, nullptr, static_cast<unsigned>(size));
  }
  ~ThreadRanks() { pthread_barrier_destroy(&all_here_); }
  ThreadRanks(const ThreadRanks&) = delete;
  ThreadRanks& operator=(const ThreadRanks&) = delete;

  /// Every rank posts a pointer; all ranks read all pointers before the next call.
  template <class Read>
  void meet(int rank, const void* mine, const Read& read) {
    posted_[static_cast<std::size_t>(rank)] = mine;
    wait();
    read();
    wait();
  }

  void wait() { pthread_barrier_wait(&all_here_); }

  class Rank : public pstripack::Communicator {
   public:
    Rank(ThreadRanks& group, int rank) : group_(group), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return group_.size_; }

    void all_min(std::int64_t* values, std::size_t count) override {
      const std::vector<std::int64_t> mine(values, values + count);
      group_.meet(rank_, mine.data(), [&] {
        for (const void* other : group_.posted_)
          for (std::size_t k = 0; k < count; ++k)
            values[k] = std::min(values[k], static_cast<const std::int64_t*>(other)[k]);
      });
    }

    void all_sum(std::int64_t* values, std::size_t count) override {
      const std::vector<std::int64_t> mine(values, values + count);
      std::fill(values, values + count, 0);
      group_.meet(rank_, mine.data(), [&] {
        for (const void* other : group_.posted_)
          for (std::size_t k = 0; k < count; ++k) values[k] += static_cast<const std::int64_t*>(other)[k];
      });
    }

    void all_gather_in_place(void* all, const std::vector<std::size_t>& begin) override {
      auto* const to = static_cast<unsigned char*>(all);
      group_.meet(rank_, all, [&] {
        for (std::size_t r = 0; r < group_.posted_.size(); ++r)
          if (r != static_cast<std::size_t>(rank_))
            std::copy_n(static_cast<const unsigned char*>(group_.posted_[r]) + begin[r],
                        begin[r + 1] - begin[r], to + begin[r]);
      });
    }

    const std::int64_t* all_gather_one(std::int64_t value) override {
      values_.resize(group_.posted_.size());
      group_.meet(rank_, &value, [&] {
        for (std::size_t r = 0; r < values_.size(); ++r)
          values_[r] = *static_cast<const std::int64_t*>(group_.posted_[r]);
      });
      return values_.data();
    }

    pstripack::Parcels exchange(const pstripack::Parcels& outgoing, std::int32_t code) override {
      using Post = std::pair<std::int32_t, const pstripack::Parcels*>;
      const Post mine(code, &outgoing);
      std::int32_t least = 0;
      pstripack::Parcels incoming = collect(&mine, [&](const void* other) {
        const auto& [its_code, parcels] = *static_cast<const Post*>(other);
        least = std::min(least, its_code);
        if (its_code < 0) return std::pair<const void*, std::size_t>(nullptr, 0);
        const std::size_t begin = parcels->begin[rank_], end = parcels->begin[rank_ + 1];
        return std::pair<const void*, std::size_t>(parcels->bytes.data() + begin, end - begin);
      });
      if (least < 0) throw pstripack::AgreedFailure(least);
      bytes_sent += static_cast<std::int64_t>(outgoing.begin.back());
      return incoming;
    }

    void start(const pstripack::Parcels& outgoing, pstripack::Parcels& incoming) override {
      group_.meet(rank_, &outgoing, [&] {
        for (std::size_t r = 0; r < group_.posted_.size(); ++r) {
          const auto& parcels = *static_cast<const pstripack::Parcels*>(group_.posted_[r]);
          const auto me = static_cast<std::size_t>(rank_);
          const std::size_t size = parcels.begin[me + 1] - parcels.begin[me];
          if (size != incoming.begin[r + 1] - incoming.begin[r]) std::abort();
          std::copy_n(parcels.bytes.data() + parcels.begin[me], size,
                      incoming.bytes.data() + incoming.begin[r]);
        }
      });
      bytes_sent += static_cast<std::int64_t>(outgoing.begin.back());
    }

   private:
    template <class Part>
    pstripack::Parcels collect(const void* mine, const Part& part) {
      pstripack::Parcels all;
      group_.meet(rank_, mine, [&] {
        all.begin.push_back(0);
        for (const void* other : group_.posted_) all.begin.push_back(all.begin.back() + part(other).second);
        all.bytes = pstripack::Block(all.begin.back());
        for (std::size_t r = 0; r < group_.posted_.size(); ++r) {
          const auto [bytes, size] = part(group_.posted_[r]);
          const auto* const from = static_cast<const unsigned char*>(bytes);
          std::copy(from, from + size, all.bytes.data() + all.begin[r]);
        }
      });
      return all;
    }
    ThreadRanks& group_;
    const int rank_;
    std::vector<std::int64_t> values_;
  };

  const int size_;
  std::vector<const void*> posted_;
  pthread_barrier_t all_here_;
};
