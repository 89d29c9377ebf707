#pragma once

#include <sys/types.h>
#include <sys/uio.h>

#include <string>

namespace pstripack {

/// stripack-compare, which runs the original beside the model: it reads the recorded calls from a socket and
/// writes its log to the model's stderr. Used by one thread at a time.
class ShadowProcess {
 public:
  /// What stands behind `lib:` in PSTRIPACK_CHECK:
  /// LIBRARY[,abi=ABI][,timeout=SECONDS][,show=K][,log=FILE]. Relative paths start at `folder`. Throws
  /// std::invalid_argument.
  ShadowProcess(const std::string& settings, const std::string& folder);

  /// Starts the program at the first call. Throws std::runtime_error if it does not run (any more).
  void send(iovec* parts, int count);

  /// No more calls. Waits for the end of the log, as long as one call of the original may take and a little
  /// longer. False: the program goes on after the model.
  bool finish() noexcept;

  /// In a forked child, whose calls are for a program of its own.
  void leave_to_parent() noexcept;

 private:
  void start();
  bool socket_is_open() const noexcept;

  std::string library_, abi_, timeout_ = "60", show_, log_;
  int socket_ = -1;
  ino_t inode_ = 0;  ///< of the socket: the model may close what it has not opened
};

}  // namespace pstripack
