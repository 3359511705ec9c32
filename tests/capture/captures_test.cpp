// Real captures, read and retargeted; skipped where they are not there (see mocap.h).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "base/temporary_folder.h"
#include "capture/gltf.h"
#include "capture/library_builder.h"
#include "capture/read_capture.h"
#include "mocap.h"

namespace ringcraft {
namespace {

struct Retargeted {
  RawClip raw;
  std::string profile;
  JointMap map;
  Clip clip;
};

Result<Retargeted> retargeted(const std::filesystem::path& path, const std::string& clip = "") {
  CaptureSource source;
  source.clip = clip;
  auto raw = read_capture(path, source);
  if (!raw) return tl::unexpected(raw.error());
  replace_junk_start(*raw);
  EXPECT_EQ(mend_jumps(*raw), 0u) << path;
  static const auto profiles = read_profiles(assets_folder() / "profiles");
  if (!profiles) return tl::unexpected(profiles.error());
  auto profile = best_profile(*profiles, *raw);
  if (!profile) return tl::unexpected(profile.error());
  auto map = map_joints(*profile, *raw);
  if (!map) return tl::unexpected(map.error());
  auto moved = retarget(*raw, *profile, canonical_skeleton());
  if (!moved) return tl::unexpected(moved.error());
  return Retargeted{std::move(*raw), profile->name, *map, std::move(*moved)};
}

class Captures : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "skipped: no captures";
  }
  std::filesystem::path folder_ = testing::mocap_folder();
};

TEST_F(Captures, EveryFileReadsAndRetargetsOrIsRefusedWithAReason) {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) files.insert(entry.path());
  int whole = 0;
  for (const auto& file : files) {
    const std::string kind = file.extension().string();
    if (kind == ".asf" || kind == ".md") continue;
    std::vector<std::string> clips = {""};
    if (kind == ".glb") {
      const auto named = each_gltf_clip(file, [](const std::string&, const auto&) {});
      ASSERT_TRUE(named) << to_string(named.error());
      clips = {"Punch_Right", "Unarmed_Melee_Attack_Kick", "Death_A_Pose"};
    }
    for (const std::string& clip : clips) {
      const auto done = retargeted(file, clip);
      if (!done) {
        EXPECT_TRUE(kind == ".glb") << to_string(done.error());
        EXPECT_FALSE(done.error().what.empty() || done.error().remedy.empty()) << file;
        continue;
      }
      ++whole;
      EXPECT_TRUE(faults(done->clip).empty()) << file << ": " << faults(done->clip).front();
      // The body is one of flesh: it stays near the floor, and over it.
      for (const Pose& pose : done->clip.frames) {
        ASSERT_GT(pose.hips.y, 0.0f) << file;
        ASSERT_LT(pose.hips.y, 2.5f) << file;
      }
    }
  }
  EXPECT_GT(whole, 0);
}

TEST_F(Captures, EverySourceFindsItsProfile) {
  const std::pair<const char*, const char*> sources[] = {
      {"cmu/13_17.amc", "cmu_asf"},
      {"cmu/16_15.bvh", "cmu_bvh"},
      {"hdm05/bk_kickLFront1Reps_007_120.amc", "cmu_asf"},
      {"deepmimic/punch.bvh", "deepmimic"},
      {"mass/mass_kick.bvh", "mass"},
      {"debian/Boxing_Toes.bvh", "boxing_toes"},
      {"characters/Knight.glb", "kaykit"},
      {"characters/Character.glb", "quaternius"},
  };
  for (const auto& [file, profile] : sources) {
    if (!std::filesystem::exists(folder_ / file)) continue;
    const auto done = retargeted(folder_ / file);
    ASSERT_TRUE(done) << to_string(done.error());
    EXPECT_EQ(done->profile, profile) << file;
  }
}

// All takes of the folder that are motions of people, by path relative to it.
std::set<std::string> takes(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".bvh" || entry.path().extension() == ".amc")
      names.insert(entry.path().lexically_relative(folder).generic_string());
  return names;
}

TEST_F(Captures, WristsAndAnklesGoTheCapturedWayAndFeetSkateNoMoreInEveryTake) {
  const bool print = std::getenv("RINGCRAFT_PRINT") != nullptr;
  for (const std::string& take : takes(folder_)) {
    const auto done = retargeted(folder_ / take);
    ASSERT_TRUE(done) << to_string(done.error());
    const auto measures = testing::measure(done->raw, done->map, done->clip, canonical_skeleton());
    for (const auto& axis : measures.axes) {
      if (axis.spread < 0.02) continue;
      EXPECT_GT(axis.correlation, 0.98)
          << take << ' ' << vrm_name(axis.joint) << " axis " << axis.axis;
    }
    EXPECT_LE(measures.our_skate, measures.source_skate + 0.005) << take;
    // Knees: no jump above the capture's own largest, or above what a boxer's knee does anyway.
    EXPECT_LT(measures.our_knee_jerk, std::max(1.25 * measures.source_knee_jerk, 4.0)) << take;
    if (!print) continue;
    fmt::print("| {} | {:.4f} | {:.4f} | {:.4f} | {:.1f} | {:.1f} |\n", take, measures.worst(0.02),
               measures.source_skate, measures.our_skate, measures.source_knee_jerk,
               measures.our_knee_jerk);
  }
}

// The manifest of docs/captures.md: one capture of each format that needs a key of its own.
TEST_F(Captures, AManifestMayNameAnyFormat) {
  const auto absolute = std::filesystem::absolute(folder_).lexically_normal();
  const TemporaryFolder scratch;
  const auto manifest = scratch.path() / "any_format.toml";
  const auto folder = absolute.string();
  std::ofstream(manifest)
      << "name = \"my_gym\"\n"
         "[[capture]]\npath = \"" +
             folder +
             "/cmu/13_17.amc\"\nguard_at = 0.5\n"
             "[[capture.action]]\nname = \"cross\"\nkind = \"attack\"\nbegin = 1.55\n"
             "end = 2.35\nstrike = [{kind = \"straight\", joint = \"rightHand\", "
             "zone = \"head\", at = 1.92}]\n"
             "[[capture]]\npath = \"" +
             folder + "/hdm05/bk_kickLFront1Reps_007_120.amc\"\nskeleton = \"" + folder +
             "/hdm05/bk.asf\"\nframe_rate = 120\nguard_at = 0.1\n"
             "[[capture.action]]\nname = \"kick\"\nkind = \"attack\"\nbegin = 0.2\n"
             "end = 2.2\nstrike = [{kind = \"front_kick\", joint = \"leftFoot\", "
             "zone = \"body\", at = 1.0}]\n"
             "[[capture]]\npath = \"" +
             folder +
             "/characters/Character.glb\"\nclip = \"Punch_Right\"\nguard_at = 0.0\n"
             "[[capture.action]]\nname = \"punch\"\nkind = \"attack\"\nbegin = 0.0\n"
             "end = 0.8\nstrike = [{kind = \"straight\", joint = \"rightHand\", "
             "zone = \"head\", at = 0.4}]\n";
  std::vector<std::string> notes;
  const auto actions = collect_actions(manifest, &notes);
  ASSERT_TRUE(actions) << to_string(actions.error());
  ASSERT_EQ(actions->size(), 3u);
  EXPECT_EQ((*actions)[0].name, "cross");
  EXPECT_THAT((*actions)[2].source, ::testing::HasSubstr("Character.glb Punch_Right"));
  for (const Action& action : *actions) EXPECT_TRUE(faults(action.clip).empty());
}

}  // namespace
}  // namespace ringcraft
