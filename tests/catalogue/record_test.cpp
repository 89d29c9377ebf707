// Compares the original's and our result for every input of the catalogue with the record: record.txt, or for
// the point files of tests/data the comments at their beginning. The original runs in its own process with a
// time limit.
//
// `record_test --print SECONDS` prints the lines of record.txt and tests/data anew, with that time limit.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>

#include "behaviour.h"
#include "inputs.h"
#include "support/data_file.h"

namespace {

struct Recorded {
  Input input;
  std::string original, ours;  ///< empty: not recorded
};
void PrintTo(const Recorded& r, std::ostream* out) { *out << r.input.name; }

/// The rest of the first line of the file that begins with `key`.
std::string line_of(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.compare(0, key.size(), key) == 0) return line.substr(key.size());
  return "";
}

std::vector<Recorded> all_recorded() {
  std::vector<Recorded> all;
  for (const Input& input : generated_inputs())
    all.push_back(
        {input, line_of(RECORD, input.name + " original: "), line_of(RECORD, input.name + " ours: ")});
  for (const auto& entry : std::filesystem::directory_iterator(TEST_DATA_DIR)) {
    if (entry.path().extension() != ".txt") continue;
    const std::string path = entry.path();
    std::string name = "file_" + entry.path().stem().string();
    std::replace(name.begin(), name.end(), '-', 'm');
    all.push_back({{name, [path] { return nodes_in(path); }},
                   line_of(path, "# original: "),
                   line_of(path, "# ours: ")});
  }
  std::sort(all.begin(), all.end(),
            [](const Recorded& a, const Recorded& b) { return a.input.name < b.input.name; });
  return all;
}

class Catalogue : public ::testing::TestWithParam<Recorded> {};

TEST_P(Catalogue, OursIsAsRecorded) {
  const Nodes nodes = GetParam().input.nodes();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(our_behaviour(nodes), GetParam().ours);
  ::testing::internal::GetCapturedStderr();
  const std::regex no_fault("-?[0-9]+|0: [0-9]+ triangles?, [0-9]+ boundary nodes");
  EXPECT_TRUE(std::regex_match(GetParam().ours, no_fault)) << GetParam().ours;
}

#ifdef HAVE_NGMATH
TEST_P(Catalogue, OriginalIsAsRecorded) {
  // If it should return, give it the time that a loaded machine may need.
  const bool hangs = GetParam().original == "does not return";
  EXPECT_EQ(original_behaviour(GetParam().input.nodes(), hangs ? 0.2 : 100), GetParam().original);
}
#endif

INSTANTIATE_TEST_SUITE_P(Of, Catalogue, ::testing::ValuesIn(all_recorded()),
                         [](const auto& info) { return info.param.input.name; });

void print_all(double time_limit) {
  for (const Recorded& r : all_recorded()) {
    const Nodes nodes = r.input.nodes();
    std::cout << r.input.name << " original: " << original_behaviour(nodes, time_limit) << '\n'
              << r.input.name << " ours: " << our_behaviour(nodes) << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "--print") {
    print_all(std::stod(argv[2]));
    return 0;
  }
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
