#include <fmt/format.h>

#include "base/document.h"
#include "cli/commands.h"

namespace ringcraft {

int run_schema(const std::string& name) {
  const auto text = schema_text(name);
  if (!text) return fail(text.error());
  fmt::print("{}\n", *text);
  return 0;
}

}  // namespace ringcraft
