#pragma once
// Calls of TRMESH that PSTRIPACK_CHECK has recorded (docs/recorded-calls.md), one after another.

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
  std::vector<pstripack::Point> points;  ///< empty if TRMESH refuses n without reading them
  bool has_returned = false;             ///< false: the rest is not recorded
  std::size_t nodes = 0;                 ///< number of nodes in the lists
  OurRun run;
};

/// The recorded calls in the order in which they returned, then those that did not. Keeps only unfinished
/// calls in memory. Every error is a std::runtime_error that names the file, the byte and what was expected.
class CallReader {
 public:
  explicit CallReader(const std::string& file);  ///< `-`: stdin
  std::optional<Call> next();

  static bool looks_like_recording(const std::string& file);  ///< or is empty, or cannot be read

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
  std::uint64_t offset_ = 0, block_ = 0;  ///< bytes read; begin of the current block
  std::map<std::pair<std::uint64_t, std::int64_t>, Call> under_way_;
};

}  // namespace comparison
