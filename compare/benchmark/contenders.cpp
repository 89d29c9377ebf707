#include "contenders.h"

#include <fmt/format.h>

#include <stdexcept>

#include "measuring.h"

#ifdef BENCHMARK_WITH_CGAL
#include "cgal_contender.h"
#endif
#ifdef BENCHMARK_WITH_QHULL
#include "qhull_contender.h"
#endif

extern "C" {  // libstripack, as a Fortran program calls it
void trmesh_(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr, int* lend,
             int* lnew, int* near, int* next, double* dist, int* ier);
void trlist_(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow, int* nt,
             int* ltri, int* ier);
void crlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
             const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
             double* xc, double* yc, double* zc, double* rc, int* ier);
}

namespace benchmark {

using legacy_stripack::Library;
using pstripack::Point;

namespace {

template <class Trmesh, class Trlist, class Crlist>
Stripack stripack(Trmesh trmesh, Trlist trlist, Crlist crlist) {
  Stripack s;
  s.trmesh = [=](const Nodes& p, Lists& l) {
    const int n = p.n();
    trmesh(&n, p.x.data(), p.y.data(), p.z.data(), l.list.data(), l.lptr.data(), l.lend.data(), &l.lnew,
           l.near.data(), l.next.data(), l.dist.data(), &l.ier);
    if (l.ier != 0) throw std::runtime_error(fmt::format("TRMESH returned IER = {}", l.ier));
  };
  s.trlist = [=](int n, const Lists& l, int rows, std::vector<int>& ltri) {
    int nt, ier;
    trlist(&n, l.list.data(), l.lptr.data(), l.lend.data(), &rows, &nt, ltri.data(), &ier);
    if (ier != 0) throw std::runtime_error(fmt::format("TRLIST returned IER = {}", ier));
  };
  s.crlist = [=](const Nodes& p, Lists& l, std::vector<int>& listc, std::vector<double>& centres) {
    const int n = p.n(), ncol = 0;
    const std::size_t stride = 2 * std::size_t(n) - 4;
    int ltri[6], nb, ier;
    double* c = centres.data();
    crlist(&n, &ncol, p.x.data(), p.y.data(), p.z.data(), l.list.data(), l.lend.data(), l.lptr.data(),
           &l.lnew, ltri, listc.data(), &nb, c, c + stride, c + 2 * stride, c + 3 * stride, &ier);
    if (ier != 0) throw std::runtime_error(fmt::format("CRLIST returned IER = {}", ier));
  };
  return s;
}

}  // namespace

Stripack ours() { return stripack(&trmesh_, &trlist_, &crlist_); }

Stripack original(const Library& library) {
  const auto method = [&library](auto routine) {
    return [&library, routine](auto... arguments) { (library.*routine)(arguments...); };
  };
  return stripack(method(&Library::trmesh), method(&Library::trlist), method(&Library::crlist));
}

#ifdef BENCHMARK_WITH_CGAL
const Witness cgal{
    fmt::format("{}, Delaunay_triangulation_on_sphere_2, -O3 -march=native, no lists", cgal_version()),
    cgal_seconds};
#else
const Witness cgal{"none found", nullptr};
#endif

#ifdef BENCHMARK_WITH_QHULL
const Witness qhull{
    fmt::format("{}, convex hull without Qt, the system's libqhull_r, no lists", qhull_version()),
    qhull_seconds};
#else
const Witness qhull{"none found", nullptr};
#endif

double seconds_a_call(Routine routine, const Stripack& library, const Nodes& nodes, Lists* lists, int calls) {
  const int n = nodes.n();
  const std::size_t triangles = 2 * std::size_t(n) - 4;
  if (routine == Routine::trmesh) {
    Lists own(n);
    return seconds_a_call([&] { library.trmesh(nodes, own); }, calls);
  }
  if (routine == Routine::trlist) {
    constexpr int rows = 9;
    std::vector<int> ltri(static_cast<std::size_t>(rows) * triangles);
    return seconds_a_call([&] { library.trlist(n, *lists, rows, ltri); }, calls);
  }
  std::vector<int> listc(3 * triangles);
  std::vector<double> centres(4 * triangles);
  return seconds_a_call([&] { library.crlist(nodes, *lists, listc, centres); }, calls);
}

double seconds_a_call(const Witness& witness, const std::vector<Point>& points, int calls) {
  const auto call = [&] {
    std::size_t vertices = 0;
    const double seconds = witness.seconds(points, vertices);
    if (vertices != points.size())
      throw std::runtime_error(fmt::format("kept {} of {} points", vertices, points.size()));
    return seconds;
  };
  const double first = call();
  if (first >= 1) return first;
  double sum = 0;
  for (int i = 0; i < calls; ++i) sum += call();
  return sum / calls;
}

}  // namespace benchmark
