#include "planner/motion_tables.h"

#include <algorithm>
#include <cmath>

#include "physics/partial.h"
#include "physics/response.h"

namespace ringcraft {
namespace {

// Shares of a response that stays up that have tables of their own; the whole is the next step.
constexpr std::array<float, 4> kParts{0, .25f, .5f, .75f};

float ground_distance(Vec3 p) {
  return std::hypot(p.x, p.z);
}

Box box_of(const BodyCapsules& capsules) {
  Box box{capsules[0].a, capsules[0].a};
  for (const Capsule& c : capsules) {
    box.low = glm::min(box.low, glm::min(c.a, c.b) - c.radius);
    box.high = glm::max(box.high, glm::max(c.a, c.b) + c.radius);
  }
  return box;
}

Sphere bound_of(const BodyCapsules& capsules) {
  const Box box = box_of(capsules);
  Sphere sphere;
  sphere.center = (box.low + box.high) * 0.5f;
  for (const Capsule& c : capsules) {
    const float far =
        std::max(glm::distance(sphere.center, c.a), glm::distance(sphere.center, c.b));
    sphere.radius = std::max(sphere.radius, far + c.radius);
  }
  return sphere;
}

PartSpheres::Lanes travels_of(const BodyCapsules& before, const BodyCapsules& after) {
  PartSpheres::Lanes rows{};
  for (std::size_t i = 0; i < kPartCount; ++i) rows[i] = travel(before[i], after[i]);
  return rows;
}

StrikeTable strike_table(const Strike& strike, const ActionTable& table) {
  StrikeTable result;
  result.strike = strike;
  result.parts = striking_parts(strike);
  result.main = part_of(strike.joint).value_or(Part::right_hand);
  float farthest = -1;
  for (Tick tick = strike.active_begin; tick < strike.active_end; ++tick) {
    const BodyCapsules& capsules = table.capsules_at(tick);
    for (std::size_t i = 0; i < kPartCount; ++i) {
      if (((result.parts >> i) & 1u) == 0) continue;
      const Capsule& c = capsules[i];
      result.reach =
          std::max(result.reach, std::max(ground_distance(c.a), ground_distance(c.b)) + c.radius);
    }
    const Capsule& main = capsules[index(result.main)];
    const Vec3 tip = main.a.z > main.b.z ? main.a : main.b;
    if (tip.z > farthest) {
      farthest = tip.z;
      result.landing = tip + Vec3(0, 0, main.radius);
      result.landing_tick = tick;
    }
  }
  return result;
}

// Appends a frame, or replaces that of `age`; the travel is that from the frame before.
void set_frame(ActionTable& table, std::size_t age, const BodyModel& body, const Pose& pose) {
  if (age >= table.capsules.size()) {
    table.capsules.resize(age + 1);
    table.travel.resize(age + 1);
    table.bound.resize(age + 1);
    table.box.resize(age + 1);
    table.spheres.resize(age + 1);
  }
  const BodyCapsules own = capsules(body, world_pose(body.skeleton, pose));
  table.capsules[age] = own;
  table.travel[age] = travels_of(table.capsules[age > 0 ? age - 1 : 0], own);
  table.bound[age] = bound_of(own);
  table.box[age] = box_of(own);
  table.spheres[age] = PartSpheres(own);
  for (const Capsule& c : own) {
    const float far = std::max(ground_distance(c.a), ground_distance(c.b)) + c.radius;
    table.extent = std::max(table.extent, far);
  }
}

// `poses` of the body, a frame each.
ActionTable action_table(const Action& action, const BodyModel& body, std::vector<Pose> poses) {
  ActionTable table;
  table.action = &action;
  table.length = action.length();
  table.pose = std::move(poses);
  for (std::size_t i = 0; i < action.clip.frames.size(); ++i) {
    table.root.push_back(scaled(action.clip.root[i], body.scale));
    set_frame(table, i, body, table.pose[i]);
  }
  table.end = Frame(table.root.back());
  for (const Strike& strike : action.strikes) table.strikes.push_back(strike_table(strike, table));
  table.defense = action.defense;
  return table;
}

// What begins and ends with the clip does so by ticks since the launch.
void set_times(ActionTable& table) {
  const auto reached = [&](Tick age) {
    return static_cast<Tick>(std::lower_bound(table.clip_ages.begin(), table.clip_ages.end(), age) -
                             table.clip_ages.begin());
  };
  for (StrikeTable& one : table.strikes) {
    Strike strike = one.strike;
    strike.active_begin = reached(strike.active_begin);
    strike.active_end = reached(strike.active_end);
    one = strike_table(strike, table);
  }
  if (table.defense) {
    table.defense->begin = reached(table.defense->begin);
    table.defense->end = reached(table.defense->end);
  }
}

// The table of an action that runs at `factor` of its clip's speed, in between the clip's frames.
ActionTable paced_table(const ActionTable& clip, const BodyModel& body, float factor) {
  const Action& action = *clip.action;
  ActionTable table;
  table.id = clip.id;
  table.action = clip.action;
  table.clip = &clip;
  table.pace = Pace(action, factor);
  table.length = table.pace.reached(clip.length);
  table.after = clip.after;
  table.first_strike = clip.first_strike;
  table.strikes = clip.strikes;
  table.defense = clip.defense;
  for (Tick tick = 0; tick <= table.length; ++tick) {
    const float age = std::min(table.pace.age(tick), static_cast<float>(clip.length));
    const auto frame = static_cast<Tick>(age);
    const float into_next = age - static_cast<float>(frame);
    table.clip_ages.push_back(static_cast<Tick>(std::lround(age)));
    table.root.push_back(mix(clip.root_at(frame), clip.root_at(frame + 1), into_next));
    table.pose.push_back(mix(clip.pose_at(frame), clip.pose_at(frame + 1), into_next));
    set_frame(table, static_cast<std::size_t>(tick), body, table.pose.back());
  }
  table.end = Frame(table.root.back());
  set_times(table);
  return table;
}

// The rows of a clip's frames, one for each of `ages`.
template <class Row>
std::vector<Row> paced(const std::vector<Row>& rows, const std::vector<Tick>& ages) {
  std::vector<Row> result;
  result.reserve(ages.size());
  for (const Tick age : ages) {
    const auto last = static_cast<Tick>(rows.size()) - 1;
    result.push_back(rows[static_cast<std::size_t>(std::clamp(age, 0, last))]);
  }
  return result;
}

}  // namespace

PartSpheres::PartSpheres(const BodyCapsules& capsules) {
  constexpr float kNowhere = 1e6f;  // m
  x.fill(kNowhere);
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const Capsule& c = capsules[i];
    const Vec3 middle = (c.a + c.b) * 0.5f;
    x[i] = middle.x, y[i] = middle.y, z[i] = middle.z;
    radius[i] = 0.5f * glm::distance(c.a, c.b) + c.radius;
  }
}

Frame::Frame(const Placement& placement)
    : x(placement.x),
      z(placement.z),
      yaw(placement.yaw),
      sine(std::sin(placement.yaw)),
      cosine(std::cos(placement.yaw)) {}

Frame relative(const Frame& outer, const Frame& inner) {
  Frame result;
  const Vec3 at = outer.to_inner({inner.x, 0, inner.z});
  result.x = at.x;
  result.z = at.z;
  result.yaw = inner.yaw - outer.yaw;
  result.sine = inner.sine * outer.cosine - inner.cosine * outer.sine;
  result.cosine = inner.cosine * outer.cosine + inner.sine * outer.sine;
  return result;
}

Frame operator*(const Frame& outer, const Frame& inner) {
  Frame result;
  const Vec3 at = outer.to_outer({inner.x, 0, inner.z});
  result.x = at.x;
  result.z = at.z;
  result.yaw = outer.yaw + inner.yaw;
  result.sine = outer.sine * inner.cosine + outer.cosine * inner.sine;
  result.cosine = outer.cosine * inner.cosine - outer.sine * inner.sine;
  return result;
}

StrikeAim aim_of(const StrikeTable& strike) {
  return {strike.landing.z, strike.landing.x, strike.landing_tick, strike.strike.kind};
}

const NextAction* Followers::find(ActionId to) const {
  for (const NextAction& one : next) {
    if (one.to == to) return &one;
  }
  for (const NextAction& one : over) {
    if (one.to == to) return &one;
  }
  return nullptr;
}

namespace {

Choice choice_of(Kind kind) {
  switch (kind) {
    case Kind::attack:
    case Kind::combination:
      return Choice::attack;
    case Kind::defense:
      return Choice::defense;
    case Kind::idle:
      return Choice::idle;
    default:
      return Choice::step;
  }
}

float within(std::span<const StrikeAim> strikes) {
  constexpr float kRounding = 1e-3f;
  if (strikes.empty()) return 0;
  float ahead = 0, aside = 0;
  for (const StrikeAim& one : strikes) {
    ahead = std::max({ahead, one.ahead + kMostGap, kMostPast - one.ahead});
    aside = std::max(aside, 0.5f * std::abs(one.aside) + kMostAside);
  }
  return std::hypot(ahead, aside) + kRounding;
}

std::vector<NextLanes> lanes_of(std::span<const NextAction> next) {
  std::vector<NextLanes> blocks((next.size() + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < next.size(); ++i) {
    NextLanes& block = blocks[i / kLanes];
    const std::size_t lane = i % kLanes;
    const Frame &alignment = next[i].alignment, &end = next[i].end;
    block.x[lane] = alignment.x, block.z[lane] = alignment.z;
    block.sine[lane] = alignment.sine, block.cosine[lane] = alignment.cosine;
    block.end_x[lane] = end.x, block.end_z[lane] = end.z;
    block.end_sine[lane] = end.sine, block.end_cosine[lane] = end.cosine;
    block.attacks[lane] = next[i].strikes.empty() ? 0.0f : 1.0f;
    block.within[lane] = within(next[i].strikes);
    block.lead[lane] = next[i].lead;
    block.until[lane] = next[i].lead + next[i].length;
    block.to[lane] = next[i].to.value;
    block.choice[lane] = next[i].choice;
    block.particular[lane] = next[i].defense != nullptr && next[i].defense->particular();
  }
  return blocks;
}

// Whether a fighter may choose it.
bool chosen(const Action& action) {
  return action.kind != Kind::response && action.kind != Kind::get_up;
}

}  // namespace

MotionTables::MotionTables(const MotionLibrary& library, const BodyModel& body)
    : library_(library), body_(body) {
  const std::size_t whole = library.actions().size();
  actions_.reserve(whole + library.responses().size() * kParts.size());
  parts_.resize(whole);
  for (const Action& action : library.actions()) {
    std::vector<Pose> poses;
    poses.reserve(action.clip.frames.size());
    for (const Pose& frame : action.clip.frames) poses.push_back(scaled(frame, body_.scale));
    actions_.push_back(action_table(action, body_, std::move(poses)));
    ActionTable& table = actions_.back();
    table.id = ActionId(actions_.size() - 1);
    table.after = table.id.at();
    table.first_strike = strikes_.size();
    for (const StrikeTable& one : table.strikes) strikes_.push_back(aim_of(one));
    shown_.push_back(&table);
  }
  for (std::size_t i = 0; i < whole; ++i) {
    ActionTable& table = actions_[i];
    if (table.action->ends_lying != Lying::none && !library.get_ups().empty()) {
      table.get_up =
          choose_get_up(library, body_.skeleton, table.pose.back(), table.action->stance);
    }
  }
  find_followers();
  for (const ActionId response : library.responses()) {
    const ResponseKind kind = library.action(response).response->kind;
    if (kind == ResponseKind::knockdown) continue;
    ActionTable& table = actions_[response.at()];
    table.way_left = way_left(body_.skeleton, table.pose);
    add_parts(response);
  }
  find_lull();
}

MotionTables::MotionTables(const MotionTables& clips, float pace)
    : library_(clips.library_), body_(clips.body_), shown_(clips.shown_), parts_(clips.parts_) {
  actions_.reserve(library_.actions().size());
  for (std::size_t i = 0; i < library_.actions().size(); ++i) {
    if (chosen(library_.actions()[i])) {
      actions_.push_back(paced_table(clips.at(ActionId(i)), body_, pace));
      shown_[i] = &actions_.back();
    }
    for (const StrikeTable& one : shown_[i]->strikes) strikes_.push_back(aim_of(one));
  }
  find_followers();
  find_lull();
}

void MotionTables::find_followers() {
  followers_.resize(library_.actions().size());
  for (std::size_t i = 0; i < followers_.size(); ++i) {
    Followers& own = followers_[i];
    for (const ActionId to : library_.launchable()) {
      if (auto next = next_action(ActionId(i), to)) own.next.push_back(std::move(*next));
    }
    for (const Edge& edge : library_.machine().edges(ActionId(i))) {
      if (!library_.action(edge.to).connects) continue;
      own.over.push_back(*next_action(ActionId(i), edge.to));
    }
    std::stable_sort(own.next.begin(), own.next.end(),
                     [](const NextAction& a, const NextAction& b) { return a.choice < b.choice; });
    own.next_lanes = lanes_of(own.next);
  }
}

void MotionTables::find_lull() {
  lull_ = std::numeric_limits<Tick>::max() / 2;
  const auto launched = [&](ActionId action) {
    lull_ = std::min(lull_, at(action).length - 1);
    for (const StrikeTable& strike : at(action).strikes) {
      lull_ = std::min(lull_, strike.strike.active_begin - 1);
    }
  };
  for (const Followers& one : followers_) {
    for (const NextAction& next : one.next) {
      launched(next.to);
      for (const ActionId passed : next.path) launched(passed);
      longest_lead_ = std::max(longest_lead_, next.lead);
    }
  }
}

void MotionTables::add_parts(ActionId action) {
  ActionTable& whole = actions_[action.at()];
  Pose rest = whole.pose.front();
  put_in_guard(library_, *whole.action, rest);
  whole.way = way_of_clip(body_.skeleton, rest, whole.pose, TargetZone::body);
  whole.leg_way = way_of_clip(body_.skeleton, rest, whole.pose, TargetZone::leg);
  whole.strides = strides_of(library_.skeleton(), whole.action->clip, body_.scale);
  parts_[action.at()] = actions_.size();
  for (const float share : kParts) {
    std::vector<Pose> poses;
    poses.reserve(whole.pose.size());
    for (const Pose& pose : whole.pose) {
      poses.push_back(partial_pose(body_.skeleton, rest, pose, share));
    }
    ActionTable part = action_table(*whole.action, body_, std::move(poses));
    part.id = ActionId(actions_.size());
    for (Placement& root : part.root) root = mix(Placement{}, root, share);
    part.end = Frame(part.root.back());
    part.after = whole.after;
    actions_.push_back(std::move(part));
    shown_.push_back(&actions_.back());
  }
}

const ActionTable& MotionTables::at(ActionId action, float share) const {
  const std::size_t first = parts_[action.at()];
  const auto step = static_cast<std::size_t>(
      std::lround(std::clamp(share, 0.0f, 1.0f) * static_cast<float>(kParts.size())));
  return *shown_[first == 0 || step >= kParts.size() ? action.at() : first + step];
}

Pose ActionTable::pose_seen(Tick age, Tick from) const {
  const float turned = turn.empty() ? 0.0f : turn[at(age)] - turn[at(from)];
  return turned == 0 ? pose_at(age) : placed(pose_at(age), {0, 0, turned});
}

ActionTable MotionTables::in_flight(const MotionInFlight& motion) const {
  const InFlight flight(*this, motion.launch);
  ActionTable table = *flight.table;
  table.clip_ages = motion.clip_ages;
  table.tone = motion.tone;
  table.length = static_cast<Tick>(table.clip_ages.size()) - 1;
  table.capsules = paced(table.capsules, table.clip_ages);
  table.spheres = paced(table.spheres, table.clip_ages);
  table.travel = paced(table.travel, table.clip_ages);
  table.box = paced(table.box, table.clip_ages);
  table.bound = paced(table.bound, table.clip_ages);
  table.root = paced(table.root, table.clip_ages);
  table.pose = paced(table.pose, table.clip_ages);
  if (!motion.launch.pace.as_the_clip()) {  // in between the clip's frames, as in the fight
    for (Tick age = 0; age <= table.length; ++age) {
      const Tick tick = motion.launch.start + age;
      table.root[static_cast<std::size_t>(age)] =
          inverse(flight.frame_at(tick).placement()) *
          root_at(library_, motion.launch, tick, body_.scale);
    }
  }
  for (std::size_t i = 0; i < motion.poses.size(); ++i) {
    const Tick tick = motion.from + static_cast<Tick>(i), age = flight.age(tick);
    if (age < 0 || age > table.length) continue;
    const auto at = static_cast<std::size_t>(age);
    table.pose[at] = placed(motion.poses[i], inverse(flight.frame_at(tick).placement()));
    set_frame(table, at, body_, table.pose[at]);
  }
  if (motion.launch.aim != 0) {
    for (Tick age = 0; age <= table.length; ++age) {
      table.turn.push_back(flight.frame_at(motion.launch.start + age).yaw);
    }
  }
  set_times(table);
  return table;
}

// `to` after `from`, by the direct edge or else by the shortest path.
std::optional<NextAction> MotionTables::next_action(ActionId from, ActionId to) const {
  const StateMachine& machine = library_.machine();
  const Path* path = machine.path(from, to);
  if (path == nullptr || path->via.size() > kLongestPath) return std::nullopt;
  const ActionTable& table = at(to);
  NextAction next;
  next.to = to;
  // A feint stands among the attacks: as a step it would take a real one's place in every list.
  next.choice = table.action->feint ? Choice::attack : choice_of(table.action->kind);
  next.path = path->via;
  for (const ActionId over : path->via) next.lead += at(over).length;
  next.length = table.length;
  next.root = table.root.data();
  next.defense = table.defense ? &*table.defense : nullptr;
  next.strikes = std::span(strikes_).subspan(table.first_strike, table.strikes.size());
  next.first_strike = table.first_strike;
  next.end = table.end;
  next.table = &table;
  const auto edge = [&](ActionId first, ActionId second) {
    return Frame(scaled(machine.edge(first, second)->alignment.placement, body_.scale));
  };
  for (const ActionId over : path->via) {
    next.alignment = next.alignment * edge(from, over) * at(over).end;
    from = over;
  }
  next.alignment = next.alignment * edge(from, to);
  return next;
}

InFlight::InFlight(const MotionTables& tables, const Launch& of)
    : table(&tables.at(of.action, of.share)), launch(of) {
  Placement turned = of.placement;
  turned.yaw += of.aim;
  aimed = Frame(turned);
  if (of.aim != 0) aimed_from = of.when(aim_ticks(*table->action));
}

Frame InFlight::frame_while_aiming(Tick tick) const {
  const float share = aim_share(*table->action, launch.age(tick));
  Placement turned = launch.placement;
  turned.yaw += launch.aim * share;
  return Frame(turned);
}

}  // namespace ringcraft
