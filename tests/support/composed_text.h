#pragma once
// What the C functions of the routines that print compose.

#include <string>

#include "support/text_calls.h"

/// The text behind a handle, which is freed.
inline std::string text_of(void* handle) {
  std::string text;
  char record[400];
  for (int length; (length = pstripack_next_record(handle, record, sizeof record)) >= 0;)
    text.append(record, static_cast<std::size_t>(length)) += '\n';
  pstripack_free_text(handle);
  return text;
}
