#include "cli/page_address.h"

#include <fmt/format.h>

namespace ringcraft {

namespace fs = std::filesystem;

Result<fs::path> page_in(const fs::path& folder) {
  std::string names;
  fs::path newest;
  fs::file_time_type at;
  for (const ResultPage& page : kResultPages) {
    std::error_code failed;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", page.file);
    if (!fs::is_regular_file(folder / page.file, failed)) continue;
    const fs::file_time_type written = fs::last_write_time(folder / page.file, failed);
    if (!newest.empty() && written <= at) continue;
    newest = folder / page.file;
    at = written;
  }
  if (!newest.empty()) return newest;
  return input_error(folder.string(), "", "no page of a result there",
                     "name a folder that holds one of " + names);
}

bool is_page(const fs::path& name) {
  const std::string ending = name.extension().string();
  return ending == ".html" || ending == ".htm" || ending == ".svg";
}

std::string percent_encoded(std::string_view path) {
  std::string out;
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string file_address(const fs::path& path) {
  std::error_code failed;
  fs::path whole = fs::absolute(path, failed);
  if (const fs::path settled = fs::weakly_canonical(whole, failed); !failed) whole = settled;
  return "file://" + percent_encoded(whole.string());
}

}  // namespace ringcraft
