#pragma once
// Results in JSON, for programs.

#include <memory>
#include <string>

#include "calls.h"
#include "case_files.h"

namespace comparison {

/// Writes an array of results, and what they have in common.
class JsonFile {
 public:
  /// Throws std::runtime_error if the file cannot be written; so do the functions that write.
  explicit JsonFile(const std::string& file);
  ~JsonFile();

  void add(const Case& one, double timeout);
  /// `result`: has no nodes if nothing was compared.
  void add(const Call& call, const Result& result, const std::string& kind, const std::string& text,
           double timeout);

  void write_cases(const Summary& summary, int exit_code);
  void write_calls(const std::string& recording, const std::string& original, int exit_code);

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace comparison
