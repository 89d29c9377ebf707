#include "pool/shared_area.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <utility>

namespace pstripack {

SharedArea& SharedArea::operator=(SharedArea&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

SharedArea::~SharedArea() {
  if (data_ != nullptr) munmap(data_, size_);
}

SharedArea SharedArea::create(std::size_t size) {
  Descriptor file(memfd_create("pstripack", MFD_CLOEXEC));
  if (!file) return {};
  int error = 0;
  do error = posix_fallocate(file.get(), 0, static_cast<off_t>(size));
  while (error == EINTR);
  return error == 0 ? map(std::move(file)) : SharedArea();
}

SharedArea SharedArea::map(Descriptor file) {
  struct stat status;
  SharedArea area;
  if (fstat(file.get(), &status) != 0 || status.st_size <= 0) return area;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const data = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (data == MAP_FAILED) return area;
  area.data_ = data;
  area.size_ = size;
  area.file_ = std::move(file);
  return area;
}

}  // namespace pstripack
