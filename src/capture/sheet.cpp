#include "capture/sheet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/sheet_motion.h"
#include "motion/aim.h"
#include "motion/strike_fit.h"

namespace ringcraft {

namespace {

constexpr float kStraightestLeg = 0.985f;  // of its length, of a leg that stands
constexpr float kEndTolerance = 0.012f;    // fraction of height: foot against the end guard
constexpr float kPelvisSigma = 2.5f, kTrunkSigma = 2.0f;    // ticks
constexpr float kFreeFootSigma = 2.3f, kAnkleSigma = 4.0f;  // ticks
constexpr float kStrikeSigma = 1.2f, kHandSigma = 2.0f;     // ticks
constexpr int kAimRounds = 4;       // after which a blow meets what it aims at, or never will
constexpr float kAimed = 0.003f;    // m
constexpr float kAimFades = 0.20f;  // s after the contact in which the aim's shift is let go
constexpr int kSinkTicks = 6;       // over which the pelvis sinks to keep the feet in reach

Error fault(const Document& document, const std::string& pointer, std::string what,
            std::string remedy) {
  return {ErrorKind::input, document.path.string(), document.place(pointer), std::move(what),
          std::move(remedy)};
}

const Skeleton& body() {
  static const Skeleton skeleton = canonical_skeleton();
  return skeleton;
}

Channel led_channel(Joint striker) {
  return of_side(is_foot(striker) ? Channel::lead_ankle : Channel::lead_wrist, side_of(striker));
}

// Strikes need a key of their limb at start and contact: the profile runs between the two.
std::optional<Error> check_strikes(const Document& document, const SheetAction& action,
                                   const std::vector<SheetKey>& keys) {
  for (std::size_t i = 0; i < action.strikes.size(); ++i) {
    const SheetStrike& s = action.strikes[i];
    const Channel channel = led_channel(s.strike.joint);
    for (const float t : {s.start, s.contact}) {
      const bool found = std::any_of(keys.begin(), keys.end(), [&](const SheetKey& key) {
        return std::abs(key.t - t) < 2e-3f && key.values[index(channel)];
      });
      if (found) continue;
      return fault(document, fmt::format("{}/strike/{}", action.pointer, i),
                   fmt::format("no key gives {} at {:.3f} s", info(channel).name, t),
                   "add a key at the strike's start and at its contact");
    }
  }
  return std::nullopt;
}

// The trunk's curves at every tick, filtered so that no key can be seen.
std::vector<BodyTargets> trunk_targets(const TrunkMotion& trunk, std::size_t count) {
  std::vector<BodyTargets> targets(count);
  for (std::size_t i = 0; i < count; ++i) {
    trunk.fill(static_cast<float>(seconds(static_cast<Tick>(i))), targets[i]);
  }
  std::vector<Vec3> pelvis(count);
  for (std::size_t i = 0; i < count; ++i) pelvis[i] = targets[i].pelvis;
  smooth(pelvis, kPelvisSigma);
  for (std::size_t i = 0; i < count; ++i) targets[i].pelvis = pelvis[i];
  for (const auto member :
       {&BodyTargets::pelvis_rotation, &BodyTargets::chest_rotation, &BodyTargets::head_rotation}) {
    std::vector<Quat> rotations(count);
    for (std::size_t i = 0; i < count; ++i) rotations[i] = targets[i].*member;
    smooth(rotations, kTrunkSigma);
    for (std::size_t i = 0; i < count; ++i) targets[i].*member = rotations[i];
  }
  return targets;
}

void add_hands(const Skeleton& skeleton, const SheetAction& action,
               const std::vector<SheetKey>& keys, const TrunkMotion& trunk,
               std::vector<BodyTargets>& targets) {
  for (std::size_t i = 0; i < 2; ++i) {
    const HandMotion hand(skeleton, action, keys, trunk, i == 0 ? Side::left : Side::right);
    std::vector<Vec3> wrist(targets.size());
    for (std::size_t k = 0; k < targets.size(); ++k) {
      targets[k].arms[i] = hand.at(static_cast<float>(seconds(static_cast<Tick>(k))), targets[k]);
      wrist[k] = targets[k].arms[i].wrist;
    }
    smooth(wrist, hand.strikes() ? kStrikeSigma : kHandSigma);
    for (std::size_t k = 0; k < targets.size(); ++k) targets[k].arms[i].wrist = wrist[k];
  }
}

// From the root's frame to action space.
void place(BodyTargets& targets, const Placement& root) {
  const Quat turn = yaw_rotation(root.yaw);
  targets.pelvis = root * targets.pelvis;
  targets.pelvis_rotation = turn * targets.pelvis_rotation;
  targets.chest_rotation = turn * targets.chest_rotation;
  targets.head_rotation = turn * targets.head_rotation;
  for (ArmTarget& arm : targets.arms) {
    arm.wrist = root * arm.wrist;
    arm.pole = turn * arm.pole;
  }
}

// Runs of ticks in which a foot is off the ground: first tick and one past the last.
std::vector<std::pair<std::size_t, std::size_t>> free_runs(const std::vector<BodyTargets>& targets,
                                                           std::size_t side) {
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].feet[side].freedom <= 0) continue;
    const bool goes_on = !runs.empty() && runs.back().second == i;
    if (!goes_on) runs.emplace_back(i, i);
    runs.back().second = i + 1;
  }
  return runs;
}

// Rounds the ankle's path of feet in the air: a kick that turns back at the contact has mass.
void smooth_free_feet(std::vector<BodyTargets>& targets) {
  for (std::size_t side = 0; side < 2; ++side) {
    for (const auto& [begin, end] : free_runs(targets, side)) {
      std::vector<Vec3> ankle;
      for (std::size_t i = begin; i < end; ++i) ankle.push_back(targets[i].feet[side].ankle);
      smooth(ankle, kFreeFootSigma);
      for (std::size_t i = begin; i < end; ++i) targets[i].feet[side].ankle = ankle[i - begin];
    }
  }
}

// The same for how such a foot is turned: it yields to the floor softly.
void smooth_free_ankles(const std::vector<BodyTargets>& targets, std::vector<Pose>& frames) {
  for (std::size_t side = 0; side < 2; ++side) {
    const Side which = side == 0 ? Side::left : Side::right;
    for (const Joint joint : {leg(which).end, toes(which)}) {
      for (const auto& [begin, end] : free_runs(targets, side)) {
        std::vector<Quat> turns;
        for (std::size_t i = begin; i < end; ++i) turns.push_back(frames[i].rotation[index(joint)]);
        smooth(turns, kAnkleSigma);
        for (std::size_t i = begin; i < end; ++i)
          frames[i].rotation[index(joint)] = turns[i - begin];
      }
    }
  }
}

// Lowers the pelvis, and the hands with it, where a standing leg would not reach its foot.
void keep_in_reach(const Skeleton& skeleton, std::vector<BodyTargets>& targets) {
  std::vector<float> sink;
  sink.reserve(targets.size());
  for (const BodyTargets& t : targets) sink.push_back(missing_reach(skeleton, t, kStraightestLeg));
  widen(sink, kSinkTicks);
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i].pelvis.y -= sink[i];
}

Result<Action> compile_once(const Document& document, const SheetAction& sheet) {
  const Skeleton& skeleton = body();
  const std::vector<SheetKey> keys = merged_keys(sheet);
  if (auto error = check_strikes(document, sheet, keys)) return tl::unexpected(*error);

  Action action = sheet.action;
  Clip& clip = action.clip;
  clip.root = root_track(sheet, keys);
  const std::size_t count = clip.root.size();
  const TrunkMotion trunk(sheet, keys);
  std::vector<BodyTargets> targets = trunk_targets(trunk, count);
  add_hands(skeleton, sheet, keys, trunk, targets);
  for (std::size_t i = 0; i < count; ++i) place(targets[i], clip.root[i]);

  clip.contacts.resize(count);
  for (std::size_t side = 0; side < 2; ++side) {
    const FootMotion foot(skeleton, sheet, keys, clip.root, trunk,
                          side == 0 ? Side::left : Side::right);
    if (foot.end_error() > kEndTolerance * kCanonicalHeight) {
      return tl::unexpected(
          fault(document, sheet.pointer,
                fmt::format("'{}': the {} foot ends {:.2f} m from its place in the end pose",
                            action.name, side == 0 ? "lead" : "rear", foot.end_error()),
                "add a step, or correct end_at"));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float t = static_cast<float>(seconds(static_cast<Tick>(i)));
      targets[i].feet[side] = foot.at(t, targets[i]);
      (side == 0 ? clip.contacts[i].left : clip.contacts[i].right) = foot.planted(t);
    }
  }
  smooth_free_feet(targets);
  keep_in_reach(skeleton, targets);
  for (const BodyTargets& t : targets) clip.frames.push_back(body_pose(skeleton, t));
  smooth_free_ankles(targets, clip.frames);
  unroll_rotations(clip);
  for (const SheetStrike& strike : sheet.strikes) {
    Strike s = strike.strike;
    s.active_begin = ticks(strike.active_begin);
    s.active_end = ticks(strike.active_end);
    action.strikes.push_back(s);
  }
  const std::vector<std::string> broken = faults(action);
  if (!broken.empty()) {
    return tl::unexpected(
        fault(document, sheet.pointer,
              fmt::format("'{}' compiles to a broken clip: {}", action.name, broken[0]),
              "look for keys far outside the body's reach"));
  }
  return action;
}

// How far the strike passes from its aim sideways and in height at its contact, m, in the root's
// frame of that moment. The opponent stands in the guard that the action starts from.
Vec3 aim_error(const SheetStrike& strike, const Action& action) {
  const AimPoint& point = *aim_point(strike.strike.aim);
  const Vec3 own =
      position_of(point, world_pose(body(), action.clip.frames.front()), kCanonicalHeight);
  const Tick contact = ticks(strike.contact);
  const Vec3 tip =
      striking_point(strike.strike, body(), world_pose(body(), action.clip.at(contact)));
  const Vec3 error(-own.x - tip.x, own.y - tip.y, 0);
  return yaw_rotation(-action.clip.root_at(contact).yaw) * error;
}

// Moves the keys of the striking limb: fully at the contact, less before and after it; elbow or
// knee half as far.
void shift_strike(const SheetStrike& strike, Vec3 shift, std::vector<SheetKey>& keys) {
  const bool foot = is_foot(strike.strike.joint);
  const Side side = side_of(strike.strike.joint);
  const Channel bend = of_side(foot ? Channel::lead_knee : Channel::lead_elbow, side);
  for (SheetKey& key : keys) {
    if (key.t < strike.start + 1e-3f) continue;
    const float u = (key.t - strike.start) / (strike.contact - strike.start);
    const float share = u <= 1 ? u * u : 1 - (key.t - strike.contact) / kAimFades;
    if (share <= 0) continue;
    const Vec3 way = shift * (share / kCanonicalHeight);
    auto& end = key.values[index(led_channel(strike.strike.joint))];
    auto& middle = key.values[index(bend)];
    if (end) *end += way;
    if (middle) *middle += way * 0.5f;
  }
}

Result<Action> compile(const Document& document, const SheetAction& sheet) {
  SheetAction aimed = sheet;
  for (int round = 0;; ++round) {
    auto action = compile_once(document, aimed);
    if (!action) return action;
    float worst = 0;
    for (const SheetStrike& strike : aimed.strikes) {
      if (strike.strike.aim.empty()) continue;
      const Vec3 error = aim_error(strike, *action);
      worst = std::max(worst, glm::length(error));
      shift_strike(strike, error, aimed.keys);
    }
    if (worst < kAimed || round == kAimRounds) return action;
  }
}

// The attack at its other distances, from the guard that it starts in.
std::vector<Action> variants(const SheetAction& sheet, const Action& action) {
  std::vector<Action> result;
  for (const auto& [name, by] : sheet.variants) {
    const Pose& guard = action.clip.frames.front();
    result.push_back(moved_reach(body(), action, guard, by * kCanonicalHeight));
    result.back().name += "_" + name;
    result.back().source += "_" + name;
  }
  return result;
}

Result<std::vector<Action>> compile_all(const Document& document) {
  auto sheets = sheet_actions(document);
  if (!sheets) return tl::unexpected(sheets.error());
  std::vector<Action> actions;
  for (const SheetAction& sheet : *sheets) {
    auto action = compile(document, sheet);
    if (!action) return tl::unexpected(action.error());
    const std::vector<Action> varied = variants(sheet, *action);
    actions.push_back(std::move(*action));
    actions.insert(actions.end(), varied.begin(), varied.end());
  }
  return actions;
}

}  // namespace

Result<std::vector<Action>> compile_sheet_file(const std::filesystem::path& path) {
  const auto document = read_document(path, "sheet");
  if (!document) return tl::unexpected(document.error());
  return compile_all(*document);
}

}  // namespace ringcraft
