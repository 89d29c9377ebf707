#include "qhull_contender.h"

#include <libqhull_r/qhull_ra.h>

#include <chrono>
#include <stdexcept>
#include <string>

static_assert(sizeof(pstripack::Point) == 3 * sizeof(coordT), "points are read as rows of coordinates");

double qhull_seconds(const std::vector<pstripack::Point>& points, std::size_t& vertices) {
  using Clock = std::chrono::steady_clock;
  std::vector<pstripack::Point> nodes = points;  // Qhull requires write access
  char command[] = "qhull";
  qhT qhull;

  const auto start = Clock::now();
  qh_zero(&qhull, stderr);
  const int error = qh_new_qhull(&qhull, 3, static_cast<int>(nodes.size()), &nodes.data()->x, False, command,
                                 nullptr, stderr);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();

  vertices = static_cast<std::size_t>(qhull.num_vertices);
  qh_freeqhull(&qhull, qh_ALL);
  if (error != 0) throw std::runtime_error("Qhull gave up with its error " + std::to_string(error));
  return seconds;
}

const char* qhull_version() { return qh_version; }
