#include "case_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/property_tree/xml_parser.hpp>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace comparison {
namespace {

const char* const kOddName = "a<b>&\"c'd\" \x01\xff\xc3\xa9,.txt";  // one control byte, one that is not UTF-8

Case odd_case(bool against_us) {
  Case one{kOddName, 1, "given", "r8", {}, 0.5};
  one.result.points_name = kOddName;
  one.result.original_name = "library";
  one.result.original.outcome = legacy_stripack::Outcome::crashed;
  one.result.ours.resize(2);
  if (against_us) one.result.broken_promises.push_back("our <mesh> is wrong");
  return one;
}

std::string contents(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(junit, has_a_test_case_for_each_case_and_a_failure_where_one_counts_against_us) {
  const std::string file = testing::TempDir() + "case_files_test.xml";
  JunitFile junit(file);
  junit.add(odd_case(false), 10);
  junit.add(odd_case(true), 10);
  junit.write();

  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(file, tree);  // throws unless well-formed
  const auto& suite = tree.get_child("testsuite");
  EXPECT_EQ(suite.get<int>("<xmlattr>.tests"), 2);
  EXPECT_EQ(suite.get<int>("<xmlattr>.failures"), 1);
  ASSERT_EQ(suite.count("testcase"), 2u);
  const auto& passed = suite.find("testcase")->second;
  const auto& failed = suite.rbegin()->second.count("failure") > 0 ? suite.rbegin()->second
                                                                   : std::next(suite.rbegin())->second;
  EXPECT_EQ(passed.count("failure"), 0u);
  EXPECT_NE(passed.get<std::string>("<xmlattr>.name").find("a<b>&\"c'd\""), std::string::npos);
  ASSERT_EQ(failed.count("failure"), 1u);
  EXPECT_EQ(failed.get<std::string>("failure.<xmlattr>.message"), "WE ARE WRONG");
  EXPECT_NE(failed.get<std::string>("system-out").find("our <mesh> is wrong"), std::string::npos);
}

TEST(csv, has_a_row_for_each_call_and_as_many_fields_in_each) {
  const std::string file = testing::TempDir() + "case_files_test.csv";
  CsvFile csv(file);
  Case one = odd_case(false);
  one.nodes = "plain";
  csv.add(one);
  one.result.ours[1].failure = "crashed";
  one.result.original.outcome = legacy_stripack::Outcome::returned;
  csv.add(one);
  std::istringstream lines(contents(file));
  std::vector<long> commas;
  for (std::string line; std::getline(lines, line);)
    commas.push_back(std::count(line.begin(), line.end(), ','));
  EXPECT_EQ(commas, std::vector<long>(5, 22));
  one.nodes = "say \"a,b\"";
  csv.add(one);
  EXPECT_NE(contents(file).find("\n\"say \"\"a,b\"\"\",1,given,r8,"), std::string::npos);
}

TEST(files, that_cannot_be_written_are_refused_at_once) {
  EXPECT_THROW(CsvFile("/no/such/folder/a.csv"), std::runtime_error);
  EXPECT_THROW(JunitFile("/no/such/folder/a.xml"), std::runtime_error);
}

}  // namespace
}  // namespace comparison
