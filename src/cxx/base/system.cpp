#include "base/system.h"

#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <thread>

#include "base/control_groups.h"

#if defined(__linux__)
#include <sched.h>
#include <sys/syscall.h>
#elif defined(__APPLE__)
#include <crt_externs.h>
#include <mach-o/dyld.h>
#endif
#if !defined(__APPLE__)
extern "C" char** environ;  // POSIX: programs declare it
#endif

namespace pstripack {

char** all_environment_variables() {
#if defined(__APPLE__)
  return *_NSGetEnviron();
#else
  return environ;
#endif
}

// POSIX has no way to learn it, so the build with PSTRIPACK_ONLY_POSIX keeps that of Linux.
std::string path_of_this_program() {
  char path[PATH_MAX] = "";
#if defined(__linux__)
  const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
  return {path, length > 0 ? static_cast<std::size_t>(length) : 0};
#elif defined(__APPLE__)
  char given[PATH_MAX];
  std::uint32_t size = sizeof given;
  return _NSGetExecutablePath(given, &size) == 0 && realpath(given, path) != nullptr ? path : "";
#else
  return path;
#endif
}

bool open_stream(int (&ends)[2]) {
#if defined(PSTRIPACK_LINUX)
  return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
#else
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return false;
  for (const int end : ends) {
    fcntl(end, F_SETFD, FD_CLOEXEC);
#if defined(SO_NOSIGPIPE)  // what macOS has instead of MSG_NOSIGNAL
    const int one = 1;
    setsockopt(end, SOL_SOCKET, SO_NOSIGPIPE, &one, sizeof one);
#endif
  }
  return true;
#endif
}

ssize_t send_without_signal(int socket, const msghdr& message) {
#if defined(MSG_NOSIGNAL)
  return sendmsg(socket, &message, MSG_NOSIGNAL);
#else
  return sendmsg(socket, &message, 0);
#endif
}

ssize_t write_unchecked(int file, const void* bytes, std::size_t size) {
#if defined(PSTRIPACK_LINUX)
  return syscall(SYS_write, file, bytes, size);
#else
  return write(file, bytes, size);
#endif
}

namespace {

/// The number that stands behind `key`, or first if the key is empty; SIZE_MAX if there is none.
std::size_t number_in(const FileText& text, const char* key = "") {
  std::size_t number;
  const char* const at = strstr(text.get(), key);
  return at != nullptr && sscanf(at + strlen(key), "%zu", &number) == 1 ? number : SIZE_MAX;
}

/// The least limit of the control groups that this process is in: each may set one, and so may those above.
std::size_t limit_of_control_groups() {
  std::size_t least = SIZE_MAX;
  for_each_control_group("", "memory", [&](const char* folder, bool is_version_2) {
    const FileText limit("", folder, is_version_2 ? "memory.max" : "memory.limit_in_bytes");
    least = std::min(least, number_in(limit));
  });
  return least;
}

}  // namespace

std::size_t memory_limit() {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  const bool known = pages > 0 && bytes > 0;
  return std::min(known ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(bytes) : SIZE_MAX,
                  limit_of_control_groups());
}

std::size_t available_memory() {
  const std::size_t limit = limit_of_control_groups();
  const std::size_t of_machine = number_in({"", "/proc", "meminfo"}, "MemAvailable:");  // in kB
  const std::size_t own = number_in({"", "/proc/self", "statm"}, " ");  // the second number: pages
  const long page = sysconf(_SC_PAGESIZE);
  if (of_machine == SIZE_MAX) return SIZE_MAX;
  if (limit == SIZE_MAX || own == SIZE_MAX || page <= 0) return 1024 * of_machine;
  return std::min(1024 * of_machine, limit - std::min(limit, static_cast<std::size_t>(page) * own));
}

ProcessorSet usable_processors() {
  ProcessorSet usable{};
  const auto add = [&usable](std::size_t i) { usable[i / 64] |= std::uint64_t{1} << i % 64; };
#if defined(PSTRIPACK_LINUX)
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) {  // fails if a cpu_set_t is too small
    for (std::size_t i = 0; i < std::min(8 * sizeof set, 64 * usable.size()); ++i)
      if (CPU_ISSET(i, &set)) add(i);
    return usable;
  }
#endif
  const std::size_t count = std::thread::hardware_concurrency();
  for (std::size_t i = 0; i < std::min(count, 64 * usable.size()); ++i) add(i);
  return usable;
}

}  // namespace pstripack
