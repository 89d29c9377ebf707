#pragma once
// The options and functions of the commands of stripack_compare.cpp. Each function returns the exit code.

#include <string>
#include <vector>

#include "chosen_original.h"

namespace comparison {

enum ExitCode { kExplained = 0, kAgainstUs = 1, kUsage = 2 };

/// `stripack-compare lists A B`
struct ListsOptions {
  std::string a, b;
  bool bytes = false;
};
int compare_lists(const ListsOptions& options);

/// `stripack-compare record -- PROGRAM ARGUMENTS`
struct RecordOptions {
  std::string file = "calls.rec";
  std::vector<std::string> command;
};
int record(const RecordOptions& options);

/// `stripack-compare replay FILE`
struct ReplayOptions {
  std::string file;
  OriginalChoice original;
  std::string library;
  double timeout = 120;
  std::size_t show = 5;
  std::string json_file;
};
int replay(const ReplayOptions& options);

}  // namespace comparison
