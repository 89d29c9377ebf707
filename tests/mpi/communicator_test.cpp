// The group of ranks over MPI: every byte arrives for all sizes, and all ranks see the same failures.

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <memory>
#include <thread>
#include <vector>

#include "mpi/mpi_communicator.h"
#include "mpi_test.h"

namespace {

using pstripack::AgreedFailure;
using pstripack::Block;
using pstripack::Failure;
using pstripack::MpiCommunicator;
using pstripack::Parcels;

const std::size_t kLimits[] = {1, 7, 64, MpiCommunicator::kLongestMessage};

/// The message from rank `from` to rank `to`; both ranks can compute it. It has at most `most` bytes.
std::vector<unsigned char> message(int from, int to, int round, std::size_t most = 5000) {
  const unsigned seed = 7919u * static_cast<unsigned>(from) + 104729u * static_cast<unsigned>(to) +
                        1299709u * static_cast<unsigned>(round);
  const std::size_t sizes[] = {0, 1, 2, 63, 64, 65, 0, 700, 5000};
  std::vector<unsigned char> bytes(std::min(sizes[(seed >> 3) % std::size(sizes)], most));
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(seed + 31 * i);
  return bytes;
}

Parcels parcels_of(const std::vector<std::vector<unsigned char>>& messages) {
  Parcels parcels;
  parcels.begin.push_back(0);
  for (const auto& m : messages) parcels.begin.push_back(parcels.begin.back() + m.size());
  parcels.bytes = Block(parcels.begin.back());
  for (std::size_t r = 0; r < messages.size(); ++r)
    std::copy(messages[r].begin(), messages[r].end(), parcels.bytes.data() + parcels.begin[r]);
  return parcels;
}

std::vector<unsigned char> parcel(const Parcels& parcels, int r) {
  const auto k = static_cast<std::size_t>(r);
  return {parcels.bytes.data() + parcels.begin[k], parcels.bytes.data() + parcels.begin[k + 1]};
}

TEST(Communicator, ExchangeDeliversEveryByte) {
  for (const std::size_t limit : kLimits) {
    MpiCommunicator ranks(MPI_COMM_WORLD, limit);
    for (int round = 0; round < (limit == 1 ? 3 : 20); ++round) {
      std::vector<std::vector<unsigned char>> mine;
      const std::size_t most = 100 * limit;  // a hundred pieces, not thousands
      for (int r = 0; r < ranks.size(); ++r) mine.push_back(message(ranks.rank(), r, round, most));
      const Parcels incoming = ranks.exchange(parcels_of(mine));
      for (int r = 0; r < ranks.size(); ++r)
        ASSERT_EQ(parcel(incoming, r), message(r, ranks.rank(), round, most)) << "from " << r;
    }
  }
}

/// Run by `ctest -C long -L long`: takes 5 GB.
TEST(Communicator, DISABLED_MovesMoreThanAnIntegerCounts) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  ASSERT_EQ(ranks.size(), 2);
  constexpr std::size_t kBytes = (std::size_t{1} << 31) + 4097, kWord = sizeof(std::uint64_t);
  const auto word = [](std::size_t i) { return 0x9e3779b97f4a7c15u * (i + 1); };
  Parcels outgoing;
  outgoing.begin = {0, 0, ranks.rank() == 0 ? kBytes : 0};
  outgoing.bytes = Block(outgoing.begin[2]);
  const auto for_each_word = [](const auto& visit) {
    for (std::size_t i = 0; i < kBytes / kWord; ++i) visit(i);
  };
  for_each_word([&](std::size_t i) {
    const std::uint64_t w = word(i);
    if (ranks.rank() == 0) std::memcpy(outgoing.bytes.data() + i * kWord, &w, kWord);
  });
  if (ranks.rank() == 0) outgoing.bytes.data()[kBytes - 1] = 77;
  const Parcels incoming = ranks.exchange(outgoing);
  if (ranks.rank() == 0) return;
  ASSERT_EQ(incoming.begin[1], kBytes);
  std::size_t wrong = 0;
  for_each_word([&](std::size_t i) {
    std::uint64_t w;
    std::memcpy(&w, incoming.bytes.data() + i * kWord, kWord);
    wrong += w != word(i);
  });
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(incoming.bytes.data()[kBytes - 1], 77);
}

TEST(Communicator, GathersTheBytesOfAllRanks) {
  for (const std::size_t limit : kLimits) {
    MpiCommunicator ranks(MPI_COMM_WORLD, limit);
    for (int round = 0; round < (limit == 1 ? 3 : 20); ++round) {
      const std::size_t most = 100 * limit;
      const auto mine = message(ranks.rank(), 0, round, most);
      const Parcels all = ranks.all_gather(mine.data(), mine.size());
      for (int r = 0; r < ranks.size(); ++r) ASSERT_EQ(parcel(all, r), message(r, 0, round, most));
      const std::int64_t* const sizes = ranks.all_gather_one(static_cast<std::int64_t>(mine.size()));
      for (int r = 0; r < ranks.size(); ++r)
        ASSERT_EQ(sizes[r], static_cast<std::int64_t>(message(r, 0, round, most).size()));
    }
  }
}

TEST(Communicator, BroadcastsScattersAndGathers) {
  for (const std::size_t limit : kLimits) {
    MpiCommunicator ranks(MPI_COMM_WORLD, limit);
    for (int root = 0; root < ranks.size(); ++root) {
      std::vector<unsigned char> bytes(1000, static_cast<unsigned char>(ranks.rank()));
      ranks.broadcast(bytes.data(), bytes.size(), root);
      ASSERT_EQ(bytes, std::vector<unsigned char>(1000, static_cast<unsigned char>(root)));

      std::vector<std::vector<unsigned char>> messages;
      for (int r = 0; r < ranks.size(); ++r) messages.push_back(message(root, r, root));
      const Parcels all = parcels_of(messages);
      const auto& expected = messages[static_cast<std::size_t>(ranks.rank())];
      const bool is_root = ranks.rank() == root;
      std::vector<unsigned char> one(expected.size()), two(expected.size());
      if (is_root) one = two = expected;
      const auto begin = is_root ? all.begin : std::vector<std::size_t>();
      ranks.start_scatter(is_root ? all.bytes.data() : nullptr, begin, one.data(), one.size(), root);
      ranks.start_scatter(is_root ? all.bytes.data() : nullptr, begin, two.data(), two.size(), root);
      ranks.finish();
      ASSERT_EQ(one, expected);
      ASSERT_EQ(two, expected);

      std::vector<unsigned char> gathered(is_root ? all.begin.back() : 0);
      if (is_root)
        std::copy(one.begin(), one.end(),
                  gathered.begin() + static_cast<long>(begin[static_cast<std::size_t>(root)]));
      ranks.start_gather(one.data(), one.size(), gathered.data(), begin, root);
      ranks.finish();
      if (is_root) {
        ASSERT_TRUE(std::equal(gathered.begin(), gathered.end(), all.bytes.data()));
      }
    }
  }
}

TEST(Communicator, FindsTheSumOfEachValue) {
  for (const std::size_t limit : {std::size_t{7}, MpiCommunicator::kLongestMessage}) {
    MpiCommunicator ranks(MPI_COMM_WORLD, limit);
    for (const std::int64_t count : {0, 1, 3, 2048, 2049, 5000}) {
      std::vector<std::int64_t> values;
      for (std::int64_t i = 0; i < count; ++i)
        values.push_back((ranks.rank() - 1) * i - (std::int64_t{1} << 40));
      ranks.all_sum(values.data(), values.size());
      const std::int64_t size = ranks.size(), of_ranks = size * (size - 1) / 2 - size;
      for (std::int64_t i = 0; i < count; ++i)
        ASSERT_EQ(values[static_cast<std::size_t>(i)], of_ranks * i - size * (std::int64_t{1} << 40));
    }
  }
}

TEST(Communicator, FindsTheSmallestOfEachValue) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  std::int64_t values[] = {ranks.rank() + 5, -ranks.rank(), INT64_MAX, INT64_MIN + ranks.rank()};
  ranks.all_min(values, std::size(values));
  EXPECT_EQ(values[0], 5);
  EXPECT_EQ(values[1], 1 - ranks.size());
  EXPECT_EQ(values[2], INT64_MAX);
  EXPECT_EQ(values[3], INT64_MIN);
}

TEST(Communicator, CountsWhatItSends) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  std::vector<std::vector<unsigned char>> messages(static_cast<std::size_t>(ranks.size()),
                                                   std::vector<unsigned char>(10));
  ranks.exchange(parcels_of(messages));
  EXPECT_EQ(ranks.bytes_sent, 10 * (ranks.size() - 1));
}

std::int32_t code_of_communicator(MPI_Comm comm) {
  try {
    MpiCommunicator ranks(comm);
    return 0;
  } catch (const Failure& failure) {
    return failure.code;
  } catch (const AgreedFailure& failure) {
    return failure.code;
  }
}

TEST(Communicator, LeavesTheErrorHandlersOfTheProgramAlone) {
  EXPECT_EQ(code_of_communicator(MPI_COMM_NULL), -8);
  EXPECT_EQ(code_of_communicator(MPI_COMM_WORLD), 0);
  for (const MPI_Comm comm : {MPI_COMM_WORLD, MPI_COMM_SELF}) {
    MPI_Errhandler handler;
    MPI_Comm_get_errhandler(comm, &handler);
    EXPECT_EQ(handler, MPI_ERRORS_ARE_FATAL);
    MPI_Errhandler_free(&handler);
  }
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TEST(Communicator, WaitsWithoutBurningAProcessor) {
  if (size_of() < 2) GTEST_SKIP() << "nobody to wait for";
  MpiCommunicator ranks(MPI_COMM_WORLD);
  std::int64_t value = 0;
  ranks.all_min(&value, 1);
  const double before = processor_seconds();
  if (ranks.rank() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ranks.all_min(&value, 1);
  EXPECT_LT(processor_seconds() - before, 0.15);
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run_on_every_rank(argc, argv, [] {});
  return code != 0 || code_of_communicator(MPI_COMM_WORLD) != -8;  // MPI is finalised
}
