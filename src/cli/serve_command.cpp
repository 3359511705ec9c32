// `ringcraft serve`: a folder of results in the browser.

#include <cstdio>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/http_server.h"

namespace ringcraft {

int run_serve(const ServeOptions& serve, const CommonOptions& options) {
  const auto folder = ServedFolder::open(serve.folder);
  if (!folder) return fail(folder.error());
  HttpLimits limits;
  limits.stop = &interrupted;
  const auto served =
      serve_http(*folder, static_cast<std::uint16_t>(serve.port), limits, [&](std::uint16_t port) {
        fmt::print("http://127.0.0.1:{}/\n", port);
        std::fflush(stdout);
        if (!options.quiet) tell("shows {}; Ctrl-C ends\n", serve.folder);
      });
  if (!served) return fail(served.error());
  return 130;
}

}  // namespace ringcraft
