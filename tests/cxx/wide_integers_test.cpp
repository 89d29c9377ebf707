// The functions of libstripack_i8 give the results of those for 32-bit integers.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "point_sets.h"
#include "support/expect.h"
#include "support/stripack_calls.h"

namespace {

using point_sets::make;

const char* const families[] = {"random", "latlon", "cap:1e-8", "hemisphere-rim", "ring", "hemisphere"};

template <class T>
std::vector<std::int64_t> wide(const std::vector<T>& values) {
  return {values.begin(), values.end()};
}

TEST(WideTrmesh, WritesTheSameAndNothingElse) {
  for (const char* family : families)
    for (const std::size_t n : {3, 4, 5, 6, 7, 12, 200, 1000}) {
      const Nodes nodes = make(family, n);
      const Mesh expected = trmesh(nodes);
      for (const Edge edge : {Edge::begin, Edge::end})
        EXPECT_TRUE(trmesh_i8(nodes, edge) == expected && trmesh_i8(nodes, edge).ier == expected.ier)
            << family << ", " << nodes.size() << " nodes";
    }
}

TEST(WideTrmesh, WritesTheSameOnThreads) {
  const Nodes nodes = make("random", 50000);
  EXPECT_TRUE(trmesh_i8(nodes) == trmesh(nodes));
}

TEST(WideTrmesh, StopsBeforeADuplicate) {
  for (const std::size_t copy : {4, 5, 20, 99}) {
    Nodes nodes = make("random", 100);
    nodes[copy] = nodes[2];
    const Mesh m = trmesh_i8(nodes);
    EXPECT_EQ(m.ier, 3);
    EXPECT_TRUE(m == trmesh(nodes));
  }
}

TEST(WideTrmesh, WritesNothingOnOtherCodes) {
  ::testing::internal::CaptureStderr();
  Nodes nodes = make("random", 10);
  nodes[7].y = std::nan("");
  Mesh m = trmesh_i8(nodes);
  EXPECT_EQ(m.ier, PSTRIPACK_BAD_COORDINATE);
  EXPECT_TRUE(is_untouched(m));
  nodes[1] = nodes[0], nodes[7].y = 0;
  m = trmesh_i8(nodes);
  EXPECT_EQ(m.ier, PSTRIPACK_COLLINEAR);
  EXPECT_TRUE(is_untouched(m));
  m = trmesh_i8({nodes[0], nodes[2]});
  EXPECT_EQ(m.ier, PSTRIPACK_TOO_FEW_NODES);
  EXPECT_TRUE(is_untouched(m));
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("node 8 of 10 is"), std::string::npos) << text;
}

TEST(WideTrmesh, TouchesNoArrayIfThereAreTooManyNodes) {
  const auto code_of = [](std::int64_t n) {
    return pstripack_trmesh_i8(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
  };
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(code_of(357913944), PSTRIPACK_TOO_MANY_NODES);
  // Numbers whose lower halves are numbers of nodes that could be triangulated.
  EXPECT_EQ(code_of((std::int64_t{1} << 32) + 10), PSTRIPACK_TOO_MANY_NODES);
  EXPECT_EQ(code_of(std::numeric_limits<std::int64_t>::max()), PSTRIPACK_TOO_MANY_NODES);
  EXPECT_EQ(code_of(-(std::int64_t{1} << 32) + 10), PSTRIPACK_TOO_FEW_NODES);
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find(" 4294967306 nodes: too many nodes"), std::string::npos) << text;
}

/// The same lists in both kinds of integers.
struct Both {
  explicit Both(const Nodes& nodes)
      : c(nodes),
        size(nodes.size()),
        n(static_cast<std::int32_t>(size)),
        m(trmesh(nodes)),
        list(wide(m.list)),
        lptr(wide(m.lptr)),
        lend(wide(m.lend)) {}

  Columns<> c;
  std::size_t size;
  std::int32_t n;
  Mesh m;
  std::vector<std::int64_t> list, lptr, lend;
};

TEST(WideQueries, ListTheSame) {
  for (const char* family : families) {
    const Both b(make(family, 500));
    for (const std::int32_t rows : {6, 9, 7}) {
      std::vector<std::int32_t> narrow(18 * b.size, -5);
      std::vector<std::int64_t> ltri(18 * b.size, -5);
      std::int32_t nt4 = -5, ier4 = -5;
      std::int64_t nt = -5, ier = -5;
      pstripack_trlist_i4(b.n, b.m.list.data(), b.m.lptr.data(), b.m.lend.data(), rows, &nt4, narrow.data(),
                          &ier4);
      pstripack_trlist_i8(b.n, b.list.data(), b.lptr.data(), b.lend.data(), rows, &nt, ltri.data(), &ier);
      EXPECT_EQ(nt, nt4);
      EXPECT_EQ(ier, ier4);
      EXPECT_EQ(ltri, wide(narrow)) << family;
      pstripack_trlist2_i4(b.n, b.m.list.data(), b.m.lptr.data(), b.m.lend.data(), &nt4, narrow.data(),
                           &ier4);
      pstripack_trlist2_i8(b.n, b.list.data(), b.lptr.data(), b.lend.data(), &nt, ltri.data(), &ier);
      EXPECT_EQ(ltri, wide(narrow)) << family;
    }
    std::vector<std::int32_t> nodes4(b.size, -5);
    std::vector<std::int64_t> nodes(b.size, -5);
    std::int32_t counts4[3];
    std::int64_t counts[3];
    pstripack_bnodes_i4(b.n, b.m.list.data(), b.m.lptr.data(), b.m.lend.data(), nodes4.data(), &counts4[0],
                        &counts4[1], &counts4[2]);
    pstripack_bnodes_i8(b.n, b.list.data(), b.lptr.data(), b.lend.data(), nodes.data(), &counts[0],
                        &counts[1], &counts[2]);
    EXPECT_EQ(nodes, wide(nodes4)) << family;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(counts[i], counts4[i]);
  }
}

TEST(WideQueries, FindTheSame) {
  const Both b(make("random", 500));
  const Nodes targets = make("random", 200, 7);
  std::int32_t start = -1;
  for (const pstripack::Point& t : targets) {
    const double p[3] = {t.x, t.y, t.z};
    double w4[3], w[3], al4 = 0, al = 0;
    std::int32_t i4[3];
    std::int64_t i[3];
    pstripack_trfind_r8(start, p, b.n, b.c.x.data(), b.c.y.data(), b.c.z.data(), b.m.list.data(),
                        b.m.lptr.data(), b.m.lend.data(), &w4[0], &w4[1], &w4[2], &i4[0], &i4[1], &i4[2]);
    pstripack_trfind_i8(start, p, b.n, b.c.x.data(), b.c.y.data(), b.c.z.data(), b.list.data(), b.lptr.data(),
                        b.lend.data(), &w[0], &w[1], &w[2], &i[0], &i[1], &i[2]);
    for (int j = 0; j < 3; ++j) {
      EXPECT_EQ(i[j], i4[j]);
      EXPECT_EQ(w[j], w4[j]);
    }
    EXPECT_EQ(pstripack_nearnd_i8(p, start, b.n, b.c.x.data(), b.c.y.data(), b.c.z.data(), b.list.data(),
                                  b.lptr.data(), b.lend.data(), &al),
              pstripack_nearnd_r8(p, start, b.n, b.c.x.data(), b.c.y.data(), b.c.z.data(), b.m.list.data(),
                                  b.m.lptr.data(), b.m.lend.data(), &al4));
    EXPECT_EQ(al, al4);
    start += 3;
  }
}

TEST(WideQueries, HaveTheSameVoronoiDiagram) {
  for (const char* family : {"random", "hemisphere", "hemisphere-rim"}) {
    Both b(make(family, 500));
    const std::size_t slots = 6 * b.size - 12, vertices = 2 * b.size - 4;
    std::vector<std::int32_t> ltri4(6 * b.size, -5), listc4(slots, -5);
    std::vector<std::int64_t> ltri(6 * b.size, -5), listc(slots, -5);
    std::vector<double> centres4(4 * vertices, -5), centres(4 * vertices, -5);
    std::int32_t nb4, ier4;
    std::int64_t nb, ier, lnew = b.m.lnew;
    const auto part = [vertices](std::vector<double>& of, std::size_t i) { return of.data() + i * vertices; };
    pstripack_crlist_r8(b.n, b.n, b.c.x.data(), b.c.y.data(), b.c.z.data(), b.m.list.data(), b.m.lend.data(),
                        b.m.lptr.data(), &b.m.lnew, ltri4.data(), listc4.data(), &nb4, part(centres4, 0),
                        part(centres4, 1), part(centres4, 2), part(centres4, 3), &ier4);
    pstripack_crlist_i8(b.n, b.n, b.c.x.data(), b.c.y.data(), b.c.z.data(), b.list.data(), b.lend.data(),
                        b.lptr.data(), &lnew, ltri.data(), listc.data(), &nb, part(centres, 0),
                        part(centres, 1), part(centres, 2), part(centres, 3), &ier);
    EXPECT_EQ(ier4, 0);
    EXPECT_EQ(ier, 0);
    EXPECT_EQ(nb, nb4);
    EXPECT_EQ(lnew, b.m.lnew);
    EXPECT_EQ(b.lptr, wide(b.m.lptr)) << family;
    EXPECT_EQ(listc, wide(listc4)) << family;
    EXPECT_EQ(ltri, wide(ltri4)) << family;
    EXPECT_EQ(centres, centres4) << family;
  }
}

}  // namespace
