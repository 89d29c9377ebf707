#include "globe.h"

#include "pictures/globe.h"

namespace bindings {
py::str globe(const std::string& title, const Array<double>& lon, const Array<double>& lat,
              const Array<std::int32_t>& simplices, const Array<double>& values, const std::string& name,
              const std::string& unit, bool shows_values, const std::string& coasts) {
  pictures::Globe globe;
  globe.title = title;
  globe.first_number = 0;
  globe.lon = items(lon), globe.lat = items(lat);
  globe.triangles = items(simplices);
  globe.cells = true;
  if (shows_values) {
    globe.value_name = name, globe.value_unit = unit;
    globe.numbers = items(values);
  }
  const std::vector<double> colours = items(values);
  return compute(0, [&] {
    globe.shading = pictures::shading_of_numbers(colours, name, unit);
    if (!coasts.empty())
      globe.coasts = pictures::read_shapefile(
          coasts == "yes" ? pictures::natural_earth(pictures::kGlobeDetail) : coasts);
    return pictures::globe_page(globe);
  });
}

}  // namespace bindings
