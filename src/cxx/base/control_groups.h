#pragma once
// What Linux tells in files: the control groups of this process (Slurm, containers), and their limits.
// Without memory from the heap. On other systems there are no such files.

#include <fcntl.h>
#include <limits.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace pstripack {

/// The first bytes of a file of the kernel; "" if it cannot be read.
class FileText {
 public:
  /// The file ROOT/FOLDER/NAME.
  FileText(const char* root, const char* folder, const char* name) {
    char path[PATH_MAX];
    const int length = std::snprintf(path, sizeof path, "%s%s/%s", root, folder, name);
    if (length < 0 || length >= static_cast<int>(sizeof path)) return;
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    const ssize_t size = read(file, text_, sizeof text_ - 1);
    close(file);
    text_[std::max<ssize_t>(size, 0)] = '\0';
  }
  const char* get() const { return text_; }
  char* get() { return text_; }

 private:
  char text_[4096] = "";
};

/// Calls visit(folder, is_version_2) for the control group of this process that limits `controller`, and for
/// each that this one is part of. The folders are below `root`.
template <class Visit>
void for_each_control_group(const char* root, const char* controller, const Visit& visit) {
  FileText groups(root, "/proc/self", "cgroup");
  char name[32], *rest = nullptr;
  std::snprintf(name, sizeof name, ",%s,", controller);
  for (char* line = strtok_r(groups.get(), "\n", &rest); line != nullptr;
       line = strtok_r(nullptr, "\n", &rest)) {
    // "4:cpu,cpuacct:/group" of version 1, "0::/group" of version 2
    char* const controllers = std::strchr(line, ':');
    char* const group = controllers == nullptr ? nullptr : std::strchr(controllers + 1, ':');
    if (group == nullptr) continue;
    const bool is_version_2 = group == controllers + 1;
    *controllers = *group = ',';
    const char* const found = std::strstr(controllers, name);
    if (!is_version_2 && (found == nullptr || found >= group)) continue;
    for (char* end = group + std::strlen(group); end != nullptr; end = std::strrchr(group, '/')) {
      *end = '\0';
      char folder[PATH_MAX];
      std::snprintf(folder, sizeof folder, "/sys/fs/cgroup%s%s%s", is_version_2 ? "" : "/",
                    is_version_2 ? "" : controller, group + 1);
      visit(folder, is_version_2);
    }
  }
}

}  // namespace pstripack
