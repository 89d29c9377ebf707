#include "base/shared_area.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdio>
#include <utility>

#include "base/system.h"

namespace pstripack {

SharedArea& SharedArea::operator=(SharedArea&& other) noexcept {
  if (this == &other) return *this;
  clear();
  file_ = std::move(other.file_);
  data_ = std::exchange(other.data_, nullptr);
  size_ = std::exchange(other.size_, 0);
  return *this;
}

void SharedArea::clear() {
  if (data_ != nullptr) munmap(data_, size_);
  data_ = nullptr;
  size_ = 0;
  file_.reset();
}

SharedArea SharedArea::create(std::size_t size) {
#if defined(PSTRIPACK_LINUX)
  Descriptor file(memfd_create("pstripack", MFD_CLOEXEC));
  if (!file) return {};
  int error = 0;
  do error = posix_fallocate(file.get(), 0, static_cast<off_t>(size));
  while (error == EINTR);
  return error == 0 ? map(std::move(file)) : SharedArea();
#else
  static std::atomic<int> areas{0};
  char name[40];
  std::snprintf(name, sizeof name, "/pstripack-%d-%d", getpid(), ++areas);
  Descriptor file(shm_open(name, O_RDWR | O_CREAT | O_EXCL, 0600));
  if (!file) return {};
  shm_unlink(name);
  return ftruncate(file.get(), static_cast<off_t>(size)) == 0 ? map(std::move(file)) : SharedArea();
#endif
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
