#pragma once
// Technique sheets: actions authored as key poses, compiled into clips of the canonical body.
//
// A sheet is a TOML file (assets/schemas/sheet.schema.json). Lengths in it are fractions of
// standing height, angles degrees, times seconds. Body keys are given relative to the root (where
// the fighter stands and faces at that moment), so a step or a turn needs no keys of its own for
// the hands; feet stand where they were put until a step of the sheet moves them. Figures behind
// the sheets and the speed profiles are measured ones (median key poses of captured boxing and
// kicking).

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "motion/action.h"

namespace ringcraft {

// All actions of one file, in the file's order, for the orthodox canonical body.
Result<std::vector<Action>> compile_sheet_file(const std::filesystem::path& path);

}  // namespace ringcraft
