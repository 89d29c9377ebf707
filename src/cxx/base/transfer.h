#pragma once

#include <errno.h>
#include <sys/uio.h>

#include <cstddef>

namespace pstripack {

/// Transfers all bytes of the parts by as many calls of transfer(parts, count) as needed; it works as
/// writev does and returns the number of bytes transferred. Returns false, with errno set, on an error
/// other than EINTR. Changes the parts.
template <class Transfer>
bool transfer_all(iovec* parts, int count, const Transfer& transfer) {
  while (count > 0) {
    const ssize_t done = transfer(parts, count);
    if (done < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    auto left = static_cast<std::size_t>(done);
    for (; count > 0 && left >= parts->iov_len; ++parts, --count) left -= parts->iov_len;
    if (count == 0) break;
    parts->iov_base = static_cast<char*>(parts->iov_base) + left;
    parts->iov_len -= left;
  }
  return true;
}

}  // namespace pstripack
