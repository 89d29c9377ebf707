#include "list_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "lists/limits.h"

namespace comparison {
namespace {

using Entries = std::vector<std::int32_t>;

class TextReader {
 public:
  explicit TextReader(const std::string& file) : name_(file), in_(file) {
    if (!in_) throw std::runtime_error("cannot read " + file);
  }

  std::optional<Call> next() {
    if (at_end()) return std::nullopt;
    Call call;
    call.number = ++calls_;
    const std::int32_t n = number("N", 3, pstripack::most_nodes<std::int32_t>());
    const std::int32_t lnew = number("LNEW", 1, 6 * n - 11);
    call.n = n;
    call.has_returned = true;
    call.nodes = static_cast<std::size_t>(n);
    call.run.lists.lnew = lnew;
    read(call.run.lists.list, "LIST", lnew - 1);
    read(call.run.lists.lptr, "LPTR", lnew - 1);
    read(call.run.lists.lend, "LEND", n);
    // Allocate only now: a wrong N would have been noticed.
    for (Entries* slots : {&call.run.lists.list, &call.run.lists.lptr})
      slots->resize(6 * call.nodes - 12, kUntouched);
    return call;
  }

 private:
  static constexpr std::int32_t kAny = std::numeric_limits<std::int32_t>::max();

  /// Skips blanks.
  bool at_end() {
    while (std::isspace(in_.peek()) != 0) line_ += in_.get() == '\n';
    return in_.peek() == EOF;
  }

  std::int32_t number(const std::string& what, std::int32_t least = -kAny, std::int32_t largest = kAny) {
    if (at_end())
      throw std::runtime_error(fmt::format("{}, line {}: the file ends, expected {}", name_, line_, what));
    std::string word;
    in_ >> word;
    std::int32_t value = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || rest != word.data() + word.size() || value < least || value > largest)
      throw std::runtime_error(fmt::format(
          "{}, line {}: expected {}{}, found '{}'", name_, line_, what,
          largest == kAny ? ", an integer" : fmt::format(" from {} to {}", least, largest), word));
    return value;
  }

  void read(Entries& entries, const char* name, std::int32_t count) {
    for (std::int32_t i = 1; i <= count; ++i) entries.push_back(number(fmt::format("{}({})", name, i)));
  }

  std::string name_;
  std::ifstream in_;
  std::size_t line_ = 1;
  std::int64_t calls_ = 0;
};

}  // namespace

ByteComparison compare_bytes(const Lists& a, std::size_t nodes_of_a, const Lists& b, std::size_t nodes_of_b) {
  ByteComparison result;
  const auto compare = [&](const char* name, const Entries& s, std::size_t used_s, const Entries& t,
                           std::size_t used_t) {
    const std::size_t used = std::min(used_s, used_t);
    for (std::size_t i = 0; i < used; ++i)
      if (s[i] != t[i] && result.different++ == 0)
        result.first = fmt::format("{}({}): {} and {}", name, i + 1, s[i], t[i]);
    result.different += std::max(used_s, used_t) - used;
  };
  const auto slots = [](const Lists& lists, std::size_t nodes) {
    return nodes == 0 ? 0
                      : std::min(static_cast<std::size_t>(std::max(lists.lnew, 1)) - 1, lists.list.size());
  };
  const std::size_t slots_of_a = slots(a, nodes_of_a), slots_of_b = slots(b, nodes_of_b);
  if (a.lnew != b.lnew && (nodes_of_a > 0 || nodes_of_b > 0)) {
    result.different = 1;
    result.first = fmt::format("LNEW: {} and {}", a.lnew, b.lnew);
  }
  compare("LIST", a.list, slots_of_a, b.list, slots_of_b);
  compare("LPTR", a.lptr, slots_of_a, b.lptr, slots_of_b);
  compare("LEND", a.lend, nodes_of_a, b.lend, nodes_of_b);
  return result;
}

std::function<std::optional<Call>()> calls_of(const std::string& file) {
  if (CallReader::looks_like_recording(file))
    return [reader = std::make_shared<CallReader>(file)] { return reader->next(); };
  return [reader = std::make_shared<TextReader>(file)] { return reader->next(); };
}

}  // namespace comparison
