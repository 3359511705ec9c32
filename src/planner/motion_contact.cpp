// What bodies in flight meet: contacts of strikes, and penetration.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "physics/penetration.h"
#include "planner/motion_tables.h"

namespace ringcraft {
namespace {

constexpr std::array<std::uint32_t, kPartLanes> kLaneBits = [] {
  std::array<std::uint32_t, kPartLanes> bits{};
  for (std::size_t i = 0; i < kPartCount; ++i) bits[i] = 1u << i;
  return bits;
}();

// The lane's bit where a < b, by the sign of a - b: a branch would keep lanes from side by side.
std::uint32_t bit_where_below(std::size_t lane, float a, float b) {
  return static_cast<std::uint32_t>(std::bit_cast<std::int32_t>(a - b) >> 31) & kLaneBits[lane];
}

// The spheres, bit index(part), that come nearer to `center` than their radius and `more` of each.
std::uint32_t nearer_than(const PartSpheres& spheres, Vec3 center, const PartSpheres::Lanes& more) {
  std::uint32_t near = 0;
  for (std::size_t i = 0; i < kPartLanes; ++i) {
    const float x = spheres.x[i] - center.x, y = spheres.y[i] - center.y,
                z = spheres.z[i] - center.z;
    const float far = std::max(0.0f, spheres.radius[i] + more[i]);
    near |= bit_where_below(i, x * x + y * y + z * z, far * far);
  }
  return near;
}

// A strike's parts over a tick, seen from the target's action space.
class SweptLimb {
 public:
  SweptLimb(std::uint32_t parts, const BodyCapsules& was, const Frame& before,
            const BodyCapsules& is, const Frame& after) {
    for (; parts != 0; parts &= parts - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(parts));
      limb_[count_++] = {part_at(i), seen(before, was[i]), seen(after, is[i])};
    }
  }
  std::span<const SweptPart> parts() const { return {limb_.data(), count_}; }

 private:
  static Capsule seen(const Frame& frame, const Capsule& c) {
    return {frame.to_outer(c.a), frame.to_outer(c.b), c.radius};
  }

  std::array<SweptPart, kMostStrikingParts> limb_;
  std::size_t count_ = 0;
};

constexpr float kTickTravel = 0.25f;  // m: farther than a blow and what it meets go in a tick

// Whether any of the parts, whose spheres are seen from where the box is given, may touch it within
// a tick.
bool may_touch(const PartSpheres& spheres, std::uint32_t parts, const Frame& seen, const Box& box) {
  for (; parts != 0; parts &= parts - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(parts));
    const Vec3 center = seen.to_outer(spheres.center(i));
    const float reach = spheres.radius[i] + kTickTravel;
    if (glm::distance2(center, glm::clamp(center, box.low, box.high)) < reach * reach) return true;
  }
  return false;
}

// The target's parts that the limb's may meet in the tick, by the spheres around them where it
// begins and by how far they go.
std::uint32_t parts_near(std::span<const SweptPart> limb, const ActionTable& target, Tick age) {
  constexpr float kRounding = 2e-3f;  // m
  std::uint32_t near = 0;
  for (const SweptPart& one : limb) {
    const float reach = 0.5f * glm::distance(one.before.a, one.before.b) + one.before.radius +
                        travel(one.before, one.after) + kRounding;
    PartSpheres::Lanes more = target.travel_at(age);
    for (float& far : more) far += reach;
    near |= nearer_than(target.spheres_at(age - 1), (one.before.a + one.before.b) * 0.5f, more);
  }
  return near;
}

std::uint32_t intended(const InFlight& who, Tick tick) {
  std::uint32_t parts = 0;
  for (const StrikeTable& strike : who.table->strikes) {
    const Tick age = who.age(tick);
    if (age >= strike.strike.active_begin - 1 && age < strike.strike.active_end + kContactRest) {
      parts |= strike.parts;
    }
  }
  return parts;
}

}  // namespace

bool may_reach(const InFlight& attacker, const StrikeTable& strike, const InFlight& target) {
  const float reach = strike.reach + target.table->extent;
  const float dx = attacker.aimed.x - target.aimed.x, dz = attacker.aimed.z - target.aimed.z;
  return dx * dx + dz * dz < reach * reach;
}

std::optional<Contact> contact_at(const InFlight& attacker, const StrikeTable& strike,
                                  const InFlight& target, Tick tick) {
  const ActionTable &own = *attacker.table, &struck = *target.table;
  const Tick own_age = attacker.age(tick), age = target.age(tick);
  const Frame after = relative(target.frame_at(tick), attacker.frame_at(tick));
  if (!may_touch(own.spheres_at(own_age), strike.parts, after, struck.box_at(age))) {
    return std::nullopt;
  }
  const bool turning = attacker.turning(tick - 1) || target.turning(tick - 1);
  const Frame before =
      turning ? relative(target.frame_at(tick - 1), attacker.frame_at(tick - 1)) : after;
  const SweptLimb limb(strike.parts, own.capsules_at(own_age - 1), before, own.capsules_at(own_age),
                       after);
  const std::uint32_t near = parts_near(limb.parts(), struck, age);
  if (near == 0) return std::nullopt;
  const std::uint32_t guards = guarding_parts(*struck.action, struck.clip_age(age));
  if (!target.turning(tick - 1)) {
    return strike_contact(limb.parts(),
                          {struck.capsules_at(age - 1), struck.capsules_at(age), guards}, near);
  }
  // Seen from where the target is now, as it has turned: in its own space parts that are apart, as
  // a glove and the middle of a head, would have other speeds.
  const Frame turned = relative(target.frame_at(tick), target.frame_at(tick - 1));
  BodyCapsules was = struck.capsules_at(age - 1);
  for (Capsule& capsule : was) {
    capsule.a = turned.to_outer(capsule.a);
    capsule.b = turned.to_outer(capsule.b);
  }
  const SweptLimb seen(strike.parts, own.capsules_at(own_age - 1),
                       relative(target.frame_at(tick), attacker.frame_at(tick - 1)),
                       own.capsules_at(own_age), after);
  return strike_contact(seen.parts(), {was, struck.capsules_at(age), guards}, near);
}

namespace {

constexpr float kBoxRounding = 1e-4f;  // m
constexpr float kInside = 1e-6f;       // m: what is no farther out of a box than that is in it

// Whether bodies in these boxes, that of a as `seen` from b, are on no axis of either box farther
// into each other than `least`: no two parts of them can be then.
bool boxes_apart(const Frame& seen, const Box& box_a, const Box& box_b, float least) {
  const Vec3 half_a = (box_a.high - box_a.low) * 0.5f, half_b = (box_b.high - box_b.low) * 0.5f;
  const Vec3 apart =
      seen.to_outer((box_a.low + box_a.high) * 0.5f) - (box_b.low + box_b.high) * 0.5f;
  const float sine = std::abs(seen.sine), cosine = std::abs(seen.cosine);
  const auto separates = [&](float distance, float own, float half_x, float half_z) {
    return own + half_x + half_z - std::abs(distance) < least - kBoxRounding;
  };
  return separates(apart.x, half_b.x, cosine * half_a.x, sine * half_a.z) ||
         separates(apart.z, half_b.z, sine * half_a.x, cosine * half_a.z) ||
         separates(seen.cosine * apart.x - seen.sine * apart.z, half_a.x, cosine * half_b.x,
                   sine * half_b.z) ||
         separates(seen.sine * apart.x + seen.cosine * apart.z, half_a.z, sine * half_b.x,
                   cosine * half_b.z);
}

}  // namespace

float penetration_at(const InFlight& a, const InFlight& b, Tick tick, float least, bool foes) {
  const Tick age_a = a.age(tick), age_b = b.age(tick);
  const Frame seen = relative(b.frame_at(tick), a.frame_at(tick));
  const Sphere& bound_b = b.table->bound_at(age_b);
  const Sphere& bound_a = a.table->bound_at(age_a);
  const float bounds = std::max(0.0f, bound_a.radius + bound_b.radius - least);
  if (glm::distance2(seen.to_outer(bound_a.center), bound_b.center) >= bounds * bounds) return 0;
  if (boxes_apart(seen, a.table->box_at(age_a), b.table->box_at(age_b), least)) return 0;
  // The parts of a that are farther than `least` in the box around b, or have their middle in it,
  // and of those the parts of b whose spheres are. A part is no deeper in another than the sphere
  // around it is.
  const PartSpheres &spheres_a = a.table->spheres_at(age_a),
                    &spheres_b = b.table->spheres_at(age_b);
  const Box& box_b = b.table->box_at(age_b);
  const float slack = std::max(0.0f, least - kBoxRounding);
  PartSpheres::Lanes x, z;  // of a's centers, seen from b
  std::uint32_t own = 0;
  for (std::size_t i = 0; i < kPartLanes; ++i) {
    x[i] = seen.x + seen.cosine * spheres_a.x[i] + seen.sine * spheres_a.z[i];
    z[i] = seen.z - seen.sine * spheres_a.x[i] + seen.cosine * spheres_a.z[i];
    const float y = spheres_a.y[i];
    const float out_x = std::max(0.0f, std::max(box_b.low.x - x[i], x[i] - box_b.high.x));
    const float out_y = std::max(0.0f, std::max(box_b.low.y - y, y - box_b.high.y));
    const float out_z = std::max(0.0f, std::max(box_b.low.z - z[i], z[i] - box_b.high.z));
    const float reach = std::max(kInside, spheres_a.radius[i] - slack);
    const float out = out_x * out_x + out_y * out_y + out_z * out_z;
    own |= bit_where_below(i, out, reach * reach);
  }
  if (foes) own &= ~intended(a, tick);
  const std::uint32_t wanted = foes ? ~intended(b, tick) : ~0u;
  const BodyCapsules& capsules_a = a.table->capsules_at(age_a);
  const BodyCapsules& capsules_b = b.table->capsules_at(age_b);
  float deepest = 0;
  for (; own != 0; own &= own - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(own));
    PartSpheres::Lanes more;
    more.fill(spheres_a.radius[i] - slack);
    std::uint32_t their = nearer_than(spheres_b, {x[i], spheres_a.y[i], z[i]}, more) & wanted;
    if (their == 0) continue;
    const Capsule& mine = capsules_a[i];
    const Vec3 from = seen.to_outer(mine.a), to = seen.to_outer(mine.b);
    for (; their != 0; their &= their - 1) {
      const Capsule& other = capsules_b[static_cast<std::size_t>(std::countr_zero(their))];
      const float distance = segment_distance(from, to, other.a, other.b).distance;
      deepest = std::max(deepest, mine.radius + other.radius - distance);
    }
  }
  return deepest > least ? deepest : 0;
}

}  // namespace ringcraft
