#pragma once
// Tables in text files, with or without title, header line, comments and segments of GMT. Columns are
// separated by blanks, commas, semicolons or tabs, or have fixed widths.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace files {

/// How a line is divided into cells.
struct TextFormat {
  /// `,`, `;` or tab: exactly one between columns; cells may be empty or in double quotes. Blank: any number
  /// of blanks, tabs and commas between columns. 0: that of the first line.
  char separator = '\0';
  /// If not, a double quote is a character like others, and so are # and ! behind the first of a line.
  bool has_quotes = true;
  /// First and last bytes of columns of fixed widths, from 1; empty: separators divide lines.
  std::vector<std::pair<std::size_t, std::size_t>> widths = {};
};

/// The format of a text, found from its first lines.
struct TextLayout {
  TextFormat format = {};
  std::size_t columns = 0;
  std::vector<std::string> names;   ///< of the columns; empty: no header
  std::vector<std::string> units;   ///< of the columns: "depth [km]", "depth (km)"; as many as names
  std::size_t header_line = 0;      ///< from 1; 0: no header, or the names are in a comment
  std::string where;                ///< in messages: the file, and the header line if there is one
  std::size_t begin = 0, line = 1;  ///< offset of the first row, and its line
  std::size_t count = 0,
              line_of_count = 0;  ///< number of rows that a first line with a single number announces

  std::string name(std::size_t column) const;  ///< "mag", or "column3" where columns have no names
};

/// Comments begin with #, % or ! at the start of a line, or with # or ! behind numbers if there is no header
/// line or blanks separate the columns. The comment before the first row can hold the names of columns, if
/// lon and lat, or x, y and z, are among them. A line before a header line that has them is a title. Throws
/// std::runtime_error with `file` and line; so does rows_of.
TextLayout layout_of(std::string_view text, const std::string& file, const TextFormat& format = {});

/// Columns of a text of fixed widths, by their first and last bytes, from 1: "1-11,13-20". Empty: `columns`
/// is something else.
std::vector<std::pair<std::size_t, std::size_t>> fixed_widths(const std::string& columns);

/// What a column is used for. `place`: a coordinate, a finite number. `value`: a number or missing.
/// `carried`: copied to the output, a number, missing or text. Digits that say more than their number are
/// text: 007, more than 15 digits, 12D3 and 1E2.
enum class Role : char { skipped, place, value, carried };

struct TextRows {
  std::vector<std::vector<double>> numbers;     ///< of each column that is not skipped; NaN: missing
  std::vector<std::vector<std::string>> texts;  ///< of each carried column, also beside its numbers
  std::vector<std::size_t> lines;               ///< of each row, from 1
  std::vector<double> segments;  ///< number of `>` lines before each row; empty: there are no such lines
};

/// Reads the rows.
TextRows rows_of(std::string_view text, const std::string& file, const TextLayout& layout,
                 const std::vector<Role>& roles);

/// The columns that `wanted` lists by name or number (from 1), separated by commas.
std::vector<std::size_t> columns_named(const std::string& wanted, const TextLayout& layout);

/// The coordinate that a column's name stands for: 'o' longitude, 'a' latitude, 'x', 'y', 'z'; 0: none.
char axis_of(const std::string& name);

}  // namespace files
