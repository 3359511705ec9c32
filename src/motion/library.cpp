#include "motion/library.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/hash.h"

namespace ringcraft {

namespace {

void add(Hasher& hasher, const Clip& clip) {
  for (const Pose& pose : clip.frames) {
    std::array<float, 3 + 4 * kJointCount> values{pose.hips.x, pose.hips.y, pose.hips.z};
    std::size_t at = 3;
    for (const Quat& q : pose.rotation) {
      for (const float value : {q.w, q.x, q.y, q.z}) values[at++] = value;
    }
    hasher.add(values);
  }
  for (const Placement& root : clip.root) hasher.add(root.x).add(root.z).add(root.yaw);
  for (const FootContacts& contact : clip.contacts) hasher.add(contact.left).add(contact.right);
}

// Everything that can change a fight; not where an action came from.
std::uint64_t hash_of(const std::vector<Action>& actions) {
  Hasher hasher;
  for (const Action& action : actions) {
    hasher.add(action.name).add(action.kind).add(action.length());
    for (const Strike& strike : action.strikes) {
      hasher.add(strike.kind).add(strike.joint).add(strike.zone);
      hasher.add(strike.active_begin).add(strike.active_end);
    }
    hasher.add(action.defense.has_value()).add(action.response.has_value());
    if (action.defense) {
      hasher.add(action.defense->kind).add(action.defense->begin).add(action.defense->end);
    }
    if (action.response) {
      hasher.add(action.response->kind).add(action.response->steps);
      hasher.add(action.response->direction).add(action.response->zone.has_value());
      hasher.add(action.response->zone.value_or(TargetZone::head));
    }
    if (action.feint) hasher.add(action.feint->of).add(action.feint->parted);
    hasher.add(action.starts_lying).add(action.ends_lying);
    for (const std::string& word : action.leads_to) hasher.add(word);
    if (action.connects) hasher.add(action.connects);
    if (action.left_out) hasher.add(action.left_out);
    if (action.stance != Stance::orthodox) hasher.add(action.stance);
    add(hasher, action.clip);
  }
  return hasher.digest();
}

}  // namespace

MotionLibrary::MotionLibrary(std::string name, std::vector<Action> actions,
                             const StateMachineSettings& settings)
    : name_(std::move(name)), skeleton_(canonical_skeleton()), actions_(std::move(actions)) {
  // A get-up that is dropped can be a fall's only way, so repeat until nothing falls.
  for (auto loose = unconnected(skeleton_, actions_, settings); !loose.empty();
       loose = unconnected(skeleton_, actions_, settings)) {
    for (auto id = loose.rbegin(); id != loose.rend(); ++id) {
      dropped_.push_back(fmt::format("{} ({}): no way back to the others within the threshold",
                                     action(*id).name, action(*id).source));
      actions_.erase(actions_.begin() + id->value);
    }
  }
  machine_ = StateMachine(skeleton_, actions_, settings);
  sort_actions();
}

MotionLibrary::MotionLibrary(LibraryParts parts)
    : name_(std::move(parts.name)),
      skeleton_(canonical_skeleton()),
      actions_(std::move(parts.actions)),
      machine_(std::move(parts.machine)),
      graph_(std::move(parts.graph)),
      dropped_(std::move(parts.dropped)),
      notes_(std::move(parts.notes)),
      switches_(std::move(parts.switches)),
      fits_(std::move(parts.fits)) {
  sort_actions();
  if (fits_.empty()) return;
  Hasher hasher;
  hasher.add(hash_);
  for (const auto& fit : fits_) hasher.add(fit == nullptr ? 0 : fit->hash());
  hash_ = hasher.digest();
}

void MotionLibrary::sort_actions() {
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    const Kind kind = actions_[i].kind;
    if (actions_[i].connects || actions_[i].left_out) continue;
    (kind == Kind::response ? responses_
     : kind == Kind::get_up ? get_ups_
                            : launchable_)
        .emplace_back(i);
  }
  hash_ = hash_of(actions_);
}

ActionId MotionLibrary::find(std::string_view name) const {
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    if (actions_[i].name == name) return ActionId(i);
  }
  return {};
}

std::size_t MotionLibrary::count(Kind kind) const {
  return static_cast<std::size_t>(
      std::count_if(actions_.begin(), actions_.end(), [&](const Action& action) {
        return action.kind == kind && !action.connects && !action.left_out;
      }));
}

MotionLibrary MotionLibrary::with(std::vector<Action> actions) const {
  return MotionLibrary(
      LibraryParts{name_, std::move(actions), machine_, {}, dropped_, notes_, switches_});
}

MotionLibrary MotionLibrary::with_fits(
    std::vector<std::shared_ptr<const MotionLibrary>> fits) const {
  return MotionLibrary(LibraryParts{name_, actions_, machine_, graph_, dropped_, notes_, switches_,
                                    std::move(fits)});
}

}  // namespace ringcraft
