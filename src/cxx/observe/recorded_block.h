#pragma once
// How PSTRIPACK_CHECK writes calls of TRMESH: a stream of blocks, each this header and a body. docs/
// recorded-calls.md is the description for programs that read it.

#include <cstdint>

namespace pstripack {

/// Little or big endian as the machine that wrote it, without padding.
struct BlockHeader {
  static constexpr char kMagic[8] = {'P', 'S', 'T', 'R', 'I', 'R', 'E', 'C'};
  static constexpr std::uint32_t kByteOrder = 0x01020304;
  static constexpr std::uint32_t kVersion = 1;
  enum Kind : std::uint32_t {
    input = 1,   ///< body: x(1..n), y(1..n), z(1..n); nothing where n < 3 or n is too large
    output = 2,  ///< body: list(1..lnew-1), lptr(1..lnew-1), lend(1..nodes); nothing where ier < 0
  };
  enum Routine : std::uint32_t { trmesh = 1 };

  char magic[8] = {};
  std::uint32_t byte_order = kByteOrder;
  std::uint32_t version = kVersion;
  std::uint32_t kind = 0;
  std::uint32_t routine = trmesh;
  std::uint32_t real_bytes = 0;     ///< of x, y, z
  std::uint32_t integer_bytes = 0;  ///< of list, lptr, lend
  std::uint64_t process = 0;        ///< a random number: process ids come again
  std::int64_t process_id = 0;
  std::int64_t call = 0;  ///< from 1 in each process; an output belongs to the input of its process and call
  std::int64_t n = 0;
  std::int64_t nodes = 0;        ///< output: those in the lists, fewer than n where ier > 0, else 0
  std::int64_t ier = 0;          ///< output
  std::int64_t lnew = 0;         ///< output; 0 where there are no lists
  std::int64_t nanoseconds = 0;  ///< output: of the call
  std::int64_t body_bytes = 0;   ///< what follows
};
static_assert(sizeof(BlockHeader) == 104);

}  // namespace pstripack
