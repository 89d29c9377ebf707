#pragma once

namespace pictures {

extern const char* const kGlobeHtml;  ///< the text of globe.html, with globe.js in it

}  // namespace pictures
