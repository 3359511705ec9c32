// A skeleton and its motion in one input, parted by the first NUL.
#include "capture/amc.h"
#include "capture/asf.h"
#include "fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace ringcraft;
  const std::string_view both(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = both.find('\0');
  const auto skeleton = parse_asf(both.substr(0, cut), "fuzz.asf", fuzzing::kLimits);
  if (!skeleton) {
    fuzzing::require(!skeleton.error().what.empty() && !skeleton.error().remedy.empty());
    return 0;
  }
  const std::string_view motion = cut == both.npos ? std::string_view() : both.substr(cut + 1);
  fuzzing::check(parse_amc(motion, "fuzz.amc", *skeleton, kAcclaimRate, fuzzing::kLimits));
  return 0;
}
