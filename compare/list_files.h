#pragma once
// Compares LIST, LPTR, LEND of two results byte by byte and as triangulations.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "calls.h"

namespace comparison {

/// Compares the entries in use: LIST and LPTR (1..LNEW-1), LEND (1..nodes), and LNEW.
struct ByteComparison {
  std::size_t different = 0;
  std::string first;  ///< "LIST(17): 5 and 9"; empty if all are equal
};
ByteComparison compare_bytes(const Lists& a, std::size_t nodes_of_a, const Lists& b, std::size_t nodes_of_b);

/// Yields the calls of a file: a recording, or text with N and LNEW, LIST(1..LNEW-1), LPTR(1..LNEW-1) and
/// LEND(1..N) for each call, in any number of lines. Errors in text name the line.
std::function<std::optional<Call>()> calls_of(const std::string& file);

}  // namespace comparison
