#include "io/report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/hash.h"
#include "io/events.h"
#include "io/quality.h"

namespace ringcraft {

namespace {

using nlohmann::json;

struct Tally {
  int strikes = 0, landed = 0, blocked = 0, missed = 0, defenses = 0, hits_taken = 0;
  int recovery_steps = 0, knockdowns = 0, knockouts = 0;
};

Tally tally_of(const Timeline& timeline, FighterId fighter) {
  Tally tally;
  for (const Event& event : timeline.events) {
    const bool own = event.who == fighter;
    switch (event.type) {
      case EventType::strike:
        tally.strikes += own;
        break;
      case EventType::hit:
        tally.landed += own && !event.fall;
        tally.hits_taken += event.whom == fighter;
        if (event.whom == fighter && event.knockout) tally.knockouts = 1;  // nobody gets up from it
        break;
      case EventType::block:
        tally.blocked += own && !event.fall;
        if (event.whom == fighter && event.knockout) tally.knockouts = 1;
        break;
      case EventType::miss:
        tally.missed += own;
        break;
      case EventType::knockdown:
        tally.knockdowns += own;
        break;
      case EventType::response:
        if (own && event.response == ResponseKind::recovery_steps) {
          tally.recovery_steps += event.steps;
        }
        break;
      case EventType::decision:
      case EventType::getup:
        break;
    }
  }
  if (fighter.at() < timeline.tracks.size()) {
    for (const Segment& segment : timeline.tracks[fighter.at()].segments) {
      tally.defenses += segment.kind == Kind::defense;
    }
  }
  return tally;
}

// Mean ground distance of the hips to the nearest other fighter, m.
double mean_distance(const Timeline& timeline, std::size_t fighter) {
  if (fighter >= timeline.tracks.size()) return 0;
  const std::vector<Pose>& own = timeline.tracks[fighter].frames;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t tick = 0; tick < own.size(); ++tick) {
    double nearest = -1;
    for (std::size_t other = 0; other < timeline.tracks.size(); ++other) {
      if (other == fighter || tick >= timeline.tracks[other].frames.size()) continue;
      const Vec3 apart = timeline.tracks[other].frames[tick].hips - own[tick].hips;
      const double distance =
          std::hypot(static_cast<double>(apart.x), static_cast<double>(apart.z));
      if (nearest < 0 || distance < nearest) nearest = distance;
    }
    if (nearest < 0) continue;
    sum += nearest;
    ++count;
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

// What a fighter launched of its own will, and which action most: not what it stands in at first.
struct Launches {
  int count = 0;
  double per_second = 0, most_share = 0;
  std::string most;
};

Launches launches_of(const FighterTrack& track) {
  std::map<std::string, int> by_name;
  Launches result;
  for (std::size_t i = 1; i < track.segments.size(); ++i) {
    const Segment& segment = track.segments[i];
    if (segment.launch.forced) continue;
    ++by_name[segment.name];
    ++result.count;
  }
  int times = 0;
  for (const auto& [name, count] : by_name) {
    if (count > times) result.most = name, times = count;
  }
  const double length = seconds(static_cast<Tick>(track.frames.size()));
  if (length > 0) result.per_second = result.count / length;
  if (result.count > 0) result.most_share = static_cast<double>(times) / result.count;
  return result;
}

json fighters_json(const Timeline& timeline, const std::vector<FighterLook>& looks,
                   const RunFacts& facts) {
  json fighters = json::array();
  for (std::size_t i = 0; i < timeline.tracks.size(); ++i) {
    const Tally tally = tally_of(timeline, FighterId(i));
    const Launches launches = launches_of(timeline.tracks[i]);
    const RunFacts::Contestant contestant =
        i < facts.contestants.size() ? facts.contestants[i] : RunFacts::Contestant{};
    fighters.push_back({{"name", i < looks.size() ? looks[i].name : ""},
                        {"style", contestant.style},
                        {"horizon_s", rounded(contestant.horizon_s, 4)},
                        {"strikes", tally.strikes},
                        {"landed", tally.landed},
                        {"blocked", tally.blocked},
                        {"missed", tally.missed},
                        {"defenses", tally.defenses},
                        {"hits_taken", tally.hits_taken},
                        {"recovery_steps", tally.recovery_steps},
                        {"knockdowns", tally.knockdowns},
                        {"knockouts", tally.knockouts},
                        {"fatigue", rounded(contestant.fatigue, 4)},
                        {"injuries",
                         {{"left_arm", rounded(contestant.injuries[0], 4)},
                          {"right_arm", rounded(contestant.injuries[1], 4)},
                          {"left_leg", rounded(contestant.injuries[2], 4)},
                          {"right_leg", rounded(contestant.injuries[3], 4)}}},
                        {"launches", launches.count},
                        {"launches_per_s", rounded(launches.per_second, 4)},
                        {"most_launched", launches.most},
                        {"most_launched_share", rounded(launches.most_share, 4)},
                        {"mean_distance_m", rounded(mean_distance(timeline, i), 4)}});
  }
  return fighters;
}

json planner_json(const Timeline& timeline, const RunFacts& facts) {
  DecisionRecord sum;
  std::uint64_t decisions = 0;
  for (const Event& event : timeline.events) {
    if (event.type != EventType::decision) continue;
    ++decisions;
    sum.nodes += event.decision.nodes;
    sum.leaves += event.decision.leaves;
    sum.forced_nodes += event.decision.forced_nodes;
    sum.pruned_unanswered_hit += event.decision.pruned_unanswered_hit;
    sum.pruned_back_turned += event.decision.pruned_back_turned;
    sum.pruned_penetration += event.decision.pruned_penetration;
    sum.pruned_candidates += event.decision.pruned_candidates;
  }
  return {{"decisions", decisions},
          {"nodes", sum.nodes},
          {"leaves", sum.leaves},
          {"forced_nodes", sum.forced_nodes},
          {"pruned",
           {{"unanswered_hit", sum.pruned_unanswered_hit},
            {"back_turned", sum.pruned_back_turned},
            {"penetration", sum.pruned_penetration},
            {"candidates", sum.pruned_candidates}}},
          {"memo", {{"hits", facts.memo_hits}, {"misses", facts.memo_misses}}}};
}

json physics_json(const Timeline& timeline, const RunFacts& facts) {
  std::uint64_t impacts = 0, strikes = 0, agreed = 0;  // the tree plans strikes, not falls
  double impulse = 0;
  for (const Event& event : timeline.events) {
    if (event.type != EventType::hit && event.type != EventType::block) continue;
    ++impacts;
    strikes += event.fall ? 0u : 1u;
    impulse += glm::length(event.impulse);
    agreed += event.foreseen ? 1u : 0u;
  }
  const double mean = impacts == 0 ? 0.0 : impulse / static_cast<double>(impacts);
  json physics = {{"impacts", impacts},
                  {"impulse_steps", facts.impulse_steps},
                  {"mean_impulse_Ns", rounded(mean, 4)},
                  {"foreseen", facts.foreseen},
                  {"foreseen_agreement", nullptr},
                  {"foreseen_at_launch_agreement", nullptr}};
  if (strikes > 0) {
    physics["foreseen_agreement"] =
        rounded(static_cast<double>(agreed) / static_cast<double>(strikes), 4);
    physics["foreseen_at_launch_agreement"] =
        rounded(static_cast<double>(facts.agreed_at_launch) / static_cast<double>(strikes), 4);
  }
  return physics;
}

// Nearest rank.
double percentile(std::vector<double> values, int percent) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t rank = (static_cast<std::size_t>(percent) * values.size() + 99) / 100;
  return values[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

json library_counts(const MotionLibrary& library) {
  const auto connecting = std::count_if(library.actions().begin(), library.actions().end(),
                                        [](const Action& action) { return action.connects; });
  return {{"actions",
           library.launchable().size() + library.responses().size() + library.get_ups().size()},
          {"attacks", library.count(Kind::attack)},
          {"combinations", library.count(Kind::combination)},
          {"defenses", library.count(Kind::defense)},
          {"transitions", library.count(Kind::transition)},
          {"idles", library.count(Kind::idle)},
          {"responses", library.count(Kind::response)},
          {"get_ups", library.count(Kind::get_up)},
          {"connecting", connecting}};
}

json report_json(const Timeline& timeline, const std::vector<FighterLook>& looks,
                 const MotionLibrary& library, const RunFacts& facts) {
  std::vector<BodyModel> bodies;
  bodies.reserve(looks.size());
  for (const FighterLook& look : looks) bodies.push_back(look.body);
  const FightQuality quality = quality_of(timeline, bodies, library);
  json of_library = library_counts(library);
  of_library["name"] = library.name();
  return {{"version", facts.version},
          {"scene", facts.scene},
          {"seed", facts.seed},
          {"library", std::move(of_library)},
          {"duration_s", rounded(seconds(timeline.end), 4)},
          {"hash", hash_name(timeline.hash())},
          {"interrupted", facts.interrupted},
          {"fighters", fighters_json(timeline, looks, facts)},
          {"planner", planner_json(timeline, facts)},
          {"physics", physics_json(timeline, facts)},
          {"quality",
           {{"penetration_p99_m", rounded(quality.penetration_p99_m, 5)},
            {"penetration_max_m", rounded(quality.penetration_max_m, 5)},
            {"penetration_max_at_s", rounded(quality.penetration_max_at_s, 3)},
            {"penetration_longest_s", rounded(quality.penetration_longest_s, 3)},
            {"foot_skate_ratio", rounded(quality.foot_skate_ratio, 5)},
            {"joint_limit_violations", quality.joint_limit_violations},
            {"wrist_speed_p99_mps", rounded(quality.wrist_speed_p99_mps, 3)}}}};
}

json timing_json(const Timeline& timeline, const ClockFacts& clock, const std::string& version) {
  const double duration = seconds(timeline.end);
  return {{"version", version},
          {"threads", clock.threads},
          {"wall_s", rounded(clock.wall_s, 3)},
          {"realtime_factor", clock.wall_s > 0 ? rounded(duration / clock.wall_s, 3) : 0.0},
          {"decision_ms",
           {{"p50", rounded(percentile(clock.decision_ms, 50), 3)},
            {"p99", rounded(percentile(clock.decision_ms, 99), 3)},
            {"max", rounded(percentile(clock.decision_ms, 100), 3)}}},
          {"impulse_step_us",
           {{"p50", rounded(percentile(clock.impulse_step_us, 50), 1)},
            {"p99", rounded(percentile(clock.impulse_step_us, 99), 1)}}}};
}

}  // namespace ringcraft
