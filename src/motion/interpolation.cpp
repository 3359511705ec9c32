#include "motion/interpolation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "motion/quality.h"

namespace ringcraft {
namespace {

const std::string kBlendOf = "blend of ";  // how a blend's source begins
constexpr float kTurns = radians(20);      // less is no turn
constexpr float kTurnsInPlace = 0.35f;     // m: a turn that leads farther is none
constexpr float kSteps = 0.12f;            // m: less is no step
constexpr std::size_t kMostMembers = 64;   // of a sort: what has more is dense, some stand for all
constexpr float kStillJump = 0.02f;        // m/s: change of velocity in a tick that nobody sees

struct Sort {
  std::string name;
  Outcomes kind;
};

std::string side_of(Joint joint) {
  return joint == Joint::left_hand || joint == Joint::left_foot || joint == Joint::left_lower_arm ||
                 joint == Joint::left_lower_leg
             ? "left"
             : "right";
}

// What an action is one of, if it is something that blends.
std::optional<Sort> sort_of(const Skeleton& skeleton, const Action& action) {
  if (action.connects || is_blend(action)) return std::nullopt;
  if (action.kind == Kind::attack || action.kind == Kind::combination) {
    if (action.strikes.empty()) return std::nullopt;
    std::string name;
    for (const Strike& strike : action.strikes)
      name += fmt::format("{}{}_{}", name.empty() ? "" : "_", name_of(strike.kind),
                          side_of(strike.joint));
    return Sort{name, Outcomes::blow};
  }
  if (action.kind != Kind::transition || action.starts_lying != Lying::none ||
      action.ends_lying != Lying::none)
    return std::nullopt;
  const float yaw = outcome_of(skeleton, action, Outcomes::turn).x;
  const Vec3 way = outcome_of(skeleton, action, Outcomes::step);
  const float travel = glm::length(way);
  if (std::abs(yaw) > kTurns && travel < kTurnsInPlace)
    return Sort{yaw > 0 ? "turn_left" : "turn_right", Outcomes::turn};
  if (travel < kSteps) return std::nullopt;
  const float off = degrees(yaw_of(way));
  return Sort{std::abs(off) <= 45    ? "step_forward"
              : std::abs(off) >= 135 ? "step_back"
              : off > 0              ? "step_left"
                                     : "step_right",
              Outcomes::step};
}

constexpr float kFar = 1e9f;

// The moments that two of a sort share; nothing where they cannot be blended. A turn on the spot
// may set its feet in another order: whoever weighs more says then when a foot is planted.
std::optional<Anchors> anchors_of(Outcomes kind, const Action& reference, const Action& other) {
  const auto anchors = shared_phases(reference, other);
  return !anchors && kind == Outcomes::turn ? Anchors{} : anchors;
}

// Distance of each pair of a sort along its registration; far where phases differ.
using Distances = std::vector<std::vector<float>>;

Distances pair_distances(const Skeleton& skeleton, Outcomes kind,
                         const std::vector<Action>& actions,
                         const std::vector<std::size_t>& members) {
  Distances far(members.size(), std::vector<float>(members.size(), kFar));
  for (std::size_t a = 0; a < members.size(); ++a) {
    far[a][a] = 0;
    for (std::size_t b = a + 1; b < members.size(); ++b) {
      const Action &one = actions[members[a]], &two = actions[members[b]];
      if (const auto anchors = anchors_of(kind, one, two))
        far[a][b] = far[b][a] = registration_distance(skeleton, one.clip, two.clip, *anchors);
    }
  }
  return far;
}

Variant variant_of(const Skeleton& skeleton, Outcomes kind, const Action& reference,
                   const Action& other) {
  return {&other, registered(skeleton, reference.clip, other.clip,
                             anchors_of(kind, reference, other).value_or(Anchors{}))
                      .tick};
}

// Evenly spread ones, where there are more than are compared with each other.
std::vector<std::size_t> thinned(const std::vector<std::size_t>& members) {
  if (members.size() <= kMostMembers) return members;
  std::vector<std::size_t> kept;
  kept.reserve(kMostMembers);
  for (std::size_t i = 0; i < kMostMembers; ++i)
    kept.push_back(members[i * members.size() / kMostMembers]);
  return kept;
}

// The member that most others are alike to, the nearest of equals, becomes a reference with these;
// then the same of what is left.
void add_families(const Skeleton& skeleton, const Sort& sort, const std::vector<Action>& actions,
                  const std::vector<std::size_t>& members, float alike, std::vector<Family>& out) {
  const Distances far = pair_distances(skeleton, sort.kind, actions, members);
  std::vector<bool> taken(members.size());
  for (int number = 1;; ++number) {
    std::size_t best = members.size(), most = 1;
    float nearest = kFar;
    for (std::size_t a = 0; a < members.size(); ++a) {
      if (taken[a]) continue;
      std::size_t count = 0;
      float sum = 0;
      for (std::size_t b = 0; b < members.size(); ++b) {
        if (taken[b] || far[a][b] > alike) continue;
        ++count;
        sum += far[a][b];
      }
      const float mean = sum / static_cast<float>(std::max<std::size_t>(1, count));
      if (count < 2 || count < most || (count == most && mean >= nearest)) continue;
      best = a;
      most = count;
      nearest = mean;
    }
    if (best == members.size()) return;
    Family family;
    family.name = number > 1 ? fmt::format("{}_{}", sort.name, number) : sort.name;
    family.kind = sort.kind;
    const auto add = [&](std::size_t b) {
      taken[b] = true;
      family.members.push_back(members[b]);
      family.variants.push_back(
          variant_of(skeleton, sort.kind, actions[members[best]], actions[members[b]]));
      family.distance.push_back(far[best][b]);
    };
    add(best);
    for (std::size_t b = 0; b < members.size(); ++b)
      if (!taken[b] && far[best][b] <= alike) add(b);
    out.push_back(std::move(family));
  }
}

// m/s: the largest change of any joint's velocity from one tick to the next.
float largest_jump(const Skeleton& skeleton, const Clip& clip) {
  float most = 0;
  WorldPose a = world_pose(skeleton, clip.at(0)), b = world_pose(skeleton, clip.at(1));
  for (Tick t = 2; t <= clip.length(); ++t) {
    const WorldPose c = world_pose(skeleton, clip.at(t));
    for (std::size_t j = 0; j < kJointCount; ++j)
      most = std::max(most, glm::length(c.position[j] - 2.0f * b.position[j] + a.position[j]));
    a = b;
    b = c;
  }
  return most / kTickSeconds;
}

// m/s against the hips, over the action.
float peak_speed(const Skeleton& skeleton, const Action& action) {
  float most = 0;
  const std::size_t joint = index(action.strikes.back().joint);
  Vec3 before{};
  for (Tick t = 0; t <= action.length(); ++t) {
    const WorldPose world = world_pose(skeleton, action.clip.at(t));
    const Vec3 now = world.position[joint] - world.position[0];
    if (t > 0) most = std::max(most, glm::distance(now, before) / kTickSeconds);
    before = now;
  }
  return most;
}

float room_of(const InterpolationSettings& settings, Outcomes kind) {
  switch (kind) {
    case Outcomes::blow:
      return settings.blow_room;
    case Outcomes::step:
      return settings.step_room;
    case Outcomes::turn:
      break;
  }
  return settings.turn_room;
}

std::string told(Outcomes kind, Vec3 outcome) {
  switch (kind) {
    case Outcomes::blow:
      return fmt::format("({:+.2f} {:.2f} {:+.2f}) m", outcome.x, outcome.y, outcome.z);
    case Outcomes::step:
      return fmt::format("({:+.2f} {:+.2f}) m", outcome.x, outcome.z);
    case Outcomes::turn:
      break;
  }
  return fmt::format("{:+.0f} degrees", degrees(outcome.x));
}

std::string told_error(Outcomes kind, float error) {
  return kind == Outcomes::turn ? fmt::format("{:.1f} degrees", degrees(error))
                                : fmt::format("{:.1f} cm", error * 100);
}

std::string parents(std::span<const Variant> variants, std::span<const float> weights) {
  std::string text;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (weights[i] <= 0) continue;
    text +=
        fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", variants[i].action->name, weights[i]);
  }
  return text;
}

// Puts blends where a family leaves room: at the sample that lies farthest from every outcome there
// is, again and again.
class Filler {
 public:
  Filler(const Skeleton& skeleton, const Family& family, const InterpolationSettings& settings)
      : skeleton_(skeleton),
        family_(family),
        settings_(settings),
        table_(skeleton, family.variants, family.kind, settings.outcomes) {
    for (std::size_t i = 0; i < family.variants.size(); ++i)
      there_.push_back(table_.samples()[i].outcome);
  }

  void fill(const Judge& judge, std::set<std::string>& names, std::vector<Action>& out,
            std::vector<std::string>& notes) {
    const float room = room_of(settings_, family_.kind);
    for (std::size_t made = 0, tried = 0;
         made < settings_.most_of_family && tried < 2 * settings_.most_of_family; ++tried) {
      const auto [wanted, apart] = emptiest();
      if (apart < room) return;
      there_.push_back(wanted);  // whatever comes of it, it is not asked for again
      Reached reached = table_.reach(wanted);
      std::string wrong;
      if (reached.error > settings_.miss * room)
        wrong = fmt::format("misses by {}", told_error(family_.kind, reached.error));
      if (wrong.empty())
        wrong = worse_than(skeleton_, reached.action, family_.variants, reached.weights, settings_);
      if (wrong.empty() && judge) wrong = judge(reached.action);
      const std::string what =
          fmt::format("{} of {}; wanted {}, nearest repetition {} off; comes to {}, {} off",
                      family_.name, parents(family_.variants, reached.weights),
                      told(family_.kind, wanted), told_error(family_.kind, apart),
                      told(family_.kind, reached.outcome), told_error(family_.kind, reached.error));
      if (!wrong.empty()) {
        notes.push_back(fmt::format("blend refused: {}: {}", what, wrong));
        continue;
      }
      there_.back() = reached.outcome;
      Action action = std::move(reached.action);
      set_zone(action, reached);
      for (int number = 1; names.contains(action.name) || number == 1; ++number)
        action.name = fmt::format("blend_{}_{}", family_.name, number);
      names.insert(action.name);
      action.source = kBlendOf + parents(family_.variants, reached.weights);
      notes.push_back(fmt::format("{}: blend: {}", action.name, what));
      out.push_back(std::move(action));
      ++made;
    }
  }

 private:
  // A blow goes where the repetition goes that lands at the nearest height.
  void set_zone(Action& action, const Reached& reached) const {
    if (family_.kind != Outcomes::blow) return;
    float nearest = kFar;
    for (std::size_t i = 0; i < reached.weights.size(); ++i) {
      const float apart = std::abs(table_.samples()[i].outcome.y - reached.outcome.y);
      if (reached.weights[i] <= 0 || apart >= nearest) continue;
      nearest = apart;
      action.strikes.back().zone = family_.variants[i].action->strikes.back().zone;
    }
  }

  std::pair<Vec3, float> emptiest() const {
    std::pair<Vec3, float> best{{}, -1.0f};
    for (const OutcomeSample& sample : table_.samples()) {
      float nearest = kFar;
      for (const Vec3& outcome : there_)
        nearest = std::min(nearest, glm::distance(outcome, sample.outcome));
      if (nearest > best.second) best = {sample.outcome, nearest};
    }
    return best;
  }

  const Skeleton& skeleton_;
  const Family& family_;
  const InterpolationSettings& settings_;
  OutcomeTable table_;
  std::vector<Vec3> there_;
};

}  // namespace

std::vector<Family> families(const Skeleton& skeleton, const std::vector<Action>& actions,
                             const InterpolationSettings& settings) {
  std::map<std::string, std::pair<Sort, std::vector<std::size_t>>> sorts;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const auto sort = sort_of(skeleton, actions[i]);
    if (!sort) continue;
    auto& [kept, members] = sorts[sort->name];
    kept = *sort;
    members.push_back(i);
  }
  std::vector<Family> found;
  for (const auto& [name, sort] : sorts) {
    if (sort.second.size() < 2) continue;
    add_families(skeleton, sort.first, actions, thinned(sort.second), settings.alike, found);
  }
  return found;
}

std::string worse_than(const Skeleton& skeleton, const Action& blend,
                       std::span<const Variant> variants, std::span<const float> weights,
                       const InterpolationSettings& settings) {
  if (const auto wrong = faults(blend); !wrong.empty()) return wrong.front();
  double skate = 0;
  float jump = 0, speed = 0;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (weights[i] <= 0) continue;
    const Action& of = *variants[i].action;
    skate = std::max(skate, foot_skate_ratio(skeleton, of.clip.frames, kTicksPerSecond));
    jump = std::max(jump, largest_jump(skeleton, of.clip));
    if (of.attacks()) speed += weights[i] * peak_speed(skeleton, of);
  }
  const double slides = foot_skate_ratio(skeleton, blend.clip.frames, kTicksPerSecond);
  if (slides > skate + static_cast<double>(settings.skate))
    return fmt::format("feet slide, {:.3f} against {:.3f}", slides, skate);
  const float jumps = largest_jump(skeleton, blend.clip);
  if (jumps > settings.jump * jump + kStillJump)
    return fmt::format("a velocity jumps by {:.2f} m/s against {:.2f}", jumps, jump);
  if (!blend.attacks()) return "";
  const float peak = peak_speed(skeleton, blend);
  if (peak < settings.keeps_speed * speed)
    return fmt::format("the blow peaks at {:.1f} m/s, its repetitions at {:.1f}", peak, speed);
  return "";
}

bool is_blend(const Action& action) {
  return action.source.starts_with(kBlendOf);
}

std::vector<Action> interpolated(const Skeleton& skeleton, const std::vector<Action>& actions,
                                 const InterpolationSettings& settings, const Judge& judge,
                                 std::vector<std::string>& notes) {
  std::set<std::string> names;
  for (const Action& action : actions) names.insert(action.name);
  std::vector<Action> made;
  for (const Family& family : families(skeleton, actions, settings))
    Filler(skeleton, family, settings).fill(judge, names, made, notes);
  return made;
}

}  // namespace ringcraft
