#pragma once
// Results of many cases: a line per case on stdout, CSV for plots, JUnit XML for continuous integration.

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

/// How many cases ended in each way.
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

/// The number of differing places by reason: "none", "12 ties, 3 rounding".
std::string differences_in_short(const Result& result);

void print_header_of_cases();
void print_line(const Case& one);

/// A CSV file with one row per call of ours.
class CsvFile {
 public:
  /// Throws std::runtime_error if the file cannot be written; so do all functions.
  explicit CsvFile(const std::string& file);
  void add(const Case& one);

 private:
  std::string name_;
  std::ofstream out_;
};

/// A JUnit file with one test per case; the test fails if the case counts against us.
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
