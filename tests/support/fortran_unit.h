#pragma once
// Captures as text what Fortran routines write, to a unit or to standard output.

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "support/text.h"

extern "C" {
int open_unit(int unit, const char* path, int path_length, const char* access, int access_length);
void close_unit(int unit);
void flush_standard_output();
}

class TemporaryFile {
 public:
  TemporaryFile() : file_(mkstemp(path_)) {
    if (file_ < 0) throw std::runtime_error("mkstemp");
  }
  ~TemporaryFile() {
    close(file_);
    unlink(path_);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path() const { return path_; }
  int descriptor() const { return file_; }
  std::string text() const { return contents(path_); }

 private:
  char path_[32] = "/tmp/pstripack_test_XXXXXX";
  int file_;
};

/// A Fortran unit while this object lives. access: "write", "read", "unformatted".
class FortranUnit {
 public:
  FortranUnit(int unit, const std::string& path, const std::string& access = "write") : unit_(unit) {
    if (open_unit(unit, path.data(), static_cast<int>(path.size()), access.data(),
                  static_cast<int>(access.size())) != 0)
      throw std::runtime_error("cannot open " + path);
  }
  ~FortranUnit() { close_unit(unit_); }
  FortranUnit(const FortranUnit&) = delete;
  FortranUnit& operator=(const FortranUnit&) = delete;

 private:
  int unit_;
};

/// What `write` writes to Fortran unit `unit`.
template <class Write>
std::string written_to_unit(int unit, Write write) {
  const TemporaryFile file;
  {
    const FortranUnit open(unit, file.path());
    write();
  }
  return file.text();
}

/// What `write` prints on Fortran's standard output.
template <class Write>
std::string written_to_stdout(Write write) {
  const TemporaryFile file;
  std::fflush(stdout);
  flush_standard_output();
  const int kept = dup(1);
  dup2(file.descriptor(), 1);
  write();
  flush_standard_output();
  dup2(kept, 1);
  close(kept);
  return file.text();
}
