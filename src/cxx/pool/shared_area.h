#pragma once
// The arrays of one TRMESH call in memory shared by the model and the pool's ranks on its machine.

#include <cstddef>
#include <cstdint>

#include "pool/channel.h"

namespace pstripack {

/// Offsets of the arrays in an area: x | y | z | list | lptr | lend, each starting on its own page.
class AreaLayout {
 public:
  AreaLayout(std::int32_t n, std::int32_t real_bytes);
  std::size_t size() const { return begin_[6]; }
  template <class Real>
  Real* coordinate(void* area, int axis) const {
    return reinterpret_cast<Real*>(static_cast<unsigned char*>(area) + begin_[axis]);
  }
  std::int32_t* list(void* area) const { return coordinate<std::int32_t>(area, 3); }
  std::int32_t* lptr(void* area) const { return coordinate<std::int32_t>(area, 4); }
  std::int32_t* lend(void* area) const { return coordinate<std::int32_t>(area, 5); }

 private:
  std::size_t begin_[7];
};

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
