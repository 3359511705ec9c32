#include "base/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace ringcraft {

namespace fs = std::filesystem;

Result<std::string> read_file(const fs::path& path) {
  std::error_code failed;
  if (!fs::exists(path, failed)) {
    if (failed) return input_error(path.string(), "", failed.message(), "check its permissions");
    return input_error(path.string(), "", "no such file", "check the path");
  }
  if (fs::is_directory(path, failed))
    return input_error(path.string(), "", "a folder", "name a file");
  if (!fs::is_regular_file(path, failed)) {
    return input_error(path.string(), "", "a device or a pipe, no file",
                       "write what it gives to a file, and name that");
  }
  const auto size = fs::file_size(path, failed);
  if (failed) return input_error(path.string(), "", failed.message(), "check its permissions");
  if (size > kLargestInput) {
    return input_error(path.string(), "", "larger than 256 MiB", "cut it into smaller files");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(size, '\0');
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    return input_error(path.string(), "", "cannot be read", "check its permissions");
  }
  return bytes;
}

namespace {

tl::unexpected<Error> unwritten(const fs::path& path, int code) {
  return input_error(path.string(), "", std::string("cannot be written: ") + std::strerror(code),
                     "choose an output folder you can write to with --out");
}

fs::path part_of(const fs::path& path) {
  fs::path beside = path;
  beside += ".part" + std::to_string(::getpid());
  return beside;
}

Result<void> write_part(const fs::path& path, std::string_view bytes) {
  std::error_code unknown;
  if (fs::is_directory(path, unknown))
    return unwritten(path, EISDIR);  // before anything is renamed
  errno = 0;
  std::ofstream stream(part_of(path), std::ios::binary | std::ios::trunc);
  if (!stream) return unwritten(path, errno);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) return unwritten(path, errno);
  return {};
}

Result<void> put_in_place(const fs::path& path) {
  std::error_code failed;
  fs::rename(part_of(path), path, failed);
  if (failed) return unwritten(path, failed.value());
  return {};
}

// Nothing is renamed before everything is written.
Result<void> write_all(const std::vector<std::pair<fs::path, std::string_view>>& files) {
  Result<void> done;
  for (const auto& [path, bytes] : files) {
    if (done) done = write_part(path, bytes);
  }
  for (const auto& [path, bytes] : files) {
    if (done) done = put_in_place(path);
  }
  if (done) return done;
  for (const auto& [path, bytes] : files) {
    std::error_code ignored;
    fs::remove(part_of(path), ignored);
  }
  return done;
}

}  // namespace

Result<void> write_file(const fs::path& path, std::string_view bytes) {
  return write_all({{path, bytes}});
}

Result<void> make_output_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || !fs::is_directory(folder)) {
    return input_error(folder.string(), "",
                       "output folder cannot be made: " +
                           (failed ? failed.message() : std::string("a file is in the way")),
                       "choose another with --out");
  }
  const fs::path probe = folder / (".ringcraft-probe" + std::to_string(::getpid()));
  const auto written = write_file(probe, "");
  if (!written) {
    return input_error(folder.string(), "", "output folder cannot be written to",
                       "choose another with --out");
  }
  fs::remove(probe, failed);
  return {};
}

Result<void> may_write(const fs::path& folder, const std::vector<std::string>& names,
                       const std::vector<fs::path>& inputs) {
  for (const std::string& name : names) {
    for (const fs::path& input : inputs) {
      std::error_code not_there;
      if (!fs::equivalent(folder / name, input, not_there)) continue;
      return input_error(input.string(), "", "is read and would be written over",
                         "name another output folder with --out");
    }
  }
  return {};
}

Result<void> write_files(const fs::path& folder, const NamedBytes& files) {
  if (auto made = make_output_folder(folder); !made) return made;
  std::vector<std::pair<fs::path, std::string_view>> all;
  for (const auto& [name, bytes] : files) all.emplace_back(folder / name, bytes);
  return write_all(all);
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<FolderLock> lock_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) {
    return input_error(folder.string(), "", std::strerror(errno), "check its permissions");
  }
  FolderLock lock(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    return input_error(folder.string(), "", "another ringcraft is writing here",
                       "wait for it, or choose another folder with --out");
  }
  return lock;
}

fs::path assets_folder() {
  if (const char* named = std::getenv("RINGCRAFT_ASSETS")) return named;
  return RINGCRAFT_SOURCE_ASSETS;
}

}  // namespace ringcraft
