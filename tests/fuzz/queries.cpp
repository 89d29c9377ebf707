// The routines that query a triangulation, by the public symbols, with arguments of any bits.

#include <array>
#include <cmath>
#include <limits>

#include "input.h"
#include "support/fortran_mesh.h"
#include "support/guarded.h"

namespace {

using pstripack::Point;

constexpr int kMostNodes = 24, kMostQuestions = 40;

class Questions {
 public:
  explicit Questions(Input& input) : input_(input), mesh_(kMostNodes) {
    for (int count = 3 + input.below(kMostNodes - 2); count > 0; --count)
      nodes_.push_back(any_vector(input, nodes_));
    begun_ = mesh_.triangulate(nodes_) == 0;
    for (const Point& p : nodes_) unit_ = unit_ && is_unit(p);
  }

  void run() {
    if (!begun_) return;
    rings_ = rings_of(mesh_.lists()).value();
    faces_ = faces_of(rings_);
    const FortranMesh before = mesh_;
    for (int i = 0; i < kMostQuestions && !input_.empty(); ++i) ask();
    require(before.list == mesh_.list && before.lptr == mesh_.lptr && before.lend == mesh_.lend,
            "changed lists");
  }

 private:
  static bool is_unit(const Point& p) { return std::fabs(dot(p, p) - 1) < 1e-13; }
  bool is_face(int a, int b, int c) const {
    Faces face = {{a - 1, b - 1, c - 1}};
    sort_faces(face);
    return std::find(faces_.begin(), faces_.end(), face[0]) != faces_.end();
  }
  bool is_node(int k) const { return 1 <= k && k <= mesh_.n; }
  int any_node() { return input_.integer(-1, mesh_.n + 2); }
  Point any_point() { return any_vector(input_, nodes_); }

  void ask() {
    constexpr void (Questions::*questions[])() = {
        &Questions::find,    &Questions::nearest, &Questions::next_nearest, &Questions::triangles,
        &Questions::voronoi, &Questions::polygon, &Questions::vectors};
    (this->*questions[input_.below(7)])();
  }

  void find() {
    const Point p = any_point();
    const int start = any_node();
    const double q[3] = {p.x, p.y, p.z};
    double b1 = -1, b2 = -1, b3 = -1;
    int i1, i2, i3;
    trfind_(&start, q, &mesh_.n, mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), mesh_.list.data(),
            mesh_.lptr.data(), mesh_.lend.data(), &b1, &b2, &b3, &i1, &i2, &i3);
    if (i1 == 0) {
      require(i2 == 0 && i3 == 0, "TRFIND: half found");
    } else if (i3 != 0) {
      require(is_face(i1, i2, i3), "TRFIND: no triangle");
      if (unit_ && is_unit(p)) require(b1 >= 0 && b2 >= 0 && b3 >= 0, "TRFIND: a negative weight");
    } else {
      require(is_node(i1) && is_node(i2) && rings_.boundary[i1 - 1] && rings_.boundary[i2 - 1],
              "TRFIND: no boundary nodes");
    }
    if (unit_ && is_unit(p)) require(i1 != 0, "TRFIND: a unit vector is not found");
  }

  void nearest() {
    const Point p = any_point();
    const int start = any_node();
    const double q[3] = {p.x, p.y, p.z};
    double angle;
    const int k = nearnd_(q, &start, &mesh_.n, mesh_.x.data(), mesh_.y.data(), mesh_.z.data(),
                          mesh_.list.data(), mesh_.lptr.data(), mesh_.lend.data(), &angle);
    require(0 <= k && k <= mesh_.n, "NEARND: no node");
    require(k != 0 || !unit_ || !is_unit(p), "NEARND: nothing is near to a unit vector");
  }

  /// GETNP with arbitrary node numbers within the arrays.
  void next_nearest() {
    std::array<int, kMostNodes + 2> npts;
    for (int& k : npts) k = std::min(any_node(), mesh_.n);
    const int l = std::min(input_.integer(-1, mesh_.n + 1), kMostNodes + 2);
    Guarded<int> given(std::vector<int>(npts.begin(), npts.begin() + std::max(l, 0)), Edge::end);
    double df;
    int ier;
    getnp_(mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), mesh_.list.data(), mesh_.lptr.data(),
           mesh_.lend.data(), &l, given.data(), &df, &ier);
    if (ier == 0) require(is_node(given[l - 1]), "GETNP: no node");
  }

  void triangles() {
    const int nrow = input_.below(4) == 0 ? input_.integer(0, 12) : input_.below(2) == 0 ? 6 : 9;
    Guarded<int> ltri(nrow == 6 || nrow == 9 ? std::size_t(nrow) * (2 * mesh_.n - 4) : 0, Edge::end);
    int nt, ier;
    trlist_(&mesh_.n, mesh_.list.data(), mesh_.lptr.data(), mesh_.lend.data(), &nrow, &nt, ltri.data(), &ier);
    require((ier == 0) == (nrow == 6 || nrow == 9), "TRLIST: IER = " + std::to_string(ier));
    if (ier != 0) return;
    Faces listed;
    for (int t = 0; t < nt; ++t)
      listed.push_back({ltri[t * nrow] - 1, ltri[t * nrow + 1] - 1, ltri[t * nrow + 2] - 1});
    sort_faces(listed);
    require(listed == faces_, "TRLIST: other triangles");
  }

  void voronoi() {
    FortranMesh copy = mesh_;
    const int cells = 2 * mesh_.n - 4, ncol = input_.integer(-1, mesh_.n);
    Guarded<int> ltri(6 * std::size_t(std::max(0, std::min(ncol, kMostNodes))), Edge::end),
        listc(std::size_t(3 * cells), Edge::end);
    Guarded<double> xc(cells, Edge::end), yc(cells, Edge::end), zc(cells, Edge::end), rc(cells, Edge::end);
    const int columns = std::min(ncol, kMostNodes);
    int nb, ier;
    crlist_(&copy.n, &columns, copy.x.data(), copy.y.data(), copy.z.data(), copy.list.data(),
            copy.lend.data(), copy.lptr.data(), &copy.lnew, ltri.data(), listc.data(), &nb, xc.data(),
            yc.data(), zc.data(), rc.data(), &ier);
    require(ier != -9, "CRLIST calls good lists broken");
    if (ier != 0) return;
    require(nb == std::count(rings_.boundary.begin(), rings_.boundary.end(), 1), "CRLIST: NB");
    for (int slot = 1; slot < copy.lnew; ++slot)
      require(1 <= listc[slot - 1] && listc[slot - 1] <= cells, "CRLIST: LISTC");
  }

  void polygon() {
    const Point p = any_point();
    const double q[3] = {p.x, p.y, p.z};
    std::vector<int> vertices;
    for (int count = input_.below(16); count > 0; --count) vertices.push_back(any_node());
    const int nv = std::min(input_.integer(-1, 16), static_cast<int>(vertices.size()));
    int ier;
    const int result =
        inside_(q, &mesh_.n, mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), &nv, vertices.data(), &ier);
    require(ier == 0 || result == 0, "INSIDE: true and an error");
  }

  void vectors() {
    const Point a = any_point(), b = any_point(), c = any_point();
    const double u[3] = {a.x, a.y, a.z}, v[3] = {b.x, b.y, b.z}, w[3] = {c.x, c.y, c.z};
    double centre[3], crossing[3], latitude, longitude, norm;
    int ier;
    const double area = areas_(u, v, w);
    require(!(area < 0) && !(area > 12.6), "AREAS");
    circum_(u, v, w, centre, &ier);
    intrsc_(u, v, w, crossing, &ier);
    scoord_(&a.x, &a.y, &a.z, &latitude, &longitude, &norm);
    left_(&a.x, &a.y, &a.z, &b.x, &b.y, &b.z, &c.x, &c.y, &c.z);
    const int n[4] = {1 + input_.below(mesh_.n), 1 + input_.below(mesh_.n), 1 + input_.below(mesh_.n),
                      1 + input_.below(mesh_.n)};
    swptst_(n, n + 1, n + 2, n + 3, mesh_.x.data(), mesh_.y.data(), mesh_.z.data());
  }

  Input& input_;
  FortranMesh mesh_;
  Nodes nodes_;
  Rings rings_;
  Faces faces_;
  bool begun_, unit_ = true;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  Questions(input).run();
  return 0;
}
