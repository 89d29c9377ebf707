#pragma once
// How ranks agree: on whether all of them could do something, and on what holds for all of them together.

#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>

#include "parallel/communicator.h"

namespace pstripack {

// Votes: values that ranks agree on. Each is encoded as a number whose minimum over all ranks is the result.

/// True if it is true on any rank.
struct OnAny {
  bool value = false;
  std::int64_t encode() const { return value ? -1 : 0; }
  void decode(std::int64_t least) { value = least != 0; }
};

/// True if it is true on all ranks.
struct OnAll {
  bool value = true;
  std::int64_t encode() const { return value ? 1 : 0; }
  void decode(std::int64_t least) { value = least != 0; }
};

struct Smallest {
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
  std::int64_t value = kNone;
  bool exists() const { return value != kNone; }
  std::int64_t encode() const { return value; }
  void decode(std::int64_t least) { value = least; }
};

struct Largest {
  std::int64_t value = 0;
  std::int64_t encode() const { return ~value; }
  void decode(std::int64_t least) { value = ~least; }
};

/// Of numbers that are not negative.
struct LargestReal {
  double value = 0;
  std::int64_t encode() const {  // the bits of such numbers are in their order
    std::int64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return ~bits;
  }
  void decode(std::int64_t least) {
    const std::int64_t bits = ~least;
    std::memcpy(&value, &bits, sizeof value);
  }
};

/// The value of rank 0.
template <class Value>
struct OfRank0 {
  OfRank0(const Communicator& ranks, Value v) : value(v), counts(ranks.rank() == 0) {}
  Value value;
  bool counts;
  std::int64_t encode() const { return counts ? static_cast<std::int64_t>(value) : Smallest::kNone; }
  void decode(std::int64_t least) { value = static_cast<Value>(least); }
};

/// Patches would take longer than one: triangulate() then makes one of all nodes. Every rank throws it at the
/// same place.
struct PatchesDoNotPay : std::exception {
  const char* what() const noexcept override { return "patches do not pay"; }
};

/// How a body ended. Its code is 0 if it returned. HiddenNode and PatchesDoNotPay, which are no failures,
/// have codes of their own, which are no result codes; that of a failure is smaller.
class Outcome {
 public:
  explicit Outcome(std::int32_t code = 0) : code_(code) {}
  template <class Body>
  static Outcome of(const Body& body) {
    Outcome outcome;
    try {
      body();
    } catch (...) {
      outcome.code_ = code_of_current();
    }
    return outcome;
  }
  /// For Communicator::exchange().
  std::int32_t code() const { return code_; }
  bool is_good() const { return code_ == 0; }
  /// Returns if the body returned. Throws HiddenNode, PatchesDoNotPay or AgreedFailure.
  void accept() const;
  /// Runs the body unless an earlier one has thrown.
  template <class Body>
  void go_on(const Body& body) {
    if (is_good()) *this = of(body);
  }

  std::int64_t encode() const { return code_; }
  void decode(std::int64_t least) { code_ = static_cast<std::int32_t>(least); }

 private:
  static std::int32_t code_of_current();
  std::int32_t code_;
};

/// Each vote becomes the result over all ranks. Collective.
template <class... Votes>
void agree(Communicator& ranks, Votes&... votes) {
  std::int64_t all[] = {votes.encode()...};
  ranks.all_min(all, sizeof...(Votes));
  const std::int64_t* least = all;
  (votes.decode(*least++), ...);
}

/// Runs body() on every rank. Returns if body() returned on all of them; otherwise throws the same exception
/// on every rank: AgreedFailure, HiddenNode or PatchesDoNotPay. The same message agrees on the votes, as
/// body() leaves them. Collective.
template <class Body, class... Votes>
void in_agreement(Communicator& ranks, const Body& body, Votes&... votes) {
  Outcome outcome = Outcome::of(body);
  agree(ranks, outcome, votes...);
  outcome.accept();
}

/// Exchanges the parcels that body() returns. Throws as in_agreement() if body() threw on any rank.
/// Collective.
template <class Body>
Parcels exchange_in_agreement(Communicator& ranks, const Body& body) {
  Parcels outgoing;
  const Outcome outcome = Outcome::of([&] { outgoing = body(); });
  try {
    return ranks.exchange(outgoing, outcome.code());
  } catch (const AgreedFailure& failure) {
    Outcome(failure.code).accept();
    throw;
  }
}

}  // namespace pstripack
