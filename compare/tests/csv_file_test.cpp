#include "csv_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

namespace {

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

struct CsvFileTest : testing::Test {
  ~CsvFileTest() override { std::remove(file.c_str()); }
  const std::string file = testing::TempDir() + "csv_file_test.csv";
};

TEST_F(CsvFileTest, SecondRunAddsRowsUnderTheSameHead) {
  for (const char* row : {"1,2", "3,4"}) CsvFile(file, "a,b").row(row);
  EXPECT_EQ(text_of(file), "a,b\n1,2\n3,4\n");
}

TEST(CsvFile, TellsAtOnceThatTheDiskIsFull) { EXPECT_THROW(CsvFile("/dev/full", "a,b"), std::runtime_error); }

TEST_F(CsvFileTest, OtherColumnsAreRefused) {
  CsvFile(file, "a,b").row("1,2");
  EXPECT_THROW(CsvFile(file, "a,c"), std::runtime_error);
  EXPECT_EQ(text_of(file), "a,b\n1,2\n");
}

TEST_F(CsvFileTest, UnwritableOnesAreRefused) {
  EXPECT_THROW(CsvFile("/no/such/folder/a.csv", "a,b"), std::runtime_error);
}

}  // namespace
