#include "numerics/every_routine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <type_traits>

#include "capi/pstripack.h"
#include "differential/routines.h"
#include "point_sets.h"
#include "support/fortran_unit.h"

namespace {

using Real = stripack_real;
using Int = stripack_integer;
using point_sets::make;
using point_sets::Random;
using pstripack::Point;

constexpr Int mark = -7777;  // fills entries before a call

/// A hash of the bits of values; all NaNs are one.
class Hash {
 public:
  template <class T>
  void add(T value) {
    if constexpr (std::is_floating_point_v<T>)
      if (std::isnan(value)) value = std::numeric_limits<T>::quiet_NaN();
    // The same number on big-endian machines.
    std::conditional_t<sizeof value == 8, std::uint64_t,
                       std::conditional_t<sizeof value == 4, std::uint32_t, std::uint8_t>>
        bits;
    static_assert(sizeof bits == sizeof value);
    std::memcpy(&bits, &value, sizeof value);
    state_ = (state_ ^ bits) * 0x9e3779b97f4a7c15;
    state_ ^= state_ >> 32;
  }
  template <class First, class... Others>
  void add(First first, Others... others) {
    add(first);
    (add(others), ...);
  }
  template <class T>
  void add(Guarded<T>& array) {
    for (std::size_t i = 0; i < array.size(); ++i) add(array[i]);
  }
  void add(const std::string& text) {
    for (const char c : text) add(c);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 1;
};

std::size_t at(Int number) { return static_cast<std::size_t>(number - 1); }

/// An array that a routine only reads.
template <class T>
class Input : public Guarded<T> {
 public:
  Input(const std::vector<T>& values, Edge edge) : Guarded<T>(values, edge) { this->make_read_only(); }
};

struct Triangulation {
  std::vector<Int> list, lptr, lend;
  Int lnew = mark;

  bool on_boundary(Int k) const { return list[at(lend[at(k)])] < 0; }
  Int last_neighbour(Int k) const { return std::abs(list[at(lend[at(k)])]); }
  Int first_neighbour(Int k) const { return list[at(lptr[at(lend[at(k)])])]; }
  Int second_neighbour(Int k) const { return std::abs(list[at(lptr[at(lptr[at(lend[at(k)])])])]); }
};

/// Arrays for a triangulation of n nodes that a routine changes.
struct Edited {
  Edited(const Triangulation& t, Int n, Edge edge)
      : list(resized(t.list, 6 * n - 12), edge),
        lptr(resized(t.lptr, 6 * n - 12), edge),
        lend(resized(t.lend, n), edge),
        lnew(t.lnew) {}

  Guarded<Int> list, lptr, lend;
  Int lnew;

 private:
  static std::vector<Int> resized(std::vector<Int> values, Int size) {
    values.resize(static_cast<std::size_t>(size), mark);
    return values;
  }
};

std::vector<Real> column(const std::vector<Point>& nodes, double Point::*v) {
  std::vector<Real> values;
  for (const Point& p : nodes) values.push_back(static_cast<Real>(p.*v));
  return values;
}

class EveryRoutine {
 public:
  EveryRoutine(const std::vector<Point>& nodes, Edge edge, const CallRoutine& call)
      : nodes_(nodes),
        n_(static_cast<Int>(nodes.size())),
        side_(edge),
        call_(call),
        x_(column(nodes, &Point::x), edge),
        y_(column(nodes, &Point::y), edge),
        z_(column(nodes, &Point::z), edge) {}

  std::uint64_t fingerprint() {
    vectors();
    if (build(n_, mesh_) != 0) return hash_.value();
    queries();
    searches();
    voronoi();
    listings();
    changes();
    if (build(n_ - 1, front_) == 0) additions();
    return hash_.value();
  }

 private:
  template <class Routine>
  void call(const char* name, const Routine& routine) {
    call_(name, routine);
  }

  // ---- TRMESH ----

  Int build(Int n, Triangulation& t) {
    Edited out({}, n, side_);
    Int ier = mark;
    call("TRMESH", [&] {
#ifdef STRIPACK_8_ARGUMENTS
      trmesh_(&n, x_.data(), y_.data(), z_.data(), out.list.data(), out.lptr.data(), out.lend.data(), &ier);
#else
      trmesh_(&n, x_.data(), y_.data(), z_.data(), out.list.data(), out.lptr.data(), out.lend.data(),
              &out.lnew, nullptr, nullptr, nullptr, &ier);
#endif
    });
    hash_.add(ier, out.lnew);
    hash_.add(out.list), hash_.add(out.lptr), hash_.add(out.lend);
    t.list.assign(out.list.data(), out.list.data() + out.list.size());
    t.lptr.assign(out.lptr.data(), out.lptr.data() + out.lptr.size());
    t.lend.assign(out.lend.data(), out.lend.data() + out.lend.size());
    t.lnew = 1 + static_cast<Int>(std::find(t.list.begin(), t.list.end(), mark) - t.list.begin());
    return ier;
  }

  // ---- vectors ----

  void vectors() {
    Random random(5);
    constexpr Int count = 100;
    std::vector<Real> angles[2];
    for (auto& a : angles)
      for (Int i = 0; i < count; ++i) a.push_back(static_cast<Real>(random.uniform(-4, 4)));
    Input<Real> latitude(angles[0], side_), longitude(angles[1], side_);
    Guarded<Real> x(count, side_), y(count, side_), z(count, side_);
    call("TRANS", [&] { trans_(&count, latitude.data(), longitude.data(), x.data(), y.data(), z.data()); });
    hash_.add(x), hash_.add(y), hash_.add(z);

    std::map<std::size_t, Input<Real>> of_node;
    const auto vector_of = [&](std::size_t k) {
      return of_node.try_emplace(k, vector(k), side_).first->second.data();
    };
    for (Int i = 0; i < std::min<Int>(n_, 300); ++i) {
      const std::size_t a = index(i), b = index(7 * i + 1), c = index(11 * i + 2);
      Real latitude_of_a = mark, longitude_of_a = mark, length = mark;
      call("SCOORD", [&] { scoord_(&x_[a], &y_[a], &z_[a], &latitude_of_a, &longitude_of_a, &length); });
      hash_.add(latitude_of_a, longitude_of_a, length);
      for (const std::size_t p : {b, c}) {
        Int left = mark;
        call("LEFT", [&] {
          left = left_(&x_[a], &y_[a], &z_[a], &x_[b], &y_[b], &z_[b], &x_[p], &y_[p], &z_[p]) != 0;
        });
        hash_.add(left);
      }
      const Real *const u = vector_of(a), *const v = vector_of(b), *const w = vector_of(c);
      Guarded<Real> out(3, side_);
      Real area = mark, stored = mark;
      Int circum_ier = mark, intrsc_ier = mark;
      call("AREAS", [&] { area = areas_(u, v, w); });
      call("CIRCUM", [&] { circum_(u, v, w, out.data(), &circum_ier); });
      hash_.add(out);
      call("INTRSC", [&] { intrsc_(u, v, w, out.data(), &intrsc_ier); });
      hash_.add(out);
      call("STORE", [&] { stored = store_(u); });
      hash_.add(area, stored);
      hash_.add(circum_ier, intrsc_ier);
    }

    Int seeds[] = {1, 2, 3};
    for (int i = 0; i < 300; ++i) {
      Int drawn = mark;
      const Int most = i < 150 ? 10 : 2000000000;
      call("JRAND", [&] { drawn = jrand_(&most, &seeds[0], &seeds[1], &seeds[2]); });
      hash_.add(drawn, seeds[0], seeds[1], seeds[2]);
    }
    polygons(random);
  }

  void polygons(Random& random) {
    for (int i = 0; i < 30; ++i) {
      const auto corners = make("cap:0.5", 12, static_cast<std::uint64_t>(i));
      Input<Real> x(column(corners, &Point::x), side_), y(column(corners, &Point::y), side_),
          z(column(corners, &Point::z), side_);
      const Int lv = 12, nv = i % 3 == 0 ? 3 : 6;
      std::vector<Int> around;
      for (Int k = 0; k < nv; ++k) around.push_back(1 + (5 * k + i) % lv);
      Input<Int> listv(around, side_);
      const Point p = i % 2 == 0 ? random.direction() : make("cap:0.5", 1, 99)[0];
      Input<Real> point({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)}, side_);
      Int inside = mark, ier = mark;
      call("INSIDE", [&] {
        inside = inside_(point.data(), &lv, x.data(), y.data(), z.data(), &nv, listv.data(), &ier) != 0;
      });
      hash_.add(inside, ier);
    }
  }

  // ---- what only asks ----

  void queries() {
    Input<Int> list(mesh_.list, side_), lptr(mesh_.lptr, side_), lend(mesh_.lend, side_);
    for (Int i = 0; i < std::min<Int>(n_, 300); ++i) {
      const Int last = lend[index(i)], neighbour = mesh_.first_neighbour(1 + static_cast<Int>(index(i)));
      Int slot = mark, count = mark, swap = mark;
      call("LSTPTR", [&] { slot = lstptr_(&last, &neighbour, list.data(), lptr.data()); });
      call("NBCNT", [&] { count = nbcnt_(&last, lptr.data()); });
      const Int a = node(i), b = node(7 * i + 1), c = node(11 * i + 2), d = node(13 * i + 3);
      call("SWPTST", [&] { swap = swptst_(&a, &b, &c, &d, x_.data(), y_.data(), z_.data()) != 0; });
      hash_.add(slot, count, swap);
    }

    nb_ = 0;
    for (Int k = 1; k <= n_; ++k) nb_ += mesh_.on_boundary(k);
    Guarded<Int> nodes(static_cast<std::size_t>(nb_), side_);
    Int nb = mark, na = mark, nt = mark;
    call("BNODES", [&] { bnodes_(&n_, list.data(), lptr.data(), lend.data(), nodes.data(), &nb, &na, &nt); });
    hash_.add(nb, na, nt);
    hash_.add(nodes);
    for (const Int rows : {6, 9}) {
      Guarded<Int> triangles(static_cast<std::size_t>(rows * nt), side_);
      Int count = mark, ier = mark;
      call("TRLIST", [&] {
        trlist_(&n_, list.data(), lptr.data(), lend.data(), &rows, &count, triangles.data(), &ier);
      });
      hash_.add(count, ier);
      hash_.add(triangles);
      if (rows == 6 && n_ <= 300) print_triangles(triangles, rows, count);
    }
    Guarded<Int> corners(static_cast<std::size_t>(3 * nt), side_);
    Int count = mark, ier = mark;
    call("TRLIST2",
         [&] { trlist2_(&n_, list.data(), lptr.data(), lend.data(), &count, corners.data(), &ier); });
    hash_.add(count, ier);
    hash_.add(corners);
    corners.make_read_only();
    Guarded<Real> areas(static_cast<std::size_t>(nt), side_);
    call("TRIAREAS",
         [&] { triareas_(&n_, x_.data(), y_.data(), z_.data(), &nt, corners.data(), areas.data()); });
    hash_.add(areas);
#ifndef LOUT_COUNTS  // double, std::int32_t
    Int defect = mark;
    std::uint64_t print = 0;
    call("pstripack_validate", [&] {
      defect = pstripack_validate(n_, x_.data(), y_.data(), z_.data(), list.data(), lptr.data(), lend.data(),
                                  mesh_.lnew, nullptr, 0);
    });
    call("pstripack_fingerprint",
         [&] { print = pstripack_fingerprint(n_, list.data(), lptr.data(), lend.data()); });
    hash_.add(defect);
    hash_.add(print);
#endif
  }

  void searches() {
    Input<Int> list(mesh_.list, side_), lptr(mesh_.lptr, side_), lend(mesh_.lend, side_);
    Random random(6);
    for (Int i = 0; i < 100; ++i) {
      const std::size_t a = index(i), b = index(7 * i + 1);
      const Point kinds[] = {random.direction(), nodes_[a],
                             point_sets::normalized({nodes_[a].x + nodes_[b].x, nodes_[a].y + nodes_[b].y,
                                                     nodes_[a].z + nodes_[b].z + 1e-300})};
      const Point p = kinds[i % 3];
      Input<Real> point({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)}, side_);
      const Int start = i % 5 == 0 ? 0 : node(3 * i);
      Real b1 = mark, b2 = mark, b3 = mark, angle = mark;
      Int i1 = mark, i2 = mark, i3 = mark, nearest = mark;
      call("TRFIND", [&] {
        trfind_(&start, point.data(), &n_, x_.data(), y_.data(), z_.data(), list.data(), lptr.data(),
                lend.data(), &b1, &b2, &b3, &i1, &i2, &i3);
      });
      call("NEARND", [&] {
        nearest = nearnd_(point.data(), &start, &n_, x_.data(), y_.data(), z_.data(), list.data(),
                          lptr.data(), lend.data(), &angle);
      });
      hash_.add(b1, b2, b3, angle);
      hash_.add(i1, i2, i3, nearest);
    }
    std::vector<Int> nearest = {1};
    for (Int l = 2; l <= std::min<Int>(n_, 70); ++l) {
      nearest.push_back(mark);
      Guarded<Int> npts(nearest, side_);
      Real distance = mark;
      Int ier = mark;
      call("GETNP", [&] {
        getnp_(x_.data(), y_.data(), z_.data(), list.data(), lptr.data(), lend.data(), &l, npts.data(),
               &distance, &ier);
      });
      hash_.add(distance);
      hash_.add(npts);
      hash_.add(ier);
      if (ier != 0) break;
      nearest.back() = npts[npts.size() - 1];
    }
  }

  // ---- Voronoi diagrams ----

  void voronoi() {
    Input<Int> list(mesh_.list, side_), lend(mesh_.lend, side_);
    Guarded<Int> lptr(mesh_.lptr, side_);
    Int lnew = mesh_.lnew, nb = mark, ier = mark;
    const Int ncol = std::max<Int>(nb_ - 2, 0);
    const auto nt = static_cast<std::size_t>(2 * n_ - 4);
    Guarded<Int> ltri(static_cast<std::size_t>(6 * ncol), side_), listc(mesh_.list.size(), side_);
    Guarded<Real> xc(nt, side_), yc(nt, side_), zc(nt, side_), rc(nt, side_);
    call("CRLIST", [&] {
      crlist_(&n_, &ncol, x_.data(), y_.data(), z_.data(), list.data(), lend.data(), lptr.data(), &lnew,
              ltri.data(), listc.data(), &nb, xc.data(), yc.data(), zc.data(), rc.data(), &ier);
    });
    hash_.add(lnew, nb, ier);
    hash_.add(lptr), hash_.add(ltri), hash_.add(listc);
    hash_.add(xc), hash_.add(yc), hash_.add(zc), hash_.add(rc);
    if (ier != 0 || n_ > 300) return;

    lptr.make_read_only(), listc.make_read_only();
    xc.make_read_only(), yc.make_read_only(), zc.make_read_only();
    const Int count = static_cast<Int>(nt);
    draw([&](const Frame& f, Int& code) {
      call("VRPLOT", [&] {
        vrplot_(&f.unit, &f.size, &f.latitude, &f.longitude, &f.angle, &n_, x_.data(), y_.data(), z_.data(),
                &count, listc.data(), lptr.data(), lend.data(), xc.data(), yc.data(), zc.data(), f.title,
                &f.numbers, &code, std::strlen(f.title));
      });
    });
    hash_.add(written_to_stdout([&] {
      call("VORONOI_POLY_COUNT", [&] { voronoi_poly_count_(&n_, lend.data(), lptr.data(), listc.data()); });
    }));
  }

  // ---- what prints ----

  struct Frame {
    Int unit = 8;
    Real size = 7.5, latitude = 40, longitude = -100, angle = 90;
    const char* title = "(Every routine)";
    Int numbers = 1;
  };
  template <class Draw>
  void draw(const Draw& routine) {
    for (const double angle : {90.0, 0.7}) {
      Frame frame;
      frame.angle = static_cast<Real>(angle);
      Int ier = mark;
      hash_.add(written_to_unit(static_cast<int>(frame.unit), [&] { routine(frame, ier); }));
      hash_.add(ier);
    }
  }
  template <class Print>
  void print(const Print& routine) {
#ifdef LOUT_COUNTS
    hash_.add(written_to_unit(7, routine));
#else
    hash_.add(written_to_stdout(routine));
#endif
  }

  void print_triangles(Guarded<Int>& triangles, Int rows, Int count) {
    const Int coordinates = 0, unit = 7;
    triangles.make_read_only();
    print([&] {
      call("TRLPRT", [&] {
        trlprt_(&n_, x_.data(), y_.data(), z_.data(), &coordinates, &rows, &count, triangles.data(), &unit);
      });
    });
  }

  void listings() {
    if (n_ > 300) return;
    Input<Int> list(mesh_.list, side_), lptr(mesh_.lptr, side_), lend(mesh_.lend, side_);
    const Int coordinates = 0, unit = 7;
    print([&] {
      call("TRPRNT", [&] {
        trprnt_(&n_, x_.data(), y_.data(), z_.data(), &coordinates, list.data(), lptr.data(), lend.data(),
                &unit);
      });
    });
    draw([&](const Frame& f, Int& ier) {
      call("TRPLOT", [&] {
        trplot_(&f.unit, &f.size, &f.latitude, &f.longitude, &f.angle, &n_, x_.data(), y_.data(), z_.data(),
                list.data(), lptr.data(), lend.data(), f.title, &f.numbers, &ier, std::strlen(f.title));
      });
    });
  }

  // ---- what changes the triangulation ----

  void add(Edited& t) {
    hash_.add(t.list), hash_.add(t.lptr), hash_.add(t.lend);
    hash_.add(t.lnew);
  }

  /// Each routine gets a copy of the triangulation of all nodes.
  void changes() {
    for (Int i = 0; i < (n_ <= 300 ? 6 : 1); ++i) {
      const Int a = node(5 * i), b = mesh_.first_neighbour(a);
      {
        Edited t(mesh_, n_, side_);
        Int slot = mark;
        call("DELNB",
             [&] { delnb_(&a, &b, &n_, t.list.data(), t.lptr.data(), t.lend.data(), &t.lnew, &slot); });
        hash_.add(slot);
        add(t);
      }
      {
        Edited t(mesh_, n_, side_);
        const Int far = node(n_ / 2 + i);
        Int crossed = n_, ier = mark;
        Guarded<Int> arcs(static_cast<std::size_t>(2 * crossed), side_);
        hash_.add(written_to_stdout([&] {
          call("EDGE", [&] {
            edge_(&a, &far, x_.data(), y_.data(), z_.data(), &crossed, arcs.data(), t.list.data(),
                  t.lptr.data(), t.lend.data(), &ier);
          });
        }));
        hash_.add(crossed, ier);
        hash_.add(arcs);
        add(t);
      }
      swap_and_back(a, b);
      if (n_ > 4) delete_node(a);
    }
    for (Int k = 1; k <= n_; ++k)
      if (mesh_.on_boundary(k)) {
        Edited t(mesh_, n_, side_);
        const Int next = mesh_.first_neighbour(k);
        Int ier = mark;
        call("DELARC",
             [&] { delarc_(&n_, &k, &next, t.list.data(), t.lptr.data(), t.lend.data(), &t.lnew, &ier); });
        hash_.add(ier);
        add(t);
        if (ier == 0) break;
      }
  }

  /// SWAP replaces arc a-b by the other diagonal; OPTIM then tests that diagonal.
  void swap_and_back(Int a, Int b) {
    Edited t(mesh_, n_, side_);
    // The corners left and right of a->b are the neighbours of a behind and before b, its first one.
    const Int left = mesh_.second_neighbour(a), right = mesh_.last_neighbour(a);
    if (mesh_.on_boundary(a)) return;
    Int slot = mark;
    call("SWAP", [&] { swap_(&left, &right, &a, &b, t.list.data(), t.lptr.data(), t.lend.data(), &slot); });
    hash_.add(slot);
    add(t);
    if (slot <= 0) return;
    Guarded<Int> arcs(std::vector<Int>{left, right}, side_);
    const Int one = 1;
    Int passes = 4, ier = mark;
    call("OPTIM", [&] {
      optim_(x_.data(), y_.data(), z_.data(), &one, t.list.data(), t.lptr.data(), t.lend.data(), &passes,
             arcs.data(), &ier);
    });
    hash_.add(passes, ier);
    hash_.add(arcs);
    add(t);
  }

  void delete_node(Int k) {
    Edited t(mesh_, n_, side_);
    Guarded<Real> x(column(nodes_, &Point::x), side_), y(column(nodes_, &Point::y), side_),
        z(column(nodes_, &Point::z), side_);
    Int columns = 0, n = n_, ier = mark;
    for (const bool enough : {false, true}) {  // the first call says how many columns it takes
      Guarded<Int> arcs(static_cast<std::size_t>(2 * columns), side_);
      call("DELNOD", [&] {
        delnod_(&k, &n, x.data(), y.data(), z.data(), t.list.data(), t.lptr.data(), t.lend.data(), &t.lnew,
                &columns, arcs.data(), &ier);
      });
      hash_.add(columns, n, ier);
      hash_.add(arcs);
      if (ier != 2 || enough) break;
    }
    hash_.add(x), hash_.add(y), hash_.add(z);
    add(t);
  }

  /// Adds the last node to the triangulation of the others: by ADDNOD, and by the steps of ADDNOD.
  void additions() {
    Edited whole(front_, n_, side_);
    const Int anywhere = 0;
    Int ier = mark;
    call("ADDNOD", [&] {
      addnod_(&anywhere, &n_, x_.data(), y_.data(), z_.data(), whole.list.data(), whole.lptr.data(),
              whole.lend.data(), &whole.lnew, &ier);
    });
    hash_.add(ier);
    add(whole);

    Edited steps(front_, n_, side_);
    const Int others = n_ - 1, start = 1;
    const std::vector<Real> p = vector(static_cast<std::size_t>(others));
    Real b1, b2, b3;
    Int i1, i2, i3;
    trfind_(&start, p.data(), &others, x_.data(), y_.data(), z_.data(), steps.list.data(), steps.lptr.data(),
            steps.lend.data(), &b1, &b2, &b3, &i1, &i2, &i3);
    Int *const list = steps.list.data(), *const lptr = steps.lptr.data(), *const lend = steps.lend.data();
    if (i3 != 0)
      call("INTADD", [&] { intadd_(&n_, &i1, &i2, &i3, list, lptr, lend, &steps.lnew); });
    else if (i1 != i2)
      call("BDYADD", [&] { bdyadd_(&n_, &i1, &i2, list, lptr, lend, &steps.lnew); });
    else if (i1 != 0)
      call("COVSPH", [&] { covsph_(&n_, &i1, list, lptr, lend, &steps.lnew); });
    add(steps);

    Edited inserted(front_, n_, side_);
    const Int slot = inserted.lend[0];
    call("INSERT", [&] { insert_(&n_, &slot, inserted.list.data(), inserted.lptr.data(), &inserted.lnew); });
    add(inserted);
  }

  std::size_t index(Int i) const { return static_cast<std::size_t>(i % n_); }
  Int node(Int i) const { return 1 + i % n_; }
  std::vector<Real> vector(std::size_t i) { return {x_[i], y_[i], z_[i]}; }

  const std::vector<Point>& nodes_;
  const Int n_;
  const Edge side_;
  const CallRoutine& call_;
  Input<Real> x_, y_, z_;
  Triangulation mesh_, front_;
  Int nb_ = 0;
  Hash hash_;
};

}  // namespace

std::vector<NamedNodes> spread_of_nodes() {
  std::vector<NamedNodes> sets;
  const auto family = [&](const char* name, std::size_t n) {
    sets.push_back({std::string(name) + " " + std::to_string(n), make(name, n)});
  };
  for (const std::size_t n : {4, 12, 300}) family("random", n);
  for (const char* name : {"hemisphere", "hemisphere-rim", "ring", "latlon", "cubed-sphere", "icosahedral",
                           "cap:1e-8", "pairs", "box", "strip", "dense-cap", "antipodal"})
    family(name, 150);
  family("hemisphere", 21000);  // on threads
  const auto special = [&](const char* name, std::vector<Point> nodes) { sets.push_back({name, nodes}); };

  constexpr double tiny = std::numeric_limits<double>::denorm_min(),
                   inf = std::numeric_limits<double>::infinity();
  std::vector<Point> nodes = make("random", 100);
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) nodes.push_back({1, i * tiny, j * 1e-310});
  special("denormal components", nodes);
  nodes = make("random", 100);
  for (Point& p : nodes) p = scaled(6371229, p);
  special("radius 6371229", nodes);
  for (Point& p : nodes) p = {1e-310 * p.x, 1e-310 * p.y, 1e-310 * p.z};
  special("denormal vectors", nodes);
  nodes = make("cap:0.3", 60);
  const Point p = nodes[0];
  nodes.push_back(scaled(-1, p));
  special("cap and a node opposite", nodes);
  nodes.back() = point_sets::normalized({p.y, -p.x, p.z + 0.1});
  special("cap and a node beside", nodes);
  nodes = make("random", 50);
  nodes[40] = nodes[20];
  special("two nodes coincide", nodes);
  nodes[2] = nodes[0];
  special("first three on a great circle", nodes);
  nodes[30].y = inf;
  special("a node that is not finite", nodes);
  nodes.resize(2);
  special("two nodes", nodes);
  return sets;
}

std::uint64_t fingerprint_of_every_routine(const std::vector<Point>& nodes, Edge edge,
                                           const CallRoutine& call_routine) {
  return EveryRoutine(nodes, edge, call_routine).fingerprint();
}
