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
  number_ = std::exchange(other.number_, 0);
  return *this;
}

void SharedArea::clear() {
  if (data_ != nullptr) munmap(data_, size_);
  data_ = nullptr;
  size_ = 0;
  close_file();
}

#if defined(PSTRIPACK_LINUX)
SharedArea SharedArea::create(std::size_t size) {
  Descriptor file(memfd_create("pstripack", MFD_CLOEXEC));
  if (!file) return {};
  int error = 0;
  do error = posix_fallocate(file.get(), 0, static_cast<off_t>(size));
  while (error == EINTR);
  return error == 0 ? map(std::move(file)) : SharedArea();
}

SharedArea::Name SharedArea::name() const {
  Name name{};
  if (file_) std::snprintf(name.text, sizeof name.text, "/proc/%d/fd/%d", getpid(), file_.get());
  return name;
}

SharedArea SharedArea::map(const char* name) { return map(Descriptor(open(name, O_RDWR | O_CLOEXEC))); }

void SharedArea::close_file() { file_.reset(); }
#else
// The name stays behind if the process is killed before it closes the file.
SharedArea SharedArea::create(std::size_t size) {
  static std::atomic<int> areas{0};
  SharedArea named;
  named.number_ = ++areas;
  named.file_ = Descriptor(shm_open(named.name().text, O_RDWR | O_CREAT | O_EXCL, 0600));
  if (!named.file_ || ftruncate(named.file_.get(), static_cast<off_t>(size)) != 0) return {};
  SharedArea area = map(std::move(named.file_));
  area.number_ = std::exchange(named.number_, 0);
  return area;
}

SharedArea::Name SharedArea::name() const {
  Name name{};
  if (number_ > 0) std::snprintf(name.text, sizeof name.text, "/pstripack-%d-%d", getpid(), number_);
  return name;
}

SharedArea SharedArea::map(const char* name) { return map(Descriptor(shm_open(name, O_RDWR, 0))); }

void SharedArea::close_file() {
  if (number_ > 0) shm_unlink(name().text);
  number_ = 0;
  file_.reset();
}
#endif

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
