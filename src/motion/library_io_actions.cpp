#include "motion/library_io_actions.h"

#include <cmath>

#include <fmt/format.h>

#include "base/utf8.h"

namespace ringcraft {

namespace {

constexpr std::size_t kFrameBytes = (3 + 4 * kJointCount + 3) * sizeof(float) + 1;
constexpr std::size_t kTextBytes = sizeof(std::uint32_t);  // of an empty one
constexpr Tick kShortest = 12;                             // of what may be chosen, as of a cut
constexpr float kFarthestReach = 10;                       // m between the two roots
constexpr std::size_t kStrikeBytes = 3 + 2 * sizeof(Tick) + sizeof(std::uint32_t) + 8;

void put_strike(BytesOut& out, const Strike& strike) {
  out.put(strike.kind);
  out.put(strike.joint);
  out.put(strike.zone);
  out.put(strike.active_begin);
  out.put(strike.active_end);
  out.put_text(strike.aim);
  out.put(strike.nearest);
  out.put(strike.farthest);
}

Strike get_strike(BytesIn& in) {
  Strike strike;
  strike.kind = in.get(StrikeKind::knee);
  strike.joint = in.get(Joint::right_toes);
  strike.zone = in.get(TargetZone::leg);
  strike.active_begin = in.get<Tick>();
  strike.active_end = in.get<Tick>();
  strike.aim = in.get_text();
  strike.nearest = in.get<float>();
  strike.farthest = in.get<float>();
  return strike;
}

void put_response(BytesOut& out, const Response& response) {
  out.put(response.kind);
  out.put(static_cast<std::int32_t>(response.steps));
  out.put(response.direction);
  out.put(response.zone.has_value());
  if (response.zone) out.put(*response.zone);
}

Response get_response(BytesIn& in) {
  Response response;
  response.kind = in.get(ResponseKind::knockdown);
  response.steps = in.get<std::int32_t>();
  response.direction = in.get<float>();
  if (in.get_flag()) response.zone = in.get(TargetZone::leg);
  return response;
}

bool inside(Tick begin, Tick end, Tick length) {
  return begin >= 0 && begin <= end && end <= length + 1;
}

std::string wrong_strike(const Strike& strike, Tick length) {
  if (!inside(strike.active_begin, strike.active_end, length) || strike.active_begin > length) {
    return "a strike outside of it";
  }
  if (!(std::abs(strike.nearest) <= kFarthestReach) ||
      !(std::abs(strike.farthest) <= kFarthestReach)) {
    return "a strike from a distance that no blow has";
  }
  switch (strike.joint) {
    case Joint::left_hand:
    case Joint::right_hand:
    case Joint::left_foot:
    case Joint::right_foot:
    case Joint::left_lower_arm:
    case Joint::right_lower_arm:
    case Joint::left_lower_leg:
    case Joint::right_lower_leg:
      return "";
    default:
      return "a strike with a joint that cannot strike";
  }
}

}  // namespace

void put_action(BytesOut& out, const Action& action) {
  out.put_text(action.name);
  out.put(action.kind);
  out.put(action.connects);
  out.put_count(action.strikes.size());
  for (const Strike& strike : action.strikes) put_strike(out, strike);
  out.put(action.defense.has_value());
  if (action.defense) {
    out.put(action.defense->kind);
    out.put(action.defense->begin);
    out.put(action.defense->end);
  }
  out.put(action.response.has_value());
  if (action.response) put_response(out, *action.response);
  out.put(action.starts_lying);
  out.put(action.ends_lying);
  out.put_count(action.leads_to.size());
  for (const std::string& word : action.leads_to) out.put_text(word);
  out.put_text(action.source);
}

Action get_action(BytesIn& in) {
  Action action;
  action.name = in.get_text();
  action.kind = in.get(Kind::idle);
  action.connects = in.get_flag();
  const std::size_t strikes = in.get_count(kStrikeBytes);
  action.strikes.reserve(strikes);
  for (std::size_t i = 0; i < strikes && in.ok(); ++i) action.strikes.push_back(get_strike(in));
  if (in.get_flag()) {
    const DefenseKind kind = in.get(DefenseKind::step_away);
    const Tick begin = in.get<Tick>();
    action.defense = Defense{kind, begin, in.get<Tick>()};
  }
  if (in.get_flag()) action.response = get_response(in);
  action.starts_lying = in.get(Lying::seat);
  action.ends_lying = in.get(Lying::seat);
  const std::size_t words = in.get_count(kTextBytes);
  action.leads_to.reserve(words);
  for (std::size_t i = 0; i < words && in.ok(); ++i) action.leads_to.push_back(in.get_text());
  action.source = in.get_text();
  return action;
}

void put_clip(BytesOut& out, const Clip& clip) {
  out.put_count(clip.frames.size());
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    const Pose& pose = clip.frames[i];
    for (const float v : {pose.hips.x, pose.hips.y, pose.hips.z}) out.put(v);
    for (const Quat& q : pose.rotation) {
      for (const float v : {q.x, q.y, q.z, q.w}) out.put(v);
    }
    const Placement& root = clip.root[i];
    for (const float v : {root.x, root.z, root.yaw}) out.put(v);
    const FootContacts& contacts = clip.contacts[i];
    out.put(static_cast<std::uint8_t>((contacts.left ? 1 : 0) | (contacts.right ? 2 : 0)));
  }
}

Clip get_clip(BytesIn& in) {
  Clip clip;
  const std::size_t frames = in.get_count(kFrameBytes);
  clip.frames.resize(frames);
  clip.root.resize(frames);
  clip.contacts.resize(frames);
  for (std::size_t i = 0; i < frames; ++i) {
    Pose& pose = clip.frames[i];
    for (float* v : {&pose.hips.x, &pose.hips.y, &pose.hips.z}) *v = in.get<float>();
    for (Quat& q : pose.rotation) {
      for (float* v : {&q.x, &q.y, &q.z, &q.w}) *v = in.get<float>();
    }
    Placement& root = clip.root[i];
    for (float* v : {&root.x, &root.z, &root.yaw}) *v = in.get<float>();
    const auto contacts = in.get<std::uint8_t>();
    clip.contacts[i] = {(contacts & 1) != 0, (contacts & 2) != 0};
  }
  return clip;
}

std::string wrong_with(const Action& action) {
  if (action.name.empty()) return "an action without a name";
  if (clean_name(action.name, std::string::npos) != action.name)
    return "a name with control characters";
  const std::vector<std::string> broken = faults(action);
  if (!broken.empty()) return broken.front();
  if (action.length() < kShortest && !action.connects) return "it is shorter than 0.1 s";
  if (action.strikes.size() > kMostStrikes) return "more strikes than an action may have";
  for (const Strike& strike : action.strikes) {
    if (std::string wrong = wrong_strike(strike, action.length()); !wrong.empty()) return wrong;
  }
  if (action.defense && !inside(action.defense->begin, action.defense->end, action.length())) {
    return "a defense outside of it";
  }
  if (const auto wrong = misplaced(action.kind, action.attacks(), action.response,
                                   action.starts_lying, action.ends_lying)) {
    return wrong->what;
  }
  if (action.response && (!std::isfinite(action.response->direction) ||
                          action.response->steps < 0 || action.response->steps > 3)) {
    return "a response of no steps or direction";
  }
  if (action.connects && action.kind != Kind::transition) return "a connection of another kind";
  return "";
}

}  // namespace ringcraft
