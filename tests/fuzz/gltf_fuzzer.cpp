#include "capture/gltf.h"
#include "fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace ringcraft;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  fuzzing::check(parse_gltf(bytes, "fuzz.glb", "", fuzzing::kLimits));
  return 0;
}
