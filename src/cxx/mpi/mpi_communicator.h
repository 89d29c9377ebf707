#pragma once
// A group of ranks over MPI. It has its own duplicate of a communicator, so that its messages do not meet
// those of the program, and its own way of waiting.

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/communicator.h"

namespace pstripack {

/// Owns a duplicate of an intra-communicator, with MPI_ERRORS_RETURN. An MPI error that ranks cannot agree
/// on (a lost process) ends the job: one line on stderr names the rank, then MPI_Abort.
///
/// Every wait, for a message or a collective, polls with pauses: it takes little processor time while other
/// ranks compute, also if there are more ranks than processors. For one thread at a time.
class MpiCommunicator : public Communicator {
 public:
  /// Longest message in bytes; longer ones are cut. MPI counts in int, and some networks fail near 2^31.
  static constexpr std::size_t kLongestMessage = std::size_t{1} << 30;

  /// Collective over comm. Throws Failure(-8) if comm is null, freed or an inter-communicator, or MPI is not
  /// running; AgreedFailure if any rank runs out of memory or passes a code other than 0.
  explicit MpiCommunicator(MPI_Comm comm, std::size_t longest_message = kLongestMessage,
                           std::int32_t code = 0);
  /// Collective, unless MPI is already finalised.
  ~MpiCommunicator() override;
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void all_min(std::int64_t* values, std::size_t count) override;
  void all_sum(std::int64_t* values, std::size_t count) override;
  void all_gather_in_place(void* all, const std::vector<std::size_t>& begin) override;
  const std::int64_t* all_gather_one(std::int64_t value) override;
  Parcels exchange(const Parcels& outgoing, std::int32_t code = 0) override;
  void make_room(const Parcels& outgoing, Parcels& incoming) override;
  void start(const Parcels& outgoing, Parcels& incoming) override;
  void finish() override;

  /// Copies `bytes` of rank `root` to every rank. Collective. Allocates nothing.
  void broadcast(void* bytes, std::size_t size, int root);

  /// Starts to send each other rank r the bytes [begin[r], begin[r+1]) of `all` on `root`. `all` and `begin`
  /// are used on `root` only; mine: where this rank's `size` bytes go if it is another one. The arrays must
  /// stay valid and unchanged until finish(), and no other member may be called before. Collective. Allocates
  /// nothing.
  void start_scatter(const void* all, const std::vector<std::size_t>& begin, void* mine, std::size_t size,
                     int root) {
    start(Way::out, const_cast<void*>(all), begin, mine, size, root);
  }
  /// The reverse: starts to collect `mine` of each other rank r in the bytes [begin[r], begin[r+1]) of `all`
  /// on `root`.
  void start_gather(const void* mine, std::size_t size, void* all, const std::vector<std::size_t>& begin,
                    int root) {
    start(Way::in, all, begin, const_cast<void*>(mine), size, root);
  }

  /// Messages from now on, on all ranks; at first 0. Messages with different tags never match. At most 32767.
  void set_tag(int tag) { tag_ = tag; }
  MPI_Comm handle() const { return comm_; }

  /// Ends the job with one line on stderr, for errors that ranks cannot agree on. kind: such as "MPI error".
  [[noreturn]] void abort(const char* kind, const char* text) const;

 private:
  void check(int code) const;
  void wait(MPI_Request* requests, int count, std::size_t bytes = 0);
  void wait(MPI_Request request) { wait(&request, 1); }
  enum class Way { out, in };
  void post(Way way, void* bytes, std::size_t size, int other);
  void start(Way way_of_root, void* all, const std::vector<std::size_t>& begin, void* mine, std::size_t size,
             int root);
  std::size_t messages_for(std::size_t size) const {
    return (size + longest_message_ - 1) / longest_message_;
  }
  bool ranks_outnumber_processors();
  int above(int distance) const { return (rank_ + distance) % size_; }
  int below(int distance) const { return (rank_ + size_ - distance) % size_; }
  void send_and_receive(const void* out, std::size_t out_size, int to, void* in, std::size_t in_size,
                        int from);
  template <class Begin>
  void gather_blocks(void* all, const Begin& begin);
  void exchange_sizes(const std::int64_t* out);

  static constexpr std::size_t kMostValues = 16;

  /// What exchange_sizes() sends on: a value for the rank so many above its sender.
  struct Routed {
    std::int64_t above, value;
  };

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1, tag_ = 0;
  std::size_t longest_message_;
  bool crowded_ = false;
  /// One number per rank, allocated once so that an agreement needs no memory.
  std::vector<std::int64_t> sizes_, other_sizes_;
  std::vector<Routed> moving_, leaving_, arriving_;
  std::vector<MPI_Request> under_way_;  ///< its capacity is reserved before anything is posted
  std::size_t bytes_under_way_ = 0;
};

}  // namespace pstripack
