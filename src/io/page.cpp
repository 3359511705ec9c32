// fight.html: the page template of viewer/ with the fight put into it.

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/file.h"
#include "io/outputs.h"

namespace ringcraft {

namespace {

constexpr const char* kRemedy =
    "build the page with `npm ci && npm run build` in viewer/ (./run.sh does it), or name the "
    "folder "
    "of page.html in RINGCRAFT_VIEWER";

// The folder of page.html: RINGCRAFT_VIEWER from the environment, else the source tree's.
std::filesystem::path viewer_folder() {
  if (const char* named = std::getenv("RINGCRAFT_VIEWER")) return named;
  return std::filesystem::path(RINGCRAFT_SOURCE_ASSETS).parent_path() / "viewer" / "dist";
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += kDigits[word >> 18];
    text += kDigits[word >> 12 & 63];
    text += i + 1 < bytes.size() ? kDigits[word >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kDigits[word & 63] : '=';
  }
  return text;
}

// JSON that no HTML parser can leave: `<` stands only inside strings, where \u003c means the same.
std::string inside_script(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

struct Place {
  std::string_view mark;
  std::string filling;
  std::size_t at = 0;  // in the template
};

}  // namespace

Result<std::string> fight_html(const std::string& glb, const std::string& events,
                               const nlohmann::json& report) {
  const std::filesystem::path path = viewer_folder() / "page.html";
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) {
    return input_error(path.string(), "", "the page's template is missing", kRemedy);
  }
  const auto page = read_file(path);
  if (!page) return tl::unexpected(page.error());

  // In the order of the template; all are found before anything is filled in, so what a fight holds
  // is never taken for a place.
  const auto replace = nlohmann::json::error_handler_t::replace;
  std::array<Place, 3> places = {
      Place{"@@RINGCRAFT_GLB@@", base64(glb)},
      Place{"@@RINGCRAFT_EVENTS@@", inside_script(events)},
      Place{"@@RINGCRAFT_REPORT@@", inside_script(report.dump(-1, ' ', false, replace))},
  };
  std::size_t from = 0, size = page->size();
  for (Place& place : places) {
    place.at = page->find(place.mark, from);
    if (place.at == std::string::npos ||
        page->find(place.mark, place.at + 1) != std::string::npos) {
      return input_error(path.string(), "",
                         "not the page's template: it must hold " + std::string(place.mark) +
                             " exactly once, in its place",
                         kRemedy);
    }
    from = place.at + place.mark.size();
    size += place.filling.size();
  }

  std::string html;
  html.reserve(size);
  from = 0;
  for (const Place& place : places) {
    html.append(*page, from, place.at - from).append(place.filling);
    from = place.at + place.mark.size();
  }
  return html.append(*page, from, std::string::npos);
}

}  // namespace ringcraft
