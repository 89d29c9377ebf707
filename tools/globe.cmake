# globe_sources: the writer of globes, for pstripack and the Python package. It needs no package.

set(pictures ${CMAKE_CURRENT_LIST_DIR}/pictures)
file(READ ${pictures}/globe.html globe_html)
file(READ ${pictures}/globe.js globe_js)
string(REPLACE "/*SCRIPT*/" "${globe_js}" globe_html "${globe_html}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${pictures}/globe.html ${pictures}/globe.js)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/globe_html.cpp @ONLY CONTENT
  "// globe.html with globe.js, by tools/globe.cmake.
#include \"pictures/globe.h\"
namespace pictures {
const char* const kGlobeHtml = R\"html(@globe_html@)html\";
}
")
set(globe_sources ${PROJECT_BINARY_DIR}/globe_html.cpp ${pictures}/coasts.cpp ${pictures}/globe.cpp
                  ${pictures}/scale.cpp ${pictures}/shading.cpp)
