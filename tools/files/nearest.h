#pragma once
// Words: in lists, and for messages.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "files/text_file.h"
#include "numbers.h"

namespace files {

/// The parts of a text between separators, also empty ones.
inline std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// Finite numbers between separators; none if a part is no number.
inline std::vector<double> numbers_between(const std::string& text, char separator) {
  std::vector<double> numbers;
  for (const std::string& part : parts_of(text, separator))
    if (!point_sets::parse(part, numbers.emplace_back())) return {};
  return numbers;
}

/// Edit distance: the fewest insertions, deletions, replacements and exchanges of neighbouring letters that
/// turn `a` into `b`.
inline std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// The word with the smallest edit distance; empty if none is close.
inline std::string nearest(const std::string& word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t fewest = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string& w : words)
    if (const std::size_t edits = edits_between(word, w); edits < fewest && edits < w.size())
      best = w, fewest = edits;
  return best;
}

/// "; did you mean WORD?", or nothing.
inline std::string did_you_mean(const std::string& word, const std::vector<std::string>& words) {
  const std::string best = nearest(word, words);
  return best.empty() ? "" : "; did you mean " + excerpt(best) + "?";
}

/// The words separated by commas; only the first ones if there are many.
inline std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t kMost = 30;
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), kMost); ++i)
    text += (i == 0 ? "" : ", ") + excerpt(words[i]);
  if (words.size() > kMost) text += " and " + std::to_string(words.size() - kMost) + " more";
  return words.empty() ? "none" : text;
}

}  // namespace files
