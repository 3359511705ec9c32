#pragma once
// What was seen by eye on the captures of ../shared/mocap (its README; docs/sources.md, C0), and
// how a list of blows compares with it.

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/canonical.h"
#include "capture/mocap.h"
#include "capture/segment.h"

namespace ringcraft::testing {

inline Clip canonical_clip_of(const std::filesystem::path& path) {
  return read_canonical(path, canonical_skeleton()).value().clip;
}

struct Seen {
  char side;  // L or R
  double at;  // s
  enum class Kind : std::uint8_t { straight, bent, uppercut, block, any } kind = Kind::any;
};
using enum Seen::Kind;

// By eye: docs/sources.md, C0.
inline const std::vector<Seen> kEye13_17 = {
    {'L', 2.98, straight},  {'L', 10.02, straight}, {'L', 17.08, straight}, {'L', 21.58, straight},
    {'L', 28.81, straight}, {'L', 32.62, straight}, {'L', 36.98, straight}, {'R', 1.90, straight},
    {'R', 3.16, straight},  {'R', 5.08, straight},  {'R', 8.82, straight},  {'R', 10.22, straight},
    {'R', 14.49, straight}, {'R', 17.27, straight}, {'R', 21.75, straight}, {'R', 27.96, straight},
    {'R', 28.97, straight}, {'R', 37.17, straight}, {'R', 18.44, bent},     {'R', 19.94, bent},
    {'R', 20.65, bent},     {'R', 29.57, bent},     {'R', 32.83, bent},     {'R', 38.66, bent},
    {'L', 18.27, bent},     {'L', 20.38, bent},     {'L', 29.31, bent},     {'L', 38.44, bent},
    {'R', 10.92, uppercut}};
inline const std::vector<Seen> kEyeBoxing = {
    {'R', 3.40, straight}, {'R', 5.08, straight},  {'R', 5.40, straight},  {'R', 6.43, straight},
    {'R', 9.87, straight}, {'R', 12.41, straight}, {'R', 14.11, straight}, {'R', 8.94, straight},
    {'L', 5.72, straight}, {'L', 9.19, straight},  {'R', 7.29, bent}};
inline const std::vector<Seen> kEye135_06 = {
    {'R', 2.67, straight},  {'L', 5.47, straight},  {'R', 13.12, straight}, {'L', 14.92, straight},
    {'R', 17.02, straight}, {'L', 17.67, straight}, {'R', 18.18, straight}, {'L', 2.41, block},
    {'R', 4.38, block},     {'L', 7.09, block},     {'L', 12.72, block},    {'L', 16.56, block},
    {'L', 10.42, block},    {'R', 10.94, block}};
// By rule (README.md): right too, where found.
inline const std::vector<Seen> kRule13_17 = {{'R', 10.52}, {'L', 38.52}};
inline const std::vector<Seen> kRule135_06 = {{'L', 5.37},  {'R', 6.66},  {'R', 10.45},
                                              {'R', 14.56}, {'L', 17.73}, {'R', 21.71}};
inline const std::vector<Seen> kRuleBoxing = {{'R', 11.87}};

inline bool same(const FoundBlow& blow, const Seen& seen) {
  const bool left = blow.strike.joint == Joint::left_hand;
  return left == (seen.side == 'L') && std::abs(blow.strike.at - seen.at) <= 0.1;
}

inline bool same_kind(const FoundBlow& blow, Seen::Kind kind) {
  if (kind == block || blow.blocks) return (kind == block) == blow.blocks;
  if (kind == straight) return blow.strike.kind == StrikeKind::straight;
  if (kind == uppercut) return blow.strike.kind == StrikeKind::uppercut;
  return blow.strike.kind == StrikeKind::hook || blow.strike.kind == StrikeKind::uppercut;
}

struct Score {
  double precision = 0, recall = 0, kind = 0;
};

inline Score score_of(const std::vector<FoundBlow>& blows, const std::vector<Seen>& eye,
                      const std::vector<Seen>& rule) {
  int found = 0, kinds = 0, right = 0;
  for (const Seen& seen : eye)
    for (const FoundBlow& blow : blows)
      if (same(blow, seen)) {
        ++found;
        kinds += same_kind(blow, seen.kind) ? 1 : 0;
        break;
      }
  for (const FoundBlow& blow : blows) {
    const auto fits = [&](const Seen& seen) { return same(blow, seen); };
    right +=
        std::any_of(eye.begin(), eye.end(), fits) || std::any_of(rule.begin(), rule.end(), fits)
            ? 1
            : 0;
  }
  return {static_cast<double>(right) / static_cast<double>(blows.size()),
          static_cast<double>(found) / static_cast<double>(eye.size()),
          static_cast<double>(kinds) / std::max(1, found)};
}

// Takes whose strikes were listed.
struct ListedTake {
  const char* file;
  const std::vector<Seen>& eye;
  const std::vector<Seen>& rule;
};
inline const std::vector<ListedTake> kListed = {{"cmu/13_17.amc", kEye13_17, kRule13_17},
                                                {"debian/Boxing_Toes.bvh", kEyeBoxing, kRuleBoxing},
                                                {"cmu/135_06.amc", kEye135_06, kRule135_06}};

// Takes of one kick each.
struct KickTake {
  const char* file;
  Joint foot;
  StrikeKind kind;
  bool spins;
};
inline const std::vector<KickTake> kKicks = {
    {"hdm05/bd_kickLFront1Reps_001_120.amc", Joint::left_foot, StrikeKind::front_kick, false},
    {"hdm05/bd_kickLFront1Reps_002_120.amc", Joint::left_foot, StrikeKind::front_kick, false},
    {"hdm05/bd_kickLFront1Reps_003_120.amc", Joint::left_foot, StrikeKind::front_kick, false},
    {"hdm05/bk_kickLFront1Reps_007_120.amc", Joint::left_foot, StrikeKind::side_kick, false},
    {"hdm05/bk_kickLFront1Reps_008_120.amc", Joint::left_foot, StrikeKind::side_kick, false},
    {"hdm05/bk_kickLFront1Reps_009_120.amc", Joint::left_foot, StrikeKind::front_kick, false},
    {"deepmimic/kick.bvh", Joint::right_foot, StrikeKind::roundhouse, false},
    {"deepmimic/spinkick.bvh", Joint::right_foot, StrikeKind::roundhouse, true},
    {"mass/mass_kick.bvh", Joint::right_foot, StrikeKind::roundhouse, false}};

// Takes in which nobody strikes.
inline const std::vector<const char*> kPeaceful = {"cmu/02_01.bvh",
                                                   "cmu/16_15.bvh",
                                                   "cmu/07_05.amc",
                                                   "cmu/09_06.amc",
                                                   "cmu/49_02.bvh",
                                                   "cmu/18_01.bvh",
                                                   "cmu/19_01.bvh",
                                                   "deepmimic/walk.bvh",
                                                   "deepmimic/run.bvh",
                                                   "deepmimic/jump.bvh",
                                                   "deepmimic/roll.bvh",
                                                   "deepmimic/spin.bvh",
                                                   "deepmimic/stealthy_walk.bvh",
                                                   "deepmimic/getup_facedown.bvh",
                                                   "deepmimic/getup_faceup.bvh",
                                                   "hdm05/bd_lieDownFloor_001_120.amc",
                                                   "hdm05/bk_lieDownFloor_005_120.amc",
                                                   "hdm05/bd_sneak2StepsLStart_001_120.amc"};

}  // namespace ringcraft::testing
