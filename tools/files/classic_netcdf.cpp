#include "files/classic_netcdf.h"

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "text_file.h"

namespace files {
namespace {

struct Variable {
  std::string_view name;
  std::uint64_t begin = 0, bytes = 0;  ///< of a record if it has records
  bool has_records = false;
};

/// Reads a header from beginning to end. The formats differ in the size of counts and offsets.
class Header {
 public:
  Header(std::string_view file, const std::string& name) : file_(file), name_(name) {
    take(3);
    const int version = static_cast<unsigned char>(take(1)[0]);
    if (version != 1 && version != 2 && version != 5) fail("its format is none of CDF-1, CDF-2 and CDF-5");
    count_size_ = version == 5 ? 8 : 4;
    offset_size_ = version == 1 ? 4 : 8;
  }

  void check() {
    records_ = number(count_size_);
    for (std::uint64_t left = list(kDimensions); left > 0; --left) {
      text();
      lengths_.push_back(number(count_size_));
    }
    skip_attributes();
    std::vector<Variable> variables;
    for (std::uint64_t left = list(kVariables); left > 0; --left) variables.push_back(variable());
    check_extents(variables);
  }

 private:
  static constexpr std::uint64_t kDimensions = 10, kVariables = 11, kAttributes = 12;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: damaged or incomplete NetCDF file: {}", name_, what));
  }
  /// Throws if the product is more than the file has bytes.
  std::uint64_t product(std::uint64_t a, std::uint64_t b, std::string_view of) const {
    if (b > 0 && a > file_.size() / b)
      fail(fmt::format("{} is longer than the file",
                       of.empty() ? "its header" : "variable " + point_sets::excerpt(of)));
    return a * b;
  }
  std::string_view take(std::uint64_t size) {
    if (size > file_.size() - at_) fail("it ends within the header");
    const std::string_view bytes = file_.substr(at_, size);
    at_ += size;
    return bytes;
  }
  std::uint64_t number(std::uint64_t size) {
    std::uint64_t value = 0;
    for (const char c : take(size)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  }
  std::string_view padded(std::uint64_t size) {
    const std::string_view bytes = take(size);
    take((4 - size % 4) % 4);
    return bytes;
  }
  std::string_view text() { return padded(number(count_size_)); }
  std::uint64_t size_of(std::uint64_t type) const {
    constexpr std::uint64_t kSizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    if (type < 1 || type > 11) fail(fmt::format("there is no type {}", type));
    return kSizes[type];
  }
  /// The number of items in a list of dimensions, attributes or variables.
  std::uint64_t list(std::uint64_t of) {
    const std::uint64_t tag = number(4), count = number(count_size_);
    if (tag != of && (tag != 0 || count != 0)) fail("its header has a list of an unknown kind");
    return count;
  }
  void skip_attributes() {
    for (std::uint64_t left = list(kAttributes); left > 0; --left) {
      text();
      const std::uint64_t size = size_of(number(4));
      padded(product(number(count_size_), size, ""));
    }
  }
  Variable variable() {
    Variable v;
    v.name = text();
    std::uint64_t values = 1;
    const std::uint64_t rank = number(count_size_);
    for (std::uint64_t d = 0; d < rank; ++d) {
      const std::uint64_t dimension = number(count_size_);
      if (dimension >= lengths_.size()) fail(fmt::format("there is no dimension {}", dimension));
      if (d == 0 && lengths_[dimension] == 0)
        v.has_records = true;
      else
        values = product(values, lengths_[dimension], v.name);
    }
    skip_attributes();
    v.bytes = product(values, size_of(number(4)), v.name);
    number(count_size_);  // the size once more, which may be wrong if it is above 2^32
    v.begin = number(offset_size_);
    return v;
  }
  void check_extents(const std::vector<Variable>& variables) const {
    std::uint64_t record = 0, with_records = 0, only = 0;
    for (const Variable& v : variables)
      if (v.has_records) {
        ++with_records;
        only = v.bytes;
        record += (v.bytes + 3) / 4 * 4;
        if (record > file_.size() + 3 && records_ > 0) fail("its records are longer than the file");
      }
    if (with_records == 1) record = only;  // not padded
    for (const Variable& v : variables) {
      if (v.has_records && records_ == 0) continue;
      const std::uint64_t before = v.has_records ? product(records_ - 1, record, v.name) : 0;
      if (v.bytes > 0 && (v.begin > file_.size() || before > file_.size() - v.begin ||
                          v.bytes > file_.size() - v.begin - before))
        fail(fmt::format("variable {} ends behind the end of the file", point_sets::excerpt(v.name)));
    }
  }

  std::string_view file_;
  const std::string& name_;
  std::uint64_t at_ = 0, count_size_ = 4, offset_size_ = 4, records_ = 0;
  std::vector<std::uint64_t> lengths_;
};

}  // namespace

void check_classic_netcdf(std::string_view file, const std::string& name) { Header(file, name).check(); }

}  // namespace files
