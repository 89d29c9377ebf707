#pragma once
// Calls of TRMESH recorded by PSTRIPACK_CHECK (man page stripack-compare(1), RECORDINGS).

#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "our_checks.h"

namespace pstripack {
struct BlockHeader;
}

namespace comparison {

struct Call {
  std::uint64_t process = 0;
  std::int64_t process_id = 0, number = 0, n = 0;
  std::size_t real_bytes = 8;
  std::vector<pstripack::Point> points;  ///< empty: TRMESH refused n without reading them
  bool has_returned = false;             ///< false: the members below are not recorded
  std::size_t nodes = 0;                 ///< number of nodes in the lists
  OurRun run;
};

/// Yields the recorded calls in the order in which they returned, then those that did not return. Only
/// unfinished calls are kept in memory. Errors are std::runtime_error with file, byte and what was expected.
class CallReader {
 public:
  explicit CallReader(const std::string& file);  ///< `-`: stdin
  std::optional<Call> next();

  static bool looks_like_recording(
      const std::string& file);  ///< true if the file is a recording, empty or unreadable

 private:
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdin) std::fclose(file);
    }
  };
  using Bytes = std::vector<char>;

  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const;
  std::size_t read(void* to, std::size_t size);
  std::optional<pstripack::BlockHeader> read_header();
  Bytes read_body(const pstripack::BlockHeader& header, std::uint64_t expected);
  void begin(const pstripack::BlockHeader& header);
  Call end(const pstripack::BlockHeader& header);

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t offset_ = 0, block_ = 0;  ///< bytes read so far; offset of the current block
  std::map<std::pair<std::uint64_t, std::int64_t>, Call> under_way_;
};

}  // namespace comparison
