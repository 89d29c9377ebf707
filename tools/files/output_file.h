#pragma once
// Output files that appear complete or not at all.

#include <fmt/format.h>
#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

namespace files {

/// Writes a temporary file beside the final one; commit() renames it. Without commit(), or after SIGHUP,
/// SIGINT, SIGPIPE, SIGQUIT, SIGTERM or SIGXCPU, nothing remains. After SIGKILL the temporary file remains.
/// An existing file is replaced unless its permissions forbid to write it, also root, and the new one gets
/// them. `-` is stdout: commit() copies to it, by whatever name, and to devices, pipes and open files without
/// a name. At most two objects may exist at a time. Throws std::runtime_error "NAME: cannot be written: why".
class OutputFile {
 public:
  explicit OutputFile(const std::string& name);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return temporary_; }  ///< where to write before commit()
  const std::string& name() const { return name_; }       ///< for messages
  bool has_a_name() const { return !copies_; }  ///< not stdout, a device or a pipe: others can lie beside it
  /// Buffered text output, for those who do not write to path().
  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(fmt::appender(text_), format, std::forward<Values>(values)...);
    if (text_.size() > std::size_t{1} << 20) flush();
  }
  void write(const void* bytes, std::size_t size);  ///< before all text
  void commit();

 private:
  void flush();
  void copy_to_target() const;
  void set_permissions() const;
  [[noreturn]] void fail(int error) const;
  std::string name_, target_, temporary_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> out_;  ///< the temporary file
  fmt::memory_buffer text_;                              ///< not yet written to it
  bool copies_;                ///< the target is a device, pipe or stdout: commit() copies
  char* to_remove_ = nullptr;  ///< the signal handlers' copy of temporary_
};

/// Removes the temporary files that OutputFiles of this process have. Signal handlers may call it.
void remove_unfinished_output();

}  // namespace files
