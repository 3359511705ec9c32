#include "scene/placed_strike.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ringcraft {
namespace {

BodyCapsules moved(BodyCapsules capsules, Vec3 by) {
  for (Capsule& capsule : capsules) {
    capsule.a += by;
    capsule.b += by;
  }
  return capsules;
}

// Capsules of an action in the world, one a tick from `first` to `last`.
std::vector<BodyCapsules> capsules_of(const MotionLibrary& library, const BodyModel& body,
                                      const Launch& launch, Tick first, Tick last) {
  std::vector<BodyCapsules> all;
  for (Tick t = first; t <= last; ++t) {
    const Pose pose = pose_at(library, launch, t, body.scale);
    all.push_back(capsules(body, world_pose(body.skeleton, pose)));
  }
  return all;
}

class Sweep {
 public:
  explicit Sweep(const StrikeQuery& query)
      : strike_(query.library.of(StrikeQuery::kAttacker).action(query.attack).strikes.front()) {
    const MotionLibrary& struck = query.library.of(StrikeQuery::kStruck);
    Launch target;
    target.action = query.target_action;
    const Placement root = root_at(struck, target, query.target_age, query.target.scale);
    forward_ = root.forward();
    Launch attacker;
    attacker.action = query.attack;
    attacker.placement = attacker_placement(root, 0);
    window_ = strike_.active_end - strike_.active_begin;
    target_ =
        capsules_of(struck, query.target, target, query.target_age - window_, query.target_age);
    attacker_ = capsules_of(query.library.of(StrikeQuery::kAttacker), query.attacker, attacker,
                            strike_.active_begin - 1, strike_.active_end - 1);
  }

  // The contact, if the first one comes exactly at the age of `active_begin` + `at`.
  std::optional<Contact> first_contact(float distance, Tick at) const {
    for (Tick i = 0; i <= at; ++i) {
      // The target's tick at the contact is its last one.
      const Tick target_tick = window_ - at + i;
      const auto t = static_cast<std::size_t>(target_tick);
      const auto a = static_cast<std::size_t>(i) + 1;
      SweptBody attacker, target;
      attacker.before = moved(attacker_[a - 1], forward_ * distance);
      attacker.after = moved(attacker_[a], forward_ * distance);
      target.before = target_[t - 1];
      target.after = target_[t];
      if (auto contact = strike_contact(attacker, strike_, target)) {
        if (i == at) return contact;
        return std::nullopt;
      }
    }
    return std::nullopt;
  }

  void add(float distance, std::vector<StrikePlace>& places) const {
    for (Tick at = 0; at < window_; ++at) {
      if (const auto contact = first_contact(distance, at)) {
        places.push_back({distance, strike_.active_begin + at, *contact});
      }
    }
  }

 private:
  const Strike& strike_;
  Vec3 forward_{};
  Tick window_ = 0;
  std::vector<BodyCapsules> target_, attacker_;
};

}  // namespace

Placement attacker_placement(const Placement& root, float distance) {
  return root * Placement{0, distance, kPi};
}

std::vector<StrikePlace> strike_places(const StrikeQuery& query, std::optional<float> distance) {
  const Sweep sweep(query);
  std::vector<StrikePlace> places;
  if (distance) {
    sweep.add(*distance, places);
    return places;
  }
  const auto count = static_cast<int>(std::lround((kFarthestPlace - kNearestPlace) / kPlaceStep));
  for (int i = 0; i <= count; ++i) {
    sweep.add(kNearestPlace + kPlaceStep * static_cast<float>(i), places);
  }
  return places;
}

Met met_by(const Contact& contact, const Strike& strike, Part part) {
  if (contact.struck == part) return Met::part;
  if (is_guard_part(part)) return Met::anything;
  if (contact.blocked) return strike.zone == zone_of(part) ? Met::guard : Met::anything;
  return zone_of(contact.struck) == zone_of(part) ? Met::zone : Met::anything;
}

std::string met_parts(const std::vector<StrikePlace>& places) {
  std::string text;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    float nearest = kFarthestPlace + 1, farthest = 0;
    for (const StrikePlace& place : places) {
      if (place.contact.struck != part_at(i)) continue;
      nearest = std::min(nearest, place.distance);
      farthest = std::max(farthest, place.distance);
    }
    if (farthest == 0) continue;
    text += fmt::format("{}{}{} {:.2f}-{:.2f} m", text.empty() ? "" : ", ", name_of(part_at(i)),
                        is_guard_part(part_at(i)) ? " (guard)" : "", nearest, farthest);
  }
  return text;
}

}  // namespace ringcraft
