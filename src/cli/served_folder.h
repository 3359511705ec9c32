#pragma once
// What `ringcraft serve` shows: the files of one folder and a page that lists the results in it.
// Nothing outside of the folder can be reached, whatever is asked for.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"

namespace ringcraft {

// A part of a file, both ends included.
struct ByteRange {
  std::uint64_t first = 0, last = 0;
};

// What a Range header asks of a file of `size` bytes (RFC 9110, section 14). Several ranges at once
// and what cannot be read count as not asked.
struct RangeAnswer {
  enum class Kind : std::uint8_t { whole, part, outside };
  Kind kind = Kind::whole;
  ByteRange range;
};
RangeAnswer range_answer(std::string_view header, std::uint64_t size);

// The path that a request's target means, without the query: percent signs decoded once, segments
// checked. None where it is malformed, climbs (".."), or names what is hidden (".x").
std::optional<std::string> path_of_target(std::string_view target);

// By the ending of the name; application/octet-stream for what is not known.
std::string media_type(const std::filesystem::path& file);

// An open file; closed with the value.
class OpenFile {
 public:
  OpenFile() = default;
  OpenFile(int descriptor, std::uint64_t size) : descriptor_(descriptor), size_(size) {}
  OpenFile(OpenFile&& other) noexcept;
  OpenFile& operator=(OpenFile&& other) noexcept;
  ~OpenFile();

  std::uint64_t size() const { return size_; }
  // Up to `count` bytes from `offset` on; fewer at the end, none on a fault.
  std::size_t read(std::uint64_t offset, char* bytes, std::size_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// What a target leads to.
struct Served {
  enum class Kind : std::uint8_t { nothing, refused, moved, page, file };
  Kind kind = Kind::nothing;
  std::string type;  // of page and file
  std::string text;  // the page; where to, if moved
  OpenFile file;
};

class ServedFolder {
 public:
  static Result<ServedFolder> open(const std::filesystem::path& folder);

  Served find(std::string_view target) const;

  // The results below the folder, by kind.
  std::string index_page() const;

 private:
  explicit ServedFolder(std::filesystem::path root) : root_(std::move(root)) {}
  std::string folder_page(const std::filesystem::path& folder, const std::string& path) const;

  std::filesystem::path root_;  // canonical
};

}  // namespace ringcraft
