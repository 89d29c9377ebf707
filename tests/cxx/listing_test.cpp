// TRPRNT, TRLPRT, VORONOI_POLY_COUNT. tests/differential/listing_differential_test.cpp compares rows and page
// breaks with the original.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "support/fortran_mesh.h"
#include "support/fortran_unit.h"
#include "support/text_calls.h"

namespace {

/// The octahedron, or its upper half; with LIST, LPTR, LEND of our TRMESH.
struct Octahedron {
  explicit Octahedron(int nodes) : n(nodes) {
    int near[6], next[6], ier;
    double dist[6];
    trmesh_(&n, x, y, z, list, lptr, lend, &lnew, near, next, dist, &ier);
    EXPECT_EQ(ier, 0);
  }
  int n, list[24], lptr[24], lend[6], lnew;
  double x[6] = {1, 0, 0, -1, 0, 0}, y[6] = {0, 1, 0, 0, -1, 0}, z[6] = {0, 0, 1, 0, 0, -1};
};

/// The layout of the Fortran 90 text, on standard output; to an open unit the layout of Algorithm 772.
template <class Print>
void expect_layouts(const Print& print, const std::string& f90) {
  const int unit = 77;
  EXPECT_EQ(print(nullptr), f90);
  const std::string on_unit = written_to_unit(unit, [&] { EXPECT_EQ(print(&unit), ""); });
  EXPECT_NE(on_unit.find("PSTRIPACK: "), std::string::npos);
  EXPECT_NE(on_unit, f90);
}

TEST(Trprnt, OfLibstripackPrintsAsFortran90Does) {
  const Octahedron half(5);
  const int iflag = -1;
  const auto print = [&](const int* lout) {
    return written_to_stdout(
        [&] { trprnt_(&half.n, half.x, half.y, half.z, &iflag, half.list, half.lptr, half.lend, lout); });
  };
  expect_layouts(print,
                 "\n\n\n"
                 "               PSTRIPACK: the neighbours of each node,  N =     5\n"
                 "\n\n"
                 " node        neighbours, counterclockwise\n"
                 "\n\n"
                 "    1        2    3    5    0\n"
                 " \n"
                 "    2        4    3    1    0\n"
                 " \n"
                 "    3        1    2    4    5\n"
                 " \n"
                 "    4        5    3    2    0\n"
                 " \n"
                 "    5        1    3    4    0\n"
                 " \n"
                 " \n"
                 "NB =        4 boundary nodes\n"
                 "NA =        8 arcs\n"
                 "NT =        4 triangles\n");
}

TEST(Trlprt, OfLibstripackPrintsAsFortran90Does) {
  const Octahedron half(5);
  const int iflag = 1, nrow = 9;
  int nt, ier, ltri[9 * 6];
  trlist_(&half.n, half.list, half.lptr, half.lend, &nrow, &nt, ltri, &ier);
  const auto print = [&](const int* lout) {
    return written_to_stdout(
        [&] { trlprt_(&half.n, half.x, half.y, half.z, &iflag, &nrow, &nt, ltri, lout); });
  };
  expect_layouts(print,
                 "\n\n\n"
                 "                  PSTRIPACK: triangles as of TRLIST,  N =    5\n"
                 "\n\n"
                 "                node      longitude         latitude\n"
                 "\n\n"
                 "                   1     0.100000E+01     0.000000E+00\n"
                 "                   2     0.000000E+00     0.100000E+01\n"
                 "                   3     0.000000E+00     0.000000E+00\n"
                 "                   4    -0.100000E+01     0.000000E+00\n"
                 "                   5     0.000000E+00    -0.100000E+01\n"
                 "\n\n"
                 "triangle         corners             neighbours              arcs\n"
                 "   no.        1      2      3      1      2      3      1      2      3\n"
                 "\n"
                 "     1        1      2      3      3      2      0      4      3      1\n"
                 "     2        1      3      5      4      0      1      7      2      3\n"
                 "     3        2      4      3      4      1      0      8      4      5\n"
                 "     4        3      4      5      0      2      3      6      7      8\n"
                 " \n"
                 "NB =        4 boundary nodes\n"
                 "NA =        8 arcs\n"
                 "NT =        4 triangles\n");
}

pstripack::Point place(double height, double longitude) {
  const double r = std::sqrt(1 - height * height);
  return {r * std::cos(longitude), r * std::sin(longitude), height};
}

/// Nodes on a spiral round the sphere.
FortranMesh spiral(int n) {
  Nodes nodes;
  for (int k = 0; k < n; ++k) nodes.push_back(place(1 - (2 * k + 1.0) / n, 2.4 * k));
  return FortranMesh(nodes);
}

/// A node with this many neighbours, and these.
FortranMesh wheel(int spokes) {
  Nodes nodes{{0, 0, 1}};
  for (int k = 0; k < spokes; ++k) nodes.push_back(place(0.6, 2 * std::acos(-1.0) * k / spokes));
  return FortranMesh(nodes);
}

std::vector<std::string> printed(const FortranMesh& m, int iflag, bool f90) {
  return lines(text_of(pstripack_trprnt_r8(m.n, m.x.data(), m.y.data(), m.z.data(), iflag, m.list.data(),
                                           m.lptr.data(), m.lend.data(), f90)));
}

// Page breaks of the two layouts: after 58 lines, of which a row of neighbours and the blank record take two.
TEST(Trprnt, BreaksPagesWithThreeBlanksInFortran90AndFourRecordsIn77) {
  const FortranMesh nodes = spiral(60);
  for (const bool f90 : {false, true}) {
    const std::vector<std::string> records = printed(nodes, -1, f90);
    const std::string blank = f90 ? " " : "";
    std::size_t at = 9;  // behind the heading
    for (int k = 1; k <= nodes.n; ++k) {
      const bool breaks = k == 27 || k == 56;  // 6 + 2 * 26 = 58, then 2 * 29
      for (int i = 0; breaks && i < (f90 ? 3 : 4); ++i) EXPECT_EQ(records.at(at++), blank) << k;
      EXPECT_EQ(std::stoi(records.at(at++).substr(0, 5)), k);
      EXPECT_EQ(records.at(at++), blank) << k;
    }
    EXPECT_EQ(records.at(at), blank);
    EXPECT_EQ(records.size(), at + (f90 ? 4 : 2));
  }
}

// After a full row Fortran's format writes the record between two nodes without a blank.
TEST(Trprnt, RecordsBetweenNodesHaveABlankInFortran90UnlessTheRowIsFull) {
  const std::vector<std::string> records = printed(spiral(60), 0, true);
  int full = 0, other = 0;
  for (std::size_t at = 9; at + 1 < records.size(); ++at) {
    if (records[at].size() <= 54 || records[at].substr(0, 5) == "     ") continue;
    const bool one_row = records[at + 1].size() < 2;
    const bool five = records[at].size() == 54 + 5 * 5 && one_row;
    if (one_row) {
      EXPECT_EQ(records[at + 1], five ? "" : " ") << records[at];
    }
    ++(five ? full : other);
  }
  EXPECT_GT(full, 5);
  EXPECT_GT(other, 5);
  EXPECT_EQ(full + other, 60);
  const std::vector<std::string> two_full_rows = printed(wheel(10), 0, true);
  EXPECT_EQ(two_full_rows.at(10).size(), 54u + 5 * 5);
  EXPECT_EQ(two_full_rows.at(11), " ");
}

// The original has room for 400 neighbours.
TEST(Trprnt, ShowsAnyNumberOfNeighbours) {
  const std::vector<std::string> records = printed(wheel(2000), 0, false);
  int shown = 0;
  std::size_t at = 13;  // behind the heading and a page break
  for (; !records.at(at).empty(); ++at) shown += static_cast<int>(records[at].size() - 54) / 5;
  EXPECT_EQ(shown, 2000);
  EXPECT_EQ(at, 13u + 400);
}

// Bad input: a message instead of an overrun.
TEST(Trprnt, EndsWhereListsAreNotClosed) {
  const std::string remark = "           LIST, LPTR, LEND are not closed lists at node    2\n";
  const auto expect_remark = [&](const auto& damage, int slot) {
    Octahedron whole(6);
    damage(whole);
    const std::string text =
        text_of(pstripack_trprnt_r8(6, whole.x, whole.y, whole.z, -1, whole.list, whole.lptr, whole.lend, 0));
    EXPECT_EQ(text.substr(text.size() - remark.size()), remark) << slot;
    EXPECT_LT(text.size(), 1000u);
  };
  for (const int slot : {0, -1, 25, 2147483647, 1}) {  // 1: into the list of node 1, and never back
    expect_remark([=](Octahedron& o) { o.lptr[o.lptr[o.lend[1] - 1] - 1] = slot; }, slot);
    if (slot != 1) expect_remark([=](Octahedron& o) { o.lend[1] = slot; }, slot);
  }
}

TEST(Trlprt, ShowsNumbersThatDoNotFitTheirColumns) {
  const double none[3] = {};
  const std::int64_t ltri[6] = {1, 2, 123456789, -1, 0, 1000000000000};
  const std::string text = text_of(pstripack_trlprt_i8(3, none, none, none, -1, 6, 1, ltri, 0));
  EXPECT_NE(text.find("     1        1      2 123456789     -1      0 1000000000000\n"), std::string::npos)
      << text;
}

TEST(VoronoiPolyCount, CountsTheCellsOfACube) {  // the dual of the octahedron
  Octahedron whole(6);
  int ltri[6], listc[24], nb, ier;
  const int ncol = 1;
  double xc[8], yc[8], zc[8], rc[8];
  crlist_(&whole.n, &ncol, whole.x, whole.y, whole.z, whole.list, whole.lend, whole.lptr, &whole.lnew, ltri,
          listc, &nb, xc, yc, zc, rc, &ier);
  ASSERT_EQ(ier, 0);
  EXPECT_EQ(written_to_stdout([&] { voronoi_poly_count_(&whole.n, whole.lend, whole.lptr, listc); }),
            "\n"
            "PSTRIPACK: Voronoi diagram\n"
            "  faces          F =        6\n"
            "  vertices       V =        8\n"
            "  edges          E =       12\n"
            "  F + V - E - 2    =        0\n"
            "\n"
            "   sides   cells   (20: 20 or more)\n"
            "       4       6\n");
}

TEST(VoronoiPolyCount, SumsUpCellsOfTwentySidesAndMore) {
  for (const int spokes : {25, 20, 19}) {
    FortranMesh nodes = wheel(spokes);
    const std::size_t size = nodes.list.size();
    std::vector<int> ltri(size), listc(size);
    std::vector<double> xc(size), yc(size), zc(size), rc(size);
    int nb, ier;
    crlist_(&nodes.n, &nodes.n, nodes.x.data(), nodes.y.data(), nodes.z.data(), nodes.list.data(),
            nodes.lend.data(), nodes.lptr.data(), &nodes.lnew, ltri.data(), listc.data(), &nb, xc.data(),
            yc.data(), zc.data(), rc.data(), &ier);
    ASSERT_EQ(ier, 0);
    const std::vector<std::string> records = lines(written_to_stdout(
        [&] { voronoi_poly_count_(&nodes.n, nodes.lend.data(), nodes.lptr.data(), listc.data()); }));
    std::map<int, int> expected;
    for (const int last : nodes.lend) {
      int sides = 1;
      for (int slot = nodes.lptr[last - 1]; slot != last; slot = nodes.lptr[slot - 1]) ++sides;
      ++expected[std::min(sides, 20)];
    }
    std::map<int, int> found;
    for (std::size_t i = 8; i < records.size(); ++i)
      found[std::stoi(records[i].substr(0, 8))] = std::stoi(records[i].substr(8));
    EXPECT_EQ(found, expected);
    EXPECT_EQ(records.at(5), "  F + V - E - 2    =        0");
    EXPECT_EQ(records.back().substr(0, 8), spokes == 19 ? "      19" : "      20");
  }
}

TEST(VoronoiPolyCount, SaysWhatIsNoDiagram) {
  const std::string remark = "  N < 3, or LEND, LPTR, LISTC are not those that CRLIST gives\n";
  const Octahedron whole(6);
  int far[24];
  for (int& vertex : far) vertex = 9;
  const auto count = [&](int n, const int* lptr, const int* listc) {
    return text_of(pstripack_voronoi_poly_count_i4(n, whole.lend, lptr, listc));
  };
  const int zeros[24] = {};
  for (const std::string& text :
       {count(2, whole.lptr, zeros), count(6, zeros, zeros), count(6, whole.lptr, far)})
    EXPECT_EQ(text, "\nPSTRIPACK: Voronoi diagram\n" + remark);
}

TEST(Text, OfAHandleThatIsNull) {
  char record[10];
  EXPECT_EQ(pstripack_next_record(nullptr, record, sizeof record), -1);
  pstripack_free_text(nullptr);
}

/// The number is read by a system call, which needs two file descriptors.
template <class Int, class NumberAt>
void expect_number_unless_unreadable(const NumberAt& number_at) {
  const Int number = 7, other = 8;
  const auto read = [&](const Int* address) {
    return number_at(address, &other, &other, &other, &other, &other);
  };
  EXPECT_EQ(read(&number), 7);
  EXPECT_EQ(read(&other), -1) << "another argument";
  EXPECT_EQ(read(nullptr), -1);
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_EQ(read(&number), -1) << "no more files";
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(read(&number), 7);
}

TEST(NumberAt, IsUnknownWhereNoneWasPassedOrItCannotBeRead) {
  expect_number_unless_unreadable<std::int32_t>(pstripack_number_at_i4);
  expect_number_unless_unreadable<std::int64_t>(pstripack_number_at_i8);
}

}  // namespace
