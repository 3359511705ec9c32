#pragma once
// Where the page of a result is, and how a browser is told.

#include <array>
#include <filesystem>
#include <string>

#include "base/error.h"

namespace ringcraft {

// What the commands write to be looked at; a folder of results is known by one of them.
struct ResultPage {
  const char* file;
  const char* heading;  // over many of its kind
};
inline constexpr std::array<ResultPage, 7> kResultPages = {{{"fight.html", "Fights"},
                                                            {"hit.html", "Hits"},
                                                            {"hit_sweep.svg", "Hit maps"},
                                                            {"study.html", "Studies and batches"},
                                                            {"table.html", "Sparring"},
                                                            {"tree.svg", "Game trees"},
                                                            {"library.html", "Libraries"}}};

// The page of a folder of results: the newest, of equally old ones the first of kResultPages.
Result<std::filesystem::path> page_in(const std::filesystem::path& folder);

// Whether the name is that of a page, by its ending.
bool is_page(const std::filesystem::path& name);

// The path with all but unreserved characters and slashes as percent signs (RFC 3986).
std::string percent_encoded(std::string_view path);

// "file:///..." of a path, made absolute (RFC 8089).
std::string file_address(const std::filesystem::path& path);

}  // namespace ringcraft
