#include "capture/bvh.h"
#include "fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace ringcraft;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzzing::check(parse_bvh(text, "fuzz.bvh", fuzzing::kLimits));
  return 0;
}
