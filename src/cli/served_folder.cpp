#include "cli/served_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/file.h"
#include "base/json_object.h"
#include "base/markup.h"
#include "cli/page_address.h"

namespace ringcraft {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 6;                   // folders below each other that the index looks into
constexpr std::size_t kMostEntries = 20'000;  // that the index looks at
constexpr std::uintmax_t kLargestReport = 1u << 20;  // bytes that are read for a row of the index

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\') return std::nullopt;
    out += c;
  }
  return out;
}

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_below(const fs::path& path, const fs::path& root) {
  const auto [mismatch, rest] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return mismatch == root.end();
}

// Opens a regular file whose real place is below `root`. Asked of the open file, so that a link
// that is changed meanwhile leads nowhere else.
std::optional<OpenFile> opened_below(const fs::path& root, const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return std::nullopt;
  struct ::stat about {};
  const bool regular = ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
  OpenFile file(descriptor, regular ? static_cast<std::uint64_t>(about.st_size) : 0);
  if (!regular) return std::nullopt;
  std::error_code failed;
  const fs::path real = fs::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), failed);
  if (failed || !is_below(real, root)) return std::nullopt;
  return file;
}

struct Row {
  std::string path;  // below the root, of the page
  std::string says;
};

// One line about the results in a folder, from its small files; empty where there are none.
std::string sentence_about(const fs::path& folder) {
  for (const char* name : {"report.json", "study.json", "bench.json"}) {
    std::error_code failed;
    const auto size = fs::file_size(folder / name, failed);
    if (failed || size > kLargestReport || !fs::is_regular_file(folder / name, failed) ||
        fs::is_symlink(folder / name, failed))  // it may lead out
      continue;
    const auto text = read_file(folder / name);
    if (!text) continue;
    std::string why;
    const auto json = json_object(*text, why);
    if (!json) continue;
    const auto word = [&](const char* key) {
      const auto found = json->find(key);
      if (found == json->end() || found->is_structured()) return std::string();
      return found->is_string() ? found->get<std::string>() : found->dump();
    };
    if (json->contains("title")) return word("title");
    if (json->contains("scene"))
      return fmt::format("scene {}, seed {}, {} s", word("scene"), word("seed"),
                         word("duration_s"));
  }
  return "";
}

constexpr const char* kStyle =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\">"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
    "<link rel=\"icon\" href=\"data:,\"><style>"
    "body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:62rem;padding:0 1rem;"
    "background:#14171c;color:#dfe4ea}a{color:#7db7ff}h1{font-size:1.4rem}"
    "h2{font-size:1.05rem;margin:1.6rem 0 .3rem;color:#aab4c0}"
    "table{border-collapse:collapse;width:100%}"
    "td{padding:.3rem .8rem .3rem 0;border-top:1px solid #2a3038}"
    "td+td{color:#9aa5b1;text-align:right}</style>";

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 10'000) return fmt::format("{} B", bytes);
  if (bytes < 10'000'000) return fmt::format("{} kB", bytes / 1000);
  return fmt::format("{} MB", bytes / 1'000'000);
}

bool is_hidden(const std::string& name) {
  return name.starts_with('.');
}

// Whether find() would answer for it: what is refused is not listed.
bool is_listed(const std::string& name) {
  return path_of_target("/" + percent_encoded(name)).has_value();
}

}  // namespace

RangeAnswer range_answer(std::string_view header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return {};
  header.remove_prefix(kUnit.size());
  const std::size_t dash = header.find('-');
  if (dash == std::string_view::npos || header.find(',') != std::string_view::npos) return {};
  const std::string_view from = header.substr(0, dash), to = header.substr(dash + 1);
  const auto first = number_in(from), last = number_in(to);
  using Kind = RangeAnswer::Kind;
  if (from.empty()) {  // the last so many bytes
    if (!last) return {};
    if (*last == 0 || size == 0) return {Kind::outside, {}};
    return {Kind::part, {size - std::min(*last, size), size - 1}};
  }
  if (!first || (!to.empty() && !last) || (last && *last < *first)) return {};
  if (*first >= size) return {Kind::outside, {}};
  return {Kind::part, {*first, last ? std::min(*last, size - 1) : size - 1}};
}

std::optional<std::string> path_of_target(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  if (!target.starts_with('/')) return std::nullopt;
  auto path = percent_decoded(target.substr(1));
  if (!path) return std::nullopt;
  for (std::size_t begin = 0; begin < path->size();) {
    const std::size_t end = std::min(path->find('/', begin), path->size());
    if (end == begin || is_hidden(path->substr(begin, end - begin))) return std::nullopt;
    begin = end + 1;
  }
  return path;
}

std::string media_type(const fs::path& file) {
  constexpr std::array<std::pair<std::string_view, const char*>, 16> kTypes = {{
      {".html", "text/html; charset=utf-8"},
      {".json", "application/json"},
      {".jsonl", "application/x-ndjson"},
      {".csv", "text/csv; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".glb", "model/gltf-binary"},
      {".vrma", "model/gltf-binary"},
      {".gltf", "model/gltf+json"},
      {".bvh", "text/plain; charset=utf-8"},
      {".txt", "text/plain; charset=utf-8"},
      {".md", "text/markdown; charset=utf-8"},
      {".toml", "application/toml"},
      {".css", "text/css; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
  }};
  const std::string ending = file.extension().string();
  for (const auto& [known, type] : kTypes) {
    if (ending == known) return type;
  }
  return "application/octet-stream";
}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t OpenFile::read(std::uint64_t offset, char* bytes, std::size_t count) const {
  const ssize_t got = ::pread(descriptor_, bytes, count, static_cast<off_t>(offset));
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

Result<ServedFolder> ServedFolder::open(const fs::path& folder) {
  std::error_code failed;
  const fs::path root = fs::canonical(folder, failed);
  if (failed)
    return input_error(folder.string(), "", "no such folder",
                       "name a folder of results; `ringcraft fight` makes one in out");
  if (!fs::is_directory(root, failed))
    return input_error(folder.string(), "", "not a folder", "name the folder that holds it");
  const fs::directory_iterator readable(root, failed);
  if (failed) return input_error(folder.string(), "", failed.message(), "check its permissions");
  return ServedFolder(root);
}

Served ServedFolder::find(std::string_view target) const {
  Served served;
  const auto path = path_of_target(target);
  if (!path) {
    served.kind = Served::Kind::refused;
    return served;
  }
  if (path->empty()) {
    served.kind = Served::Kind::page;
    served.text = index_page();
    served.type = media_type("index.html");
    return served;
  }
  std::error_code failed;
  const fs::path real = fs::canonical(root_ / *path, failed);
  if (failed) return served;
  if (!is_below(real, root_)) {
    served.kind = Served::Kind::refused;
    return served;
  }
  if (fs::is_directory(real, failed)) {
    served.kind = path->ends_with('/') ? Served::Kind::page : Served::Kind::moved;
    served.type = media_type("index.html");
    served.text =
        path->ends_with('/') ? folder_page(real, *path) : "/" + percent_encoded(*path) + "/";
    return served;
  }
  if (path->ends_with('/')) return served;
  auto file = opened_below(root_, real);
  if (!file) return served;
  served.kind = Served::Kind::file;
  served.type = media_type(real);
  served.file = std::move(*file);
  return served;
}

std::string ServedFolder::index_page() const {
  std::array<std::vector<Row>, kResultPages.size()> rows;
  std::error_code failed;
  fs::recursive_directory_iterator at(root_, fs::directory_options::skip_permission_denied, failed);
  for (std::size_t seen = 0; !failed && at != fs::recursive_directory_iterator();
       at.increment(failed)) {
    if (++seen > kMostEntries) break;
    const std::string name = at->path().filename().string();
    std::error_code unreadable;
    const bool left_out = !is_listed(name) || at->is_symlink(unreadable);
    if (left_out || at.depth() >= kDeepest) at.disable_recursion_pending();
    if (left_out) continue;
    for (std::size_t i = 0; i < kResultPages.size(); ++i) {
      if (name != kResultPages[i].file || !at->is_regular_file(unreadable)) continue;
      rows[i].push_back({at->path().lexically_relative(root_).string(),
                         sentence_about(at->path().parent_path())});
    }
  }
  std::string page = fmt::format("{}<title>Ringcraft</title><h1>Ringcraft: {}</h1>\n", kStyle,
                                 escaped(root_.filename().string()));
  bool any = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].empty()) continue;
    any = true;
    std::ranges::sort(rows[i], {}, &Row::path);
    page += fmt::format("<h2>{}</h2><table>\n", kResultPages[i].heading);
    for (const Row& row : rows[i]) {
      const std::string folder = fs::path(row.path).parent_path().string();
      page += fmt::format("<tr><td><a href=\"/{}\">{}</a><td>{} <a href=\"/{}\">files</a>\n",
                          percent_encoded(row.path), escaped(folder.empty() ? row.path : folder),
                          escaped(row.says), percent_encoded(folder.empty() ? "" : folder + "/"));
    }
    page += "</table>\n";
  }
  if (!any) page += "<p>No results here yet: <code>ringcraft fight</code> makes some.\n";
  return page;
}

std::string ServedFolder::folder_page(const fs::path& folder, const std::string& path) const {
  std::vector<std::pair<std::string, std::string>> entries;  // name, size
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed);
       !failed && at != fs::directory_iterator() && entries.size() < kMostEntries;
       at.increment(failed)) {
    const std::string name = at->path().filename().string();
    std::error_code unreadable;
    if (!is_listed(name) || at->is_symlink(unreadable)) continue;
    if (at->is_directory(unreadable)) {
      entries.emplace_back(name + "/", "");
    } else if (at->is_regular_file(unreadable)) {
      entries.emplace_back(name, size_text(at->file_size(unreadable)));
    }
  }
  std::ranges::sort(entries);
  std::string page =
      fmt::format("{}<title>{}</title><p><a href=\"/\">all results</a></p><h1>{}</h1><table>\n",
                  kStyle, escaped(path), escaped(path));
  for (const auto& [name, size] : entries)
    page += fmt::format("<tr><td><a href=\"/{}\">{}</a><td>{}\n", percent_encoded(path + name),
                        escaped(name), size);
  return page + "</table>\n";
}

}  // namespace ringcraft
