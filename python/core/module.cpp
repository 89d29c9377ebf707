// The module pstripack._core, which takes and returns NumPy arrays. The Python files document the package.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "arrays.h"
#include "base/parallel_for.h"
#include "capi/pstripack.h"
#include "drawing.h"
#include "globe.h"
#include "point_sets.h"
#include "scvt_run.h"
#include "triangulation.h"

namespace {

namespace py = pybind11;
using bindings::Array;
using bindings::array_of;
using bindings::Buffer;
using bindings::compute;
using bindings::items;
using bindings::NoTriangulation;
using bindings::Rows;
using bindings::Runs;
using bindings::Triangulation;
using pstripack::Point;

py::array rows_of_three(Buffer<std::int32_t>&& values) {
  const auto rows = static_cast<py::ssize_t>(values.size() / 3);
  return array_of<std::int32_t>(std::move(values), {rows, 3});
}
py::tuple arrays_of(Runs&& runs) {
  return py::make_tuple(array_of(std::move(runs.begin)), array_of(std::move(runs.values)));
}

std::size_t rows_of(const py::array& array) {
  if (array.ndim() != 2 || array.shape(1) != 3) throw py::value_error("an array of shape (n, 3) is needed");
  return static_cast<std::size_t>(array.shape(0));
}
const Point* places_in(const Array<double>& places) {
  static_assert(sizeof(Point) == 3 * sizeof(double));
  return reinterpret_cast<const Point*>(places.data());
}

struct Mesh {
  std::unique_ptr<const Triangulation> triangulation;

  Mesh(const py::array_t<double>& nodes, int threads) {
    const std::size_t n = rows_of(nodes);
    constexpr auto size = static_cast<py::ssize_t>(sizeof(double));
    bindings::Coordinates given{n, {}, nodes.strides(0) / size};
    for (py::ssize_t axis = 0; n > 0 && axis < 3; ++axis) given.axis[axis] = nodes.data(0, axis);
    triangulation = compute(threads, [&] { return std::make_unique<const Triangulation>(given); });
  }
  const Triangulation* operator->() const { return triangulation.get(); }
};

std::size_t columns_of(const Mesh& mesh, const Array<double>& values) {
  if (values.ndim() != 2 || static_cast<std::size_t>(values.shape(0)) != mesh->size())
    throw py::value_error("a row of values for each node is needed");
  return static_cast<std::size_t>(values.shape(1));
}

/// The nodes as the mesh keeps them, column by column: an array that keeps the mesh alive.
py::array points(const py::object& self) {
  const auto& mesh = self.cast<const Mesh&>();
  const auto n = static_cast<py::ssize_t>(mesh->size());
  constexpr auto size = static_cast<py::ssize_t>(sizeof(double));
  return py::array_t<double>({n, py::ssize_t{3}}, {size, n * size}, mesh->coordinates(), self);
}

/// What a member without arguments computes: rows of three corners or opposite triangles, or a measure.
template <auto member>
py::array rows_of(const Mesh& mesh, int threads) {
  return rows_of_three(compute(threads, [&] { return (*mesh.triangulation.*member)(); }));
}
template <auto member>
py::array array_by(const Mesh& mesh, int threads) {
  return array_of(compute(threads, [&] { return (*mesh.triangulation.*member)(); }));
}

/// Copies of LIST, LPTR, LEND, and LNEW.
py::tuple lists(const Mesh& mesh) {
  const auto view = mesh->lists();
  const py::ssize_t slots = view.lnew - 1, n = static_cast<py::ssize_t>(view.n);
  return py::make_tuple(Array<std::int32_t>(slots, view.list), Array<std::int32_t>(slots, view.lptr),
                        Array<std::int32_t>(n, view.lend), view.lnew);
}

/// Disables Python's search for reference cycles during its lifetime: it takes long if there are many new
/// lists, which have no cycles.
class NoSearchForCycles {
 public:
  NoSearchForCycles() : gc_(py::module_::import("gc")), was_on_(gc_.attr("isenabled")().cast<bool>()) {
    gc_.attr("disable")();
  }
  ~NoSearchForCycles() {
    if (was_on_) gc_.attr("enable")();
  }
  NoSearchForCycles(const NoSearchForCycles&) = delete;
  NoSearchForCycles& operator=(const NoSearchForCycles&) = delete;

 private:
  const py::object gc_;
  const bool was_on_;
};

/// A list of integers for each run. Equal integers below `count` are the same object in all lists.
py::list lists_of(const Array<std::int32_t>& begin, const Array<std::int32_t>& values, std::size_t count) {
  const NoSearchForCycles paused;
  const std::int32_t* const first = begin.data();
  const std::int32_t* const value = values.data();
  const py::ssize_t runs = begin.size() - 1;
  std::vector<py::object> integers(count);
  py::list result(runs);
  for (py::ssize_t k = 0; k < runs; ++k) {
    py::list run(first[k + 1] - first[k]);
    for (std::int32_t i = first[k]; i < first[k + 1]; ++i) {
      py::object& integer = integers[static_cast<std::size_t>(value[i])];
      if (!integer) integer = py::int_(value[i]);
      PyList_SET_ITEM(run.ptr(), i - first[k], py::object(integer).release().ptr());
    }
    PyList_SET_ITEM(result.ptr(), k, run.release().ptr());
  }
  return result;
}

/// The corners of all faces; the first corner of each face in the list of corners; this list.
py::tuple arrays_of(files::Faces&& faces) {
  for (std::int32_t& corner : faces.corner) --corner;
  return py::make_tuple(array_of(std::move(faces.points)),
                        array_of(std::vector<std::int32_t>(faces.begin.begin(), faces.begin.end())),
                        array_of(std::move(faces.corner)));
}

py::array midpoints(const Mesh& mesh, const Array<std::int32_t>& arcs, int threads) {
  const auto count = static_cast<std::size_t>(arcs.shape(0));
  return array_of(compute(threads, [&] { return mesh->midpoints(arcs.data(), count); }));
}

py::array gradients(const Mesh& mesh, const Array<double>& values, int threads) {
  const std::size_t columns = columns_of(mesh, values);
  return array_of<double>(compute(threads, [&] { return mesh->gradients(values.data(), columns); }),
                          {values.shape(0), values.shape(1), 3});
}

py::array boundary(const Mesh& mesh) {
  const std::vector<std::int32_t> nodes = compute(0, [&] { return mesh->boundary(); });
  return Array<std::int32_t>(static_cast<py::ssize_t>(nodes.size()), nodes.data());
}

py::tuple closest_pair(const Mesh& mesh, int threads) {
  const bindings::ClosestPair pair = compute(threads, [&] { return mesh->closest_pair(); });
  return py::make_tuple(pair.distance, pair.first, pair.second);
}

/// The triangles of the places, and their barycentric weights there or None.
py::tuple find(const Mesh& mesh, const Array<double>& places, const Array<std::int32_t>& corners,
               bool with_weights, int threads) {
  const std::size_t count = rows_of(places), triangles = rows_of(corners);
  Buffer<double> weights(with_weights ? 3 * count : 0);
  Buffer<std::int32_t> found = compute(threads, [&] {
    return mesh->find(places_in(places), count, corners.data(), triangles,
                      with_weights ? weights.data() : nullptr);
  });
  const py::object table =
      with_weights ? py::object(array_of<double>(std::move(weights), {places.shape(0), 3})) : py::none();
  return py::make_tuple(array_of(std::move(found)), table);
}

py::array nearest(const Mesh& mesh, const Array<double>& places, int threads) {
  const std::size_t count = rows_of(places);
  return array_of(compute(threads, [&] { return mesh->nearest(places_in(places), count); }));
}

py::array k_nearest(const Mesh& mesh, const Array<double>& places, std::size_t k, int threads) {
  const std::size_t count = rows_of(places);
  return array_of<std::int32_t>(compute(threads, [&] { return mesh->nearest(places_in(places), count, k); }),
                                {places.shape(0), static_cast<py::ssize_t>(k)});
}

py::array distances(const Mesh& mesh, const Array<double>& places, const Array<std::int32_t>& nodes,
                    int threads) {
  const std::size_t count = rows_of(places), k = static_cast<std::size_t>(nodes.shape(1));
  return array_of<double>(
      compute(threads, [&] { return mesh->distances(places_in(places), count, nodes.data(), k); }),
      {nodes.shape(0), nodes.shape(1)});
}

/// (indptr, indices, data), as scipy.sparse names them.
py::tuple arrays_of(Rows&& rows) {
  return py::make_tuple(array_of(std::move(rows.begin)), array_of(std::move(rows.nodes)),
                        array_of(std::move(rows.numbers)));
}

py::tuple within(const Mesh& mesh, const Array<double>& places, double radius, int threads) {
  const std::size_t count = rows_of(places);
  return arrays_of(compute(threads, [&] { return mesh->within(places_in(places), count, radius); }));
}

Triangulation::Method method_of(const std::string& name) {
  using Method = Triangulation::Method;
  return name == "cubic" ? Method::cubic : name == "natural" ? Method::natural : Method::linear;
}

py::tuple weights(const Mesh& mesh, const std::string& method, const Array<double>& places, int threads) {
  const std::size_t count = rows_of(places);
  return arrays_of(
      compute(threads, [&] { return mesh->weights(method_of(method), places_in(places), count); }));
}

py::array interpolate(const Mesh& mesh, const std::string& method, const Array<double>& places,
                      const Array<double>& values, int threads) {
  const std::size_t count = rows_of(places), columns = columns_of(mesh, values);
  return array_of<double>(compute(threads,
                                  [&] {
                                    return mesh->interpolate(method_of(method), places_in(places), count,
                                                             values.data(), columns);
                                  }),
                          {places.shape(0), values.shape(1)});
}

/// Unit vectors of longitudes and latitudes, by the formulas of the command `pstripack`.
py::array vectors(const Array<double>& lon, const Array<double>& lat, bool degrees) {
  if (lon.ndim() != 1 || lat.ndim() != 1 || lon.size() != lat.size())
    throw py::value_error("longitudes and latitudes differ in number");
  files::LonLat angles;
  angles.lon = items(lon), angles.lat = items(lat);
  angles.degrees = degrees;
  return array_of(compute(0, [&] { return files::points_of(angles); }));
}

/// Corners x, y; the first corner of each outline, and the number of corners; the face of each outline.
py::tuple arrays_of(bindings::Outlines&& outlines) {
  const auto corners = static_cast<py::ssize_t>(outlines.xy.size() / 2);
  return py::make_tuple(array_of<double>(std::move(outlines.xy), {corners, 2}),
                        array_of(std::move(outlines.begin)), array_of(std::move(outlines.face)));
}

template <bindings::Outlines (*draw)(const bindings::Window&, const Triangulation&, bool)>
py::tuple outlines_in(const Mesh& mesh, bool cells, bool orthographic, double lon, double lat, double radius,
                      int threads) {
  return arrays_of(compute(threads, [&] {
    return draw({orthographic, lon, lat, radius}, *mesh.triangulation, cells);
  }));
}

using RingsOfPolygon = std::vector<std::vector<std::pair<double, double>>>;  // degrees, outline first

/// The outlines and areas of cells in polygons.
py::tuple cut_cells(const Mesh& mesh, const std::vector<RingsOfPolygon>& polygons, int threads) {
  std::vector<files::MapRegion> regions;
  for (const RingsOfPolygon& rings : polygons) regions.push_back({regions.size() + 1, {}, rings});
  try {
    bindings::CutCells cells =
        compute(threads, [&] { return bindings::cut_cells(*mesh.triangulation, regions); });
    return arrays_of(std::move(cells.outlines)) + py::make_tuple(array_of(std::move(cells.area)));
  } catch (const files::NoMesh& e) {
    throw py::value_error(std::string("clip: ") + e.what());
  }
}

/// Raises an exception of the package with the indices of the nodes in question.
void raise(const NoTriangulation& e) {
  using Cause = NoTriangulation::Cause;
  const char* name = "TriangulationError";
  if (e.cause == Cause::bad_coordinate) name = "BadCoordinateError";
  if (e.cause == Cause::coincident) name = "CoincidentNodesError";
  if (e.cause == Cause::collinear) name = "CollinearNodesError";
  const py::object type = py::module_::import("pstripack._errors").attr(name);
  const py::object error = type(e.what(), py::tuple(py::cast(e.nodes)));
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const NoTriangulation& e) {
      raise(e);
    }
  });
  // Ctrl-C ends long searches.
  bindings::between_places = [] {
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  m.attr("version") = pstripack_version();
  py::class_<Mesh>(m, "Mesh")
      .def(py::init<py::array_t<double>, int>(), py::arg("points").noconvert(), py::arg("threads"))
      .def_property_readonly("points", &points)
      .def("triangles", &rows_of<&Triangulation::triangles>)
      .def("opposite_triangles", &rows_of<&Triangulation::opposite_triangles>)
      .def("lists", &lists)
      .def("neighbours",
           [](const Mesh& mesh, int threads) {
             return arrays_of(compute(threads, [&] { return mesh->neighbours(); }));
           })
      .def("boundary", &boundary)
      .def("circumcentres", &array_by<&Triangulation::circumcentres>)
      .def("triangle_areas", &array_by<&Triangulation::triangle_areas>)
      .def("cells",
           [](const Mesh& mesh, int threads) {
             constexpr double kNoDivision = -2;
             return arrays_of(compute(threads, [&] { return mesh->cells(kNoDivision); }));
           })
      .def("cell_areas", &array_by<&Triangulation::cell_areas>)
      .def("circumradii", &array_by<&Triangulation::circumradii>)
      .def("cell_centroids", &array_by<&Triangulation::cell_centroids>)
      .def("closest_pair", &closest_pair)
      .def("faces",
           [](const Mesh& mesh, bool cells, int threads) {
             return arrays_of(compute(threads, [&] { return faces_of(*mesh.triangulation, cells); }));
           })
      .def("map_polygons",
           [](const Mesh& mesh, bool cells, int threads) {
             return arrays_of(
                 compute(threads, [&] { return bindings::map_polygons(*mesh.triangulation, cells); }));
           })
      .def("cut_cells", &cut_cells)
      .def("polygons_in", &outlines_in<bindings::polygons_in>)
      .def("lines_in", &outlines_in<bindings::lines_in>)
      .def("midpoints", &midpoints)
      .def("gradients", &gradients)
      .def("find", &find)
      .def("nearest", &nearest)
      .def("k_nearest", &k_nearest)
      .def("distances", &distances)
      .def("within", &within)
      .def("weights", &weights)
      .def("interpolate", &interpolate);
  m.def("lists_of", &lists_of);
  m.def("vectors", &vectors);
  m.def("radians_of_single", py::vectorize(point_sets::radians_of_single));
  m.def("globe", &bindings::globe);
  m.def("scvt", &bindings::scvt);
  m.def("scvt_cells", &bindings::scvt_cells);
}
