// First generators on ranks: any number of ranks gives the same bits. Whole runs on ranks: mpi/scvt_test.cpp
// and pstripack.scvt_ranks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "parallel/agreement.h"
#include "point_sets.h"
#include "scvt/caller_agreement.h"
#include "scvt/evaluator.h"
#include "scvt/first_generators.h"
#include "scvt/spread.h"
#include "support/thread_ranks.h"

namespace {

using namespace pstripack;
using namespace pstripack::scvt;

constexpr int kRanks[] = {1, 2, 3, 5, 8};

const BumpDensity kBump({0, 0.6, 0.8}, 0.6, 0.1, 3);
const ConstantDensity kConstant;

/// The data of all ranks, in the order of ranks.
class Gathered {
 public:
  void add(const std::vector<std::int64_t>& numbers, const std::vector<Point>& points) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < numbers.size(); ++i) all_.emplace_back(numbers[i], points[i]);
    most_on_a_rank = std::max(most_on_a_rank, numbers.size());
  }
  std::vector<Point> points() {
    std::sort(all_.begin(), all_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Point> points;
    for (const auto& [number, point] : all_) {
      points.push_back(point);
      EXPECT_EQ(number, static_cast<std::int64_t>(points.size()));
    }
    return points;
  }
  std::size_t most_on_a_rank = 0;

 private:
  std::mutex mutex_;
  std::vector<std::pair<std::int64_t, Point>> all_;
};

/// An evaluator without MPI: each rank triangulates all generators and keeps its own stars. Slow.
class GatheringEvaluator final : public Evaluator {
 public:
  GatheringEvaluator(Communicator& ranks, const Density& density) : Evaluator(density), ranks_(ranks) {}
  Communicator& ranks() override { return ranks_; }
  void begin_with(const std::vector<std::int64_t>& numbers) override { numbers_ = numbers; }
  std::vector<std::int32_t> homes(const std::vector<Point>& generators) override {  // somewhere else
    std::vector<std::int32_t> homes;
    for (std::size_t i = 0; i < generators.size(); ++i)
      homes.push_back(static_cast<std::int32_t>(numbers_[i] * 7 % ranks_.size()));
    return homes;
  }

  Neighbourhood triangulate(const std::vector<Point>& generators) override {
    const Parcels numbers = ranks_.all_gather(numbers_.data(), generators.size() * sizeof(std::int64_t));
    const Parcels points = ranks_.all_gather(generators.data(), generators.size() * sizeof(Point));
    const Items<std::int64_t> number(numbers);
    const Items<Point> point(points);
    std::vector<Point> all(number.size());
    for (std::size_t i = 0; i < number.size(); ++i)
      all[static_cast<std::size_t>(number.begin()[i]) - 1] = point.begin()[i];
    std::vector<std::int32_t> list, lptr, lend;
    const NeighbourLists stars = scvt::triangulate(all, list, lptr, lend);
    std::vector<NodeAddress> home(all.size());
    for (RankNumber r = 0; r < static_cast<RankNumber>(ranks_.size()); ++r) {
      LocalNode k = 0;
      for (const std::int64_t of_rank : Items<std::int64_t>(numbers, r))
        home[static_cast<std::size_t>(of_rank) - 1] = {static_cast<RankOfNode>(r), k++};
    }
    // Own generators first, all the others behind them.
    std::vector<NodeAddress> owners;
    numbers_.resize(generators.size());
    std::vector<std::int32_t> local(all.size());
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      local[static_cast<std::size_t>(numbers_[i]) - 1] = static_cast<std::int32_t>(i) + 1;
    points_ = generators;
    end_.clear();
    neighbour_.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (local[i] == 0) {
        points_.push_back(all[i]);
        numbers_.push_back(static_cast<std::int64_t>(i) + 1);
        owners.push_back(home[i]);
        local[i] = static_cast<std::int32_t>(points_.size());
      }
    for (std::size_t i = 0; i < generators.size(); ++i) {
      const auto node = static_cast<std::size_t>(numbers_[i]) - 1;
      for (std::size_t s = stars.begin_of(node); s < stars.end_of(node); ++s)
        neighbour_.push_back(local[static_cast<std::size_t>(stars.neighbour[s]) - 1]);
      end_.push_back(static_cast<std::int32_t>(neighbour_.size()));
    }
    halo_ = Halo(owners, ranks_);
    return {points_.data(),
            numbers_.data(),
            {generators.size(), end_.data(), neighbour_.data()},
            points_.size(),
            &halo_};
  }

 private:
  Communicator& ranks_;
  std::vector<std::int64_t> numbers_;
  std::vector<Point> points_;
  std::vector<std::int32_t> end_, neighbour_;
  Halo halo_;
};

TEST(Spread, RandomGeneratorsAreTheSameOnAnyNumberOfRanks) {
  constexpr std::size_t kCount = 1001;
  const std::vector<Point> alone = random_generators(kCount, kBump, 5);
  ASSERT_EQ(alone.size(), kCount);
  // Neighbours on the curve are close.
  double length = 0;
  for (std::size_t i = 1; i < kCount; ++i) {
    const Point step = minus(alone[i], alone[i - 1]);
    length += std::sqrt(dot(step, step));
  }
  EXPECT_LT(length, 2.5 * std::sqrt(12.6 * kCount));
  // Also so few that some trials lie in a hemisphere, and the next ones must begin at the same candidate.
  for (const std::size_t count : {kCount, std::size_t{4}})
    for (const int size : kRanks) {
      Gathered gathered;
      ThreadRanks::run(size, [&](Communicator& ranks) {
        GatheringEvaluator evaluator(ranks, kBump);
        const Spread spread = random_generators(evaluator, count, 5);
        gathered.add(spread.numbers, spread.points);
      });
      EXPECT_LE(gathered.most_on_a_rank, count / static_cast<unsigned>(size) + 2);
      EXPECT_EQ(gathered.points(), count == kCount ? alone : random_generators(count, kBump, 5)) << size;
    }
}

TEST(Spread, RefinedGeneratorsAreTheSameOnAnyNumberOfRanks) {
  // Of the icosahedron's refinements many arcs are equally long: the choice is by numbers.
  for (const auto& [density, points] :
       {std::pair<const Density*, std::vector<Point>>(&kBump, point_sets::make("random", 500, 1)),
        {&kConstant, point_sets::make("icosahedral", 642, 1)}})
    for (const std::size_t n : {points.size(), std::size_t{1000}, 4 * points.size() - 6}) {
      std::vector<Point> first;
      for (const int size : kRanks) {
        Gathered gathered;
        ThreadRanks::run(size, [&, &points = points, density = density](Communicator& ranks) {
          GatheringEvaluator evaluator(ranks, *density);
          Spread mine;
          for (std::size_t i = 0; i < points.size(); ++i)
            if (static_cast<int>(i % static_cast<std::size_t>(size)) == ranks.rank()) {
              mine.points.push_back(points[i]);
              mine.numbers.push_back(static_cast<std::int64_t>(i) + 1);
            }
          evaluator.begin_with(mine.numbers);
          const Spread finer = refined(ranks, evaluator.triangulate(mine.points), *density, n);
          gathered.add(finer.numbers, finer.points);
        });
        const std::vector<Point> all = gathered.points();
        EXPECT_EQ(all.size(), n);
        if (first.empty()) first = all;
        EXPECT_EQ(all, first) << size;
      }
    }
}

TEST(Spread, RowsGoWhereTheyAreSentInTheOrderOfTheirNumbers) {
  ThreadRanks::run(3, [&](Communicator& ranks) {
    Rows rows{2, {}, {}};
    std::vector<std::int32_t> to;
    for (std::int64_t number = 1; number <= 100; ++number)
      if (number * number % 3 == ranks.rank()) {
        rows.numbers.push_back(number);
        to.push_back(static_cast<std::int32_t>(number - 1) / 34);
        rows.values.insert(rows.values.end(), {1.0 / static_cast<double>(number), -0.0});
      }
    const Rows slice = moved(ranks, rows, to);
    const std::size_t sizes[] = {34, 34, 32};
    ASSERT_EQ(slice.numbers.size(), sizes[ranks.rank()]);
    for (std::size_t i = 0; i < slice.numbers.size(); ++i) {
      EXPECT_EQ(slice.numbers[i], static_cast<std::int64_t>(i) + 1 + 34 * ranks.rank());
      EXPECT_EQ(slice.values[2 * i], 1.0 / static_cast<double>(slice.numbers[i]));
      EXPECT_TRUE(std::signbit(slice.values[2 * i + 1]));
    }
  });
}

/// What a procedure of the caller throws on some ranks, all ranks get: each the same.
TEST(Caller, ThrowsTheSameOnAllRanks) {
  using Body = std::function<void(int rank)>;
  const auto thrown_on_all = [](const Body& body) {
    std::vector<std::string> thrown(3);
    ThreadRanks::run(3, [&](Communicator& ranks) {
      std::string& mine = thrown[static_cast<std::size_t>(ranks.rank())];
      try {
        in_agreement_with_caller(ranks, [&] { body(ranks.rank()); });
        mine = "nothing";
      } catch (const BadDensity& e) {
        mine = std::string("bad density: ") + e.what();
      } catch (const NoTessellation& e) {
        mine = e.what();
      } catch (const AgreedFailure& e) {
        mine = "code " + std::to_string(e.code);
      }
    });
    for (const std::string& of_rank : thrown) EXPECT_EQ(of_rank, thrown[0]);
    return thrown[0];
  };
  EXPECT_EQ(thrown_on_all([](int) {}), "nothing");
  EXPECT_EQ(thrown_on_all([](int rank) {
              if (rank == 1) throw std::runtime_error("no such file");
            }),
            "no such file");
  EXPECT_EQ(thrown_on_all([](int rank) {
              if (rank == 2) throw 7;
            }),
            "a procedure of the caller threw an exception");
  EXPECT_EQ(thrown_on_all([](int rank) {
              if (rank == 0) throw std::bad_alloc();
              if (rank == 1) throw std::runtime_error("no such file");
            }),
            "code -6");
  // Of two bad values the one at the place that comes first; an exception comes before both.
  const BadDensity east({0, 1, 0}, -2), west({0, -1, 0}, -3);
  const auto bad = [&](int rank) {
    if (rank == 1) throw east;
    if (rank == 2) throw west;
  };
  EXPECT_EQ(thrown_on_all(bad), std::string("bad density: ") + west.what());
  EXPECT_EQ(thrown_on_all([&](int rank) {
              bad(rank);
              throw std::runtime_error("no such file");
            }),
            "no such file");
}

}  // namespace
