#include "probe.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>

#include "child_process.h"
#include "original.h"

namespace legacy_stripack {
namespace {

constexpr int kNodes = 6, kSlots = 24;
constexpr double kCoordinate[3][kNodes] = {{1, 0, 0, -1, 0, 0}, {0, 1, 0, 0, -1, 0}, {0, 0, 1, 0, 0, -1}};
constexpr std::size_t kRoom = 1024;  // entries of every array
constexpr int kUnwritten = 0x55;     // every byte of the integers

/// An array of 4-byte or 8-byte integers or reals.
struct Array {
  std::int64_t words[kRoom];

  template <class T>
  T get(std::size_t i) const {
    T value;
    std::memcpy(&value, reinterpret_cast<const char*>(words) + i * sizeof value, sizeof value);
    return value;
  }
  template <class T>
  void set(std::size_t i, T value) {
    std::memcpy(reinterpret_cast<char*>(words) + i * sizeof value, &value, sizeof value);
  }
};

/// Arguments in the order of the 12-argument TRMESH, in memory shared by child and parent. The eighth
/// argument is LNEW of this TRMESH and IER of the 8-argument one, which ignores the rest.
struct Arguments {
  std::int64_t n;  // read as 4 bytes or as 8
  Array coordinates[3], list, lptr, lend, eighth, near, next, dist, twelfth;
};
using Trmesh = void(const void* n, const void* x, const void* y, const void* z, void* list, void* lptr,
                    void* lend, void* eighth, void* near, void* next, void* dist, void* twelfth);

/// True if every node has four different neighbours, none of them its opposite.
template <class Int>
bool is_octahedron(const Arguments& a) {
  const auto is_slot = [](Int slot) { return 1 <= slot && slot <= kSlots; };
  for (int k = 1; k <= kNodes; ++k) {
    std::set<Int> neighbours;
    const Int last = a.lend.get<Int>(static_cast<std::size_t>(k - 1));
    Int slot = last;
    for (int i = 0; i < 4; ++i) {
      if (!is_slot(slot)) return false;
      neighbours.insert(a.list.get<Int>(static_cast<std::size_t>(slot - 1)));
      slot = a.lptr.get<Int>(static_cast<std::size_t>(slot - 1));
    }
    std::set<Int> expected;
    for (int other = 1; other <= kNodes; ++other)
      if (other % 3 != k % 3) expected.insert(other);
    if (slot != last || neighbours != expected) return false;
  }
  return true;
}

/// The ABI in which the arguments after the call are a correct result.
template <class Int>
std::optional<Abi> abi_of_answer(const Arguments& a, int real_bytes) {
  if (!is_octahedron<Int>(a)) return std::nullopt;
  if (a.twelfth.get<Int>(0) == 0) return Abi{real_bytes, sizeof(Int), 12};
  if (a.eighth.get<Int>(0) == 0) return Abi{real_bytes, sizeof(Int), 8};
  return std::nullopt;
}

/// Detects the ABI with reals of this size; if it finds none, adds the outcome to `why_not`.
std::optional<Abi> answer(const Library& library, int real_bytes, double time_limit, std::string& why_not) {
  const Shared<Arguments> shared;
  Arguments& a = *shared.data();
  a.n = kNodes;
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double value = kCoordinate[axis][i];
      real_bytes == 4 ? a.coordinates[axis].set(i, static_cast<float>(value))
                      : a.coordinates[axis].set(i, value);
    }
  for (Array* array : {&a.eighth, &a.twelfth}) std::memset(array, kUnwritten, sizeof *array);
  const auto trmesh = reinterpret_cast<Trmesh*>(library.trmesh_address());
  const Ended ended = run_in_child(
      [&] {
        const int nowhere = open("/dev/null", O_WRONLY);
        for (const int file : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, file);
        trmesh(&a.n, &a.coordinates[0], &a.coordinates[1], &a.coordinates[2], &a.list, &a.lptr, &a.lend,
               &a.eighth, &a.near, &a.next, &a.dist, &a.twelfth);
      },
      time_limit);
  const bool has_returned = ended.outcome == Outcome::returned;
  if (has_returned) {
    if (const auto abi = abi_of_answer<std::int32_t>(a, real_bytes)) return abi;
    if (const auto abi = abi_of_answer<std::int64_t>(a, real_bytes)) return abi;
  }
  Triangulation call;
  call.outcome = ended.outcome;
  call.signal = ended.signal;
  why_not += (why_not.empty() ? "with REAL*" : "; with REAL*") + std::to_string(real_bytes) + " it " +
             describe(call, time_limit) + (has_returned ? " other lists" : "");
  return std::nullopt;
}

}  // namespace

Probe probe_abi(const Library& library, int first_real_bytes, double time_limit) {
  Probe probe;
  for (const int real_bytes : {first_real_bytes, 12 - first_real_bytes}) {
    probe.abi = answer(library, real_bytes, time_limit, probe.why_not);
    if (probe.abi) break;
  }
  return probe;
}

}  // namespace legacy_stripack
