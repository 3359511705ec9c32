#include "scene/library_check_gates.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/quantile.h"

namespace ringcraft {

namespace {

bool is_hand(const Strike& strike) {
  return strike.joint == Joint::left_hand || strike.joint == Joint::right_hand;
}

template <class Wanted, class Value>
std::vector<double> of_authored(const LibraryCheck& check, Wanted wanted, Value value) {
  std::vector<double> values;
  for (const StrikeMeasures& m : check.strikes) {
    if (m.authored && wanted(m)) values.push_back(value(m));
  }
  return values;
}

auto of_kind(StrikeKind kind) {
  return [kind](const StrikeMeasures& m) { return m.strike.kind == kind; };
}

// Over all actions: ranges of joints, sliding feet, parts inside each other.
void add_body_gates(LibraryCheck& check) {
  if (check.actions.empty()) return;
  double beyond = 0, excess = 0, skate = 0, slid = 0, all = 0, deepest = 0, jump = 0;
  std::vector<double> depths;
  for (const ActionMeasures& m : check.actions) {
    if (m.left_out) continue;
    beyond += static_cast<double>(m.limit_violations);
    excess = std::max(excess, m.worst_limit_deg);
    skate = std::max(skate, m.foot_skate);
    slid += m.foot_skate * m.seconds;
    all += m.seconds;
    depths.insert(depths.end(), m.self_depths_m.begin(), m.self_depths_m.end());
    if (m.authored) deepest = std::max(deepest, m.self_penetration_m);
    if (m.authored && m.steps_or_rises) jump = std::max(jump, m.own_jump_mps);
  }
  std::sort(depths.begin(), depths.end());
  check.gates.push_back({"joints beyond their range", beyond, 0, 0, "frames"});
  check.gates.push_back(
      {"joints beyond their range, worst", excess, 0, kMostBeyondDegrees, "degrees"});
  check.gates.push_back({"foot skate, worst action", skate, 0, kMostFootSkate, ""});
  check.gates.push_back({"foot skate, mean over time", slid / all, 0, kMostFootSkate, ""});
  check.gates.push_back(
      {"steps and get-ups, jump of velocity, worst", jump, 0, kMostOwnJump, "m/s"});
  check.gates.push_back({"self-penetration, 99 % of all frames",
                         100 * depths[depths.size() * 99 / 100], 0, 100 * kMostSelfPenetration,
                         "cm"});
  check.gates.push_back({"self-penetration, 99 % of worst authored", 100 * deepest, 0,
                         100 * kMostSelfPenetration, "cm"});
}

// Authored strikes arrive within 3 cm of what they aim at, over the whole reach stated.
void add_aim_gates(LibraryCheck& check) {
  double met = 0, all = 0, worst = 0;
  for (const StrikeMeasures& m : check.strikes) {
    if (!m.authored) continue;
    const bool stated = m.aim_best_m >= 0 && m.strike.farthest > 0;
    all += 1;
    met += stated && m.aim_worst_m <= kMostAimError ? 1 : 0;
    worst = std::max(worst, m.aim_worst_m);
  }
  if (all == 0) return;
  check.gates.push_back({"aims met within 3 cm over their reach", 100 * met / all, 100, 100, "%"});
  check.gates.push_back(
      {"aims, farthest miss within a reach", 100 * worst, 0, 100 * kMostAimError, "cm"});
}

void add_seam_gates(LibraryCheck& check) {
  if (check.seams.empty()) return;
  std::vector<double> jumps;
  jumps.reserve(check.seams.size());
  for (const SeamMeasures& seam : check.seams) jumps.push_back(seam.jump);
  std::sort(jumps.begin(), jumps.end());
  const std::size_t n = jumps.size();
  check.gates.push_back({"seams, jump of velocity, 99 %", jumps[n * 99 / 100], 0, 1, "m/s"});
  check.gates.push_back({"seams, jump of velocity, worst", jumps[n - 1], 0, kMostSeamJump, "m/s"});
}

// As published (docs/sources.md, V1): speeds at the impact, in the world, on a body that stands.
void add_speed_gates(LibraryCheck& check) {
  const auto impact = [](const StrikeMeasures& m) { return m.impact; };
  const auto start = [](const StrikeMeasures& m) { return m.start_to_contact_s; };
  const auto straights = of_authored(check, of_kind(StrikeKind::straight), impact);
  const auto hooks = of_authored(check, of_kind(StrikeKind::hook), impact);
  const auto rounds = of_authored(check, of_kind(StrikeKind::roundhouse), impact);
  const auto fronts = of_authored(check, of_kind(StrikeKind::front_kick), impact);
  const auto extreme = [&](const std::vector<double>& values, const char* what, double least,
                           double most) {
    if (values.empty()) return;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    check.gates.push_back({fmt::format("{}, slowest", what), *low, least, most, "m/s"});
    check.gates.push_back({fmt::format("{}, median", what), median(values), least, most, "m/s"});
    check.gates.push_back({fmt::format("{}, fastest", what), *high, least, most, "m/s"});
  };
  extreme(straights, "straights at the fist", 7, 11);
  if (!hooks.empty() && !straights.empty()) {
    check.gates.push_back(
        {"hooks over straights, medians", median(hooks) / median(straights), 1.0, 1.6, ""});
  }
  extreme(rounds, "roundhouse at the foot", 11, 14);
  if (!rounds.empty() && !fronts.empty()) {
    check.gates.push_back(
        {"roundhouse over front kick, medians", median(rounds) / median(fronts), 1.4, 1.5, ""});
  }
  const auto alone = [](const StrikeMeasures& m) {
    return m.strike.kind == StrikeKind::roundhouse && m.number == 0;
  };
  const auto times = of_authored(check, alone, start);
  if (!times.empty()) {
    const auto [low, high] = std::minmax_element(times.begin(), times.end());
    check.gates.push_back({"roundhouse, start to contact, quickest", *low, 0.4, 0.6, "s"});
    check.gates.push_back({"roundhouse, start to contact, slowest", *high, 0.4, 0.6, "s"});
  }
}

// Calibration sections 3 and 6: what falls when motion is robotic.
void add_motion_gates(LibraryCheck& check) {
  const auto punches = [](const StrikeMeasures& m) {
    return is_hand(m.strike) && m.strike.kind != StrikeKind::backfist;
  };
  const auto rear = [&](const StrikeMeasures& m) {
    return punches(m) && m.strike.joint == Joint::right_hand;
  };
  const auto share = of_authored(check, punches, [](const auto& m) { return m.peak_fraction; });
  if (!share.empty()) {
    check.gates.push_back({"peak of the hand's time, median", median(share), 0.55, 0.75, ""});
    const auto ratio =
        of_authored(check, punches, [](const auto& m) { return m.brake / std::max(1.0, m.push); });
    check.gates.push_back({"brake over push, median", median(ratio), 1.3, 3, ""});
  }
  const auto first = of_authored(check, rear, [](const auto& m) { return m.pelvis_to_chest_s; });
  const auto second = of_authored(check, rear, [](const auto& m) { return m.chest_to_limb_s; });
  if (!first.empty()) {
    check.gates.push_back(
        {"pelvis to chest, rear hand, median", median(first) * 1000, 30, 70, "ms"});
    check.gates.push_back(
        {"chest to hand, rear hand, median", median(second) * 1000, 30, 70, "ms"});
  }
  double still = 0, all = 0;
  for (const ActionMeasures& m : check.actions) {
    const bool stands = m.kind != Kind::response && m.kind != Kind::get_up;
    if (!m.authored || !stands) continue;
    still += m.still_hands * m.seconds;
    all += m.seconds;
  }
  if (all > 0) {
    check.gates.push_back({"wrists slower than 0.15 m/s", 100 * still / all, 0, 5, "% of time"});
  }
}

void add_yardstick_gates(LibraryCheck& check) {
  if (!check.yardstick) return;
  const Yardstick& y = *check.yardstick;
  check.gates.push_back({"authored to real, median", 100 * y.authored_median, 0, 14, "cm"});
  check.gates.push_back({"authored to real, 90 %", 100 * y.authored_90, 0, 20, "cm"});
  check.gates.push_back({"real strikes to authored, median", 100 * y.strikes_median, 0, 18, "cm"});
  check.gates.push_back({"real strikes to authored, 90 %", 100 * y.strikes_90, 0, 22, "cm"});
}

}  // namespace

void add_gates(LibraryCheck& check) {
  add_speed_gates(check);
  add_motion_gates(check);
  add_body_gates(check);
  add_aim_gates(check);
  add_seam_gates(check);
  add_yardstick_gates(check);
}

}  // namespace ringcraft
