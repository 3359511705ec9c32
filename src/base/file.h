#pragma once
// Reading whole files, and writing them whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace ringcraft {

// Largest file that is read (256 MiB): an input cannot exhaust the program.
inline constexpr std::uintmax_t kLargestInput = 256u << 20;

// All bytes of a regular file. An error, of kind input: none there, a folder, not readable, larger
// than kLargestInput.
Result<std::string> read_file(const std::filesystem::path& path);

// Writes beside the target, then renames: the file appears whole or not at all.
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

// An error where one of these files of a folder is one of `inputs`. To be asked before long work
// whose result would be written over what it is made from.
Result<void> may_write(const std::filesystem::path& folder, const std::vector<std::string>& names,
                       const std::vector<std::filesystem::path>& inputs);

// Makes the folder and writes files into it: where one cannot be written, those that were there
// stay as they were.
using NamedBytes = std::vector<std::pair<std::string, std::string>>;
Result<void> write_files(const std::filesystem::path& folder, const NamedBytes& files);

// Makes the folder and checks that files can be written there.
Result<void> make_output_folder(const std::filesystem::path& folder);

// A folder that is this process's as long as the value lives; others that ask are refused.
class FolderLock {
 public:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  FolderLock(FolderLock&& o) noexcept : descriptor_(std::exchange(o.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  int descriptor_;
};
Result<FolderLock> lock_folder(const std::filesystem::path& folder);

// The folder `assets`: RINGCRAFT_ASSETS from the environment, else the source tree's.
std::filesystem::path assets_folder();

}  // namespace ringcraft
