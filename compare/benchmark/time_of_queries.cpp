#include "time_of_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "child_process.h"
#include "contenders.h"
#include "orders.h"
#include "parallel/cost.h"
#include "point_sets.h"

extern "C" {  // libstripack, as a Fortran program calls it
void getnp_(const double* x, const double* y, const double* z, const int* list, const int* lptr, int* lend,
            const int* l, int* npts, double* df, int* ier);
void trfind_(const int* nst, const double* p, const int* n, const double* x, const double* y, const double* z,
             const int* list, const int* lptr, const int* lend, double* b1, double* b2, double* b3, int* i1,
             int* i2, int* i3);
int nearnd_(const double* p, const int* ist, const int* n, const double* x, const double* y, const double* z,
            const int* list, const int* lptr, const int* lend, double* al);
}

namespace benchmark {
namespace {

using legacy_stripack::Outcome;
using pstripack::Point;

struct Queries {
  decltype(&getnp_) getnp;
  decltype(&trfind_) trfind;
  decltype(&nearnd_) nearnd;
};

template <class Routine>
Routine* found(const legacy_stripack::Library& library, const char* name) {
  void* const symbol = library.symbol(name);
  if (symbol == nullptr) throw std::runtime_error(fmt::format("the original has no {}", name));
  return reinterpret_cast<Routine*>(symbol);
}

double thread_seconds() { return pstripack::clock_seconds(CLOCK_THREAD_CPUTIME_ID); }

/// Both libraries answer the same questions about the same lists in turn, in a process of their own. The
/// smallest time of each counts.
class Table {
 public:
  Table(const Queries& own, const Queries& theirs, int repeats)
      : own_(own), theirs_(theirs), repeats_(repeats) {}

  /// `ask` makes `calls` calls.
  void row(const std::string& what, std::size_t calls, const std::function<void(const Queries&)>& ask) const {
    constexpr double never = std::numeric_limits<double>::infinity(), time_limit = 600;
    const legacy_stripack::Shared<double> least(2);  // ours, theirs
    least[0] = least[1] = never;
    const auto ended = legacy_stripack::run_in_child(
        [&] {
          for (int k = 0; k < repeats_; ++k)
            for (const bool theirs : {k % 2 == 0, k % 2 != 0}) {
              const double start = thread_seconds();
              ask(theirs ? theirs_ : own_);
              least[theirs] = std::min(least[theirs], thread_seconds() - start);
            }
        },
        time_limit);
    if (ended.outcome != Outcome::returned)
      throw std::runtime_error(what + ": the calls crashed or exceeded their time limit");
    const auto nanoseconds = [&](double seconds) { return 1e9 * seconds / static_cast<double>(calls); };
    fmt::print("{:<38} {:>9.0f} {:>9.0f} {:>9.2f}\n", what, nanoseconds(least[0]), nanoseconds(least[1]),
               least[0] / least[1]);
    std::fflush(stdout);
  }

 private:
  Queries own_, theirs_;
  int repeats_;
};

void next_nearest(const Table& table, const Nodes& nodes, Lists& lists) {
  constexpr int most = 64;
  const auto call = [&](const Queries& q, int l, int* npts) {
    double df;
    int ier;
    q.getnp(nodes.x.data(), nodes.y.data(), nodes.z.data(), lists.list.data(), lists.lptr.data(),
            lists.lend.data(), &l, npts, &df, &ier);
    if (ier != 0) throw std::runtime_error(fmt::format("GETNP returned IER = {}", ier));
  };
  // Nodes are numbered at random, so the first ones lie anywhere.
  const std::size_t centres = static_cast<std::size_t>(std::min(nodes.n(), 10000));
  std::vector<int> near(centres * most);
  for (std::size_t c = 0; c < centres; ++c) {
    near[most * c] = static_cast<int>(c) + 1;
    for (int l = 2; l <= most; ++l) call({getnp_, trfind_, nearnd_}, l, &near[most * c]);
  }
  for (const int l : {2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48, 64})
    table.row(fmt::format("GETNP, L = {}", l), centres, [&](const Queries& q) {
      for (std::size_t c = 0; c < centres; ++c) call(q, l, &near[most * c]);
    });
  for (const int last : {10, 20, 30, 64})
    table.row(fmt::format("GETNP, L = 2..{} of each node", last),
              centres * static_cast<std::size_t>(last - 1), [&](const Queries& q) {
                for (std::size_t c = 0; c < centres; ++c)
                  for (int l = 2; l <= last; ++l) call(q, l, &near[most * c]);
              });
}

void searches(const Table& table, const Nodes& nodes, const Lists& lists) {
  const int n = nodes.n();
  const auto trfind = [&](const Queries& q, int start, const Point& p) {
    const double at[3] = {p.x, p.y, p.z};
    double b1, b2, b3;
    int i1, i2, i3;
    q.trfind(&start, at, &n, nodes.x.data(), nodes.y.data(), nodes.z.data(), lists.list.data(),
             lists.lptr.data(), lists.lend.data(), &b1, &b2, &b3, &i1, &i2, &i3);
    return i1;
  };
  const auto nearnd = [&](const Queries& q, int start, const Point& p) {
    const double at[3] = {p.x, p.y, p.z};
    double al;
    return q.nearnd(at, &start, &n, nodes.x.data(), nodes.y.data(), nodes.z.data(), lists.list.data(),
                    lists.lptr.data(), lists.lend.data(), &al);
  };

  // `many` points at a typical distance from a node, and `few` points anywhere: walks to those take about
  // sqrt(n) steps, so their number is limited to some tenths of a second.
  const std::size_t many = 20000, few = std::min(many, static_cast<std::size_t>(1e6 / std::sqrt(n)));
  const std::vector<Point> anywhere = point_sets::make("random", many, 2);
  std::vector<Point> beside;
  std::vector<int> node;
  for (std::size_t i = 0; i < many; ++i) {
    node.push_back(1 + static_cast<int>((i * 7919) % static_cast<std::size_t>(n)));
    const Point& at = nodes.all[static_cast<std::size_t>(node[i] - 1)];
    const double step = 2 / std::sqrt(n);
    beside.push_back(point_sets::normalized(
        {at.x + step * anywhere[i].x, at.y + step * anywhere[i].y, at.z + step * anywhere[i].z}));
  }
  const auto rows = [&](const std::string& name, const auto& search) {
    table.row(name + ", from a node near by", many, [&](const Queries& q) {
      for (std::size_t i = 0; i < many; ++i) search(q, node[i], beside[i]);
    });
    table.row(name + ", from node 1", few, [&](const Queries& q) {
      for (std::size_t i = 0; i < few; ++i) search(q, 1, anywhere[i]);
    });
    table.row(name + ", from any node", few, [&](const Queries& q) {
      for (std::size_t i = 0; i < few; ++i) search(q, node[i], anywhere[i]);
    });
    table.row(name + ", from the node found last", few, [&](const Queries& q) {
      int start = 1;
      for (std::size_t i = 0; i < few; ++i) start = search(q, start, anywhere[i]);
    });
  };
  rows("TRFIND", trfind);
  rows("NEARND", nearnd);
}

}  // namespace

void run_time_of_queries(int n, const legacy_stripack::Original& original, int repeats) {
  const legacy_stripack::Library& library = original.library();
  if (library.abi().real_bytes == 4) throw std::runtime_error("queries: the original is not REAL*8");
  const Queries own{getnp_, trfind_, nearnd_};
  const Queries theirs{found<decltype(getnp_)>(library, "getnp_"),
                       found<decltype(trfind_)>(library, "trfind_"),
                       found<decltype(nearnd_)>(library, "nearnd_")};
  fmt::print(
      "\nsearches among {} random nodes, in our lists; both in turn, least time of {}\n\n{:<38} "
      "{:>19}\n{:<38} {:>9} {:>9} {:>9}\n",
      n, repeats, "", "nanoseconds a call", "", "ours", "original", "ratio");
  std::fflush(stdout);
  const Nodes nodes(comparison::nodes_in_order("random", static_cast<std::size_t>(n), "given"));
  Lists lists(nodes.n());
  ours().trmesh(nodes, lists);
  const Table table(own, theirs, repeats);
  next_nearest(table, nodes, lists);
  searches(table, nodes, lists);
}

}  // namespace benchmark
