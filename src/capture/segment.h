#pragma once
// Segmentation: actions found in a capture without hand work, each with what was measured.
//
// Nothing here knows a file: thresholds are shares of body height, of limb length, or speeds of a
// body of 1.75 m, and say on which margin they stand (docs/captures.md).

#include <filesystem>
#include <string>
#include <vector>

#include "capture/cut.h"

namespace ringcraft {

// One limb's blow as found: a strike, or a block that is made like one.
struct FoundBlow {
  StrikeCut strike;     // limb, kind, zone, moment of its peak speed
  bool blocks = false;  // the forearm sweeps down across the body or up before the head
  bool spins = false;   // the body turns away and round on the way
  double begin = 0;     // s: the limb leaves
  double reach = 0;     // s: full reach
  double end = 0;       // s: the limb is back, or has come to rest
  std::string evidence;
};

// An action as found. `evidence` says what was measured, as in "right hand 7.9 m/s at 17.28 s,
// extension 0.31 -> 0.96, path straight 0.97".
struct FoundAction {
  ActionCut cut;
  std::string evidence;
};

struct Segmentation {
  std::vector<FoundAction> segments;  // in order of their begins
  std::vector<FoundBlow> blows;       // in order of time, those in no segment included
  double guard_at = 0;                // s: the moment nearest to this fighter's usual guard
  float guard_yaw = 0;                // rad: pelvis yaw off the opponent in it
  bool southpaw = false;  // stands right foot forward; the cuts are of the clip as given
  std::vector<std::string> notes;
};

// `capture`: on the canonical skeleton, one frame a tick, feet planted (retarget.h). `name`
// begins the names of its actions.
Segmentation segment(const Skeleton& skeleton, const Clip& capture, const std::string& name);

// The found actions but those in whose time one of `listed` lies (half of the shorter of the two).
std::vector<FoundAction> not_listed(std::vector<FoundAction> found,
                                    const std::vector<ActionCut>& listed);

struct FolderSettings {
  bool mirrored = true;  // every action also as the other side would do it
};

// The actions of one capture file, or of every capture of a folder and the folders in it, in order
// of their paths: read, retargeted by the profile that fits best, segmented, cut; southpaws
// mirrored. A file that cannot be read and an action that cannot be cut are passed over; `notes`
// says which and why, and on what evidence each action stands. Names are distinct. An error only
// where the folder itself cannot be read.
Result<std::vector<Action>> collect_folder_actions(const std::filesystem::path& folder_or_file,
                                                   std::vector<std::string>* notes,
                                                   const FolderSettings& settings = {});

}  // namespace ringcraft
