// Loading a library file alone: the file that RINGCRAFT_LIBRARY names, else the kickboxing library
// built and written before the clock runs. What `fight` pays before it begins; the bar is 100 ms.
// BM counters: actions, and bytes of the file.
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <benchmark/benchmark.h>

#include "base/file.h"
#include "capture/library_builder.h"
#include "capture/library_file.h"

namespace ringcraft {
namespace {

void load_library_file(benchmark::State& state) {
  std::filesystem::path file;
  const char* named = std::getenv("RINGCRAFT_LIBRARY");
  const bool own = named == nullptr;
  if (own) {
    file = std::filesystem::temp_directory_path() / "ringcraft_load_bench.ringlib";
    const auto library = build_library(assets_folder() / "kickboxing" / "library.toml");
    if (!library || !write_library(*library, file)) {
      state.SkipWithError("the library cannot be built and written");
      return;
    }
  } else {
    file = named;
  }
  std::size_t actions = 0;
  for (auto _ : state) {
    const auto library = load_library(file);
    if (!library) {
      state.SkipWithError(to_string(library.error()).c_str());
      break;
    }
    actions = library->actions().size();
  }
  std::error_code ignored;
  state.counters["actions"] = static_cast<double>(actions);
  state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(file, ignored));
  if (own) std::filesystem::remove(file, ignored);
}
BENCHMARK(load_library_file)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace ringcraft
