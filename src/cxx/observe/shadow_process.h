#pragma once

#include <sys/types.h>
#include <sys/uio.h>

#include <string>

namespace pstripack {

/// The process stripack-compare, which runs the original beside the model: it reads the recorded calls from a
/// socket and writes its log to the model's stderr. To be used by one thread at a time.
class ShadowProcess {
 public:
  /// settings: PSTRIPACK_CHECK after `lib:`, that is
  /// LIBRARY[,abi=ABI][,timeout=SECONDS][,show=K][,log=FILE]. Relative paths start at `folder`. Throws
  /// std::invalid_argument.
  ShadowProcess(const std::string& settings, const std::string& folder);

  /// Sends a block; starts the program at the first call. Throws std::runtime_error if it cannot be started
  /// or has ended.
  void send(iovec* parts, int count);

  /// After the last block: waits until the program has ended, for the timeout of one call plus 10 seconds at
  /// most. False if it is still running.
  bool finish() noexcept;

  /// In a forked child: the next send() starts a program of its own.
  void leave_to_parent() noexcept;

 private:
  void start();
  bool socket_is_open() const noexcept;

  std::string library_, abi_, timeout_ = "60", show_, log_;
  int socket_ = -1;
  ino_t inode_ = 0;  ///< of the socket, to notice that the model has closed the descriptor
};

}  // namespace pstripack
