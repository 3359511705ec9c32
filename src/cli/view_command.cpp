// `ringcraft view`: a page in the user's browser.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/page_address.h"
#include "cli/scene_inputs.h"

namespace ringcraft {

namespace {

namespace fs = std::filesystem;

// What opens pages here, as the words of a command; empty without one. $BROWSER is the user's own
// word, as xdg-open takes it; without it a display is needed.
std::vector<std::string> browser() {
  if (const char* named = std::getenv("BROWSER"); named != nullptr && *named != '\0') {
    std::istringstream first(std::string(named).substr(0, std::string(named).find(':')));
    std::vector<std::string> words;
    for (std::string word; first >> word;) words.push_back(word);
    return words;
  }
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  if (!set("DISPLAY") && !set("WAYLAND_DISPLAY")) return {};
  return {"xdg-open"};
}

// Starts the browser without a shell and leaves it alone. False where it cannot be started, or
// fails within a moment.
bool opens(std::vector<std::string> words, const std::string& address) {
  bool placed = false;
  for (std::string& word : words) {
    if (word != "%s") continue;
    word = address;
    placed = true;
  }
  if (!placed) words.push_back(address);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t own_session;
  posix_spawnattr_init(&own_session);
  posix_spawnattr_setflags(&own_session, POSIX_SPAWN_SETSID);
  pid_t process = 0;
  const int failed =
      posix_spawnp(&process, arguments[0], &files, &own_session, arguments.data(), environ);
  posix_spawnattr_destroy(&own_session);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) return false;
  constexpr auto kMoment = std::chrono::milliseconds(50);
  for (int moments = 0; moments < 40; ++moments) {
    int status = 0;
    if (::waitpid(process, &status, WNOHANG) == process)
      return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (interrupted) break;
    std::this_thread::sleep_for(kMoment);
  }
  return true;
}

}  // namespace

int run_view(const ViewOptions& view, const CommonOptions& options) {
  fs::path page;  // empty: the one of a fight to come
  std::error_code failed;
  if (fs::is_directory(view.what, failed)) {
    const auto found = page_in(view.what);
    // A folder without one may be called as a scene is.
    if (!found && !scene_with(view.what, {})) return fail(found.error());
    page = found.value_or("");
  } else if (is_page(view.what)) {
    if (!fs::is_regular_file(view.what, failed))
      return fail({ErrorKind::input, view.what, "", "no such page", "check the path"});
    page = view.what;
  } else if (const fs::path kind = fs::path(view.what).extension();
             !kind.empty() && kind != ".toml" && fs::is_regular_file(view.what, failed)) {
    return fail({ErrorKind::input, view.what, "", "neither a page nor a scene",
                 "name the fight.html beside it, or a scene"});
  }
  const char* of_fights = !options.out.empty()    ? "--out"
                          : options.seed          ? "--seed"
                          : !options.sets.empty() ? "--set"
                          : view.threads          ? "--threads"
                                                  : nullptr;
  if (!page.empty() && of_fights != nullptr)
    return fail({ErrorKind::usage, view.what, of_fights, "of no effect on what is there already",
                 "leave it out, or name a scene"});
  if (page.empty()) {
    const auto scene = scene_with(view.what, options);
    if (!scene) return fail(scene.error());
    CommonOptions fought = options;
    if (fought.out.empty()) fought.out = with_name(kFightFolder, scene->name);
    fought.summary_to_stderr = true;
    if (const int code = run_fight(view.what, {}, fought); code != 0) return code;
    page = fs::path(fought.out) / "fight.html";
  }
  const std::string address = file_address(page);
  fmt::print("{}\n", address);
  std::fflush(stdout);
  if (view.print) return 0;
  const std::vector<std::string> words = browser();
  if (words.empty()) {
    if (!options.quiet) tell("no display here; open the address by hand\n");
  } else if (!opens(words, address) && !options.quiet) {
    tell("{} did not open it; open the address by hand\n", words.front());
  }
  return 0;
}

}  // namespace ringcraft
