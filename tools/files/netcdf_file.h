#pragma once
// NetCDF files open for reading: the variables of all groups, and their values as the attributes tell them
// (NetCDF User Guide, appendix A; CF 1.11, sections 2.5 and 8.1).

#include <netcdf.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "files/nodes.h"
#include "files/text_file.h"

namespace files {

/// What the header says of a variable.
struct NetcdfVariable {
  std::string path;  ///< "lon", or of a group "observations/lon"
  int group = -1, id = -1;
  nc_type type = NC_CHAR;
  std::vector<int> dimensions = {};
  std::vector<std::size_t> lengths = {};

  std::string name() const { return path.substr(path.rfind('/') + 1); }
  bool has_numbers() const { return type != NC_CHAR && type <= NC_UINT64; }
  /// The dimensions without those of length 1, such as WRF's Time, before and after the others; at least one.
  std::vector<int> dimensions_of_places() const;
  /// True if the dimensions are those of the nodes, and others of length 1.
  bool is_of(const std::vector<int>& nodes) const;
};

/// A NetCDF file. Errors are std::runtime_error: one line with the file and the variable.
class NetcdfFile {
 public:
  /// `contents`: the file, if it came through a pipe; else empty.
  NetcdfFile(const std::string& name, const std::string& contents, const ReadOptions& options);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  const ReadOptions& options() const { return options_; }
  template <class... Values>
  [[noreturn]] void fail(fmt::format_string<Values...> what, Values&&... values) const {
    files::fail(name_, what, std::forward<Values>(values)...);
  }

  const std::vector<NetcdfVariable>& variables() const { return variables_; }
  std::vector<std::string> names() const;
  /// The variable with this path, or the only one with this name. An attribute of a variable `from` means the
  /// nearest: that in the group of `from`, else in the groups around it (CF 1.11, section 2.7). Null: none.
  const NetcdfVariable* find(const std::string& name, const NetcdfVariable* from = nullptr) const;
  /// The same; throws if there is none.
  const NetcdfVariable& variable(const std::string& name, const NetcdfVariable* from = nullptr) const;

  /// An attribute, "" if it is none or no text.
  std::string text(const NetcdfVariable& v, const char* attribute) const;
  /// Has the attributes of the file.
  NetcdfVariable global() const { return {"", id_, NC_GLOBAL}; }
  std::vector<std::string> attributes(const NetcdfVariable& v) const;  ///< their names
  /// The numbers of an attribute, also one that is written as a text; empty: there are none.
  std::vector<double> numbers(const NetcdfVariable& v, const char* attribute) const;
  double number(const NetcdfVariable& v, const char* attribute, double otherwise) const;

  /// The values: `_Unsigned` applied, then NaN for what is missing or out of the valid range, then scale and
  /// offset, in double precision. Missing are `_FillValue` or, without it, the library's fill value, except
  /// of bytes; all numbers of `missing_value`; and what is not finite. The valid range is that of the stored
  /// numbers, unless only the unpacked ones can be of its type.
  std::vector<double> values(const NetcdfVariable& v) const;
  /// True if scale or offset change the values.
  bool is_packed(const NetcdfVariable& v) const;
  /// The texts of a variable of characters, which has a dimension more, or of strings; of integers beyond
  /// 2^53 their digits, and "" for what is missing.
  std::vector<std::string> texts(const NetcdfVariable& v) const;

  /// Returns `rows`. A header of a few bytes can announce any number of values.
  std::size_t expect_few(const NetcdfVariable& v, std::size_t rows, std::size_t row) const;
  std::string dimension_name(int dimension) const;
  std::size_t length_of(int dimension) const;
  /// "T(time=12, lat=96)".
  std::string shape(const std::string& name, const std::vector<int>& dimensions) const;

  /// Throws if the status of a call of NetCDF's is an error.
  void check(const std::string& variable, int status) const;

 private:
  void add_group(int group, const std::string& path);

  std::string name_;
  const ReadOptions& options_;
  std::vector<NetcdfVariable> variables_;
  int id_ = -1;
  std::string_view mapped_;
};

}  // namespace files
