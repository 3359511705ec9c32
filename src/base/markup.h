#pragma once
// Text inside of XML, SVG and HTML.

#include <string>
#include <string_view>

namespace ringcraft {

// `text` as the content of an element or of an attribute in quotes: <, >, & and quotes as entities,
// control characters as spaces.
std::string escaped(std::string_view text);

}  // namespace ringcraft
