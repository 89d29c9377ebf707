#pragma once
// Results of many cases: one line per case for people, CSV for plots, JUnit XML for continuous integration.

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "comparison.h"

namespace comparison {

/// A comparison and its settings.
struct Case {
  std::string nodes;  ///< family or file
  std::uint64_t seed;
  std::string order, precision;
  Result result;
  double seconds;  ///< of the whole case
};

/// How many cases ended in which way.
struct Summary {
  std::size_t cases = 0, equal = 0, explained = 0, no_result = 0, against_us = 0;

  void add(const Result& result) {
    ++cases;
    ++(result.against_us()           ? against_us
       : !result.original_returned() ? no_result
       : result.equal()              ? equal
                                     : explained);
  }
};

/// The places where the meshes differ, by reason: "none", "12 ties, 3 rounding".
std::string differences_in_short(const Result& result);

void print_header_of_cases();
void print_line(const Case& one);

/// One row per call of ours.
class CsvFile {
 public:
  /// Throws std::runtime_error if the file cannot be written; so do the other functions.
  explicit CsvFile(const std::string& file);
  void add(const Case& one);

 private:
  std::string name_;
  std::ofstream out_;
};

/// One test case per case; it fails if it counts against us.
class JunitFile {
 public:
  explicit JunitFile(const std::string& file);
  void add(const Case& one, double timeout);
  void write();

 private:
  std::string name_;
  std::ofstream out_;
  std::string cases_;
  std::size_t tests_ = 0, failures_ = 0;
  double seconds_ = 0;
};

}  // namespace comparison
