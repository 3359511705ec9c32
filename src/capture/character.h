#pragma once
// Reading a skinned character (.glb, .vrm) to be shown in place of the mannequin.

#include <filesystem>

#include "base/error.h"
#include "motion/character.h"

namespace ringcraft {

// Skinned meshes with their materials' colours and pictures; bones by the profile that fits best.
// Meshes that hang on a bone without a skin (weapons, shields) and shapes are left out, with a
// note. Buffers and pictures must lie in the file itself.
Result<Character> read_character(const std::filesystem::path& path);

// The same from bytes; `file` is only for messages, `profiles` the folder of skeleton profiles.
Result<Character> parse_character(std::string_view bytes, const std::string& file,
                                  const std::filesystem::path& profiles);

}  // namespace ringcraft
