#include "calls.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "list_files.h"
#include "observe/recorded_block.h"

namespace comparison {
namespace {

using pstripack::BlockHeader;

/// A temporary file with these bytes.
class File {
 public:
  explicit File(const std::string& contents) {
    char name[] = "/tmp/pstripack_calls_XXXXXX";
    close(mkstemp(name));
    path_ = name;
    std::ofstream(path_, std::ios::binary) << contents;
  }
  ~File() { unlink(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

BlockHeader header(BlockHeader::Kind kind, std::int64_t call) {
  BlockHeader h;
  std::memcpy(h.magic, BlockHeader::kMagic, sizeof h.magic);
  h.kind = kind;
  h.real_bytes = 8;
  h.integer_bytes = 4;
  h.process = 77;
  h.process_id = 1234;
  h.call = call;
  h.n = 3;
  return h;
}

template <class T>
std::string block(BlockHeader h, const std::vector<T>& body) {
  h.body_bytes = static_cast<std::int64_t>(body.size() * sizeof(T));
  std::string text(reinterpret_cast<const char*>(&h), sizeof h);
  return text.append(reinterpret_cast<const char*>(body.data()), body.size() * sizeof(T));
}

const std::vector<double> kTriangle{1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::int32_t> kLists{2, -3, 3, -1, 1, -2, 2, 1, 4, 3, 6, 5, 2, 4, 6};

std::string input(std::int64_t call = 1) { return block(header(BlockHeader::input, call), kTriangle); }
BlockHeader output_header(std::int64_t call = 1) {
  BlockHeader h = header(BlockHeader::output, call);
  h.nodes = 3;
  h.lnew = 7;
  h.nanoseconds = 1500;
  return h;
}
std::string output(std::int64_t call = 1) { return block(output_header(call), kLists); }

/// The error for a file with these bytes.
std::string error(const std::string& contents) {
  const File file(contents);
  try {
    CallReader reader(file.path());
    while (reader.next()) {
    }
  } catch (const std::runtime_error& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find(file.path() + ", byte "), 0u) << text;
    return text.substr(file.path().size() + 2);
  }
  return "";
}

TEST(recorded_calls, are_read_as_they_were_written) {
  const File file(input() + output());
  CallReader reader(file.path());
  const auto call = reader.next();
  ASSERT_TRUE(call);
  EXPECT_EQ(call->process, 77u);
  EXPECT_EQ(call->process_id, 1234);
  EXPECT_EQ(call->number, 1);
  EXPECT_EQ(call->n, 3);
  EXPECT_EQ(call->real_bytes, 8u);
  ASSERT_EQ(call->points.size(), 3u);
  EXPECT_EQ(call->points[1].x, 0);
  EXPECT_EQ(call->points[1].y, 1);
  EXPECT_TRUE(call->has_returned);
  EXPECT_EQ(call->nodes, 3u);
  EXPECT_EQ(call->run.ier, 0);
  EXPECT_EQ(call->run.seconds, 1.5e-6);
  EXPECT_EQ(call->run.lists.lnew, 7);
  EXPECT_EQ(call->run.lists.list, std::vector<std::int32_t>(kLists.begin(), kLists.begin() + 6));
  EXPECT_EQ(call->run.lists.lptr, std::vector<std::int32_t>(kLists.begin() + 6, kLists.begin() + 12));
  EXPECT_EQ(call->run.lists.lend, std::vector<std::int32_t>(kLists.begin() + 12, kLists.end()));
  EXPECT_FALSE(reader.next());
}

TEST(recorded_calls, in_single_precision_are_widened) {
  BlockHeader h = header(BlockHeader::input, 1);
  h.real_bytes = 4;
  const File file(block(h, std::vector<float>{1, 0, 0, 0, 0.1F, 0, 0, 0, 1}));
  const auto call = CallReader(file.path()).next();
  ASSERT_TRUE(call);
  EXPECT_EQ(call->real_bytes, 4u);
  EXPECT_EQ(call->points[1].y, static_cast<double>(0.1F));
}

TEST(recorded_calls, may_interleave_and_those_without_a_result_come_last) {
  const File file(input(1) + input(2) + input(3) + output(2) + output(1));
  CallReader reader(file.path());
  for (const auto& [number, has_returned] : {std::pair(2, true), {1, true}, {3, false}}) {
    const auto call = reader.next();
    ASSERT_TRUE(call);
    EXPECT_EQ(call->number, number);
    EXPECT_EQ(call->has_returned, has_returned);
    EXPECT_EQ(call->points.size(), 3u);
  }
  EXPECT_FALSE(reader.next());
}

TEST(recorded_calls, with_a_negative_code_have_no_lists) {
  BlockHeader h = header(BlockHeader::output, 1);
  h.ier = -2;
  const File file(input() + block(h, std::vector<int>{}));
  const auto call = CallReader(file.path()).next();
  ASSERT_TRUE(call);
  EXPECT_EQ(call->run.ier, -2);
  EXPECT_EQ(call->nodes, 0u);
  EXPECT_EQ(call->run.lists.lend, std::vector<std::int32_t>(3, kUntouched));
}

TEST(recorded_calls, that_are_cut_off_are_refused_with_the_byte) {
  const std::string whole = input() + output();
  EXPECT_EQ(error(whole), "");
  for (std::size_t size = 1; size < whole.size(); ++size) {
    if (size == input().size()) continue;  // a call that has not returned
    EXPECT_EQ(error(whole.substr(0, size)).find("byte " + std::to_string(size) + ": the file ends within"),
              0u)
        << size << ": " << error(whole.substr(0, size));
  }
}

TEST(recorded_calls, that_are_malformed_are_refused_with_the_byte_and_what_was_expected) {
  const auto changed = [](auto change) {
    BlockHeader h = header(BlockHeader::input, 1);
    change(h);
    return error(block(h, kTriangle));
  };
  EXPECT_EQ(error("hello"), "byte 0: expected a block of a recorded call, which begins with PSTRIREC");
  EXPECT_EQ(error(input() + "PSTRIREX"),
            "byte 176: expected a block of a recorded call, which begins with PSTRIREC");
  EXPECT_EQ(changed([](auto& h) { h.byte_order = 0x04030201; }),
            "byte 8: written on a machine of the other byte order");
  EXPECT_EQ(changed([](auto& h) { h.byte_order = 5; }),
            "byte 8: expected the byte order mark 16909060, found 5");
  EXPECT_EQ(changed([](auto& h) { h.version = 2; }), "byte 12: expected version 1, found 2");
  EXPECT_EQ(changed([](auto& h) { h.kind = 3; }), "byte 16: expected 1 (input) or 2 (output), found 3");
  EXPECT_EQ(changed([](auto& h) { h.routine = 9; }),
            "byte 20: expected 1 to 6 (TRMESH in some order, pstripack_delaunay), found 9");
  EXPECT_EQ(changed([](auto& h) { h.real_bytes = 16; }), "byte 24: expected reals of 4 or 8 bytes, found 16");
  EXPECT_EQ(changed([](auto& h) { h.integer_bytes = 2; }), "byte 28: expected integers of 4 bytes, found 2");
  EXPECT_EQ(changed([](auto& h) { h.n = 4; }), "byte 96: expected a body of 96 bytes, found 72");
  EXPECT_EQ(changed([](auto& h) { h.n = 2; }), "byte 96: expected a body of 0 bytes, found 72");
  EXPECT_EQ(error(output()), "byte 0: call 1 of process 1234: the file has its result, not its beginning");
  EXPECT_EQ(error(input() + input()), "byte 176: call 1 of process 1234 begins a second time");

  const auto output_changed = [](auto change) {
    BlockHeader h = output_header();
    change(h);
    return error(input() + block(h, kLists));
  };
  EXPECT_EQ(output_changed([](auto& h) { h.n = 4; }), "byte 232: expected n = 3 as in the input");
  EXPECT_EQ(output_changed([](auto& h) { h.nodes = 4; }), "byte 240: expected at most n nodes in the lists");
  EXPECT_EQ(output_changed([](auto& h) { h.lnew = 8; }), "byte 256: expected LNEW at most 6n-11");
  EXPECT_EQ(output_changed([](auto& h) { h.lnew = 6; }), "byte 272: expected a body of 52 bytes, found 60");
}

TEST(recorded_calls, of_a_length_that_cannot_be_take_no_memory) {
  BlockHeader h = header(BlockHeader::input, 1);
  h.n = 357913943;
  h.body_bytes = 24 * h.n;
  const std::string text(reinterpret_cast<const char*>(&h), sizeof h);
  EXPECT_EQ(error(text + "end"), "byte 107: the file ends within the 8589934632 bytes of a block's body");
}

const std::string kText = "3 7\n 2 -3 3 -1 1 -2\n2 1 4 3 6 5\n2 4 6\n";

std::string error_of_text(const std::string& contents) {
  const File file(contents);
  try {
    const auto next = calls_of(file.path());
    while (next()) {
    }
  } catch (const std::runtime_error& e) {
    return std::string(e.what()).substr(file.path().size() + 2);
  }
  return "";
}

TEST(lists_as_text, are_the_same_as_recorded_ones_however_the_lines_break) {
  std::string one_a_line = kText + kText;
  std::replace(one_a_line.begin(), one_a_line.end(), ' ', '\n');
  for (const std::string& text : {kText + kText, one_a_line}) {
    const File file(text), recording(input() + output());
    const auto next = calls_of(file.path()), recorded = calls_of(recording.path());
    const auto expected = recorded();
    ASSERT_TRUE(expected);
    for (int i = 1; i <= 2; ++i) {
      const auto call = next();
      ASSERT_TRUE(call);
      EXPECT_EQ(call->number, i);
      EXPECT_EQ(call->n, 3);
      EXPECT_EQ(call->run.ier, 0);
      EXPECT_EQ(compare_bytes(call->run.lists, 3, expected->run.lists, 3).different, 0u);
    }
    EXPECT_FALSE(next());
  }
}

TEST(lists_as_text, that_are_malformed_are_refused_with_the_line_and_what_was_expected) {
  EXPECT_EQ(error_of_text("three"), "line 1: expected N from 3 to 357913943, found 'three'");
  EXPECT_EQ(error_of_text("2 7"), "line 1: expected N from 3 to 357913943, found '2'");
  EXPECT_EQ(error_of_text("\n3 8"), "line 2: expected LNEW from 1 to 7, found '8'");
  EXPECT_EQ(error_of_text("3 7\n2 -3 3. -1"), "line 2: expected LIST(3), an integer, found '3.'");
  EXPECT_EQ(error_of_text("3 7\n2 -3 3 -1 1 -2\n2 1 4"), "line 3: the file ends, expected LPTR(4)");
  EXPECT_EQ(error_of_text(kText + "4"), "line 5: the file ends, expected LNEW");
}

TEST(compared_bytes, are_those_in_use) {
  Lists a, b;
  a.list = {2, -3, 3, -1, 1, -2, 5};
  a.lptr = {2, 1, 4, 3, 6, 5, 5};
  a.lend = {2, 4, 6};
  a.lnew = 7;
  b = a;
  b.list[6] = b.lptr[6] = 99;
  EXPECT_EQ(compare_bytes(a, 3, b, 3).different, 0u);
  b.lptr[3] = 4;
  b.lend[2] = 5;
  EXPECT_EQ(compare_bytes(a, 3, b, 3).different, 2u);
  EXPECT_EQ(compare_bytes(a, 3, b, 3).first, "LPTR(4): 3 and 4");
  EXPECT_EQ(compare_bytes(a, 0, b, 0).different, 0u);
  b = a;
  b.lnew = 5;
  EXPECT_EQ(compare_bytes(a, 3, b, 3).different, 5u) << "LNEW and two slots of each";
  EXPECT_EQ(compare_bytes(a, 3, b, 3).first, "LNEW: 7 and 5");
}

}  // namespace
}  // namespace comparison
