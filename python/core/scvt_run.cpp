#include "scvt_run.h"

#include <algorithm>
#include <exception>
#include <string>

#include "capi/pstripack.h"

namespace bindings {
namespace {

/// The caller's procedures, and the first exception that one of them raised; it ends the run.
struct Procedures {
  const py::object &density, &progress;
  std::exception_ptr error;

  /// Runs body() with Python's lock.
  template <class Body>
  void call(const Body& body) {
    if (error) return;
    const py::gil_scoped_acquire locked;
    try {
      body();
    } catch (...) {
      error = std::current_exception();
    }
  }
};

/// A pstripack_density_procedure. If it fails, it writes no values, which the library refuses as a wrong
/// density.
void density_at(std::int32_t n, const double* xyz, double* values, void* user) {
  auto& procedures = *static_cast<Procedures*>(user);
  procedures.call([&] {
    const py::array places = Array<double>({py::ssize_t{n}, py::ssize_t{3}}, xyz);  // a copy: it may be kept
    const py::array_t<double, py::array::c_style | py::array::forcecast> result(procedures.density(places));
    if (result.ndim() != 1 || result.shape(0) != n)
      throw py::value_error("the density must return one number for each of the places: an array of shape (" +
                            std::to_string(n) + ",)");
    std::copy_n(result.data(), n, values);
  });
}

/// A pstripack_scvt_progress_procedure.
std::int32_t progress_to(const pstripack_scvt_progress* at, void* user) {
  auto& procedures = *static_cast<Procedures*>(user);
  bool stop = false;
  procedures.call([&] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (procedures.progress.is_none()) return;
    const py::object answer = procedures.progress(at->generators, at->evaluations, at->gradient, at->energy);
    stop = py::bool_(answer);
  });
  return stop || procedures.error ? 1 : 0;
}

}  // namespace

py::tuple scvt(const py::object& start, const py::object& density, double tolerance, bool lloyd,
               std::int64_t most_evaluations, std::int64_t seed, const py::object& progress, bool widths,
               bool well_centred, int threads) {
  const bool given = py::isinstance<py::array>(start);
  const auto n =
      given ? static_cast<std::int32_t>(start.cast<Array<double>>().shape(0)) : start.cast<std::int32_t>();
  const auto count = static_cast<std::size_t>(n);
  Buffer<double> columns(3 * count);
  double *const x = columns.data(), *const y = x + count, *const z = y + count;
  if (given) {
    const Array<double> rows = start.cast<Array<double>>();
    for (std::size_t i = 0; i < count; ++i)
      x[i] = rows.data()[3 * i], y[i] = rows.data()[3 * i + 1], z[i] = rows.data()[3 * i + 2];
  }

  Procedures procedures{density, progress, nullptr};
  const pstripack_density by_python{density_at, &procedures, 0};
  pstripack_scvt_options options{};
  options.bytes = sizeof options;
  options.start = given ? PSTRIPACK_SCVT_GIVEN : PSTRIPACK_SCVT_BY_NUMBER;
  options.method = lloyd ? PSTRIPACK_SCVT_LLOYD : PSTRIPACK_SCVT_NEWTON;
  options.tolerance = tolerance;
  options.most_evaluations = most_evaluations;
  options.seed = seed;
  options.progress = progress_to;
  options.user = &procedures;
  options.widths = widths ? 1 : 0;
  options.well_centred = well_centred ? 1 : 0;
  pstripack_scvt_result result{};
  char message[500] = "";
  const bool is_constant = density.is_none();
  const std::int32_t code = compute(threads, [&] {
    return pstripack_scvt(n, x, y, z, is_constant ? nullptr : &by_python, &options, &result, message,
                          sizeof message);
  });
  if (procedures.error) std::rethrow_exception(procedures.error);
  Array<double> generators({py::ssize_t{code == 0 ? result.generators : 0}, py::ssize_t{3}});
  double* to = generators.mutable_data();
  for (py::ssize_t i = 0; i < generators.shape(0); ++i) *to++ = x[i], *to++ = y[i], *to++ = z[i];
  return py::make_tuple(code, message, generators, result.energy, result.gradient, result.evaluations,
                        result.reason);
}

py::tuple scvt_cells(const py::object& width, double radius) {
  const py::object none = py::none();
  Procedures procedures{width, none, nullptr};
  const pstripack_density by_python{density_at, &procedures, 0};
  double cells = 0;
  char message[500] = "";
  const std::int32_t code =
      compute(1, [&] { return pstripack_scvt_cells(&by_python, radius, &cells, message, sizeof message); });
  if (procedures.error) std::rethrow_exception(procedures.error);
  return py::make_tuple(code, message, cells);
}

}  // namespace bindings
