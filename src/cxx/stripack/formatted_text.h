#pragma once
// Text composed record by record, with fields as Fortran's edit descriptors write them.

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>

namespace pstripack {

/// A text of records, each ended by '\n'. Fields are right-justified. A value too wide for its field is
/// written in full, after a blank, where Fortran writes asterisks: the value matters more than the column.
/// Independent of the locale. Throws std::bad_alloc.
class FormattedText {
 public:
  const std::string& text() const { return text_; }

  FormattedText& add(std::string_view words) {
    text_ += words;
    return *this;
  }
  FormattedText& skip(int blanks) {
    text_.append(static_cast<std::size_t>(blanks), ' ');
    return *this;
  }
  FormattedText& end() {
    text_ += '\n';
    return *this;
  }
  /// `count` empty records.
  FormattedText& empty(int count) {
    text_.append(static_cast<std::size_t>(count), '\n');
    return *this;
  }
  /// Iw
  template <class Int>
  FormattedText& integer(Int value, int width) {
    return number(width, value);
  }
  /// Fw.d
  FormattedText& fixed(double value, int width, int decimals) {
    return number(width, value, std::chars_format::fixed, decimals);
  }
  /// Ew.6: 0.123456E+00, with three digits in the exponent 0.123456+100.
  FormattedText& exponential(double value, int width) {
    if (!std::isfinite(value))
      return justified(std::isnan(value) ? "NaN" : value < 0 ? "-Infinity" : "Infinity", width);
    std::array<char, 16> digits;  // -d.ddddde+xxx
    char* const end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::scientific, 5)
            .ptr;
    const bool negative = digits[0] == '-';
    const char* const d = digits.data() + (negative ? 1 : 0);
    int exponent = 0;
    std::from_chars(d + (d[8] == '+' ? 9 : 8), end, exponent);
    if (value != 0) ++exponent;  // from d.ddddd to 0.dddddd
    const int size = std::abs(exponent);
    std::string field = negative ? "-0." : "0.";
    field += d[0];
    field.append(d + 2, 5);
    if (size < 100) field += 'E';
    field += exponent < 0 ? '-' : '+';
    if (size < 10) field += '0';
    return justified(field + std::to_string(size), width);
  }

 private:
  FormattedText& justified(std::string_view field, int width) {
    const auto columns = static_cast<std::size_t>(width);
    text_.append(field.size() > columns ? 1 : columns - field.size(), ' ');
    text_ += field;
    return *this;
  }
  /// A value as std::to_chars writes it.
  template <class... Value>
  FormattedText& number(int width, Value... value) {
    std::array<char, 400> digits;
    const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value...).ptr;
    return justified({digits.data(), static_cast<std::size_t>(end - digits.data())}, width);
  }

  std::string text_;
};

}  // namespace pstripack
