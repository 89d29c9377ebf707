#pragma once
// The texts composed by the C functions of the printing routines.

#include <string>

#include "support/text_calls.h"

/// The text of a handle; frees the handle.
inline std::string text_of(void* handle) {
  std::string text;
  char record[400];
  for (int length; (length = pstripack_next_record(handle, record, sizeof record)) >= 0;)
    text.append(record, static_cast<std::size_t>(length)) += '\n';
  pstripack_free_text(handle);
  return text;
}
