#pragma once
// Text files of nodes as rows of numbers.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace point_sets {

/// Rows with equal numbers of finite values, or NaN if allowed.
struct Table {
  std::size_t columns = 0;
  std::vector<double> values;      ///< row after row
  std::vector<std::size_t> lines;  ///< of each row, from 1

  std::size_t rows() const { return lines.size(); }
  const double* row(std::size_t i) const { return &values[columns * i]; }
};

/// The numbers in `text`: decimal or hexadecimal, also with Fortran's D exponents; commas count as blanks,
/// `#` and `!` start comments. The first line may hold the number of rows alone. Throws std::runtime_error
/// with `name` and line on anything else, on fewer than 2 or more than `most_columns` columns, and if there
/// are no rows. `with_nan`: the word `nan` is a number, too.
Table table_of(std::string_view text, const std::string& name, std::size_t most_columns = 3,
               bool with_nan = false);

/// The same for a file; `-`: stdin. Throws std::runtime_error.
std::string contents_of(const std::string& file);

}  // namespace point_sets
