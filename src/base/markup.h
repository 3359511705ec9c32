#pragma once
// Text inside of XML, SVG and HTML.

#include <string>
#include <string_view>

namespace ringcraft {

// `text` as the content of an element: <, > and & as entities, control characters as spaces.
// Not for attributes: quotes stay.
std::string escaped(std::string_view text);

}  // namespace ringcraft
