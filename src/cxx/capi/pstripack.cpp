// The C API: sets the default floating-point environment and turns exceptions into codes.

#include "capi/pstripack.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "base/floating_point.h"
#include "base/system.h"
#include "base/workspace.h"
#include "capi/hooks.h"
#include "capi/version.h"
#include "geometry/node_arrays.h"
#include "lists/adjacency_lists.h"
#include "lists/limits.h"
#include "mesh/delaunay.h"
#include "observe/check.h"
#include "observe/report.h"
#include "stripack/original/original_rules.h"
#include "trmesh/trmesh.h"
#ifdef PSTRIPACK_WITH_POOL
#include "pool/client.h"
#endif

namespace {

using namespace pstripack;

#ifndef PSTRIPACK_WITH_POOL
Engine* pool_engine() noexcept { return nullptr; }
#endif
std::atomic<Engine*> communicator{nullptr};

TrmeshResult carry_out(const TrmeshCall& call, CallReport* report) noexcept {
  try {
    return trmesh(call, report, communicator.load(std::memory_order_acquire), pool_engine());
  } catch (...) {
    return {PSTRIPACK_OUT_OF_MEMORY};  // only std::bad_alloc is possible, before anything is written
  }
}

/// The same, with a line in the report. Not inlined, so that a call without a report does not pay for it.
[[gnu::noinline]] TrmeshResult carry_out_and_report(const TrmeshCall& call) noexcept {
  const auto& [list, lptr, lend, lnew] = call.lists;
  CallReport report;
  const double start = clock_seconds(CLOCK_MONOTONIC);
  const TrmeshResult result = carry_out(call, &report);
  if (result.is_silent) return result;
  if (report.mode == CallWay::on_threads) report.cost = GroupCost(report.cost.maximum);
  report.seconds = clock_seconds(CLOCK_MONOTONIC) - start;
  report.n = call.n;
  report.ier = result.ier;
  report.order = result.order;
  report.order_node = result.order_node;
  if (result.ier >= 0) report.nodes_in_mesh = result.ier > 0 ? result.other - 1 : call.n;
  for (std::int64_t k = 0; k < report.nodes_in_mesh; ++k) report.boundary_nodes += list[lend[k] - 1] < 0;
  if (call.n >= 3 && result.ier != PSTRIPACK_TOO_MANY_NODES) {
    report.shortest = std::numeric_limits<double>::infinity(), report.longest = 0;
    for (std::int32_t k = 0; k < call.n; ++k) {
      const Point p = call.nodes[static_cast<std::size_t>(k)];
      const double length = std::hypot(p.x, p.y, p.z);
      report.shortest = std::fmin(report.shortest, length);
      report.longest = std::fmax(report.longest, length);
    }
  }
  if (result.order == OriginalOrder::inexact) {
    try {
      const auto nodes = static_cast<std::size_t>(report.nodes_in_mesh);
      report.difference =
          exact_difference(call.nodes, ListsView<std::int32_t>{nodes, list, lptr, lend, *lnew});
    } catch (...) {
      // Only std::bad_alloc is possible. The report then says that nothing was compared.
    }
  }
  add_to_report(report);
  return result;
}

/// What a call without memory needs, and the number of nodes that there is memory for.
std::string what_fits(std::int64_t nodes) {
  const double needed = static_cast<double>(workspace_bytes(1)) * static_cast<double>(nodes),
               available = static_cast<double>(available_memory());
  if (needed < available) return "";
  char text[200];
  std::snprintf(text, sizeof text,
                ": %.1f GB are needed beside the arrays of the call, %.1f GB are free: enough for %.0f nodes",
                needed * 1e-9, available * 1e-9, std::floor(available / needed * static_cast<double>(nodes)));
  return text;
}

/// TRMESH with its report, its recording and its messages. `nodes` is clamped to 32 bits: all numbers
/// beyond give the same code.
TrmeshResult trmesh_with_messages(std::int64_t nodes, const NodeArrays& arrays, const ListArrays& lists,
                                  bool by_direction = false) noexcept {
  using Limits = std::numeric_limits<std::int32_t>;
  const TrmeshCall call{
      static_cast<std::int32_t>(std::clamp<std::int64_t>(nodes, Limits::min(), Limits::max())), arrays, lists,
      by_direction};
  const auto work = [&] {
    return report_is_wanted() ? carry_out_and_report(call) : carry_out(call, nullptr);
  };
  TrmeshResult result;
  if (Check* const check = check_of_calls(); check == nullptr) {
    result = work();
  } else {
    const CheckedCall checked = check_input(*check, call);
    result = work();
    check_output(*check, checked, result, lists);
  }
  if (result.is_silent) return result;
  // STRIPACK's own codes are silent; codes that STRIPACK does not have print a line.
  if (result.ier == PSTRIPACK_BAD_COORDINATE) {
    const Point p = arrays[static_cast<std::size_t>(result.node) - 1];
    std::fprintf(stderr, "pstripack: trmesh: node %lld of %lld is (%g, %g, %g): %s (IER = -5)\n",
                 static_cast<long long>(result.node), static_cast<long long>(nodes), p.x, p.y, p.z,
                 pstripack_strerror(result.ier));
  } else if (result.ier == PSTRIPACK_RANKS_DISAGREE) {
    const auto n = static_cast<long long>(nodes), n_there = static_cast<long long>(result.node),
               rank = static_cast<long long>(result.other);
    if (n != n_there)
      std::fprintf(stderr, "pstripack: trmesh: N is %lld on rank 0 and %lld on rank %lld (IER = -7)\n", n,
                   n_there, rank);
    else
      std::fprintf(stderr,
                   "pstripack: trmesh: the coordinates of %lld nodes on rank %lld are not those on rank 0 "
                   "(IER = -7)\n",
                   n, rank);
  } else if (result.ier < PSTRIPACK_COLLINEAR) {
    std::fprintf(stderr, "pstripack: trmesh: %lld nodes: %s%s (IER = %d)\n", static_cast<long long>(nodes),
                 pstripack_strerror(result.ier),
                 result.ier == PSTRIPACK_OUT_OF_MEMORY ? what_fits(nodes).c_str() : "",
                 static_cast<int>(result.ier));
  }
  return result;
}

template <class Real>
TrmeshResult trmesh_call(std::int64_t n, const Real* x, const Real* y, const Real* z, std::int32_t* list,
                         std::int32_t* lptr, std::int32_t* lend, std::int32_t* lnew) noexcept {
  return in_default_floating_point([&] {
    return trmesh_with_messages(n, {x, y, z}, {list, lptr, lend, lnew});
  });
}

/// `array` begins with `count` integers of 32 bits; widens them in place to 64 bits.
///
///   bytes      0   4   8   12  16  20  24
///   narrow     |n0 |n1 |n2 |
///   wide       |  w0   |  w1   |  w2   |      from the last to the first, which overwrites only what is read
void widen(std::int64_t* array, std::int64_t count) noexcept {
  auto* const bytes = reinterpret_cast<unsigned char*>(array);
  for (std::int64_t i = count - 1; i >= 0; --i) {
    std::int32_t narrow;
    std::memcpy(&narrow, bytes + i * std::int64_t{sizeof narrow}, sizeof narrow);
    const std::int64_t wide = narrow;
    std::memcpy(bytes + i * std::int64_t{sizeof wide}, &wide, sizeof wide);
  }
}

}  // namespace

extern "C" {

void pstripack_set_trmesh_engine(Engine* engine) { communicator.store(engine, std::memory_order_release); }

int pstripack_report_is_wanted(void) { return report_is_wanted(); }
void pstripack_add_to_report(const CallReport* call) { add_to_report(*call); }
void pstripack_leave_check_to_another_rank(int leave) { leave_check_to_another_rank(leave != 0); }

void pstripack_release_memory(void) { free_cached_blocks(); }

const char* pstripack_version(void) { return PSTRIPACK_VERSION; }

const char* pstripack_strerror(int ier) {
  if (ier > 0) return "this node coincides with a later one";
  switch (ier) {
#define PSTRIPACK_CODE(name, value, meaning) \
  case name:                                 \
    return meaning;
    PSTRIPACK_CODES(PSTRIPACK_CODE)
#undef PSTRIPACK_CODE
  }
  return "unknown code";
}

int32_t pstripack_trmesh(int32_t n, const double* x, const double* y, const double* z, int32_t* list,
                         int32_t* lptr, int32_t* lend, int32_t* lnew) {
  return trmesh_call(n, x, y, z, list, lptr, lend, lnew).ier;
}

int32_t pstripack_delaunay(int32_t n, const double* x, const double* y, const double* z, int32_t* list,
                           int32_t* lptr, int32_t* lend, int32_t* lnew) {
  return in_default_floating_point([&] {
    return trmesh_with_messages(n, {x, y, z}, {list, lptr, lend, lnew}, true).ier;
  });
}

int32_t pstripack_trmesh_r4(int32_t n, const float* x, const float* y, const float* z, int32_t* list,
                            int32_t* lptr, int32_t* lend, int32_t* lnew) {
  return trmesh_call(n, x, y, z, list, lptr, lend, lnew).ier;
}

int64_t pstripack_trmesh_i8(int64_t n, const double* x, const double* y, const double* z, int64_t* list,
                            int64_t* lptr, int64_t* lend, int64_t* lnew) {
  int32_t narrow_lnew = 0;
  const TrmeshResult result =
      trmesh_call(n, x, y, z, reinterpret_cast<int32_t*>(list), reinterpret_cast<int32_t*>(lptr),
                  reinterpret_cast<int32_t*>(lend), &narrow_lnew);
  if (result.ier < 0) return result.ier;
  widen(list, narrow_lnew - 1);
  widen(lptr, narrow_lnew - 1);
  widen(lend, result.ier > 0 ? result.other - 1 : n);
  *lnew = narrow_lnew;
  return result.ier;
}

int32_t pstripack_validate(int32_t n, const double* x, const double* y, const double* z, const int32_t* list,
                           const int32_t* lptr, const int32_t* lend, int32_t lnew, char* message,
                           int32_t length) {
  const auto say = [&](const char* text) {
    if (message != nullptr && length > 0)
      std::snprintf(message, static_cast<std::size_t>(length), "%s", text);
  };
  try {
    if (const std::int32_t code = code_of_count(n); code != PSTRIPACK_OK) {
      say(pstripack_strerror(code));
      return code;
    }
    std::vector<Point> p(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = {x[i], y[i], z[i]};
    const ListsView<std::int32_t> lists{p.size(), list, lptr, lend, lnew};
    const Verdict verdict = in_default_floating_point([&] {
      const Verdict as_trmesh = is_valid(p.data(), lists);
      if (as_trmesh || as_trmesh.lengths == Lengths::directions) return as_trmesh;
      const Verdict by_direction = is_valid(p.data(), lists, Lengths::directions);
      return by_direction ? by_direction : as_trmesh;
    });
    say(verdict.message.c_str());
    return static_cast<std::int32_t>(verdict.defect);
  } catch (...) {
    say(pstripack_strerror(PSTRIPACK_OUT_OF_MEMORY));
    return PSTRIPACK_OUT_OF_MEMORY;
  }
}

uint64_t pstripack_fingerprint(int32_t n, const int32_t* list, const int32_t* lptr, const int32_t* lend) {
  try {
    if (n > most_nodes<std::int32_t>()) return 0;
    const ListsView<std::int32_t> lists{static_cast<std::size_t>(n < 0 ? 0 : n), list, lptr, lend, 0};
    return check_lists(lists) ? fingerprint(triangles_of(lists)) : 0;
  } catch (...) {
    return 0;
  }
}

}  // extern "C"
