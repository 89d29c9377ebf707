// A program that calls TRMESH, for the tests of record, replay and the check beside it:
//   caller [r4] FAMILY N [CALLS [EXIT_CODE]]     calls TRMESH CALLS times for the same nodes; prints IER;
//   FAMILY
//                                                `all`: for each family
//   caller delaunay FAMILY N                     calls pstripack_delaunay for these nodes in single precision
//   caller crash                                 ends by a signal within the second call

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "capi/pstripack.h"
#include "point_sets.h"

namespace {

bool by_direction = false;

std::int32_t trmesh(std::int32_t n, const double* x, const double* y, const double* z, std::int32_t* list,
                    std::int32_t* lptr, std::int32_t* lend, std::int32_t* lnew) {
  return (by_direction ? pstripack_delaunay : pstripack_trmesh)(n, x, y, z, list, lptr, lend, lnew);
}
std::int32_t trmesh(std::int32_t n, const float* x, const float* y, const float* z, std::int32_t* list,
                    std::int32_t* lptr, std::int32_t* lend, std::int32_t* lnew) {
  return pstripack_trmesh_r4(n, x, y, z, list, lptr, lend, lnew);
}

/// Nodes of a family; `two` nodes; or random nodes of which two coincide, the first three are collinear, or
/// one is not a number.
std::vector<pstripack::Point> nodes(const std::string& family, std::size_t n) {
  if (family == "two") return {{1, 0, 0}, {0, 1, 0}};
  const bool is_family = family != "duplicate" && family != "collinear" && family != "nan";
  auto points = point_sets::make(is_family ? family : "random", n);
  if (family == "duplicate") points[70] = points[30];
  if (family == "collinear") points[2] = points[0];
  if (family == "nan") points[60].x = std::numeric_limits<double>::quiet_NaN();
  return points;
}

template <class Real>
void call(const std::vector<pstripack::Point>& points) {
  const std::size_t n = points.size(), slots = n < 3 ? 0 : 6 * n - 12;
  std::vector<Real> x, y, z;
  for (const auto& p : points) {
    x.push_back(static_cast<Real>(p.x));
    y.push_back(static_cast<Real>(p.y));
    z.push_back(static_cast<Real>(p.z));
  }
  std::vector<std::int32_t> list(slots), lptr(slots), lend(n);
  std::int32_t lnew = 0;
  std::printf("IER %d\n", trmesh(static_cast<std::int32_t>(n), x.data(), y.data(), z.data(), list.data(),
                                 lptr.data(), lend.data(), &lnew));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.at(0) == "crash") {
    call<double>(point_sets::make("random", 100));
    // LIST is a null pointer: a signal ends TRMESH after the input has been recorded.
    std::vector<double> x, y, z;
    for (const auto& p : point_sets::make("random", 100))
      x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    return pstripack_trmesh(100, x.data(), y.data(), z.data(), nullptr, nullptr, nullptr, nullptr);
  }
  const bool single_precision = words[0] == "r4";
  by_direction = words[0] == "delaunay";
  if (single_precision || by_direction) words.erase(words.begin());
  std::vector<std::string> families{words.at(0)};
  if (words[0] == "all") {
    families = point_sets::families();
    families.insert(families.end(), point_sets::hard_families().begin(), point_sets::hard_families().end());
  }
  for (const std::string& family : families) {
    auto points = nodes(family, std::stoul(words.at(1)));
    if (by_direction)
      for (auto& p : points) p = {float(p.x), float(p.y), float(p.z)};
    for (int calls = words.size() > 2 ? std::stoi(words[2]) : 1; calls > 0; --calls)
      single_precision ? call<float>(points) : call<double>(points);
  }
  return words.size() > 3 ? std::stoi(words[3]) : 0;
}
