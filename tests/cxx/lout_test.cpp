// LOUT of TRPRNT and TRLPRT: callers written for the Fortran 90
// text do not pass it, and leave an arbitrary value in its place.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "differential/routines.h"
#include "support/fortran_unit.h"
#include "support/guarded.h"

namespace {

using Int = stripack_integer;
using Real = stripack_real;
constexpr int some_unit = 20;

/// The octahedron, and calls of the two routines with a given address in the place of LOUT.
struct Octahedron {
  Octahedron() {
    Int lnew, near[6], next[6], ier;
    Real dist[6];
    trmesh_(&n, x, y, z, list, lptr, lend, &lnew, near, next, dist, &ier);
    EXPECT_EQ(ier, 0);
    trlist_(&n, list, lptr, lend, &nrow, &nt, ltri, &ier);
    EXPECT_EQ(ier, 0);
  }
  std::string neighbours(const void* lout) {
    return written_to_stdout(
        [&] { trprnt_(&n, x, y, z, &iflag, list, lptr, lend, static_cast<const Int*>(lout)); });
  }
  std::string triangles(const void* lout) {
    return written_to_stdout(
        [&] { trlprt_(&n, x, y, z, &iflag, &nrow, &nt, ltri, static_cast<const Int*>(lout)); });
  }
  Int n = 6, iflag = 0, nrow = 9, nt, list[24], lptr[24], lend[6], ltri[9 * 8];
  Real x[6] = {1, 0, 0, -1, 0, 0}, y[6] = {0, 1, 0, 0, -1, 0}, z[6] = {0, 0, 1, 0, 0, -1};
};

/// Both routines print on standard output, and `unit` stays empty.
void expect_standard_output(Octahedron& mesh, const void* lout, const std::string& what) {
  const Int six = 6;
  const std::string on_unit = written_to_unit(some_unit, [&] {
    EXPECT_EQ(mesh.neighbours(lout), mesh.neighbours(&six)) << what;
    EXPECT_EQ(mesh.triangles(lout), mesh.triangles(&six)) << what;
  });
  EXPECT_EQ(on_unit, "") << what;
}

TEST(Lout, IsReadWhereItNamesAnOpenUnit) {
  Octahedron mesh;
  const Int six = 6, unit = some_unit;
  EXPECT_GT(mesh.neighbours(&six).size(), 500U);
  for (const auto listing : {&Octahedron::neighbours, &Octahedron::triangles}) {
    const std::string text = written_to_unit(some_unit, [&] { EXPECT_EQ((mesh.*listing)(&unit), ""); });
    EXPECT_GT(text.size(), 500U);
    // libstripack prints on standard output as the Fortran 90 text does, to a unit as Algorithm 772.
    if (sizeof(Real) == 4 || sizeof(Int) == 8) {
      EXPECT_EQ(text, (mesh.*listing)(&six));
    }
  }
}

// What callers compiled by gfortran leave there: zero, a number, an invalid address, that of code or of a
// variable.
TEST(Lout, NotPassedPrintsOnStandardOutputWhateverIsInItsPlace) {
  Octahedron mesh;
  for (const std::uintptr_t number : {std::uintptr_t{0}, std::uintptr_t{6}, std::uintptr_t{20},
                                      std::uintptr_t{0x600000080}, UINTPTR_MAX, UINTPTR_MAX / 2 + 1})
    expect_standard_output(mesh, reinterpret_cast<const void*>(number), std::to_string(number));
  Guarded<Int> page(1, Edge::begin);
  page[0] = some_unit;
  expect_standard_output(mesh, page.data() - 1, "memory without access");
  expect_standard_output(mesh, reinterpret_cast<char*>(page.data()) - 1, "half of it without access");
  expect_standard_output(mesh, reinterpret_cast<const void*>(&std::puts), "code");
  expect_standard_output(mesh, mesh.x, "a real");
  const Int text[] = {0x2f2f2f2f, 0};
  expect_standard_output(mesh, text, "text");
}

TEST(Lout, CountsOnlyIfItIsFrom1To99) {
  Octahedron mesh;
  for (const Int no_unit : {-20, 0, 100, 1 << 20})
    expect_standard_output(mesh, &no_unit, std::to_string(no_unit));
}

TEST(Lout, CountsOnlyIfTheUnitIsConnectedForFormattedWriting) {
  Octahedron mesh;
  const Int unit = 31;
  expect_standard_output(mesh, &unit, "not open");
  EXPECT_NE(std::remove("fort.31"), 0) << "opened by the call";
  const Int standard_input = 5;
  expect_standard_output(mesh, &standard_input, "standard input");
  const TemporaryFile file;
  for (const std::string access : {"read", "unformatted"}) {
    const FortranUnit open(31, file.path(), access);
    expect_standard_output(mesh, &unit, access);
  }
  EXPECT_EQ(file.text(), "");
}

// The addresses of a caller's other variables are the most likely ones.
TEST(Lout, IsNotTheAddressOfAnotherArgument) {
  Octahedron mesh;
  mesh.iflag = some_unit;
  for (Int* array : {mesh.list, mesh.lptr, mesh.lend, mesh.ltri}) array[0] = some_unit;
  const Int six = 6;
  const std::string on_unit = written_to_unit(some_unit, [&] {
    for (const Int* argument : {&mesh.n, &mesh.iflag, mesh.list, mesh.lptr, mesh.lend})
      EXPECT_EQ(mesh.neighbours(argument), mesh.neighbours(&six));
    for (const Int* argument : {&mesh.n, &mesh.iflag, &mesh.nrow, &mesh.nt, mesh.ltri})
      EXPECT_EQ(mesh.triangles(argument), mesh.triangles(&six));
  });
  EXPECT_EQ(on_unit, "");
}

}  // namespace
