#include "cli/commands.h"

#include <csignal>
#include <cstdlib>

#include <fmt/format.h>

#include "base/file.h"

namespace ringcraft {

std::atomic<bool> interrupted = false;

namespace {

constexpr int kInterrupted = 130;
std::atomic<int> end_at_signal = 0;

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
  if (end_at_signal > 0 || interrupted.exchange(true)) std::_Exit(kInterrupted);
}

}  // namespace

void watch_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGXFSZ, SIG_IGN);
}

EndAtSignal::EndAtSignal() {
  ++end_at_signal;
  if (interrupted) std::_Exit(kInterrupted);
}

EndAtSignal::~EndAtSignal() {
  --end_at_signal;
}

std::string with_name(std::string path, const std::string& name) {
  const std::size_t from = path.find('<'), to = path.find('>');
  return path.replace(from, to + 1 - from, name);
}

Result<std::filesystem::path> output_folder(const CommonOptions& options,
                                            const std::filesystem::path& usual,
                                            const std::vector<std::string>& names,
                                            const std::vector<std::filesystem::path>& inputs) {
  std::filesystem::path folder = options.out.empty() ? usual : std::filesystem::path(options.out);
  if (auto may = may_write(folder, names, inputs); !may) return tl::unexpected(may.error());
  if (auto made = make_output_folder(folder); !made) return tl::unexpected(made.error());
  return folder;
}

int fail(const Error& error) {
  tell("ringcraft: {}\n", to_string(error));
  return static_cast<int>(error.kind);
}

}  // namespace ringcraft
