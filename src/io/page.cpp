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

// Where what is filled in stands, in the order of the template.
constexpr std::array<std::string_view, 3> kPlaces = {"@@RINGCRAFT_GLB@@", "@@RINGCRAFT_EVENTS@@",
                                                     "@@RINGCRAFT_REPORT@@"};

}  // namespace

Result<std::string> page_template() {
  const std::filesystem::path path = viewer_folder() / "page.html";
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) {
    return input_error(path.string(), "", "the page's template is missing", kRemedy);
  }
  auto page = read_file(path);
  if (!page) return page;
  std::size_t from = 0;
  for (const std::string_view place : kPlaces) {
    const std::size_t at = page->find(place, from);
    if (at == std::string::npos || page->find(place, at + 1) != std::string::npos) {
      return input_error(path.string(), "",
                         "not the page's template: it must hold " + std::string(place) +
                             " exactly once, in its place",
                         kRemedy);
    }
    from = at + place.size();
  }
  return page;
}

Result<std::string> fight_html(const std::string& glb, const std::string& events,
                               const nlohmann::json& report) {
  auto page = page_template();
  if (!page) return page;
  const auto replace = nlohmann::json::error_handler_t::replace;
  const std::array<std::string, 3> fillings = {base64(glb), inside_script(events),
                                               inside_script(report.dump(-1, ' ', false, replace))};
  std::size_t size = page->size();
  for (const std::string& filling : fillings) size += filling.size();

  // Places are looked for in the template alone, so what a fight holds is never taken for one.
  std::string html;
  html.reserve(size);
  std::size_t from = 0;
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const std::size_t at = page->find(kPlaces[i], from);
    html.append(*page, from, at - from).append(fillings[i]);
    from = at + kPlaces[i].size();
  }
  return html.append(*page, from, std::string::npos);
}

}  // namespace ringcraft
