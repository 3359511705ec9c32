#pragma once
// The subcommands. Each returns the exit code: 0 done, 1 a check found faults, 2 usage or
// configuration, 3 file or input data, 4 simulation failed, 130 interrupted.

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "motion/skeleton.h"

namespace ringcraft {

// The largest seed that JSON holds exactly, as the schema of scenes says.
inline constexpr std::uint64_t kMostSeed = (std::uint64_t{1} << 53) - 1;

// The scene and the library of a command that is told none.
inline constexpr const char* kUsualScene = "duel";
inline constexpr const char* kUsualLibrary = "kickboxing";

// Where results go without --out; what stands in <> is the name of the scene or of the library.
inline constexpr const char* kFightFolder = "out/<scene>";
inline constexpr const char* kTreeFolder = "out/<scene>_tree";
inline constexpr const char* kBatchFolder = "out/batch_<scene>";
inline constexpr const char* kMergeFolder = "out/merged";
inline constexpr const char* kHitFolder = "out/hit";
inline constexpr const char* kBenchFolder = "out/bench";
inline constexpr const char* kLibraryFolder = "out/library";
inline constexpr const char* kSparringFolder = "out/sparring";
inline constexpr const char* kBuiltLibrary = "<library>.ringlib";
std::string with_name(std::string path, const std::string& name);

// What all commands understand.
struct CommonOptions {
  std::string out;  // output folder; empty: the command's usual one
  std::optional<std::uint64_t> seed;
  std::vector<std::string> sets;  // --set path.to.key=value
  int threads = 1;
  bool json = false;
  bool quiet = false;
  int verbose = 0;
  bool summary_to_stderr = false;  // stdout is for something else
};

// What of a scene a command lets its user set anew; the others refuse the options.
enum class Overrides : std::uint8_t { none, seed, seed_and_values };

struct FightCommandOptions {
  std::vector<std::string> exports = {};  // bvh, vrma
  std::string profile;                    // whose skeleton the BVH has; empty: VRM's names
  bool root_motion = false;
};

struct HitOptions {
  std::string library = kUsualLibrary;
  std::string body = "middleweight";
  std::string pose = "idle_guard_bounce@0.1";
  std::string part = "head";
  std::string impulse = "0,0,-26";
  std::optional<float> tone;            // none: HitQuery's
  std::string strike;                   // an action instead of the impulse
  std::string attacker;                 // its body; empty: as `body`
  std::optional<float> distance;        // m between the two
  std::vector<std::string> sweep = {};  // AXIS=FROM:TO:STEP
};

struct TreeOptions {
  double at_s = 0;
  std::size_t nodes = 400;
};

struct SparringOptions {
  std::string library = kUsualLibrary;
  std::string attacker = "middleweight", defender = "middleweight";
  std::vector<std::string> captures = {};  // two files of one capture space
};

struct LibraryBuildOptions {
  std::string source;                         // manifest or folder of captures
  std::optional<std::string> responses_from;  // none given: kickboxing for a folder
  bool not_mirrored = false, not_connected = false;
  bool interpolate = false, not_interpolated = false;  // neither: a folder is, a manifest is not
};

struct InterpolateOptions {
  int wanted = 200;        // outcomes for each family
  std::uint64_t seed = 1;  // where --seed says none
};

struct BatchOptions {
  int count = 10;  // bouts
};

inline constexpr double kBenchSeconds = 10;

struct BenchOptions {
  std::optional<double> duration_s;  // of the fight; none: kBenchSeconds, or as --set says
  int rounds = 1;
};

struct ServeOptions {
  std::string folder = "out";
  int port = 8765;  // 0: any that is free
};

struct ViewOptions {
  std::string what = kUsualScene;  // folder, page or scene
  bool print = false;              // only the address
  bool threads = false;            // --threads was given
};

// Set by SIGINT and SIGTERM.
extern std::atomic<bool> interrupted;

// From here on SIGINT and SIGTERM set `interrupted`; a second one ends the process at once. A file
// that may not grow (ulimit -f) is an error of who writes it.
void watch_signals();

// While one lives, SIGINT and SIGTERM end the process at once, with exit code 130: for work that
// has nothing finished to keep. No file may be written meanwhile.
class EndAtSignal {
 public:
  EndAtSignal();
  ~EndAtSignal();
  EndAtSignal(const EndAtSignal&) = delete;
  EndAtSignal& operator=(const EndAtSignal&) = delete;
};

// Text for people, on stderr; where that cannot be written, nothing is said.
template <class... Values>
void tell(fmt::format_string<Values...> text, Values&&... values) {
  const std::string said = fmt::format(text, std::forward<Values>(values)...);
  std::fwrite(said.data(), 1, said.size(), stderr);
}

// Tells one line and returns the error's exit code.
int fail(const Error& error);

// The folder for results, `usual` where --out names none. It is made before the work: an error
// where it cannot be written to, or one of the `names` that are to stand there is one of the
// `inputs`.
Result<std::filesystem::path> output_folder(const CommonOptions& options,
                                            const std::filesystem::path& usual,
                                            const std::vector<std::string>& names,
                                            const std::vector<std::filesystem::path>& inputs);

int run_fight(const std::string& scene, const FightCommandOptions& fight,
              const CommonOptions& options);
int run_hit(const HitOptions& hit, const CommonOptions& options);
int run_tree(const std::string& scene, const TreeOptions& tree, const CommonOptions& options);
int run_sparring(const SparringOptions& sparring, const CommonOptions& options);
int run_replay(const std::string& events_file, const CommonOptions& options);
int run_library_build(const LibraryBuildOptions& build, const CommonOptions& options);
int run_library_inspect(const std::string& library, const CommonOptions& options);
int run_library_interpolate(const std::string& library, const InterpolateOptions& asked,
                            const CommonOptions& options);
// Heights of the fighter and of the opponent, m.
struct CheckHeights {
  double own = static_cast<double>(kCanonicalHeight);
  double opponent = static_cast<double>(kCanonicalHeight);
};
int run_library_check(const std::string& library, const CheckHeights& heights,
                      const CommonOptions& options);
int run_batch_command(const std::string& scene, const BatchOptions& asked,
                      const CommonOptions& options);
int run_merge(const std::vector<std::string>& folders, const CommonOptions& options);
int run_schema(const std::string& name);
int run_bench_command(const std::string& scene, const BenchOptions& asked,
                      const CommonOptions& options);
int run_serve(const ServeOptions& serve, const CommonOptions& options);
int run_view(const ViewOptions& view, const CommonOptions& options);

}  // namespace ringcraft
