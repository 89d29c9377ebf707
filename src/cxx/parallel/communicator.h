#pragma once
// What the parallel algorithm asks of a group of ranks, and all that it knows of them: MPI stays in
// src/cxx/mpi, a single process is a group of one, and tests run many ranks as threads.

#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

#include "parallel/parcels.h"

namespace pstripack {

/// A failure on this rank.
struct Failure : std::exception {
  explicit Failure(std::int32_t c) : code(c) {}
  std::int32_t code;  ///< less than 0
};

/// A failure that all ranks have agreed on: the most negative code of any rank. Every rank throws it at the
/// same place.
struct AgreedFailure : std::exception {
  explicit AgreedFailure(std::int32_t c) : code(c) {}
  const char* what() const noexcept override { return "a rank failed"; }
  std::int32_t code;
};

/// The code of a Failure or an AgreedFailure; -6, out of memory, for any other exception.
std::int32_t code_of(const std::exception_ptr& error);

/// A group of ranks. Every member function but rank() and size() is collective: all ranks call
/// it, in the same order. An allocation that fails inside, on any rank, is an AgreedFailure(-6) on all of
/// them.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// values[i] becomes its smallest value over all ranks; at most 16 values.
  virtual void all_min(std::int64_t* values, std::size_t count) = 0;

  /// values[i] becomes its sum over all ranks. Allocates nothing.
  virtual void all_sum(std::int64_t* values, std::size_t count) = 0;

  /// Every rank gets the bytes of all ranks, in the order of the ranks.
  Parcels all_gather(const void* bytes, std::size_t size);
  /// The same where every rank knows how many: `all` gets all of them, of which rank r brings [begin[r],
  /// begin[r+1]) in place. Allocates nothing.
  virtual void all_gather_in_place(void* all, const std::vector<std::size_t>& begin) = 0;
  /// The values of all ranks, in their order; valid until the next call of any member. Allocates nothing.
  virtual const std::int64_t* all_gather_one(std::int64_t value) = 0;

  /// Every rank r gets the bytes that each rank meant for r. `outgoing.begin` has size()+1 entries. A rank
  /// that passes the code of a failure (< 0) sends nothing; every rank then throws AgreedFailure with the
  /// most negative code.
  virtual Parcels exchange(const Parcels& outgoing, std::int32_t code = 0) = 0;

  /// Allocates the bytes of `incoming`, whose `begin` tells what each rank sends here, and what start() needs
  /// for these parcels. Not collective. Throws std::bad_alloc.
  virtual void make_room(const Parcels& outgoing, Parcels& incoming) {
    (void)outgoing;
    incoming.bytes = Block(incoming.begin.back());
  }
  /// Starts to send every rank its parcel of `outgoing`, which fills that of this rank in `incoming` there.
  /// The bytes of both must stay as they are until finish(). Needs make_room(). Allocates nothing.
  virtual void start(const Parcels& outgoing, Parcels& incoming) = 0;
  /// Waits for all that this rank has started. Not collective.
  virtual void finish() {}

  /// Bytes that this rank has handed over for other ranks so far; for reports.
  std::int64_t bytes_sent = 0;

  /// Processor time that this rank has spent waiting for others so far; for reports.
  double idle_cpu_seconds = 0;
};

/// A group of one.
class SingleProcess : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void all_min(std::int64_t*, std::size_t) override {}
  void all_sum(std::int64_t*, std::size_t) override {}
  void all_gather_in_place(void*, const std::vector<std::size_t>&) override {}
  const std::int64_t* all_gather_one(std::int64_t value) override {
    value_ = value;
    return &value_;
  }
  Parcels exchange(const Parcels& outgoing, std::int32_t code) override;
  void start(const Parcels& outgoing, Parcels& incoming) override;

 private:
  std::int64_t value_ = 0;
};

}  // namespace pstripack
