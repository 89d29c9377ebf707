#pragma once
// Tables of text as they come: with or without a header line; columns separated by blanks, commas, semicolons
// or tabs; comments; segments of GMT.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace files {

/// What the first lines of a text say about all of it.
struct TextLayout {
  /// `,`, `;`, tab: one of them between columns, which may be empty, or in double quotes. Blank: any number
  /// of blanks, tabs and commas.
  char separator = ' ';
  std::size_t columns = 0;
  std::vector<std::string> names;            ///< of the columns; empty: there is no header
  std::vector<std::string> units;            ///< of the columns: "depth [km]", "depth (km)"; as many as names
  std::size_t header_line = 0;               ///< from 1; 0: none, or the names are in a comment
  std::size_t begin = 0, line = 1;           ///< offset of the first row, and its line
  std::size_t count = 0, line_of_count = 0;  ///< the number of rows, if the first line is a single number

  std::string name(std::size_t column) const;  ///< "mag", or "column3" where columns have no names
};

/// Comments begin with #, % or ! at the beginning of a line, or with # or ! after numbers where there is no
/// header line or columns are separated by blanks. The names of columns can also be in the comment before the
/// first row, if they include lon and lat, or x, y and z. Throws std::runtime_error with `file` and line, as
/// rows_of.
TextLayout layout_of(std::string_view text, const std::string& file);

/// What a column is needed for. Places are finite numbers; values are numbers or missing; a carried column
/// can also be text.
enum class Role : char { skipped, place, value, carried };

struct TextRows {
  std::vector<std::vector<double>> numbers;     ///< of each column, unless skipped; NaN: missing
  std::vector<std::vector<std::string>> texts;  ///< of each carried column in which a word is no number
  std::vector<std::size_t> lines;               ///< of each row, from 1
  std::vector<double> segments;  ///< number of lines `>` before each row; empty: there are none
};

/// Reads on threads. Places may be NaN if there is a value: its caller names the node.
TextRows rows_of(std::string_view text, const std::string& file, const TextLayout& layout,
                 const std::vector<Role>& roles);

/// The columns that `wanted` names, by name or number (from 1), separated by commas.
std::vector<std::size_t> columns_named(const std::string& wanted, const TextLayout& layout,
                                       const std::string& file);

/// What a column's name says: 'o' longitude, 'a' latitude, 'x', 'y', 'z', or 0.
char axis_of(const std::string& name);

}  // namespace files
