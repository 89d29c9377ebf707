// The routines that query a triangulation, by the public symbols, with arguments of any bits.

#include <array>
#include <cmath>
#include <limits>

#include "fortran_mesh.h"
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
    switch (input_.below(9)) {
      case 0:
        return find();
      case 1:
        return nearest();
      case 2:
        return next_nearest();
      case 3:
        return all_by_distance();
      case 4:
        return triangles();
      case 5:
        return voronoi();
      case 6:
        return polygon();
      case 7:
        return boundary();
      default:
        return vectors();
    }
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
    if (!unit_ || !is_unit(p)) return;
    require(k != 0, "NEARND: nothing is near to a unit vector");
    double most = -2;
    for (const Point& node : nodes_) most = std::max(most, dot(p, node));
    require(dot(p, mesh_.node(k)) > most - 1e-12, "NEARND: another node is nearer");
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

  void all_by_distance() {
    std::vector<int> npts(mesh_.n);
    npts[0] = 1 + input_.below(mesh_.n);
    double last = -std::numeric_limits<double>::infinity();
    for (int l = 2; l <= mesh_.n; ++l) {
      double df;
      int ier;
      getnp_(mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), mesh_.list.data(), mesh_.lptr.data(),
             mesh_.lend.data(), &l, npts.data(), &df, &ier);
      if (!unit_) {
        if (ier != 0) return;
        continue;
      }
      require(ier == 0, "GETNP: IER = " + std::to_string(ier));
      require(df >= last - 1e-12, "GETNP: a node that is nearer than the one before");
      last = df;
    }
    std::sort(npts.begin(), npts.end());
    for (int k = 1; k <= mesh_.n; ++k) require(npts[k - 1] == k, "GETNP: not all nodes once");
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
    require(nb == boundary_nodes(), "CRLIST: NB");
    for (int slot = 1; slot < copy.lnew; ++slot)
      require(1 <= listc[slot - 1] && listc[slot - 1] <= cells, "CRLIST: LISTC");
  }

  int boundary_nodes() const {
    return static_cast<int>(std::count(rings_.boundary.begin(), rings_.boundary.end(), 1));
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
    const int unwanted = input_.integer(1, 100), x = input_.bits<std::int32_t>();
    int ix = x, iy = input_.bits<std::int32_t>(), iz = input_.bits<std::int32_t>();
    // The routine requires seeds from 1 to 30,000.
    for (int* seed : {&ix, &iy, &iz}) *seed = 1 + static_cast<int>(static_cast<unsigned>(*seed) % 30000);
    if (unwanted >= 1) {
      const int drawn = jrand_(&unwanted, &ix, &iy, &iz);
      require(1 <= drawn && drawn <= unwanted, "JRAND");
    }
  }

  void boundary() {
    std::vector<int> nodes(mesh_.n);
    int nb, na, nt;
    bnodes_(&mesh_.n, mesh_.list.data(), mesh_.lptr.data(), mesh_.lend.data(), nodes.data(), &nb, &na, &nt);
    require(nb == boundary_nodes() && nt == static_cast<int>(faces_.size()) && 2 * na == mesh_.lnew - 1,
            "BNODES");
    const int k = 1 + input_.below(mesh_.n), wanted = any_node(), last = mesh_.lend[k - 1];
    const auto& ring = rings_.neighbours[k - 1];
    require(nbcnt_(&last, mesh_.lptr.data()) == static_cast<int>(ring.size()), "NBCNT");
    const int slot = lstptr_(&last, &wanted, mesh_.list.data(), mesh_.lptr.data());
    require(slot == last || mesh_.list[slot - 1] == wanted, "LSTPTR");
  }

  void vectors() {
    const Point a = any_point(), b = any_point(), c = any_point();
    const double u[3] = {a.x, a.y, a.z}, v[3] = {b.x, b.y, b.z}, w[3] = {c.x, c.y, c.z};
    double centre[3], crossing[3], latitude, longitude, norm;
    int ier;
    const double area = areas_(u, v, w);
    require(!(area < 0) && !(area > 12.6), "AREAS");
    circum_(u, v, w, centre, &ier);
    const bool unit = is_unit(a) && is_unit(b) && is_unit(c);
    if (unit && ier == 0)
      require(std::fabs(std::hypot(centre[0], centre[1], centre[2]) - 1) < 1e-9, "CIRCUM");
    intrsc_(u, v, w, crossing, &ier);
    if (unit && ier == 0)
      require(std::fabs(std::hypot(crossing[0], crossing[1], crossing[2]) - 1) < 1e-9, "INTRSC");
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
