#pragma once

namespace pictures {

extern const char* const kGlobeHtml;  ///< the text of globe.html

}  // namespace pictures
