#pragma once
// LIST, LPTR, LEND of two results side by side: byte by byte, and as triangulations.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "calls.h"

namespace comparison {

/// The entries in use, LIST and LPTR (1..LNEW-1), LEND (1..nodes), and LNEW, of two results.
struct ByteComparison {
  std::size_t different = 0;
  std::string first;  ///< "LIST(17): 5 and 9"; empty if none is different
};
ByteComparison compare_bytes(const Lists& a, std::size_t nodes_of_a, const Lists& b, std::size_t nodes_of_b);

/// The calls of a file one after another: a recording; or text, whose numbers are N and LNEW, then
/// LIST(1..LNEW-1), LPTR(1..LNEW-1) and LEND(1..N), in as many lines as one likes, for each call. Errors of
/// text name the line.
std::function<std::optional<Call>()> calls_of(const std::string& file);

}  // namespace comparison
