#pragma once

#include <exception>
#include <string>

/// The text of the exception that work() throws; "none" if it throws none.
template <class Work>
std::string error_of(const Work& work) {
  try {
    work();
    return "none";
  } catch (const std::exception& e) {
    return e.what();
  }
}
