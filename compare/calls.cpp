#include "calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <type_traits>

#include "lists/limits.h"
#include "observe/recorded_block.h"

namespace comparison {
namespace {

using pstripack::BlockHeader;
using pstripack::Point;

constexpr std::int64_t kMostNodes = pstripack::most_nodes<std::int32_t>();
constexpr const char* kOrders[] = {"canonical", "original",       "bitwise",
                                   "ngmath",    "bitwise-ngmath", "delaunay"};

template <class Real>
std::vector<Point> points_of(const std::vector<char>& body) {
  const std::size_t n = body.size() / (3 * sizeof(Real));
  std::vector<Real> values(3 * n);
  std::copy(body.begin(), body.end(), reinterpret_cast<char*>(values.data()));
  std::vector<Point> points(n);
  for (std::size_t i = 0; i < n; ++i) points[i] = {values[i], values[n + i], values[2 * n + i]};
  return points;
}

}  // namespace

CallReader::CallReader(const std::string& file)
    : name_(file == "-" ? "stdin" : file), file_(file == "-" ? stdin : std::fopen(file.c_str(), "rb")) {
  if (!file_) throw std::runtime_error(fmt::format("cannot read {}: {}", file, std::strerror(errno)));
  // Unbuffered: both processes share the position in the file. An original that ends its child process by
  // exit() would reset it to what this process has taken out of its buffer.
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
}

bool CallReader::looks_like_recording(const std::string& file) {
  char magic[sizeof BlockHeader::kMagic] = {};
  std::ifstream in(file, std::ios::binary);
  return !in.read(magic, 1) ||
         (in.read(magic + 1, sizeof magic - 1), std::memcmp(magic, BlockHeader::kMagic, sizeof magic) == 0);
}

std::optional<Call> CallReader::next() {
  while (const auto header = read_header()) {
    if (header->kind == BlockHeader::output) return end(*header);
    begin(*header);
  }
  if (under_way_.empty()) return std::nullopt;
  return std::move(under_way_.extract(under_way_.begin()).mapped());
}

void CallReader::fail(std::uint64_t at, const std::string& what) const {
  throw std::runtime_error(fmt::format("{}, byte {}: {}", name_, at, what));
}

std::size_t CallReader::read(void* to, std::size_t size) {
  const std::size_t done = std::fread(to, 1, size, file_.get());
  if (std::ferror(file_.get()) != 0)
    throw std::runtime_error(fmt::format("cannot read {}: {}", name_, std::strerror(errno)));
  offset_ += done;
  return done;
}

std::optional<BlockHeader> CallReader::read_header() {
  BlockHeader header;
  block_ = offset_;
  const std::size_t size = read(&header, sizeof header);
  if (size == 0) return std::nullopt;
  const std::size_t magic = sizeof header.magic;
  if (std::memcmp(header.magic, BlockHeader::kMagic, std::min(size, magic)) != 0)
    fail(block_, "expected a block of a recorded call, which begins with PSTRIREC");
  if (size < sizeof header)
    fail(offset_, fmt::format("the file ends within the {} bytes of a block's header", sizeof header));
  const auto expect = [&](bool holds, const auto& field, const std::string& what) {
    const auto at = reinterpret_cast<const char*>(&field) - reinterpret_cast<const char*>(&header);
    if (!holds)
      fail(block_ + static_cast<std::uint64_t>(at), fmt::format("expected {}, found {}", what, field));
  };
  if (header.byte_order == __builtin_bswap32(BlockHeader::kByteOrder))
    fail(block_ + magic, "written on a machine of the other byte order");
  expect(header.byte_order == BlockHeader::kByteOrder, header.byte_order,
         fmt::format("the byte order mark {}", BlockHeader::kByteOrder));
  expect(header.version == BlockHeader::kVersion, header.version,
         fmt::format("version {}", BlockHeader::kVersion));
  expect(header.kind == BlockHeader::input || header.kind == BlockHeader::output, header.kind,
         "1 (input) or 2 (output)");
  expect(BlockHeader::trmesh <= header.routine && header.routine <= BlockHeader::delaunay, header.routine,
         "1 to 6 (TRMESH in some order, pstripack_delaunay)");
  expect(header.real_bytes == 4 || header.real_bytes == 8, header.real_bytes, "reals of 4 or 8 bytes");
  expect(header.integer_bytes == 4, header.integer_bytes, "integers of 4 bytes");
  return header;
}

/// Checks the length before allocating that much memory.
CallReader::Bytes CallReader::read_body(const BlockHeader& header, std::uint64_t expected) {
  if (header.body_bytes < 0 || static_cast<std::uint64_t>(header.body_bytes) != expected)
    fail(block_ + offsetof(BlockHeader, body_bytes),
         fmt::format("expected a body of {} bytes, found {}", expected, header.body_bytes));
  constexpr std::size_t kPiece = std::size_t{1} << 24;
  Bytes body;
  while (body.size() < expected) {
    const std::size_t done = body.size(), piece = std::min<std::size_t>(kPiece, expected - done);
    body.resize(done + piece);
    if (read(body.data() + done, piece) < piece)
      fail(offset_, fmt::format("the file ends within the {} bytes of a block's body", expected));
  }
  return body;
}

void CallReader::begin(const BlockHeader& header) {
  Call call;
  call.process = header.process;
  call.process_id = header.process_id;
  call.number = header.call;
  call.n = header.n;
  call.real_bytes = header.real_bytes;
  call.run.abi = header.real_bytes == 4 ? "r4" : "r8";
  call.run.order = kOrders[header.routine - BlockHeader::trmesh];
  const bool has_points = 3 <= header.n && header.n <= kMostNodes;
  const Bytes body =
      read_body(header, has_points ? 3 * static_cast<std::uint64_t>(header.n) * header.real_bytes : 0);
  call.points = header.real_bytes == 4 ? points_of<float>(body) : points_of<double>(body);
  if (!under_way_.emplace(std::pair(header.process, header.call), std::move(call)).second)
    fail(block_, fmt::format("call {} of process {} begins a second time", header.call, header.process_id));
}

Call CallReader::end(const BlockHeader& header) {
  auto found = under_way_.extract({header.process, header.call});
  if (!found)
    fail(block_, fmt::format("call {} of process {}: the file has its result, not its beginning", header.call,
                             header.process_id));
  Call call = std::move(found.mapped());
  const auto expect = [&](bool holds, std::size_t at, const std::string& what) {
    if (!holds) fail(block_ + at, "expected " + what);
  };
  const std::int64_t n = call.n, most_slots = call.points.empty() ? 0 : 6 * n - 12;
  expect(header.n == n, offsetof(BlockHeader, n), fmt::format("n = {} as in the input", n));
  expect(0 <= header.nodes && header.nodes <= (most_slots == 0 ? 0 : n), offsetof(BlockHeader, nodes),
         "at most n nodes in the lists");
  expect(0 <= header.lnew && header.lnew <= most_slots + 1, offsetof(BlockHeader, lnew),
         "LNEW at most 6n-11");
  const std::size_t slots = header.lnew == 0 ? 0 : static_cast<std::size_t>(header.lnew) - 1;
  call.nodes = static_cast<std::size_t>(header.nodes);
  const Bytes body = read_body(header, (2 * slots + call.nodes) * sizeof(std::int32_t));

  call.has_returned = true;
  call.run.ier = static_cast<int>(header.ier);
  call.run.seconds = 1e-9 * static_cast<double>(header.nanoseconds);
  Lists& lists = call.run.lists;
  const char* from = body.data();
  const auto take = [&from](std::vector<std::int32_t>& entries, std::size_t size, std::size_t count) {
    entries.assign(size, kUntouched);
    const std::size_t bytes = count * sizeof(std::int32_t);
    std::copy_n(from, bytes, reinterpret_cast<char*>(entries.data()));
    from += bytes;
  };
  take(lists.list, static_cast<std::size_t>(most_slots), slots);
  take(lists.lptr, static_cast<std::size_t>(most_slots), slots);
  take(lists.lend, call.points.size(), call.nodes);
  lists.lnew = header.ier < 0 ? kUntouched : static_cast<std::int32_t>(header.lnew);
  return call;
}

}  // namespace comparison
