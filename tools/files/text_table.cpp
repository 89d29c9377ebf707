#include "files/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "files/columns.h"
#include "files/nearest.h"
#include "files/text_file.h"
#include "numbers.h"

namespace files {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

bool is_space(char c) { return kBlanks.find(c) != kBlanks.npos; }
bool is_blank(char c) { return c == ' ' || c == ',' || is_space(c); }
bool begins_comment(char c) { return c == '#' || c == '!' || c == '%'; }
bool ends_word(char c) { return is_blank(c) || c == '#' || c == '!'; }

/// Errors of spreadsheets. A line that begins with one is a row, no comment.
constexpr std::string_view kErrors[] = {"#N/A", "#VALUE!", "#REF!", "#DIV/0!", "#NUM!", "#NAME?", "#NULL!"};
std::string_view error_at(std::string_view text) {
  if (text.substr(0, 1) == "#")
    for (const std::string_view error : kErrors)
      if (text.substr(0, error.size()) == error) return error;
  return {};
}
bool is_comment(std::string_view content) { return begins_comment(content[0]) && error_at(content).empty(); }

bool is_missing(std::string_view word) {
  if (!word.empty() && error_at(word) == word) return true;
  if (word.size() > 4) return false;
  const std::string l = lower(word);
  return l.empty() || l == "nan" || l == "na" || l == "n/a" || l == "null";
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// True for digits that are no number but a name, or have more digits than a number keeps.
bool is_name_of_digits(std::string_view word) {
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  std::size_t digits = 0;
  while (digits < word.size() && is_digit(word[digits])) ++digits;
  const std::string_view rest = word.substr(digits);
  if (digits > 1 && word[0] == '0') return true;
  if (rest.empty()) return digits > 15;
  return digits > 0 && rest.size() > 1 && std::strchr("eEdDxX", rest[0]) != nullptr && is_digit(rest[1]);
}

bool is_number(std::string_view word, double& value) {
  constexpr std::string_view kMinus = "\xE2\x88\x92";  // of typography
  if (word.substr(0, kMinus.size()) == kMinus)
    return point_sets::parse("-" + std::string(word.substr(kMinus.size())), value);
  const auto [end, error] = point_sets::parse_beginning(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size()) return std::isfinite(value);
  // Test the first character: strtod is slow and carried columns have many words.
  return !word.empty() && std::strchr("0123456789+-.", word[0]) != nullptr &&
         point_sets::parse(std::string(word), value);
}

bool has_hemisphere(std::string_view word) {
  const auto is_letter = [](char c) { return std::strchr("NSEWnsew", c) != nullptr && c != '\0'; };
  double value;
  return word.size() > 1 && ((is_letter(word.back()) && is_number(word.substr(0, word.size() - 1), value)) ||
                             (is_letter(word.front()) && is_number(word.substr(1), value)));
}

/// What the user can do about a word that is not a number.
std::string remedy_for(std::string_view word) {
  if (is_missing(word)) return ": remove the row, or say --skip-missing";
  if (has_hemisphere(word)) return ": write 45N as 45, 45S as -45, 120W as -120";
  if (word.find("\xC2\xB0") != word.npos || word.find('\xB0') != word.npos || word.find(':') != word.npos)
    return ": write degrees as one decimal number, 45.5";
  if (word.find(';') != word.npos) return ": separate all columns by semicolons, or none";
  if (const std::size_t comma = word.find(','); comma != word.npos && word.find(',', comma + 1) == word.npos)
    return ": write a decimal comma as a point";
  if (word.find_first_of(" \t") != word.npos)
    return ": write a decimal comma as a point, or use one separator";
  return ": correct it, remove the row, or choose other --columns";
}

/// Takes the first line off the text, and returns it without its end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

using Cells = std::vector<std::string_view>;

/// Sets the cells of a line, without their quotes. False if a closing quote is missing.
bool split(std::string_view line, const TextFormat& format, Cells& cells) {
  cells.clear();
  for (const auto& [first, last] : format.widths)
    cells.push_back(trimmed(line.substr(std::min(first - 1, line.size()), last - first + 1)));
  if (!format.widths.empty()) return true;
  const bool by_blanks = format.separator == ' ';
  for (bool more = true; more;) {
    const auto begins = [&](char c) {
      return by_blanks ? !is_blank(c) : c == format.separator || !is_space(c);
    };
    const auto ends = [&](char c) { return by_blanks ? ends_word(c) : c == format.separator; };
    line.remove_prefix(
        static_cast<std::size_t>(std::find_if(line.begin(), line.end(), begins) - line.begin()));
    if (by_blanks && (line.empty() || is_comment(line))) break;
    const bool is_quoted = format.has_quotes && !line.empty() && line[0] == '"';
    std::size_t end = is_quoted ? 1 : by_blanks ? error_at(line).size() : 0;
    if (is_quoted) {
      while (end < line.size() && (line[end] != '"' || line.substr(end, 2) == "\"\""))
        end += line[end] == '"' ? 2 : 1;
      if (end >= line.size()) return false;
      cells.push_back(line.substr(1, end - 1));
      ++end;
    }
    if (!is_quoted || !by_blanks)
      end = static_cast<std::size_t>(
          std::find_if(line.begin() + static_cast<std::ptrdiff_t>(end), line.end(), ends) - line.begin());
    if (!is_quoted) cells.push_back(trimmed(line.substr(0, end)));
    more = by_blanks || end < line.size();
    line.remove_prefix(std::min(end + (by_blanks ? 0 : 1), line.size()));
  }
  return true;
}
Cells split(std::string_view line, const TextFormat& format) {
  Cells cells;
  split(line, format, cells);
  return cells;
}

/// Replaces "" in a quoted cell by ".
std::string without_doubled_quotes(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') ++i;
  }
  return result;
}

/// The place of the first of these characters outside of quotes.
std::size_t find_unquoted(std::string_view line, std::string_view characters) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (!quoted && characters.find(line[i]) != characters.npos) return i;
  }
  return line.npos;
}

/// Removes a comment behind the numbers of a row.
std::string_view without_comment(std::string_view line) { return line.substr(0, find_unquoted(line, "#!")); }

bool is_header(const Cells& cells) {
  bool has_word = false;
  double value;
  for (const std::string_view cell : cells) {
    if (is_number(cell, value) || has_hemisphere(cell) || lower(cell) == "nan") return false;
    has_word = has_word || (!cell.empty() && std::strchr("+-.0123456789", cell[0]) == nullptr);
  }
  return has_word;
}

/// True if tabs separate the columns: the first line has one between any two columns and is not all numbers.
/// Otherwise a tab counts as a blank.
bool is_separated_by_tabs(std::string_view line) {
  if (line.find('\t') == line.npos) return false;
  const Cells cells = split(line, {'\t'});
  double value;
  for (const std::string_view cell : cells) {
    if (cell.empty()) return false;
    const Cells words = split(cell, {' '});
    if (words.size() > 1 && is_number(words[0], value) && is_number(words[1], value)) return false;
  }
  return is_header(cells) || split(line, {' '}).size() != cells.size();
}

/// The format with the separator of this line, if the caller has not said it.
TextFormat format_of(std::string_view line, TextFormat format) {
  if (format.separator != '\0') return format;
  format.separator = find_unquoted(line, ";") != line.npos   ? ';'
                     : is_separated_by_tabs(line)            ? '\t'
                     : find_unquoted(line, ",") != line.npos ? ','
                                                             : ' ';
  return format;
}

/// Sets names and units from the header. In text separated by blanks a unit is a word of its own.
void set_names(TextLayout& layout, const Cells& cells) {
  layout.names.clear();
  layout.units.clear();
  const auto is_unit = [](std::string_view w) {
    return w.size() > 1 && ((w.front() == '[' && w.back() == ']') || (w.front() == '(' && w.back() == ')'));
  };
  for (const std::string_view cell : cells) {
    if (layout.format.separator == ' ' && is_unit(cell) && !layout.names.empty()) {
      layout.units.back() = cell.substr(1, cell.size() - 2);
      continue;
    }
    const std::string_view text = trimmed(cell);
    const std::size_t begin = text.find_last_of("[(");
    if (begin != text.npos && begin > 0 && is_unit(text.substr(begin))) {
      layout.names.emplace_back(trimmed(text.substr(0, begin)));
      layout.units.emplace_back(text.substr(begin + 1, text.size() - begin - 2));
    } else {
      layout.names.emplace_back(text);
      layout.units.emplace_back();
    }
  }
}

bool has_place(const std::vector<std::string>& names) {
  const auto has = [&](char axis) {
    return std::any_of(names.begin(), names.end(), [&](const auto& name) { return axis_of(name) == axis; });
  };
  return (has('o') && has('a')) || (has('x') && has('y') && has('z'));
}

const char* name_of(char separator) {
  return separator == ','    ? "commas"
         : separator == ';'  ? "semicolons"
         : separator == '\t' ? "tabs"
                             : "blanks";
}

/// The reason why a line has too few or too many columns, for the message.
std::string of_other_count(std::string_view line, std::size_t found, const TextLayout& layout) {
  const char separator = layout.format.separator;
  const bool has_none = separator == ' ' || line.find(separator) == line.npos;
  for (const char other : {';', '\t', ',', ' '})
    if (has_none && other != separator && split(line, {other}).size() == layout.columns)
      return fmt::format("separated by {}, the lines before by {}: use one separator", name_of(other),
                         name_of(separator));
  const bool commas_split_numbers =
      separator == ' ' && found == 2 * layout.columns &&
      static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) == layout.columns;
  return fmt::format(
      "found {} {}{} where the {} {}: {}", found, layout.names.empty() ? "number" : "column",
      found == 1 ? "" : "s", layout.header_line > 0 ? "header has" : "lines before have", layout.columns,
      commas_split_numbers ? "write a decimal comma as a point" : "complete the row, or remove it");
}

/// Why the word is not allowed in the column.
std::string why_not(std::string_view word, std::size_t column, const TextLayout& layout) {
  const std::string name =
      layout.names.empty() ? "" : fmt::format(" in column '{}'", excerpt(layout.name(column)));
  if (word.empty())
    return fmt::format("nothing{}: remove the row, say --skip-missing, or choose other --columns",
                       name.empty() ? " between separators" : name);
  if (!name.empty() && lower(word) == lower(layout.names[column])) return "the header line again: remove it";
  return fmt::format("'{}'{} is not a finite number{}", excerpt(word), name, remedy_for(word));
}

}  // namespace

std::string TextLayout::name(std::size_t column) const {
  return column < names.size() ? names[column] : fmt::format("column{}", column + 1);
}

char axis_of(const std::string& name) {
  std::string l = lower(name);
  for (const char* const unit : {"_degrees", "_degree", "_deg", "_radians", "_rad"})
    if (const std::size_t length = std::strlen(unit);
        l.size() > length && l.compare(l.size() - length, length, unit) == 0)
      l.resize(l.size() - length);
  for (const char* const w : {"lon", "long", "lng", "longitude", "decimallongitude"})
    if (l == w) return 'o';
  for (const char* const w : {"lat", "latitude", "decimallatitude"})
    if (l == w) return 'a';
  return l == "x" || l == "y" || l == "z" ? l[0] : '\0';
}

std::vector<std::pair<std::size_t, std::size_t>> fixed_widths(const std::string& columns) {
  std::vector<std::pair<std::size_t, std::size_t>> widths;
  for (const std::string& part : parts_of(columns, ',')) {
    const std::vector<double> ends = numbers_between(part, '-');
    if (ends.size() != 2 || !(1 <= ends[0] && ends[0] <= ends[1] && ends[1] <= 1e6)) return {};
    widths.emplace_back(static_cast<std::size_t>(ends[0]), static_cast<std::size_t>(ends[1]));
  }
  return widths;
}

namespace {

/// True if the next line with a content is a header line that names coordinates.
bool is_before_header(std::string_view text, const TextFormat& format) {
  while (!text.empty()) {
    const std::string_view line = take_line(text), content = trimmed(line);
    if (content.empty()) continue;
    TextLayout layout;
    layout.format = format_of(content, format);
    const Cells cells = split(format.widths.empty() ? content : line, layout.format);
    if (!is_header(cells)) return false;
    set_names(layout, cells);
    return has_place(layout.names);
  }
  return false;
}

}  // namespace

TextLayout layout_of(std::string_view text, const std::string& file, const TextFormat& format) {
  TextLayout layout;
  const std::size_t mark = text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  if (text.find('\n') == text.npos && trimmed(text).find('\r') != text.npos)
    fail(file + ":1", "lines end with CR alone: end them with LF, for example by `tr '\\r' '\\n'`");
  std::string_view rest = text.substr(mark), comment;
  bool has_row = false;
  for (std::size_t number = 1; !has_row && !rest.empty(); ++number) {
    const std::string_view line = take_line(rest), content = trimmed(line);
    const std::string_view whole = format.widths.empty() ? content : line;
    if (content.empty() || content[0] == '>') continue;
    if (is_comment(content)) {
      comment = content.substr(1);
      continue;
    }
    const bool is_whole = layout.header_line > 0 || !format.has_quotes || !error_at(content).empty();
    const std::string_view plain = is_whole ? whole : trimmed(without_comment(content));
    if (layout.header_line == 0) layout.format = format_of(plain, format);
    const Cells cells = split(plain, layout.format);
    double n = 0;
    if (!cells.empty() && !is_number(cells[0], n) && !has_place(layout.names) &&
        is_before_header(rest, format)) {  // a title
      layout.header_line = 0;
      continue;
    }
    if (is_header(cells)) {
      if (layout.header_line > 0)
        fail(line_of(file, number),
             "a second header line, after the one in line {}: remove one of them, or put # before it",
             layout.header_line);
      layout.header_line = number;
      // The names in a header may contain #.
      layout.format = format_of(content, format);
      set_names(layout, split(whole, layout.format));
      continue;
    }
    if (layout.header_line == 0 && layout.line_of_count == 0 && cells.size() == 1 && is_number(cells[0], n) &&
        n >= 1 && n == std::floor(n)) {
      layout.line_of_count = number;
      layout.count = static_cast<std::size_t>(std::min(n, 1e18));
      continue;
    }
    has_row = true;
    layout.begin = static_cast<std::size_t>(line.data() - text.data());
    layout.line = number;
    layout.columns = layout.header_line > 0 ? layout.names.size() : cells.size();
  }
  layout.where = layout.header_line > 0 ? line_of(file, layout.header_line) : file;
  if (!has_row) {
    if (layout.header_line > 0)
      fail(layout.where, "a header line, and no row of numbers after it: add the nodes");
    fail(file, "no points: expected lines 'lon lat' or 'x y z'");
  }
  if (layout.header_line == 0 && !comment.empty()) {
    const TextFormat of_rows = layout.format;
    layout.format = {of_rows.separator};
    if (split(comment, layout.format).size() != layout.columns) layout.format = {' '};
    set_names(layout, split(comment, layout.format));
    layout.format = of_rows;
    if (layout.names.size() != layout.columns || !has_place(layout.names))
      layout.names.clear(), layout.units.clear();
  }
  return layout;
}

TextRows rows_of(std::string_view text, const std::string& file, const TextLayout& layout,
                 const std::vector<Role>& roles) {
  const bool has_comments =
      layout.header_line == 0 && layout.format.has_quotes && layout.format.separator != ' ';
  std::vector<bool> has_words(layout.columns);  // of each column: a word in it is not a number
  TextRows rows;
  rows.numbers.resize(layout.columns);
  rows.texts.resize(layout.columns);
  Cells cells;
  std::size_t number = layout.line - 1;
  double segments = 0;
  for (text.remove_prefix(layout.begin); !text.empty();) {
    std::string_view line = take_line(text);
    const std::string_view content = trimmed(line);
    ++number;
    if (content.empty() || is_comment(content)) continue;
    if (content[0] == '>') {
      ++segments;
      continue;
    }
    if (has_comments && error_at(content).empty()) line = without_comment(line);
    if (!split(line, layout.format, cells))
      fail(line_of(file, number), "a double quote without an end: add it, or say --quote none");
    if (cells.empty()) continue;
    for (std::size_t c = 0; c < std::min(cells.size(), layout.columns); ++c) {
      const Role role = roles[c];
      const std::string_view word = cells[c];
      if (role == Role::skipped) continue;
      if (role == Role::carried) {
        rows.texts[c].push_back(layout.format.has_quotes ? without_doubled_quotes(word) : std::string(word));
        if (!has_words[c]) has_words[c] = is_name_of_digits(word);
      }
      double value = kMissing;
      if (has_words[c] || !is_number(word, value)) {
        value = kMissing;
        if (role == Role::place || (role == Role::value && !is_missing(word))) {
          // Look for another separator before blaming a word.
          const std::string other = of_other_count(line, 0, layout);
          fail(line_of(file, number), "{}",
               other.rfind("separated", 0) == 0 && layout.columns > 1 ? other : why_not(word, c, layout));
        }
        if (!is_missing(word)) has_words[c] = true;
      }
      rows.numbers[c].push_back(value);
    }
    if (cells.size() != layout.columns)
      fail(line_of(file, number), "{}", of_other_count(line, cells.size(), layout));
    rows.lines.push_back(number);
    rows.segments.push_back(segments);
  }
  if (layout.line_of_count > 0 && layout.count != rows.lines.size())
    fail(line_of(file, layout.line_of_count),
         "a single number is the count of the points that follow; there are {}: correct or remove it",
         rows.lines.size());
  if (segments == 0) rows.segments.clear();
  for (std::size_t c = 0; c < layout.columns; ++c)
    if (has_words[c]) rows.numbers[c].clear();
  return rows;
}

std::vector<std::size_t> columns_named(const std::string& wanted, const TextLayout& layout) {
  std::vector<std::size_t> columns;
  for (const std::string& part : parts_of(wanted, ',')) {
    const std::string word(trimmed(part));
    std::vector<std::size_t> found;
    const auto find_all = [&](const auto& is_it) {
      for (std::size_t c = 0; c < layout.names.size() && found.size() < 2; ++c)
        if (is_it(layout.names[c])) found.push_back(c);
    };
    find_all([&](const std::string& name) { return name == word; });
    if (found.empty()) find_all([&](const std::string& name) { return lower(name) == lower(word); });
    if (found.size() > 1)
      fail(layout.where, "the header names column '{}' twice, {} and {}: choose columns by number",
           excerpt(word), found[0] + 1, found[1] + 1);
    if (double number = 0; found.empty() && is_number(word, number)) {
      if (number != std::floor(number) || number < 1 || number > static_cast<double>(layout.columns))
        fail(layout.where, "there is no column {}: there are {}", excerpt(word), layout.columns);
      found.push_back(static_cast<std::size_t>(number) - 1);
    }
    if (found.empty() && layout.names.empty())
      fail(layout.where, "the columns have no names: choose them by number, not '{}'", excerpt(word));
    if (found.empty())
      fail(layout.where, "there is no column '{}'{}; the header has {}", excerpt(word),
           did_you_mean(word, layout.names), listed(layout.names));
    if (std::find(columns.begin(), columns.end(), found[0]) != columns.end())
      fail(layout.where, "column '{}' is chosen twice", excerpt(word));
    columns.push_back(found[0]);
  }
  return columns;
}

}  // namespace files
