// Sequences of changes of a triangulation by the public symbols. After each change the lists must be well
// formed: every slot in one closed list, every triangle closed, the Euler number of a sphere or a disc. If
// all nodes are in general position and every change so far keeps a Delaunay triangulation, the exact
// validator must accept it. Now and then a routine gets damaged copies of the lists in arrays between
// inaccessible pages: it must return.

#include <array>

#include "fortran_mesh.h"
#include "point_sets.h"
#include "support/guarded.h"
#include "support/reference_predicates.h"
#include "support/trmesh.h"

namespace {

using pstripack::Point;

constexpr int kMostNodes = 40, kMostChanges = 60, kColumns = 3 * kMostNodes;

class Changes {
 public:
  explicit Changes(Input& input) : input_(input), general_(input.below(2) == 0), mesh_(kMostNodes) {
    Nodes nodes;
    for (int count = 3 + input.below(12); count > 0; --count) nodes.push_back(vector(nodes));
    begun_ = mesh_.triangulate(nodes) == 0;
  }

  void run() {
    if (!begun_) return;
    check("TRMESH");
    for (int i = 0; i < kMostChanges && !input_.empty() && !failed_; ++i) {
      const bool was_delaunay = delaunay_;
      const std::string changed = change();
      require(!failed_ || !general_ || !was_delaunay,
              changed + " of a Delaunay triangulation in general position");
      check(changed);
    }
  }

 private:
  Point vector(const Nodes& nodes) {
    return general_ ? general_direction(input_) : any_vector(input_, nodes);
  }
  int any_node() { return input_.integer(-1, mesh_.n + 2); }
  int some_node() { return 1 + input_.below(mesh_.n); }

  /// Makes a change; returns its name.
  std::string change() {
    switch (input_.below(8)) {
      case 0:
      case 1:
        return add();
      case 2:
        return remove();
      case 3:
        return connect();
      case 4:
        return cut();
      case 5:
        return optimize();
      case 6:
        return enter();
      default:
        return with_damaged_lists();
    }
  }

  bool place_next() {
    if (mesh_.n == kMostNodes) return false;
    Nodes nodes;
    for (int k = 1; k <= mesh_.n; ++k) nodes.push_back(mesh_.node(k));
    mesh_.place(mesh_.n + 1, vector(nodes));
    return true;
  }

  std::string add() {
    if (!place_next()) return "nothing";
    const int start = any_node(), k = mesh_.n + 1;
    int ier;
    addnod_(&start, &k, mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), mesh_.list.data(), mesh_.lptr.data(),
            mesh_.lend.data(), &mesh_.lnew, &ier);
    if (ier == 0) ++mesh_.n;
    require(ier != -9, "ADDNOD calls good lists broken");
    return "ADDNOD";
  }

  std::string remove() {
    const int k = any_node(), before = mesh_.n;
    int lwk = input_.below(2) == 0 ? kColumns : input_.below(8) - 1, ier;
    std::vector<int> iwk(2 * kColumns);
    delnod_(&k, &mesh_.n, mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), mesh_.list.data(),
            mesh_.lptr.data(), mesh_.lend.data(), &mesh_.lnew, &lwk, iwk.data(), &ier);
    const bool deleted = ier == 0 || ier == 5 || ier == 6;
    require(mesh_.n == before - deleted, "N after DELNOD");
    require(ier != -9 && ier != 3, "DELNOD calls good lists broken");
    failed_ = ier == 4 || ier == 5;
    if (mesh_.n < 4) delaunay_ = false;
    return "DELNOD, IER = " + std::to_string(ier);
  }

  std::string connect() {
    const int a = input_.below(8) == 0 ? -input_.below(3) : some_node(), b = some_node();
    int lwk = input_.below(4) == 0 ? input_.below(8) - 1 : kColumns, ier;
    std::vector<int> iwk(2 * kColumns);
    edge_(&a, &b, mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), &lwk, iwk.data(), mesh_.list.data(),
          mesh_.lptr.data(), mesh_.lend.data(), &ier);
    require(ier != -9, "EDGE calls good lists broken");
    failed_ = ier == 4;
    delaunay_ = false;
    return "EDGE, IER = " + std::to_string(ier);
  }

  /// DELARC, sometimes for nodes that are not a boundary arc.
  std::string cut() {
    const int a = any_node();
    const int b = a >= 1 && a <= mesh_.n && input_.below(4) > 0 ? -mesh_.last_neighbour(a) : any_node();
    int ier;
    delarc_(&mesh_.n, &a, &b, mesh_.list.data(), mesh_.lptr.data(), mesh_.lend.data(), &mesh_.lnew, &ier);
    if (ier == 0) delaunay_ = false;
    require(ier != -9 && ier != 4, "DELARC calls good lists broken");
    return "DELARC";
  }

  /// OPTIM of any arcs after exchanges by SWAP where both new triangles are counterclockwise.
  std::string optimize() {
    int iwk[16];
    const int columns = input_.below(9);
    for (int i = 0; i < columns; ++i) {
      const int a = some_node(), last = mesh_.lend[a - 1];
      int slot = last;
      for (int steps = input_.below(16); steps >= 0; --steps) slot = mesh_.lptr[slot - 1];
      const int b = std::abs(mesh_.list[slot - 1]);
      iwk[2 * i] = a;
      iwk[2 * i + 1] = b;
      if (input_.below(2) == 0) exchange(a, b);
    }
    int nit = input_.integer(-1, 20), ier;
    nit = std::min(nit, 1000);
    const int na = input_.below(8) == 0 ? -input_.below(3) : columns;
    optim_(mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), &na, mesh_.list.data(), mesh_.lptr.data(),
           mesh_.lend.data(), &nit, iwk, &ier);
    require(ier != -9, "OPTIM calls good lists broken");
    delaunay_ = false;
    return "SWAP and OPTIM, IER = " + std::to_string(ier);
  }

  /// The node after `b` in the list of `a`, from b's slot.
  int after(int a, int b) const {
    const int slot = lstptr_(&mesh_.lend[a - 1], &b, mesh_.list.data(), mesh_.lptr.data());
    return std::abs(mesh_.list[mesh_.lptr[slot - 1] - 1]);
  }

  void exchange(int a, int b) {
    if (mesh_.last_neighbour(a) == -b || mesh_.last_neighbour(b) == -a) return;
    const int in1 = after(a, b), in2 = after(b, a);  // left and right of a->b
    for (const int k : {a, b, in1, in2})
      if (!has_direction(mesh_.node(k))) return;
    if (exact::left(mesh_.node(in1), mesh_.node(in2), mesh_.node(b)) <= 0 ||
        exact::left(mesh_.node(in2), mesh_.node(in1), mesh_.node(a)) <= 0)
      return;
    int slot;
    swap_(&in1, &in2, &a, &b, mesh_.list.data(), mesh_.lptr.data(), mesh_.lend.data(), &slot);
    require(slot >= 0, "SWAP calls good lists broken");
    if (slot > 0)
      require(std::abs(mesh_.list[slot - 1]) == in1 && after(in1, a) == in2,
              "the arc that SWAP should have made");
  }

  /// INTADD, BDYADD, COVSPH where TRFIND locates the node, without ADDNOD's swaps.
  std::string enter() {
    if (!place_next()) return "nothing";
    const int k = mesh_.n + 1, start = any_node();
    const Point p = mesh_.node(k);
    const double q[3] = {p.x, p.y, p.z};
    double b1, b2, b3;
    int i1, i2, i3;
    trfind_(&start, q, &mesh_.n, mesh_.x.data(), mesh_.y.data(), mesh_.z.data(), mesh_.list.data(),
            mesh_.lptr.data(), mesh_.lend.data(), &b1, &b2, &b3, &i1, &i2, &i3);
    if (i1 == 0) return "nothing";
    ++mesh_.n;
    delaunay_ = false;
    int *const list = mesh_.list.data(), *const lptr = mesh_.lptr.data(), *const lend = mesh_.lend.data();
    if (i3 != 0) {
      intadd_(&k, &i1, &i2, &i3, list, lptr, lend, &mesh_.lnew);
      return "INTADD";
    }
    if (i1 != i2) {
      bdyadd_(&k, &i1, &i2, list, lptr, lend, &mesh_.lnew);
      return "BDYADD";
    }
    covsph_(&k, &i1, list, lptr, lend, &mesh_.lnew);
    return "COVSPH";
  }

  /// Calls a routine on copies of the lists with some arbitrary entries. SWAP, OPTIM and EDGE are not told
  /// the lengths of the arrays, so they get only numbers within these.
  std::string with_damaged_lists() {
    const ::Edge side = input_.below(2) == 0 ? ::Edge::begin : ::Edge::end;
    const int routine = input_.below(10), n = mesh_.n, slots = 6 * n - 12;
    const bool told = routine < 7;
    Lists copy = mesh_.lists();
    for (int damages = 1 + input_.below(8); damages > 0; --damages) switch (input_.below(3)) {
        case 0:
          copy.list[input_.below(256) % slots] = told ? input_.integer(-n - 1, n + 1) : some_node();
          break;
        case 1:
          copy.lptr[input_.below(256) % slots] =
              told ? input_.integer(-1, slots + 2) : 1 + input_.below(256) % slots;
          break;
        default:
          copy.lend[input_.below(n)] = told ? input_.integer(-1, slots + 2) : 1 + input_.below(256) % slots;
      }
    Guarded<int> list(copy.list, side), lptr(copy.lptr, side), lend(copy.lend, side), iwk(2 * kColumns, side);
    Guarded<double> x(mesh_.x, side), y(mesh_.y, side), z(mesh_.z, side);
    int lnew = input_.below(4) == 0 ? input_.integer(-1, slots + 2) : copy.lnew, count = n, lwk = kColumns,
        ier, slot;
    const int a = told ? any_node() : some_node(), b = told ? any_node() : some_node(),
              c = told ? any_node() : some_node(), d = some_node();
    switch (routine) {
      case 0:
        intadd_(&n, &a, &b, &c, list.data(), lptr.data(), lend.data(), &lnew);
        break;
      case 1:
        bdyadd_(&n, &a, &b, list.data(), lptr.data(), lend.data(), &lnew);
        break;
      case 2:
        covsph_(&n, &a, list.data(), lptr.data(), lend.data(), &lnew);
        break;
      case 3:
        delnb_(&a, &b, &n, list.data(), lptr.data(), lend.data(), &lnew, &slot);
        break;
      case 4:
        delarc_(&n, &a, &b, list.data(), lptr.data(), lend.data(), &lnew, &ier);
        break;
      case 5:
        delnod_(&a, &count, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(), &lnew, &lwk,
                iwk.data(), &ier);
        break;
      case 6:
        addnod_(&a, &n, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(), &lnew, &ier);
        break;
      case 7:
        swap_(&a, &b, &c, &d, list.data(), lptr.data(), lend.data(), &slot);
        break;
      case 8: {
        const int columns = 2;
        int nit = 1 + input_.below(20);
        iwk[0] = a, iwk[1] = b, iwk[2] = c, iwk[3] = d;
        optim_(x.data(), y.data(), z.data(), &columns, list.data(), lptr.data(), lend.data(), &nit,
               iwk.data(), &ier);
        break;
      }
      default:
        edge_(&a, &b, x.data(), y.data(), z.data(), &lwk, iwk.data(), list.data(), lptr.data(), lend.data(),
              &ier);
    }
    return "nothing";
  }

  void check(const std::string& changed) const {
    if (failed_) return;
    const auto where = [&](const std::string& what) {
      return what + " after " + changed + ", " + std::to_string(mesh_.n) + " nodes";
    };
    const Lists lists = mesh_.lists();
    const auto rings = rings_of(lists);
    require(rings.has_value(), where("lists that are none"));
    int arcs = 0, corners = 0, boundary = 0;
    for (int k = 0; k < mesh_.n; ++k) {
      const auto& ring = rings->neighbours[k];
      const int degree = static_cast<int>(ring.size());
      arcs += degree, corners += degree - rings->boundary[k], boundary += rings->boundary[k];
    }
    require(corners == 3 * static_cast<int>(faces_of(*rings).size()), where("triangles that do not close"));
    require(rings_of(mesh_.n, faces_of(*rings)) == rings, where("triangles that do not fit together"));
    require(mesh_.n - arcs / 2 + corners / 3 == (boundary > 0 ? 1 : 2), where("a wrong Euler number"));
    if (!general_ || !delaunay_) return;
    Nodes nodes;
    for (int k = 1; k <= mesh_.n; ++k) nodes.push_back(mesh_.node(k));
    require(verdict(nodes, lists).empty(), where(verdict(nodes, lists)));
  }

  Input& input_;
  const bool general_;
  bool begun_, delaunay_ = true;
  bool failed_ = false;  ///< DELNOD or EDGE has reported a failure, possible if triangles overlap
  FortranMesh mesh_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  Changes(input).run();
  return 0;
}
