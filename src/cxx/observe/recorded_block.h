#pragma once
// The format of calls of TRMESH that PSTRIPACK_CHECK writes: a stream of blocks, each with this header and a
// body. The man page stripack-compare(1) describes it for programs that read it.

#include <cstdint>

namespace pstripack {

/// Without padding, in the byte order of the machine that wrote it.
struct BlockHeader {
  static constexpr char kMagic[8] = {'P', 'S', 'T', 'R', 'I', 'R', 'E', 'C'};
  static constexpr std::uint32_t kByteOrder = 0x01020304;
  static constexpr std::uint32_t kVersion = 1;
  enum Kind : std::uint32_t {
    input = 1,   ///< body: x(1..n), y(1..n), z(1..n); empty if n < 3 or n is too large
    output = 2,  ///< body: list(1..lnew-1), lptr(1..lnew-1), lend(1..nodes); empty if ier < 0
  };
  /// TRMESH under each value of PSTRIPACK_ORDER, then pstripack_delaunay.
  enum Routine : std::uint32_t { trmesh = 1, original, bitwise, ngmath, bitwise_ngmath, delaunay };

  char magic[8] = {};
  std::uint32_t byte_order = kByteOrder;
  std::uint32_t version = kVersion;
  std::uint32_t kind = 0;
  std::uint32_t routine = trmesh;
  std::uint32_t real_bytes = 0;     ///< of x, y, z
  std::uint32_t integer_bytes = 0;  ///< of list, lptr, lend
  std::uint64_t process = 0;        ///< a hash of its id and the time, because process ids are reused
  std::int64_t process_id = 0;
  std::int64_t call = 0;  ///< from 1 in each process; an output belongs to the input of its process and call
  std::int64_t n = 0;
  std::int64_t nodes = 0;        ///< output: number of nodes in the lists, fewer than n if ier > 0; input: 0
  std::int64_t ier = 0;          ///< output
  std::int64_t lnew = 0;         ///< output; 0 if there are no lists
  std::int64_t nanoseconds = 0;  ///< output: duration of the call
  std::int64_t body_bytes = 0;   ///< length of the body
};
static_assert(sizeof(BlockHeader) == 104);

}  // namespace pstripack
