#include "capture/library_file.h"

#include <fstream>

#include "base/file.h"
#include "capture/library_builder.h"
#include "motion/library_io.h"

namespace ringcraft {

namespace fs = std::filesystem;

bool begins_as_library(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;  // a pipe would be waited for
  std::string head(16, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return looks_like_library(head);
}

namespace {

// Any other is taken for a manifest.
bool is_library_file(const fs::path& file) {
  return begins_as_library(file) || file.extension() == ".ringlib";
}

}  // namespace

fs::path library_source(const fs::path& named) {
  std::error_code ignored;
  fs::path source = named;
  if (!fs::exists(source, ignored) && !named.has_parent_path()) source = assets_folder() / named;
  if (fs::is_regular_file(source / "library.toml", ignored)) return source / "library.toml";
  return source;
}

Result<MotionLibrary> load_library(const fs::path& library) {
  const fs::path source = library_source(library);
  std::error_code ignored;
  if (!fs::is_regular_file(source, ignored)) {
    if (fs::is_directory(source, ignored)) {
      return input_error(library.string(), "", "the folder holds no library.toml",
                         "make a library of it first: ringcraft library build " + library.string() +
                             " -o my.ringlib");
    }
    return input_error(library.string(), "", "no motion library there",
                       "name a library file, a manifest (library.toml), its folder, or a folder of "
                       "assets");
  }
  if (!is_library_file(source)) {
    LibraryBuildSettings quick;
    quick.connect = false;
    return build_library(source, quick);
  }
  const auto bytes = read_file(source);
  if (!bytes) return tl::unexpected(bytes.error());
  return library_from_bytes(*bytes, source.string());
}

Result<void> may_write_library(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored) || begins_as_library(file)) return {};
  return input_error(file.string(), "", "exists and is no motion library",
                     "give another file to write to");
}

Result<void> write_library(const MotionLibrary& library, const fs::path& file) {
  if (auto may = may_write_library(file); !may) return may;
  const std::string bytes = library_bytes(library);
  // Before a good file is replaced by one that nobody can read.
  if (auto read = library_from_bytes(bytes, library.name()); !read) {
    Error fault = std::move(read.error());
    fault.what = "the library could not be read back, nothing is written: " + fault.what;
    fault.remedy = "correct that action in its manifest or sheet";
    return tl::unexpected(std::move(fault));
  }
  return write_file(file, bytes);
}

}  // namespace ringcraft
