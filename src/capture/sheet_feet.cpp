#include <algorithm>
#include <cmath>

#include "capture/sheet_motion.h"

namespace ringcraft {

namespace {

constexpr float kH = kCanonicalHeight;
constexpr float kLetGo = 0.10f;    // s: from a set foot to a hanging one, and back
constexpr float kHeelOff = 0.10f;  // s: the heel is off the floor so long before and after the ball
// Of the heel as the ball leaves and as it meets the floor, degrees over what the foot stands with
// (captured steps: 0 to 33 and 0 to 19).
constexpr float kRollOff = 14.0f, kRollOn = 9.0f;
constexpr float kFullRoll = 0.3f;  // m: of a step of this length and longer
constexpr float kClear =
    0.075f;  // m: of a free ankle that moves over the floor, above a standing one
constexpr float kComesDown = 0.8f;  // of a foot that lands: height over the way that is left
constexpr float kLanding = 0.11f;   // m: no more than that
constexpr float kHanging = 25.0f;   // degrees of point of a foot that hangs

const Placement& placement_at(const std::vector<Placement>& root, float t) {
  const auto last = static_cast<Tick>(root.size()) - 1;
  return root[static_cast<std::size_t>(std::clamp<Tick>(ticks(t), 0, last))];
}

}  // namespace

FootMotion::FootMotion(const Skeleton& skeleton, const SheetAction& action,
                       const std::vector<SheetKey>& keys, const std::vector<Placement>& root,
                       const TrunkMotion& trunk, Side side)
    : skeleton_(skeleton), side_(side) {
  const Placement end = end_placement(action);
  make_spans(action, end);
  make_angles(action, keys, root, end);
  make_paths(action, keys, root);
  make_knee(action, keys, root, trunk);
}

void FootMotion::make_spans(const SheetAction& action, const Placement& end) {
  const std::size_t i = side_ == Side::left ? 0 : 1;
  const auto on_ground = [&](const std::optional<Vec2>& ball) {
    const Vec2 at = ball.value_or(Vec2(0));
    return Vec3(at.x * kH, skeleton_.toe_height(), at.y * kH);
  };
  const bool starts_set = action.start.ball[i].has_value();
  const bool ends_set = action.end.ball[i].has_value();
  const Vec3 guard = on_ground(ends_set ? action.end.ball[i] : action.start.ball[i]);
  Vec3 ball = starts_set ? on_ground(action.start.ball[i]) : guard;
  start_ball_ = ball;
  bool set = starts_set;
  for (const SheetStep& step : action.steps) {
    if (step.foot != side_) continue;
    Span span;
    span.lift = set ? step.lift : 0;
    span.land = step.land.value_or(action.length + 1);
    span.starts_free = !set;
    span.ends_free = !step.land;
    span.free = step.free || span.starts_free || span.ends_free;
    span.height = step.height * kH;
    span.from = ball;
    Placement at = end;
    if (step.at) at = {step.at->x * kH, step.at->y * kH, radians(step.at->z)};
    if (step.land) ball = at * guard;
    span.to = ball;
    set = step.land.has_value();
    spans_.push_back(std::move(span));
  }
  if (!starts_set && spans_.empty()) {
    Span span;
    span.land = action.length + 1;
    span.from = span.to = ball;
    span.free = span.starts_free = span.ends_free = true;
    spans_.push_back(std::move(span));
    set = false;
  }
  if (set && ends_set) end_error_ = glm::distance(ball, end * guard);
}

void FootMotion::make_angles(const SheetAction& action, const std::vector<SheetKey>& keys,
                             const std::vector<Placement>& root, const Placement& end) {
  const Channel yaw = of_side(Channel::lead_foot_yaw, side_);
  const Channel heel = of_side(Channel::lead_heel, side_);
  const Channel point = of_side(Channel::lead_point, side_);
  const auto value = [](const KeyValues& values, Channel channel, float fallback) {
    const auto& v = values[index(channel)];
    return v ? v->x : fallback;
  };
  const float guard_yaw = value(action.end.values, yaw, value(action.start.values, yaw, -45));
  const float guard_heel = value(action.end.values, heel, value(action.start.values, heel, 0));
  // Events in order of time: keys, lifts (the foot keeps what it had) and landings (as in the
  // guard).
  struct Event {
    float t;
    std::optional<float> yaw, heel;
  };
  std::vector<Event> events;
  std::size_t step_index = 0;
  for (const SheetStep& step : action.steps) {
    if (step.foot != side_) continue;
    const Span& span = spans_[step_index++];
    events.push_back({span.lift, {}, {}});
    if (!step.land) continue;
    const float turned = step.at ? step.at->z : degrees(end.yaw) + full_turns(action);
    events.push_back({*step.land, guard_yaw + turned, guard_heel});
  }
  // (a key at the landing says how the foot comes down)
  for (const SheetKey& key : keys) {
    Event event{key.t, {}, {}};
    if (key.values[index(yaw)]) {
      const bool last = key.t >= action.length - 1e-4f;
      const float turned = last ? end.yaw : placement_at(root, key.t).yaw;
      event.yaw = key.values[index(yaw)]->x + degrees(turned);
    }
    if (key.values[index(heel)]) event.heel = key.values[index(heel)]->x;
    if (event.yaw || event.heel) events.push_back(event);
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.t < b.t; });
  float last_yaw = guard_yaw, last_heel = guard_heel;
  for (const Event& event : events) {
    const bool lift = !event.yaw && !event.heel;
    if (event.yaw || lift) yaw_.add(event.t, Vec3(last_yaw = event.yaw.value_or(last_yaw), 0, 0));
    if (event.heel || lift)
      heel_.add(event.t, Vec3(last_heel = event.heel.value_or(last_heel), 0, 0));
  }
  for (const SheetKey& key : keys) {
    const bool edge = key.t <= 0 || key.t >= action.length - 1e-4f;
    const auto& v = key.values[index(point)];
    if (v || edge) point_.add(key.t, v.value_or(Vec3(kHanging, 0, 0)));
  }
}

void FootMotion::make_paths(const SheetAction& action, const std::vector<SheetKey>& keys,
                            const std::vector<Placement>& root) {
  const Channel ankle = of_side(Channel::lead_ankle, side_);
  for (Span& span : spans_) {
    if (!span.free) continue;
    std::vector<float> times;
    std::vector<Vec3> points;
    const auto set_ankle = [&](float t, Vec3 ball) {
      FootTarget foot;
      foot.ball = ball;
      foot.yaw = radians(yaw_.at(t).x);
      foot.heel = radians(heel_.at(t).x);
      times.push_back(t);
      points.push_back(ankle_of(skeleton_, foot));
    };
    if (!span.starts_free) set_ankle(span.lift, span.from);
    for (const SheetKey& key : keys) {
      const auto& value = key.values[index(ankle)];
      const bool inside =
          (span.starts_free ? key.t >= 0 : key.t > span.lift + 1e-3f) && key.t < span.land - 1e-3f;
      if (!value || !inside) continue;
      times.push_back(key.t);
      points.push_back(placement_at(root, key.t) * (*value * kH));
    }
    if (!span.ends_free) set_ankle(span.land, span.to);
    if (times.empty()) {
      times.push_back(0);
      points.push_back(span.from + kUp * (0.05f * kH));
    }
    std::vector<ProfileWindow> windows;
    for (const SheetStrike& strike : action.strikes) {
      const bool inside = strike.start > span.lift - 1e-3f && strike.contact < span.land;
      if (tip_of(strike.strike.joint) == leg(side_).end && inside) {
        windows.push_back({strike.start, strike.contact, speed_profile(strike.profile)});
      }
    }
    span.path.emplace(times, points, windows);
    span.rests = !action.strikes.empty();
    const Tick count = ticks(std::min(span.land, action.length) - span.lift);
    span.rise.assign(static_cast<std::size_t>(std::max<Tick>(1, count)) + 1, 0);
    if (windows.empty()) add_clearance(span, keys);
    if (!span.ends_free) add_landing(span, windows.empty() ? span.lift : windows.back().contact);
  }
}

// Where the path has the ankle; a foot that lands after a blow gets there early enough to come to
// rest.
Vec3 FootMotion::on_path(const Span& span, float t) const {
  constexpr float kRests = 0.05f, kHurries = 0.15f;  // s
  const float left = span.land - t;
  if (!span.rests || span.ends_free || left <= 0) return span.path->at(t);
  if (left < kRests) return span.path->at(span.land - left * left / (2 * kRests));
  const float early = 1 - glm::smoothstep(kRests, kRests + kHurries, left);
  return span.path->at(t + 0.5f * kRests * early);
}

// A foot comes down on its place: at the end of a step, and after a kick's contact at `earliest`,
// what is left of its way is never much longer than it is high.
void FootMotion::add_landing(Span& span, float earliest) const {
  constexpr float kLast = 0.35f, kSetsIn = 0.15f;  // s
  const float from = std::max(earliest, span.land - kLast);
  const auto count = static_cast<Tick>(span.rise.size());
  const Vec3 place = span.path->at(span.lift + static_cast<float>(seconds(count - 1)));
  for (Tick tick = 0; tick < count; ++tick) {
    const float t = span.lift + static_cast<float>(seconds(tick));
    const Vec3 left = on_path(span, t) - place;
    const float wanted = std::min(kLanding, kComesDown * std::hypot(left.x, left.z));
    const float missing = std::max(0.0f, wanted - left.y);
    float& rise = span.rise[static_cast<std::size_t>(tick)];
    rise = std::max(rise, missing * glm::smoothstep(from, from + kSetsIn, t));
  }
}

// A free foot that moves over the floor does not brush it: its ankle rises the faster it goes. It
// lies where it begins and ends, and with its shin where the knee is on the floor.
void FootMotion::add_clearance(Span& span, const std::vector<SheetKey>& keys) const {
  Track knee;
  for (const SheetKey& key : keys) {
    const auto& value = key.values[index(of_side(Channel::lead_knee, side_))];
    if (value) knee.add(key.t, *value);
  }
  const auto count = static_cast<Tick>(span.rise.size());
  const float clear = skeleton_.ankle_height() + kClear;
  for (Tick tick = 0; tick < count; ++tick) {
    const float t = span.lift + static_cast<float>(seconds(tick));
    const Vec3 way = on_path(span, t + kTickSeconds) - on_path(span, t - kTickSeconds);
    const float speed = std::hypot(way.x, way.z) / (2 * kTickSeconds);
    const float missing = std::max(0.0f, clear - on_path(span, t).y);
    const float knee_up = knee.empty() ? 1 : glm::smoothstep(0.05f, 0.18f, knee.at(t).y);
    span.rise[static_cast<std::size_t>(tick)] =
        missing * glm::smoothstep(0.1f, 0.5f, speed) * knee_up;
  }
  widen(span.rise, 10);
  for (Tick tick = 0; tick < count; ++tick) {
    const auto since = static_cast<float>(seconds(tick));
    const auto until = static_cast<float>(seconds(count - 1 - tick));
    float& rise = span.rise[static_cast<std::size_t>(tick)];
    rise *= glm::smoothstep(0.0f, kLetGo, since) * glm::smoothstep(0.0f, kLetGo, until);
  }
}

void FootMotion::make_knee(const SheetAction& action, const std::vector<SheetKey>& keys,
                           const std::vector<Placement>& root, const TrunkMotion& trunk) {
  const Channel knee = of_side(Channel::lead_knee, side_);
  const bool any = std::any_of(keys.begin(), keys.end(), [&](const SheetKey& k) {
    return k.values[index(knee)].has_value();
  });
  if (!any) return;
  for (const SheetKey& key : keys) {
    const bool edge = key.t <= 0 || key.t >= action.length - 1e-4f;
    const auto& value = key.values[index(knee)];
    if (!value && !edge) continue;
    BodyTargets body;
    trunk.fill(key.t, body);
    const Placement& place = placement_at(root, key.t);
    const Quat turn = yaw_rotation(place.yaw);
    const Quat pelvis = turn * body.pelvis_rotation;
    Vec3 pole =
        pelvis * kForward * 0.5f + yaw_rotation(radians(yaw_.at(key.t).x)) * kForward * 0.5f;
    if (value) {
      const Vec3 hip = place * body.pelvis + pelvis * skeleton_.offset[index(leg(side_).root)];
      const FootTarget foot = at(key.t, body);
      const Vec3 line = normalized_or(ankle_of(skeleton_, foot) - hip, -kUp);
      const Vec3 from_hip = place * (*value * kH) - hip;
      const Vec3 off = from_hip - line * glm::dot(from_hip, line);
      if (glm::length(off) > 0.01f * kH) pole = glm::normalize(off);
    }
    knee_.add(key.t, glm::inverse(pelvis) * pole);
  }
}

const FootMotion::Span* FootMotion::span_at(float t) const {
  for (const Span& span : spans_) {
    if (t > span.lift && t < span.land) return &span;
    if (span.starts_free && t < span.land) return &span;
  }
  return nullptr;
}

float FootMotion::freedom(const Span& span, float t) const {
  if (!span.free) return 0;
  const float up = span.starts_free ? 1 : glm::smoothstep(span.lift, span.lift + kLetGo, t);
  const float down = span.ends_free ? 1 : 1 - glm::smoothstep(span.land - kLetGo, span.land, t);
  return std::min(up, down);
}

// A foot that steps rolls over its ball: its heel leaves the floor faster and faster before the
// ball does, and comes to rest after it.
float FootMotion::heel_roll(float t) const {
  float roll = 0;
  for (const Span& span : spans_) {
    if (span.free) continue;
    const float before = (span.lift - t) / kHeelOff, after = (t - span.land) / kHeelOff;
    if (before >= 1 || after >= 1) continue;
    const float share = std::min(1.0f, glm::distance(span.from, span.to) / kFullRoll);
    const float off = radians(kRollOff) * share, on = radians(kRollOn) * share;
    if (before >= 0) {
      roll += off * (1 - before) * (1 - before);
    } else if (after >= 0) {
      roll += on * (1 - after) * (1 - after);
    } else {
      const float length = span.land - span.lift, u = (t - span.lift) / length, v = 1 - u;
      const float steep = 2 * length / kHeelOff;  // of either end, over the whole step
      roll += off * v * v * (1 + 2 * u + steep * u) + on * u * u * (1 + 2 * v + steep * v);
    }
  }
  return roll;
}

bool FootMotion::planted(float t) const {
  return span_at(t) == nullptr;
}

FootTarget FootMotion::at(float t, const BodyTargets& trunk) const {
  FootTarget foot;
  foot.ball = start_ball_;
  for (const Span& span : spans_) {
    if (t >= span.land) foot.ball = span.to;
  }
  foot.yaw = radians(yaw_.at(t).x);
  foot.heel = radians(heel_.at(t).x);
  foot.point = radians(point_.at(t).x);
  if (!knee_.empty()) {
    foot.knee_pole = trunk.pelvis_rotation * normalized_or(knee_.at(t), kForward);
  }
  foot.heel += heel_roll(t);
  const Span* span = span_at(t);
  if (span == nullptr) return foot;
  const float u = std::clamp((t - span->lift) / (span->land - span->lift), 0.0f, 1.0f);
  if (!span->free) {
    // A quick low arc: the foot, which its heel has set in motion, is gentle at either end (half
    // way from the least acceleration to the least jerk), the height leaves and meets the floor
    // without a blow.
    const float along = u * u * (1.5f + u * (4 - u * (7.5f - 3 * u)));
    const float rise = std::sin(kPi * u) * std::sin(kPi * u);
    foot.ball = span->from + (span->to - span->from) * along + kUp * (span->height * rise);
    return foot;
  }
  foot.freedom = freedom(*span, t);
  foot.ankle = on_path(*span, t);
  if (!span->rise.empty()) {
    const auto last = static_cast<Tick>(span->rise.size()) - 1;
    const Tick tick = std::clamp<Tick>(ticks(t - span->lift), 0, last);
    foot.ankle.y += span->rise[static_cast<std::size_t>(tick)];
  }
  // Set down and let go of, a foot goes its ankle's way: only how it is turned passes over.
  const bool leaves = u < 0.5f;
  foot.ball = (leaves ? span->from : span->to) + foot.ankle -
              span->path->at(leaves ? span->lift : span->land);
  return foot;
}

}  // namespace ringcraft
