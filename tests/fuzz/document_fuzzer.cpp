// TOML under a schema: the first byte picks the schema.
#include "base/document.h"
#include "fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace ringcraft;
  static constexpr const char* kSchemas[] = {"scene",    "style", "body",
                                             "manifest", "sheet", "profile"};
  if (size == 0) return 0;
  const char* schema = kSchemas[data[0] % std::size(kSchemas)];
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto document = parse_document(text, "fuzz.toml", schema);
  fuzzing::require(document || !document.error().what.empty());
  return 0;
}
