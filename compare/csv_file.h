#pragma once
// A CSV file to which successive runs add rows.

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

class CsvFile {
 public:
  /// Writes the column names into a new or empty file. Throws std::runtime_error if the file cannot be
  /// written or has other columns.
  CsvFile(const std::string& file, const std::string& columns) : name_(file) {
    std::string first;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored))  // a device may have no end
      if (std::ifstream old(file); std::getline(old, first) && first != columns)
        throw std::runtime_error(file + ":1: has other columns than " + columns);
    out_.open(file, std::ios::app);
    if (first.empty()) out_ << columns << std::endl;
    check();
  }
  /// Written at once: an interrupted run keeps its rows.
  void row(const std::string& values) {
    out_ << values << std::endl;
    check();
  }

 private:
  void check() const {
    if (!out_) throw std::runtime_error(name_ + ": cannot write");
  }
  std::string name_;
  std::ofstream out_;
};
