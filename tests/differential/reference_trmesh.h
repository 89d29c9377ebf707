#pragma once
// A plain TRMESH on LIST, LPTR and LEND, without optimizations. It is the reference for REAL*4, for which
// there is no original here; in REAL*8 it is compared with libngmath's. Indices are those of Fortran: element
// 0 is not used.

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace differential {

template <class Real>
class ReferenceTrmesh {
 public:
  struct Rules {
    int tolerance_in_epsilons;
    bool single_precision_random;
  };

  ReferenceTrmesh(std::vector<Real> x, std::vector<Real> y, std::vector<Real> z, Rules rules)
      : n(static_cast<int>(x.size())), rules_(rules), x_(shifted(x)), y_(shifted(y)), z_(shifted(z)) {
    list.assign(static_cast<std::size_t>(6 * n), 0);
    lptr = list;
    lend.assign(static_cast<std::size_t>(n) + 1, 0);
  }

  /// Returns IER; -99 if a search takes more than `most_starts` restarts.
  int run(int most_starts = 20000) {
    starts_left_ = most_starts;
    const Real d = side(1, 2, 3);
    if (d == 0) return -2;
    list = d > 0 ? std::vector<int>{0, 2, -3, 3, -1, 1, -2} : std::vector<int>{0, 3, -2, 1, -3, 2, -1};
    list.resize(static_cast<std::size_t>(6 * n), 0);
    for (int s = 1; s <= 6; ++s) at(lptr, s) = s % 2 == 1 ? s + 1 : s - 1;
    for (int k = 1; k <= 3; ++k) at(lend, k) = 2 * k;
    lnew = 7;

    std::vector<int> near(static_cast<std::size_t>(n) + 1);
    std::vector<Real> dist(static_cast<std::size_t>(n) + 1);
    for (int i = 4; i <= n; ++i) {
      const Real d1 = -dot(i, 1), d2 = -dot(i, 2), d3 = -dot(i, 3);
      at(near, i) = d1 <= d2 && d1 <= d3 ? 1 : d2 <= d1 && d2 <= d3 ? 2 : 3;
      at(dist, i) = -dot(i, at(near, i));
    }
    for (int k = 4; k <= n; ++k) {
      if (const int ier = add(k, at(near, k)); ier != 0) return ier;
      for (int i = k + 1; i <= n; ++i) {
        const int slot = lstptr(at(lend, k), at(near, i));
        if (std::abs(at(list, slot)) == at(near, i) && -dot(i, k) < at(dist, i)) {
          at(near, i) = k;
          at(dist, i) = -dot(i, k);
        }
      }
    }
    return 0;
  }

  const int n;
  std::vector<int> list, lptr, lend;
  int lnew = 0;
  int nodes = 3;  ///< number of nodes in the lists

 private:
  struct Point {
    Real x, y, z;
  };
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

  static std::vector<Real> shifted(std::vector<Real> v) {
    v.insert(v.begin(), 0);
    return v;
  }
  template <class T>
  static T& at(std::vector<T>& v, int i) {
    return v.at(static_cast<std::size_t>(i));
  }
  Point point(int i) { return {at(x_, i), at(y_, i), at(z_, i)}; }
  static Real dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  Real dot(int a, int b) { return dot(point(a), point(b)); }
  Real side(int i, int j, int k) {
    const Point a = point(i), b = point(j), c = point(k);
    return c.x * (a.y * b.z - b.y * a.z) - c.y * (a.x * b.z - b.x * a.z) + c.z * (a.x * b.y - b.x * a.y);
  }
  bool must_swap(int n1, int n2, int n3, int n4) {
    const Point o = point(n4);
    const auto from = [&](int i) { return Point{point(i).x - o.x, point(i).y - o.y, point(i).z - o.z}; };
    const Point a = from(n1), b = from(n2), c = from(n3);
    return c.x * (b.y * a.z - a.y * b.z) - c.y * (b.x * a.z - a.x * b.z) + c.z * (b.x * a.y - a.x * b.y) > 0;
  }
  template <class Kind>
  int random(int limit) {
    ix_ = 171 * ix_ % 30269;
    iy_ = 172 * iy_ % 30307;
    iz_ = 170 * iz_ % 30323;
    const Kind sum = Kind(ix_) / Kind(30269) + Kind(iy_) / Kind(30307) + Kind(iz_) / Kind(30323);
    return static_cast<int>(Kind(limit) * (sum - std::floor(sum)) + Kind(1));
  }
  int random_start(int limit) {
    --starts_left_;
    return std::min(limit, rules_.single_precision_random ? random<float>(limit) : random<Real>(limit));
  }

  int last(int k) { return std::abs(at(list, at(lend, k))); }
  int first(int k) { return std::abs(at(list, at(lptr, at(lend, k)))); }
  int lstptr(int lpl, int wanted) {
    int slot = at(lptr, lpl);
    while (slot != lpl && at(list, slot) != wanted) slot = at(lptr, slot);
    return slot;
  }
  void append(int entry, int next) {
    at(list, lnew) = entry;
    at(lptr, lnew) = next;
    ++lnew;
  }
  void insert(int k, int slot) {
    const int next = at(lptr, slot);
    at(lptr, slot) = lnew;
    append(k, next);
  }

  int add(int k, int start) {
    int i1, i2, i3;
    if (!find(k, start, i1, i2, i3)) return -99;
    if (i1 == 0) return -2;
    if (i3 != 0) {
      for (const int l : {i1, i2, i3}) {
        const Point a = point(k), b = point(l);
        if (a.x == b.x && a.y == b.y && a.z == b.z) return l;
      }
      const int m = lnew;
      insert(k, lstptr(at(lend, i1), i2));
      insert(k, lstptr(at(lend, i2), i3));
      insert(k, lstptr(at(lend, i3), i1));
      append(i1, m + 4);
      append(i2, m + 5);
      append(i3, m + 3);
      at(lend, k) = m + 5;
    } else if (i1 != i2) {
      int s = at(lend, i1);
      std::vector<int> seen{i1};
      int v = -at(list, s);
      const int f = at(lptr, s);
      at(list, s) = v;
      at(lptr, s) = lnew;
      at(lend, i1) = lnew;
      append(-k, f);
      for (;;) {
        s = at(lend, v);
        insert(k, s);
        if (v == i2) break;
        seen.push_back(v);
        v = at(list, s) = -at(list, s);
      }
      list_of(k, seen, -i2);
    } else {
      std::vector<int> seen;
      int v = i1;
      do {
        seen.push_back(v);
        const int s = at(lend, v);
        insert(k, s);
        v = at(list, s) = -at(list, s);
      } while (v != i1);
      const int end = seen.back();
      seen.pop_back();
      list_of(k, seen, end);
    }
    nodes = k;
    optimise(k);
    return 0;
  }

  void list_of(int k, const std::vector<int>& neighbours, int end) {
    const int m = lnew;
    for (const int v : neighbours) append(v, lnew + 1);
    append(end, m);
    at(lend, k) = lnew - 1;
  }

  void optimise(int k) {
    const int alpha = at(lptr, at(lend, k));
    int u = std::abs(at(list, alpha)), sigma = at(lptr, alpha), v = std::abs(at(list, sigma));
    for (;;) {
      const int tau = lstptr(at(lend, v), u);
      if (at(list, tau) >= 0) {
        const int w = std::abs(at(list, at(lptr, tau)));
        if (must_swap(w, k, v, u))
          if (const int rho = swap(w, k, v, u)) {
            v = w;
            sigma = rho;
            continue;
          }
      }
      if (sigma == alpha || at(list, sigma) < 0) return;
      u = v;
      sigma = at(lptr, sigma);
      v = std::abs(at(list, sigma));
    }
  }

  int swap(int in1, int in2, int io1, int io2) {
    if (std::abs(at(list, lstptr(at(lend, in1), in2))) == in2) return 0;
    int p = lstptr(at(lend, io1), in2), h = at(lptr, p);
    at(lptr, p) = at(lptr, h);
    if (at(lend, io1) == h) at(lend, io1) = p;
    p = lstptr(at(lend, in1), io1);
    at(lptr, h) = at(lptr, p);
    at(lptr, p) = h;
    at(list, h) = in2;
    p = lstptr(at(lend, io2), in1);
    h = at(lptr, p);
    at(lptr, p) = at(lptr, h);
    if (at(lend, io2) == h) at(lend, io2) = p;
    p = lstptr(at(lend, in2), io2);
    at(lptr, h) = at(lptr, p);
    at(lptr, p) = h;
    at(list, h) = in1;
    return h;
  }

  /// TRFIND for node k among nodes 1..k-1.
  bool find(int k, int o, int& i1, int& i2, int& i3) {
    const auto D = [&](int a, int b) { return side(a, b, k); };
    while (starts_left_ > 0) {
      int r = first(o), l = 0, slot = at(lptr, at(lend, o));
      const int end = last(o), begin = r;
      bool is_wedge = false;
      if (at(list, at(lend, o)) < 0) {
        if (D(o, begin) < 0) return visible(k, o, begin, i1, i2, i3);
        if (D(end, o) < 0) return visible(k, end, o, i1, i2, i3);
      } else {
        while (!is_wedge && D(o, r) < 0) {
          slot = at(lptr, slot);
          r = std::abs(at(list, slot));
          is_wedge = r == end;
        }
        if (is_wedge) l = begin;
      }
      while (!is_wedge) {
        slot = at(lptr, slot);
        l = std::abs(at(list, slot));
        if (D(o, l) < 0) {
          is_wedge = true;
          break;
        }
        r = l;
        if (r == end) break;
      }
      if (!is_wedge && D(o, begin) < 0) {
        is_wedge = true;
        l = begin;
      }
      if (!is_wedge) {
        if (std::fabs(dot(o, k)) < 1 - 4 * epsilon) {
          slot = at(lend, o);
          while (!(D(r, o) < 0)) {
            slot = at(lptr, slot);
            if (slot == at(lend, o)) {
              i1 = i2 = i3 = 0;
              return true;
            }
            r = std::abs(at(list, slot));
          }
        }
        o = r;
        --starts_left_;
        continue;
      }

      int t = o, r_star = r, l_star = l;
      bool is_astray = false;
      while (!is_astray && D(r, l) < 0) {
        const int tau = lstptr(at(lend, l), r);
        if (at(list, tau) < 0) return visible(k, r, l, i1, i2, i3);
        const int m = std::abs(at(list, at(lptr, tau)));
        if (D(o, m) < 0) {
          t = l;
          l = m;
          r_star = r;
          is_astray = l == l_star || l == o;
        } else {
          t = r;
          r = m;
          l_star = l;
          is_astray = r == r_star || r == o;
        }
      }
      if (!is_astray) {
        Real b1 = D(l, t), b2 = D(t, r);
        if (D(r, l) < epsilon) {
          const Real c = dot(r, l), px = dot(k, r), py = dot(k, l);
          b1 = px - c * py;
          b2 = py - c * px;
        }
        const Real tolerance = Real(rules_.tolerance_in_epsilons) * epsilon;
        if (!(b1 < -tolerance || b2 < -tolerance)) {
          i1 = r;
          i2 = l;
          i3 = t;
          return true;
        }
      }
      o = random_start(k - 1);
    }
    return false;
  }

  bool visible(int k, int r_star, int l_star, int& i1, int& i2, int& i3) {
    i3 = 0;
    const auto ends = [&](int from, int to, int next) {
      const Real c = dot(from, to);
      const Point a = point(from), b = point(to), q{a.x - c * b.x, a.y - c * b.y, a.z - c * b.z};
      return dot(point(k), q) >= 0 || dot(point(next), q) >= 0;
    };
    int r = r_star, l = l_star, rightmost = 0, far_end = 0;
    while (rightmost == 0) {
      const int next = first(l);
      if (side(l, next, k) >= 0) {
        if (ends(r, l, next)) {
          rightmost = l;
          break;
        }
        far_end = l;
      }
      r = l;
      l = next;
      if (l == r_star) {
        i1 = i2 = r_star;
        return true;
      }
    }
    i1 = rightmost;
    i2 = far_end;
    if (far_end != 0) return true;
    r = r_star;
    l = l_star;
    for (;;) {
      const int next = last(r);
      if (side(next, r, k) >= 0) {
        if (ends(l, r, next)) {
          i2 = r;
          return true;
        }
        i1 = r;
      }
      l = r;
      r = next;
      if (r == r_star) {
        i1 = i2 = r;
        return true;
      }
    }
  }

  const Rules rules_;
  std::vector<Real> x_, y_, z_;
  int ix_ = 1, iy_ = 2, iz_ = 3;
  int starts_left_ = 0;
};

}  // namespace differential
