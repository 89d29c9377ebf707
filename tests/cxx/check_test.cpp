// PSTRIPACK_CHECK. The library reads it when it is loaded, so every case runs this program again.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "observe/recorded_block.h"
#include "point_sets.h"
#include "support/expect.h"
#include "support/this_program.h"
#include "support/trmesh.h"

namespace {

using pstripack::BlockHeader;

const std::string kToFile = "PSTRIPACK_CHECK=calls.rec";

struct Block {
  BlockHeader header;
  std::string body;
};

/// The blocks of folder/calls.rec, which must all be whole.
std::vector<Block> blocks(const Folder& folder) {
  std::vector<Block> all;
  const std::string stream = contents(folder.path() + "/calls.rec");
  for (std::size_t at = 0; at < stream.size();) {
    Block block;
    if (stream.size() - at < sizeof block.header) {
      ADD_FAILURE() << "half a header";
      break;
    }
    std::memcpy(&block.header, stream.data() + at, sizeof block.header);
    at += sizeof block.header;
    if (std::memcmp(block.header.magic, "PSTRIREC", 8) != 0 || block.header.body_bytes < 0 ||
        stream.size() - at < static_cast<std::size_t>(block.header.body_bytes)) {
      ADD_FAILURE() << "not a whole block";
      break;
    }
    block.body = stream.substr(at, static_cast<std::size_t>(block.header.body_bytes));
    at += block.body.size();
    all.push_back(block);
  }
  return all;
}

template <class T>
std::string bytes(const std::vector<T>& values, std::size_t count) {
  return {reinterpret_cast<const char*>(values.data()), count * sizeof(T)};
}

std::string input_of(const Nodes& nodes) {
  const Columns c(nodes);
  return bytes(c.x, nodes.size()) + bytes(c.y, nodes.size()) + bytes(c.z, nodes.size());
}
std::string output_of(const Mesh& m, std::size_t nodes) {
  const auto slots = static_cast<std::size_t>(m.lnew) - 1;
  return bytes(m.list, slots) + bytes(m.lptr, slots) + bytes(m.lend, nodes);
}

TEST(Check, IsOffUnlessAskedFor) {
  const Folder folder;
  for (const char* environment : {"env -u PSTRIPACK_CHECK", "PSTRIPACK_CHECK="}) {
    const Outcome outcome = run_self(folder, environment, "calls random 1000 2");
    EXPECT_EQ(outcome.out + outcome.err, "") << environment;
    EXPECT_EQ(std::system(("test \"$(ls " + folder.path() + ")\" = \"$(printf 'err\\nout')\"").c_str()), 0);
  }
}

TEST(Check, RecordsTheBytesOfInputAndOutput) {
  const Folder folder;
  const Outcome outcome = run_self(folder, kToFile, "calls cap 500 2");
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Nodes nodes = point_sets::make("cap", 500);
  const Mesh mesh = trmesh(nodes);
  const auto all = blocks(folder);
  ASSERT_EQ(all.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const BlockHeader& header = all[i].header;
    const bool is_input = i % 2 == 0;
    EXPECT_EQ(header.byte_order, 0x01020304u);
    EXPECT_EQ(header.version, 1u);
    EXPECT_EQ(header.kind, is_input ? 1u : 2u);
    EXPECT_EQ(header.routine, 1u);
    EXPECT_EQ(header.real_bytes, 8u);
    EXPECT_EQ(header.integer_bytes, 4u);
    EXPECT_EQ(header.process, all[0].header.process);
    EXPECT_EQ(header.call, i < 2 ? 1 : 2);
    EXPECT_EQ(header.n, static_cast<std::int64_t>(nodes.size()));
    EXPECT_EQ(header.ier, 0);
    EXPECT_EQ(header.nodes, is_input ? 0 : header.n);
    EXPECT_EQ(header.lnew, is_input ? 0 : mesh.lnew);
    EXPECT_EQ(header.nanoseconds > 0, !is_input);
    EXPECT_EQ(all[i].body, is_input ? input_of(nodes) : output_of(mesh, nodes.size()));
  }
}

TEST(Check, RecordsEveryCode) {
  const Folder folder;
  run_self(folder, kToFile, "codes");
  const auto all = blocks(folder);
  ASSERT_EQ(all.size(), 10u);
  const struct {
    int n, ier, nodes;
  } expected[] = {{2, -1, 0}, {100, -2, 0}, {100, -5, 0}, {100, 31, 70}, {1 << 30, -4, 0}};
  for (std::size_t i = 0; i < 5; ++i) {
    const Block &input = all[2 * i], &output = all[2 * i + 1];
    EXPECT_EQ(output.header.n, expected[i].n);
    EXPECT_EQ(output.header.ier, expected[i].ier);
    EXPECT_EQ(output.header.nodes, expected[i].nodes);
    EXPECT_EQ(input.body.size(), expected[i].n == 100 ? 2400u : 0u) << "only what TRMESH reads";
    EXPECT_EQ(output.body.empty(), output.header.ier < 0);
  }
  Nodes nodes = point_sets::make("random", 100);
  std::swap(nodes[2], nodes[50]);
  nodes[70] = nodes[30];
  EXPECT_EQ(all[7].body, output_of(trmesh(nodes), 70));
}

TEST(Check, RecordsSinglePrecisionAsItIs) {
  const Folder folder;
  run_self(folder, kToFile, "single");
  const auto all = blocks(folder);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].header.real_bytes, 4u);
  const std::vector<float> octahedron{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  EXPECT_EQ(all[0].body, bytes(octahedron, 18));
  EXPECT_EQ(all[1].body.size(), (24 + 24 + 6) * 4u);
}

TEST(Check, IsAppendedToTheFileOfTheFolderWhereTheProgramBegan) {
  const Folder folder;
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = run_self(folder, kToFile, "elsewhere random 1000 1");
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  const auto all = blocks(folder);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NE(all[0].header.process, all[2].header.process);
}

/// Every call of every process is recorded once, its input before its output.
void expect_calls(const std::vector<Block>& all, std::size_t processes, std::size_t calls_of_each) {
  std::map<std::uint64_t, std::map<std::int64_t, std::vector<std::uint32_t>>> kinds;
  for (const Block& b : all) kinds[b.header.process][b.header.call].push_back(b.header.kind);
  EXPECT_EQ(kinds.size(), processes);
  for (const auto& [process, calls] : kinds) {
    EXPECT_EQ(calls.size(), calls_of_each);
    EXPECT_EQ(calls.begin()->first, 1);
    EXPECT_EQ(calls.rbegin()->first, static_cast<std::int64_t>(calls_of_each));
    for (const auto& [call, kind] : calls) EXPECT_EQ(kind, (std::vector<std::uint32_t>{1, 2}));
  }
}

TEST(Check, KeepsTheBlocksOfThreadsAndProcessesWhole) {
  for (const auto& [arguments, processes, calls_of_each] : {std::tuple{"threads random 500 16", 1u, 16u},
                                                            {"processes random 3000 4", 4u, 5u},
                                                            {"fork random 500 1", 2u, 2u}}) {
    const Folder folder;
    run_self(folder, kToFile, arguments);
    expect_calls(blocks(folder), processes, calls_of_each);
  }
}

TEST(Check, HasTheInputOfACallThatCrashes) {
  const Folder folder;
  run_self(folder, kToFile, "crash random 500 1", false);
  const auto all = blocks(folder);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2].header.kind, 1u);
  EXPECT_EQ(all[2].body, input_of(point_sets::make("random", 500)));
}

TEST(Check, WarnsOnceOfAFileThatCannotBeWrittenAndGoesOn) {
  const Folder folder;
  ASSERT_EQ(std::system(("mkfifo " + folder.path() + "/pipe " + folder.path() + "/read").c_str()), 0);
  const int reader = open((folder.path() + "/read").c_str(), O_RDONLY | O_NONBLOCK);
  for (const std::string path : {"/proc/no/such/folder", "/tmp", "/dev/full", "pipe", "read"}) {
    const Outcome outcome = run_self(folder, "PSTRIPACK_CHECK=" + path, "calls random 100 3");
    EXPECT_EQ(outcome.out, "");
    expect_line(outcome.err, "pstripack: PSTRIPACK_CHECK: ", path + ": ");
  }
  close(reader);
}

TEST(Check, LeavesNoHalfBlockWhereTheDiskIsFull) {
  const Folder folder;
  // 80 times 512 bytes, not more; a call of 500 nodes takes 38,112.
  const Outcome outcome = run_self(folder, "trap '' XFSZ; ulimit -f 80; " + kToFile, "calls random 500 5");
  expect_line(outcome.err, "pstripack: ", "calls.rec: File too large");
  EXPECT_EQ(blocks(folder).size(), 2u);
}

TEST(Check, BesideTheModelMayFailToStart) {
  const Folder folder;
  const std::string program = "PSTRIPACK_COMPARE=./missing ";
  for (const auto& [environment, message] : std::vector<std::pair<std::string, std::string>>{
           {program + "PSTRIPACK_CHECK=lib:", "cannot run ./missing"},
           {program + "PSTRIPACK_CHECK=lib:,log=/no/such/log", "/no/such/log"},
           {program + "PSTRIPACK_CHECK=lib:a.so,speed=3",
            "'speed=3': expected abi=, timeout=, show= or log="},
           {program + "PSTRIPACK_CHECK=lib:a.so,show=", "'show=': expected abi=, timeout=, show= or log="},
           {program + "PSTRIPACK_CHECK=lib:a.so,timeout=3s", "'timeout=3s': expected seconds"},
           {program + "PSTRIPACK_CHECK=lib:a.so,timeout=soon", "'timeout=soon': expected seconds"},
           {"PSTRIPACK_COMPARE=/bin/false PSTRIPACK_CHECK=lib:", "stripack-compare has ended"}}) {
    const Outcome outcome = run_self(folder, environment, "calls random 5000 3");
    EXPECT_EQ(outcome.out, "");
    expect_line(outcome.err, "pstripack: ", message);
  }
}

/// A program in place of stripack-compare, which is a shell script.
void write_program(const Folder& folder, const std::string& script) {
  const std::string path = folder.path() + "/program";
  std::ofstream(path) << "#!/bin/sh\n" << script << '\n';
  ASSERT_EQ(std::system(("chmod +x " + path).c_str()), 0);
}

TEST(Check, BesideTheModelGetsTheStreamAndItsSettingsButNoVariablesOfTheJob) {
  const Folder folder;
  write_program(folder,
                "echo \"$@\" > words; env > variables; ls /proc/self/fd > files; cat > calls.rec; echo log");
  const Outcome outcome = run_self(folder,
                                   "OMPI_COMM_WORLD_RANK=0 PMIX_RANK=0 PSTRIPACK_COMPARE=./program "
                                   "PSTRIPACK_CHECK=lib:old.so,abi=8arg,timeout=3,show=7",
                                   "calls random 500 2");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "log\n") << "its stdout is the model's stderr";
  EXPECT_EQ(contents(folder.path() + "/words"),
            "replay - --timeout 3 --original " + folder.path() + "/old.so --original-abi 8arg --show 7\n");
  const std::string variables = contents(folder.path() + "/variables");
  for (const char* prefix : {"OMPI_", "PMIX_", "PSTRIPACK_"})
    EXPECT_EQ(variables.find(prefix), std::string::npos) << prefix;
  EXPECT_EQ(lines(contents(folder.path() + "/files")).size(), 4u) << "0, 1, 2 and that of ls";
  expect_calls(blocks(folder), 1, 2);
}

TEST(Check, BesideTheModelDoesNotHoldItUpForEver) {
  const Folder folder;
  write_program(folder, "exec > /dev/null 2>&1; cat > /dev/null; sleep 30");
  const Outcome outcome =
      run_self(folder, "PSTRIPACK_COMPARE=./program PSTRIPACK_CHECK=lib:,timeout=0.1", "calls random 500 1");
  expect_line(outcome.err, "pstripack: ", "the check of its last calls goes on");
}

TEST(Check, BesideAForkedChildIsAProgramOfItsOwn) {
  const Folder folder;
  write_program(folder, "cat > stream.$$; cat stream.$$ >> calls.rec");
  run_self(folder, "PSTRIPACK_COMPARE=./program PSTRIPACK_CHECK=lib:", "fork random 500 1");
  expect_calls(blocks(folder), 2, 2);
  EXPECT_EQ(std::system(("test $(ls " + folder.path() + "/stream.* | wc -l) -eq 2").c_str()), 0);
}

TEST(Check, WritesToNoFileThatTheModelHasOpenedInPlaceOfTheSocket) {
  const Folder folder;
  write_program(folder, "cat > part; mv part calls.rec");
  const Outcome outcome =
      run_self(folder, "PSTRIPACK_COMPARE=./program PSTRIPACK_CHECK=lib:", "closes random 500 1");
  // The model has closed the socket, so it cannot wait for the program beside it.
  const std::string is_there = "test -e " + folder.path() + "/calls.rec";
  for (int wait = 0; wait < 1000 && std::system(is_there.c_str()) != 0; ++wait) usleep(10000);
  EXPECT_EQ(contents(folder.path() + "/own"), "");
  expect_calls(blocks(folder), 1, 1);
}

/// The program that the cases run. Exit code 0 if all results are as without a check.
int run_as(const std::string& action, const std::string& family, std::size_t n, int count) {
  if (action == "codes") return codes_are_right() ? 0 : 1;
  if (action == "single") {
    const float x[] = {1, 0, 0, -1, 0, 0}, y[] = {0, 1, 0, 0, -1, 0}, z[] = {0, 0, 1, 0, 0, -1};
    std::int32_t list[24], lptr[24], lend[6], lnew;
    return pstripack_trmesh_r4(6, x, y, z, list, lptr, lend, &lnew);
  }
  const Nodes nodes = point_sets::make(family, n);
  if (action == "processes") {
    for (int i = 0; i < count; ++i) {
      if (fork() != 0) continue;
      for (int k = 0; k < 5; ++k) call_trmesh(nodes);
      _exit(0);  // OpenMP's end in a forked child is not what is tested: libarcher crashes in it
    }
    int failed = 0;
    for (int status; wait(&status) > 0;) failed += status != 0;
    return failed;
  }
  if (const int code = make_calls(action, nodes, count, "PSTRIPACK_CHECK"); code != 0) return code;
  if (action == "crash") {
    const Columns c(nodes);
    return pstripack_trmesh(static_cast<std::int32_t>(n), c.x.data(), c.y.data(), c.z.data(), nullptr,
                            nullptr, nullptr, nullptr);
  }
  if (action == "closes") {
    for (int file = 3; file < 100; ++file) close(file);
    for (int i = 0; i < 20; ++i)
      if (std::fopen("own", "a") == nullptr) return 1;
    call_trmesh(nodes);
    return 0;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return run_as_or_test(argc, argv, run_as); }
