#include "physics/contact.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "physics/penetration.h"

namespace ringcraft {
namespace {

constexpr float kTouch = 1e-4f;  // m: gap that counts as touching
constexpr int kMostAdvances = 64;
constexpr float kFarther = 1e-3f;  // m: more than rounding
// A guard that is met at most this far behind the target (m of the striker's way) still takes the
// blow: glove and forearm are soft and wider than their capsules.
constexpr float kGuardReach = 0.02f;
// A guard that the striker, going straight on, would press in by less than that (m) is only
// brushed: leather gives so far.
constexpr float kBrushed = 0.02f;

constexpr std::uint32_t kAllParts = (1u << kPartCount) - 1;

constexpr std::uint32_t bit(Part part) {
  return 1u << index(part);
}

Capsule between(const Capsule& a, const Capsule& b, float share) {
  return {glm::mix(a.a, b.a, share), glm::mix(a.b, b.b, share), a.radius};
}

// Displacement over the interval of the axis point nearest to `point`.
Vec3 displacement(const Capsule& before, const Capsule& after, const Capsule& now, Vec3 point) {
  const Vec3 axis = now.b - now.a;
  const float length2 = glm::dot(axis, axis);
  const float t =
      length2 > 1e-12f ? std::clamp(glm::dot(point - now.a, axis) / length2, 0.0f, 1.0f) : 0.0f;
  return glm::mix(after.a - before.a, after.b - before.b, t);
}

// First touch of two moving capsules by conservative advancement: the gap cannot close faster than
// both travel.
std::optional<Contact> first_touch(const SweptPart& striker, const SweptTarget& target,
                                   Part struck) {
  const Capsule &s0 = striker.before, &s1 = striker.after;
  const Capsule &t0 = target.before[index(struck)], &t1 = target.after[index(struck)];
  const float closing = travel(s0, s1) + travel(t0, t1);
  const float reach = s0.radius + t0.radius;
  // Too far for the interval, as the spheres around them tell: what the first step below would say.
  const float spheres = 0.5f * (glm::distance(s0.a, s0.b) + glm::distance(t0.a, t0.b));
  const float far = spheres + reach + closing + kFarther;
  const Vec3 apart = (s0.a + s0.b - t0.a - t0.b) * 0.5f;
  if (glm::dot(apart, apart) > far * far) return std::nullopt;
  float share = 0;
  Capsule s = s0, t = t0;
  SegmentDistance d = segment_distance(s.a, s.b, t.a, t.b);
  for (int i = 0; i < kMostAdvances && d.distance - reach > kTouch; ++i) {
    if (closing < 1e-9f) return std::nullopt;
    share += (d.distance - reach) / closing;
    if (share > 1) return std::nullopt;
    s = between(s0, s1, share);
    t = between(t0, t1, share);
    d = segment_distance(s.a, s.b, t.a, t.b);
  }
  Contact c;
  const Vec3 moved = displacement(s0, s1, s, d.on_first) - displacement(t0, t1, t, d.on_second);
  c.velocity = moved / target.seconds;
  c.normal = normalized_or(d.on_first - d.on_second, normalized_or(-moved, kUp));
  const float closing_speed = -glm::dot(c.velocity, c.normal);
  if (closing_speed <= 0) return std::nullopt;  // slides past or draws away
  c.striker = striker.part;
  c.struck = struck;
  c.blocked = (target.guards & bit(struck)) != 0;
  const float along = std::min(1.0f, closing_speed / glm::length(c.velocity));
  const float nearest = d.distance * std::sqrt(1 - along * along);
  if (c.blocked && reach - nearest < kBrushed) return std::nullopt;
  c.point = d.on_second + c.normal * t0.radius;
  c.share = share;
  return c;
}

// A guard that is met together with what is behind it takes the blow.
std::optional<Contact> part_contact(const SweptPart& striker, const SweptTarget& target,
                                    std::uint32_t target_parts) {
  std::optional<Contact> hit, block;
  for (std::uint32_t left = target_parts & kAllParts; left != 0; left &= left - 1) {
    const Part part = part_at(static_cast<std::size_t>(std::countr_zero(left)));
    const auto c = first_touch(striker, target, part);
    if (!c) continue;
    auto& best = c->blocked ? block : hit;
    if (!best || c->share < best->share) best = c;
  }
  if (!hit) return block;
  if (!block) return hit;
  const float way = travel(striker.before, striker.after);
  return (block->share - hit->share) * way <= kGuardReach ? block : hit;
}

}  // namespace

std::uint32_t guarding_parts() {
  static const std::uint32_t kParts = [] {
    std::uint32_t parts = 0;
    for (std::size_t i = 0; i < kPartCount; ++i) {
      if (is_guard_part(part_at(i))) parts |= bit(part_at(i));
    }
    return parts;
  }();
  return kParts;
}

std::uint32_t guarding_parts(const Action& action, Tick age) {
  const std::optional<Defense>& defense = action.defense;
  std::uint32_t parts = guarding_parts();
  if (!defense || defense->kind != DefenseKind::check) return parts;
  if (age < defense->begin || age >= defense->end) return parts;
  const FootContacts carry = action.clip.contacts_at(age);
  if (!carry.left) parts |= bit(Part::left_shin) | bit(Part::left_foot);
  if (!carry.right) parts |= bit(Part::right_shin) | bit(Part::right_foot);
  return parts;
}

std::optional<Contact> strike_contact(const SweptBody& attacker, Part striker,
                                      const SweptBody& target) {
  const SweptPart part{striker, attacker.before[index(striker)], attacker.after[index(striker)]};
  return part_contact(part, target, ~0u);
}

std::optional<Contact> strike_contact(const SweptBody& attacker, const Strike& strike,
                                      const SweptBody& target) {
  std::array<SweptPart, kMostStrikingParts> limb;
  std::size_t count = 0;
  for (std::uint32_t left = striking_parts(strike); left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    limb[count++] = {part_at(i), attacker.before[i], attacker.after[i]};
  }
  return strike_contact({limb.data(), count}, target);
}

std::optional<Contact> strike_contact(std::span<const SweptPart> limb, const SweptTarget& target,
                                      std::uint32_t target_parts) {
  std::optional<Contact> first;
  for (const SweptPart& part : limb) {
    const auto c = part_contact(part, target, target_parts);
    if (c && (!first || c->share < first->share)) first = c;
  }
  return first;
}

std::optional<Contact> fall_contact(const SweptBody& faller, const SweptBody& other, float least) {
  constexpr std::array<Part, 8> kFalling{
      Part::pelvis,     Part::abdomen,     Part::chest,          Part::head,
      Part::left_thigh, Part::right_thigh, Part::left_upper_arm, Part::right_upper_arm};
  std::optional<Contact> first;
  for (const Part part : kFalling) {
    const std::size_t i = index(part);
    const auto c = strike_contact(faller, part, other);
    if (!c || (first && c->share >= first->share)) continue;
    const Capsule &was = faller.before[i], &is = faller.after[i];
    const Vec3 own = (is.a + is.b - was.a - was.b) * (.5f / faller.seconds);
    if (glm::dot(own, -c->normal) >= least) first = c;
  }
  return first;
}

std::uint32_t striking_parts(const Strike& strike) {
  const Part part = part_of(strike.joint).value_or(Part::right_hand);
  std::uint32_t parts = bit(part);
  if (strike.kind == StrikeKind::roundhouse) {
    parts |= 1u << static_cast<unsigned>(parent_of(part));
  }
  return parts;
}

TargetZone zone_of(Part part) {
  switch (part) {
    case Part::neck:
    case Part::head:
      return TargetZone::head;
    case Part::left_thigh:
    case Part::left_shin:
    case Part::left_foot:
    case Part::right_thigh:
    case Part::right_shin:
    case Part::right_foot:
      return TargetZone::leg;
    default:
      return TargetZone::body;
  }
}

}  // namespace ringcraft
