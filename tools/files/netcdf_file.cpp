#include "files/netcdf_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netcdf_mem.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "files/nearest.h"
#include "files/text_file.h"
#include "lists/limits.h"
#include "numbers.h"

namespace files {
namespace {

/// The bytes of a file, mapped into memory; empty: it cannot be.
std::string_view mapped(const std::string& name) {
  struct stat status {};
  const int file = open(name.c_str(), O_RDONLY);
  void* begin = MAP_FAILED;
  if (file >= 0 && fstat(file, &status) == 0 && status.st_size > 0)
    begin = mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, file, 0);
  if (file >= 0) close(file);
  if (begin == MAP_FAILED) return {};
  return {static_cast<const char*>(begin), static_cast<std::size_t>(status.st_size)};
}

/// What NetCDF's types of numbers hold, by nc_type.
constexpr int kBits[] = {0, 8, 0, 16, 32, 0, 0, 8, 16, 32, 64, 64};  // of integers; 0: floating point

/// The stored numbers of a variable as its type and `_Unsigned` mean them.
struct Stored {
  int bits;  ///< of integers; 0: floating point
  bool is_float, has_sign, is_unsigned;
  double count;  ///< of the integers of the type
  double fill;   ///< the library's fill value

  Stored(nc_type type, const std::string& attribute)
      : bits(kBits[type]),
        is_float(type == NC_FLOAT),
        has_sign(type <= NC_DOUBLE || type == NC_INT64),
        is_unsigned(has_sign ? attribute == "true" || attribute == "True"
                             : attribute != "false" && attribute != "False"),
        count(std::ldexp(1, bits)),
        fill(bits == 0  ? NC_FILL_DOUBLE
             : has_sign ? 1 - count / 2
                        : count - 1) {}
  double number(double value) const {
    if (is_float) return static_cast<double>(static_cast<float>(value));
    if (bits == 0 || is_unsigned != has_sign) return value;
    if (is_unsigned) return value < 0 ? value + count : value;
    return value >= count / 2 ? value - count : value;
  }
};

}  // namespace

std::vector<int> NetcdfVariable::dimensions_of_places() const {
  std::size_t begin = 0, end = lengths.size();
  while (begin + 1 < end && lengths[begin] == 1) ++begin;
  while (begin + 1 < end && lengths[end - 1] == 1) --end;
  return {dimensions.begin() + static_cast<std::ptrdiff_t>(begin),
          dimensions.begin() + static_cast<std::ptrdiff_t>(end)};
}

bool NetcdfVariable::is_of(const std::vector<int>& nodes) const {
  std::vector<int> own;
  for (std::size_t d = 0; d < dimensions.size(); ++d)
    if (std::find(nodes.begin(), nodes.end(), dimensions[d]) != nodes.end())
      own.push_back(dimensions[d]);
    else if (lengths[d] != 1)
      return false;
  return !nodes.empty() && own == nodes;
}

NetcdfFile::NetcdfFile(const std::string& name, const std::string& contents, const ReadOptions& options)
    : name_(name), options_(options) {
  if (contents.empty()) mapped_ = mapped(name);
  const std::string_view bytes = contents.empty() ? mapped_ : contents;
  if (bytes.substr(0, 3) != "CDF" && contents.empty())
    check("", nc_open(name.c_str(), NC_NOWRITE, &id_));
  else  // in memory, since libnetcdf reads what a truncated file in a classic format lacks as zeros
    check("", nc_open_mem(name.c_str(), NC_NOWRITE, bytes.size(), const_cast<char*>(bytes.data()), &id_));
  add_group(id_, "");
}

NetcdfFile::~NetcdfFile() {
  nc_close(id_);
  if (!mapped_.empty()) munmap(const_cast<char*>(mapped_.data()), mapped_.size());
}

void NetcdfFile::add_group(int group, const std::string& path) {
  char name[NC_MAX_NAME + 1];
  int count = 0;
  check("", nc_inq_nvars(group, &count));
  for (int id = 0; id < count; ++id) {
    nc_type type = NC_CHAR;
    int rank = 0, dimensions[NC_MAX_VAR_DIMS];
    check("", nc_inq_var(group, id, name, &type, &rank, dimensions, nullptr));
    NetcdfVariable& v = variables_.emplace_back(
        NetcdfVariable{path + name, group, id, type, {dimensions, dimensions + rank}});
    for (const int dimension : v.dimensions) v.lengths.push_back(length_of(dimension));
  }
  check("", nc_inq_grps(group, &count, nullptr));
  std::vector<int> groups(static_cast<std::size_t>(count));
  check("", nc_inq_grps(group, &count, groups.data()));
  for (const int inner : groups) {
    check("", nc_inq_grpname(inner, name));
    add_group(inner, path + name + "/");
  }
}

void NetcdfFile::check(const std::string& variable, int status) const {
  if (status != NC_NOERR)
    fail("{}{}", variable.empty() ? "" : "variable " + excerpt(variable) + ": ",
         status == EPERM ? "incomplete NetCDF file: it ends before its last value" : nc_strerror(status));
}

std::vector<std::string> NetcdfFile::names() const {
  std::vector<std::string> all;
  for (const NetcdfVariable& v : variables_) all.push_back(v.path);
  return all;
}

const NetcdfVariable* NetcdfFile::find(const std::string& name, const NetcdfVariable* from) const {
  const std::string word =
      name.substr(name.find_first_not_of('/') == name.npos ? 0 : name.find_first_not_of('/'));
  const auto with_path = [&](const std::string& path) -> const NetcdfVariable* {
    for (const NetcdfVariable& v : variables_)
      if (v.path == path) return &v;
    return nullptr;
  };
  if (from != nullptr && word == name)
    for (std::string group = from->path; group.find('/') != group.npos;) {
      group.resize(group.rfind('/'));
      if (const NetcdfVariable* const v = with_path(group + "/" + word)) return v;
    }
  if (const NetcdfVariable* const v = with_path(word)) return v;
  const NetcdfVariable* found = nullptr;
  for (const NetcdfVariable& v : variables_)
    if (v.name() == word) {
      if (found != nullptr) return nullptr;
      found = &v;
    }
  return found;
}

const NetcdfVariable& NetcdfFile::variable(const std::string& name, const NetcdfVariable* from) const {
  const NetcdfVariable* const found = find(name, from);
  if (found == nullptr)
    fail("there is no variable '{}'{}; the file has {}", excerpt(name), did_you_mean(name, names()),
         listed(names()));
  return *found;
}

std::string NetcdfFile::text(const NetcdfVariable& v, const char* attribute) const {
  std::string text;
  nc_type type = NC_CHAR;
  std::size_t length = 0;
  if (nc_inq_att(v.group, v.id, attribute, &type, &length) != NC_NOERR) return text;
  if (type == NC_CHAR) {
    text.resize(length);
    check(attribute, nc_get_att_text(v.group, v.id, attribute, text.data()));
  } else if (type == NC_STRING && length == 1) {
    char* string = nullptr;
    check(attribute, nc_get_att_string(v.group, v.id, attribute, &string));
    if (string != nullptr) text = string;
    nc_free_string(1, &string);
  }
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();  // of Fortran
  return text;
}

std::vector<std::string> NetcdfFile::attributes(const NetcdfVariable& v) const {
  int count = 0;
  check(v.path, nc_inq_varnatts(v.group, v.id, &count));
  std::vector<std::string> names;
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1];
    check(v.path, nc_inq_attname(v.group, v.id, a, name));
    names.emplace_back(name);
  }
  return names;
}

std::vector<double> NetcdfFile::numbers(const NetcdfVariable& v, const char* attribute) const {
  nc_type type = NC_CHAR;
  std::size_t length = 0;
  if (nc_inq_att(v.group, v.id, attribute, &type, &length) != NC_NOERR) return {};
  if (type == NC_CHAR || type == NC_STRING) {
    double value = 0;
    return point_sets::parse(text(v, attribute), value) ? std::vector{value} : std::vector<double>{};
  }
  std::vector<double> values(length);
  return nc_get_att_double(v.group, v.id, attribute, values.data()) == NC_NOERR ? values
                                                                                : std::vector<double>{};
}

double NetcdfFile::number(const NetcdfVariable& v, const char* attribute, double otherwise) const {
  const std::vector<double> found = numbers(v, attribute);
  return found.size() == 1 ? found[0] : otherwise;
}

bool NetcdfFile::is_packed(const NetcdfVariable& v) const {
  return number(v, "scale_factor", 1) != 1 || number(v, "add_offset", 0) != 0;
}

std::vector<double> NetcdfFile::values(const NetcdfVariable& v) const {
  std::size_t size = 1;
  for (const std::size_t length : v.lengths) size *= expect_few(v, length, size);
  std::vector<double> values(size);
  check(v.path, nc_get_var_double(v.group, v.id, values.data()));

  const Stored stored(v.type, text(v, "_Unsigned"));
  std::vector<double> missing = numbers(v, "_FillValue");
  if (missing.empty() && stored.bits != 8) missing.push_back(stored.fill);
  for (const double value : numbers(v, "missing_value")) missing.push_back(value);
  for (double& value : missing) value = stored.number(value);

  const double scale = number(v, "scale_factor", 1), offset = number(v, "add_offset", 0);
  const bool packed = is_packed(v);
  std::vector<double> range = numbers(v, "valid_range");
  nc_type type = v.type;
  for (const char* const attribute : {"valid_range", "valid_min", "valid_max"})
    nc_inq_atttype(v.group, v.id, attribute, &type);
  const bool is_unpacked_range = packed && stored.bits > 0 && (type == NC_FLOAT || type == NC_DOUBLE);
  if (range.size() != 2) range = {number(v, "valid_min", -INFINITY), number(v, "valid_max", INFINITY)};
  if (!is_unpacked_range)
    for (double& bound : range) bound = std::isfinite(bound) ? stored.number(bound) : bound;
  const auto is_out = [&](double value) { return value < range[0] || value > range[1]; };

  for (double& value : values) {
    value = stored.number(value);
    if (!std::isfinite(value) || std::find(missing.begin(), missing.end(), value) != missing.end() ||
        (!is_unpacked_range && is_out(value)))
      value = std::nan("");
    else if (packed)  // else -0 would become 0
      value = value * scale + offset;
    if (is_unpacked_range && is_out(value)) value = std::nan("");
  }
  return values;
}

std::vector<std::string> NetcdfFile::texts(const NetcdfVariable& v) const {
  std::size_t size = 1;
  for (const std::size_t length : v.lengths) size *= expect_few(v, length, size);
  std::vector<std::string> texts;
  if (v.type == NC_CHAR) {  // of equal length, padded with zeros or blanks
    const std::size_t length = v.lengths.back();
    std::size_t count = 1;
    for (std::size_t d = 0; d + 1 < v.lengths.size(); ++d) count *= expect_few(v, v.lengths[d], count);
    std::string bytes(size, '\0');
    check(v.path, nc_get_var_text(v.group, v.id, bytes.data()));
    for (std::size_t i = 0; i < count; ++i) {
      std::string text = bytes.substr(i * length, length);
      text.resize(std::min(text.size(), text.find('\0')));
      text.resize(text.find_last_not_of(' ') + 1);
      texts.push_back(std::move(text));
    }
  } else if (v.type == NC_STRING) {
    std::vector<char*> strings(size);
    check(v.path, nc_get_var_string(v.group, v.id, strings.data()));
    for (const char* const string : strings) texts.emplace_back(string == nullptr ? "" : string);
    nc_free_string(size, strings.data());
  } else {
    std::vector<unsigned long long> whole(size);
    const bool is_unsigned = Stored(v.type, text(v, "_Unsigned")).is_unsigned;
    check(v.path, v.type == NC_UINT64
                      ? nc_get_var_ulonglong(v.group, v.id, whole.data())
                      : nc_get_var_longlong(v.group, v.id, reinterpret_cast<long long*>(whole.data())));
    const std::vector<double> numbers = values(v);
    for (std::size_t i = 0; i < size; ++i)
      texts.push_back(std::isnan(numbers[i]) ? ""
                      : is_unsigned          ? std::to_string(whole[i])
                                             : std::to_string(static_cast<long long>(whole[i])));
  }
  return texts;
}

std::size_t NetcdfFile::expect_few(const NetcdfVariable& v, std::size_t rows, std::size_t row) const {
  constexpr std::size_t most = pstripack::most_nodes<std::int32_t>();
  if (rows > most / std::max<std::size_t>(row, 1))
    fail("variable {}: {} times {} values; there can be {} nodes at most", excerpt(v.path), rows, row, most);
  return rows;
}

std::string NetcdfFile::dimension_name(int dimension) const {
  char name[NC_MAX_NAME + 1];
  check("", nc_inq_dimname(id_, dimension, name));
  return excerpt(name);
}

std::size_t NetcdfFile::length_of(int dimension) const {
  std::size_t length = 0;
  check("", nc_inq_dimlen(id_, dimension, &length));
  return length;
}

std::string NetcdfFile::shape(const std::string& name, const std::vector<int>& dimensions) const {
  std::vector<std::string> parts;
  for (const int dimension : dimensions)
    parts.push_back(fmt::format("{}={}", dimension_name(dimension), length_of(dimension)));
  return fmt::format("{}({})", excerpt(name), fmt::join(parts, ", "));
}

}  // namespace files
