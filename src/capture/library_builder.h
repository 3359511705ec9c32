#pragma once
// From files to a library: a manifest names captures and technique sheets; actions are cut from the
// first and compiled from the second.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "motion/interpolation.h"
#include "motion/library.h"

namespace ringcraft {

struct LibraryBuildSettings {
  // The library whose responses, get-ups and idles stand in for what a folder of captures lacks
  // (nobody is struck in most of them); empty: nothing stands in. A manifest names its own.
  std::string responses_from = "kickboxing";
  bool mirrored = true;  // a folder's actions also as the other side would do them
  bool connect = true;   // with a motion graph, and ways through it where they are shorter
  // Blends between repetitions where outcomes leave room (motion/interpolation.h). Unset: of a
  // folder's captures, and not of a manifest's actions.
  std::optional<bool> interpolate;
  Judge judge;      // what else a blend has to pass; none where it is empty
  int threads = 1;  // never changes the result
};

// Builds a library from a manifest (assets/schemas/manifest.schema.json) or from a folder of
// captures without one, in which actions are found without hand work (segment.h). Paths in a
// manifest are relative to the manifest. A capture that is marked optional and is not there is
// passed over.
Result<MotionLibrary> build_library(const std::filesystem::path& source,
                                    const LibraryBuildSettings& settings = {});

// The actions of a manifest alone, before the state machine drops what is not connected; `notes`,
// when given, collects what was passed over and why.
Result<std::vector<Action>> collect_actions(const std::filesystem::path& manifest,
                                            std::vector<std::string>* notes = nullptr);

// The files that a library is made from, as load_library() is given it: itself, and the captures
// and sheets that a manifest names.
std::vector<std::filesystem::path> files_of_library(const std::filesystem::path& library);

// A library of these actions with its motion graph, and with ways through it as actions that
// connect where they shorten the paths of the state machine.
MotionLibrary connected_library(const std::string& name, std::vector<Action> actions,
                                std::vector<std::string> notes,
                                const LibraryBuildSettings& settings);

}  // namespace ringcraft
