#include "probe.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>

#include "child_process.h"

namespace legacy_stripack {
namespace {

constexpr int kNodes = 6, kSlots = 24;
constexpr double kCoordinate[3][kNodes] = {{1, 0, 0, -1, 0, 0}, {0, 1, 0, 0, -1, 0}, {0, 0, 1, 0, 0, -1}};
constexpr double kTimeLimit = 2;
constexpr int kUnwritten = -987654321;
constexpr std::size_t kRoom = 1024;  // entries of every array

/// Arguments in the order of the 12-argument TRMESH, in memory that child and parent share. The eighth is
/// LNEW there and IER of the 8-argument one, which takes no notice of the rest.
struct Arguments {
  std::int64_t n;  // read as 4 bytes or as 8
  double coordinates[3][kRoom];
  int list[kRoom], lptr[kRoom], lend[kRoom], eighth[kRoom], near[kRoom], next[kRoom];
  double dist[kRoom];
  int twelfth[kRoom];
};
using Trmesh = void(const void* n, const void* x, const void* y, const void* z, int* list, int* lptr,
                    int* lend, int* eighth, int* near, int* next, void* dist, int* twelfth);

/// Every node has four different neighbours, and they are not the opposite one.
bool is_octahedron(const Arguments& a) {
  const auto is_slot = [](int slot) { return 1 <= slot && slot <= kSlots; };
  for (int k = 1; k <= kNodes; ++k) {
    std::set<int> neighbours;
    int slot = a.lend[k - 1];
    for (int i = 0; i < 4; ++i) {
      if (!is_slot(slot)) return false;
      neighbours.insert(a.list[slot - 1]);
      slot = a.lptr[slot - 1];
    }
    std::set<int> expected;
    for (int other = 1; other <= kNodes; ++other)
      if (other % 3 != k % 3) expected.insert(other);
    if (slot != a.lend[k - 1] || neighbours != expected) return false;
  }
  return true;
}

template <class Real>
void write_coordinates(Arguments& a) {
  for (int axis = 0; axis < 3; ++axis)
    std::copy_n(kCoordinate[axis], kNodes, reinterpret_cast<Real*>(a.coordinates[axis]));
}

/// The ABI that answers to coordinates of this kind.
std::optional<Abi> answer(const Library& library, bool single_precision) {
  const Shared<Arguments> shared;
  Arguments& a = *shared.data();
  a.n = kNodes;
  single_precision ? write_coordinates<float>(a) : write_coordinates<double>(a);
  a.eighth[0] = a.twelfth[0] = kUnwritten;
  const auto trmesh = reinterpret_cast<Trmesh*>(library.trmesh_address());
  const Ended ended = run_in_child(
      [&] {
        trmesh(&a.n, a.coordinates[0], a.coordinates[1], a.coordinates[2], a.list, a.lptr, a.lend, a.eighth,
               a.near, a.next, a.dist, a.twelfth);
      },
      kTimeLimit);
  if (ended.outcome != Outcome::returned || !is_octahedron(a)) return std::nullopt;
  if (a.twelfth[0] == 0) return single_precision ? Abi::r4 : Abi::r8;
  if (a.eighth[0] == 0 && !single_precision) return Abi::args8;
  return std::nullopt;
}

}  // namespace

std::optional<Abi> abi_shown_by(const Library& library) {
  const bool single_precision = library.abi() == Abi::r4;
  if (const auto abi = answer(library, single_precision)) return abi;
  return answer(library, !single_precision);
}

void refuse_other_abi(const Library& library) {
  const auto shown = abi_shown_by(library);
  if (!shown || *shown == library.abi()) return;
  const char* const looks_like = *shown == Abi::r8   ? "REAL*8 with 12 arguments"
                                 : *shown == Abi::r4 ? "REAL*4 with 12 arguments"
                                                     : "REAL*8 with 8 arguments";
  throw std::runtime_error(library.file() + ": its TRMESH looks like " + looks_like + ", which is ABI " +
                           name_of(*shown) + ", not " + name_of(library.abi()));
}

}  // namespace legacy_stripack
