#include "memory_of_lists.h"

#include <fmt/format.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "base/shared_area.h"
#include "contenders.h"
#include "measuring.h"
#include "orders.h"

namespace benchmark {
namespace {

/// Our lists of these nodes. TRMESH keeps memory, so another process calls it.
Lists lists_by_another_process(const Nodes& nodes) {
  Lists lists(nodes.n());
  const std::size_t slots = lists.list.size();
  const auto area = pstripack::SharedArea::create((2 * slots + lists.lend.size()) * sizeof(int));
  if (area.data() == nullptr) throw std::runtime_error("no shared memory");
  int* const shared = static_cast<int*>(area.data());
  measured([&] {
    ours().trmesh(nodes, lists);
    std::copy(lists.list.begin(), lists.list.end(), shared);
    std::copy(lists.lptr.begin(), lists.lptr.end(), shared + slots);
    std::copy(lists.lend.begin(), lists.lend.end(), shared + 2 * slots);
    return 0.0;
  });
  lists.list.assign(shared, shared + slots);
  lists.lptr.assign(shared + slots, shared + 2 * slots);
  lists.lend.assign(shared + 2 * slots, shared + 2 * slots + lists.lend.size());
  lists.lnew = static_cast<int>(slots) + 1;  // the nodes surround the centre
  return lists;
}

}  // namespace

void print_memory_of_lists() {
  const Nodes nodes(nodes_in_order("random", 1000000, "given"));
  const std::size_t triangles = 2 * static_cast<std::size_t>(nodes.n()) - 4;
  Lists lists = lists_by_another_process(nodes);
  const Stripack library = ours();
  const auto trlist = [&] {
    std::vector<int> ltri(9 * triangles);
    return peak_bytes([&] { library.trlist(nodes.n(), lists, 9, ltri); });
  };
  const auto crlist = [&] {
    std::vector<int> listc(3 * triangles);
    std::vector<double> centres(4 * triangles);
    return peak_bytes([&] { library.crlist(nodes, lists, listc, centres); });
  };
  fmt::print(
      "\npeak memory beyond the caller's arrays, bytes a node, {} random nodes\n\n{:<24} {:>7} {:>9} {:>9}\n",
      nodes.n(), "lists", "threads", "TRLIST", "CRLIST");
  const auto bytes_a_node = [&](double bytes) { return fmt::format("{:>9.0f}", bytes / nodes.n()); };
  const auto print_row = [&](const char* kind) {
    fmt::print("{:<24} {:>7} {} {}\n", kind, 1, bytes_a_node(measured(trlist)),
               bytes_a_node(measured(crlist)));
  };
  const std::vector<int> canonical = lists.lend;
  print_row("canonical");
  for (int& last : lists.lend) last = lists.lptr[static_cast<std::size_t>(last) - 1];
  print_row("LEND at other neighbours");
#ifdef _OPENMP
  lists.lend = canonical;  // here, since a forked child has only one thread
  omp_set_num_threads(omp_get_num_procs());
  fmt::print("{:<24} {:>7} {}\n", "canonical", omp_get_num_procs(), bytes_a_node(trlist()));
#endif
  std::fflush(stdout);
}

}  // namespace benchmark
