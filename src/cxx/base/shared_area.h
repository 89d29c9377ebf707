#pragma once

#include <cstddef>

#include "base/descriptor.h"

namespace pstripack {

/// Memory that several processes map. No function throws.
class SharedArea {
 public:
  SharedArea() = default;
  SharedArea(SharedArea&& other) noexcept { *this = static_cast<SharedArea&&>(other); }
  SharedArea& operator=(SharedArea&& other) noexcept;
  ~SharedArea() { clear(); }

  /// A new area of `size` bytes. On Linux all pages are allocated now, so that using them cannot fail. Empty
  /// if there is not enough memory.
  static SharedArea create(std::size_t size);
  /// Maps an area that another process created and whose descriptor was passed on. Empty on failure.
  static SharedArea map(Descriptor file);

  void* data() const { return data_; }
  std::size_t size() const { return size_; }
  const Descriptor& file() const { return file_; }
  /// The memory stays mapped.
  void close_file() { file_.reset(); }

 private:
  void clear();
  Descriptor file_;
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace pstripack
