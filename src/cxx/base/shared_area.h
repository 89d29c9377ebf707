#pragma once

#include <cstddef>

#include "base/descriptor.h"

namespace pstripack {

/// Memory that two processes map. Never throws.
class SharedArea {
 public:
  SharedArea() = default;
  SharedArea(SharedArea&& other) noexcept { *this = static_cast<SharedArea&&>(other); }
  SharedArea& operator=(SharedArea&& other) noexcept;
  ~SharedArea() { clear(); }

  /// A new area whose pages are allocated, so that using it cannot fail. Empty if memory is out.
  static SharedArea create(std::size_t size);
  /// The other process's area. Empty on failure.
  static SharedArea map(Descriptor file);
  /// The area of a process of this user on this machine, in which it is open as `file`. Empty on failure.
  static SharedArea map_of(int process, int file);

  void* data() const { return data_; }
  std::size_t size() const { return size_; }
  const Descriptor& file() const { return file_; }
  /// Closes the descriptor; the memory stays mapped.
  void close_file() { file_.reset(); }

 private:
  void clear();
  Descriptor file_;
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace pstripack
