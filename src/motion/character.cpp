#include "motion/character.h"

#include <algorithm>

#include "motion/pose.h"

namespace ringcraft {

namespace {

bool is_limb(Joint joint) {
  switch (joint) {
    case Joint::left_upper_arm:
    case Joint::left_lower_arm:
    case Joint::left_hand:
    case Joint::right_upper_arm:
    case Joint::right_lower_arm:
    case Joint::right_hand:
    case Joint::left_upper_leg:
    case Joint::left_lower_leg:
    case Joint::right_upper_leg:
    case Joint::right_lower_leg:
      return true;
    default:
      return false;
  }
}

// The joint that a bone leads to: the next one on the spine, the limb, the foot. The hips', the
// head's, the hands' and the toes' lead nowhere.
std::optional<Joint> end_of(Joint joint, const Character& character) {
  static constexpr std::array<Joint, 6> kSpine = {Joint::hips,        Joint::spine, Joint::chest,
                                                  Joint::upper_chest, Joint::neck,  Joint::head};
  if (joint == Joint::hips) return std::nullopt;
  for (std::size_t i = 1; i + 1 < kSpine.size(); ++i) {
    if (kSpine.at(i) != joint) continue;
    for (std::size_t k = i + 1; k < kSpine.size(); ++k)
      if (character.joint[index(kSpine.at(k))]) return kSpine.at(k);
    return std::nullopt;
  }
  for (std::size_t child = index(joint) + 1; child < kJointCount; ++child)
    if (kParent.at(child) == static_cast<int>(index(joint)) && character.joint.at(child))
      return joint_at(child);
  return std::nullopt;
}

// How a bone's surroundings go from where they were bound to the T-pose.
struct BoneFit {
  Vec3 from{}, to{};
  Quat turn{1, 0, 0, 0};
  glm::mat3 stretch{1};
};

// What is not in the bones' lengths goes by the way from ankle to head joint (or the highest of the
// spine that is known), or by the whole height where that is less: a big head on a small body does
// not grow with the body.
float thickness(const Character& character, const WorldPose& rest, float height) {
  const auto span = [](Vec3 head, Vec3 left, Vec3 right) {
    return head.y - 0.5f * (left.y + right.y);
  };
  const auto bound = [&](Joint joint) { return *character.joint[index(joint)]; };
  const auto ours = [&](Joint joint) { return rest.position[index(joint)]; };
  Joint top = Joint::head;
  while (!character.joint[index(top)])
    top = joint_at(static_cast<std::size_t>(kParent[index(top)]));  // the hips are always there
  const float joints =
      span(ours(top), ours(Joint::left_foot), ours(Joint::right_foot)) /
      std::max(span(bound(top), bound(Joint::left_foot), bound(Joint::right_foot)), 1e-3f);
  float low = bound(Joint::left_foot).y, high = bound(top).y;
  for (const CharacterPiece& piece : character.pieces)
    for (const Vec3& at : piece.position) {
      low = std::min(low, at.y);
      high = std::max(high, at.y);
    }
  return std::min(joints, height / std::max(high - low, 1e-3f));
}

BoneFit fit_of(const Character& character, const WorldPose& rest, Joint joint, float scale) {
  BoneFit fit;
  fit.from = *character.joint[index(joint)];
  fit.to = rest.position[index(joint)];
  fit.stretch = glm::mat3(scale);
  const auto end = end_of(joint, character);
  if (!end) return fit;
  const Vec3 theirs = *character.joint[index(*end)] - fit.from;
  const Vec3 ours = rest.position[index(*end)] - fit.to;
  if (glm::length(theirs) < 1e-4f) return fit;
  const Vec3 along = glm::normalize(theirs);
  if (is_limb(joint)) fit.turn = rotation_between(theirs, ours);
  const float more = glm::length(ours) / glm::length(theirs) - scale;
  fit.stretch += more * glm::outerProduct(along, along);
  return fit;
}

std::array<BoneFit, kJointCount> fits_of(const Character& character, const Skeleton& skeleton) {
  const WorldPose rest = world_pose(skeleton, rest_pose(skeleton));
  const float scale = thickness(character, rest, skeleton.height);
  std::array<BoneFit, kJointCount> fits;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (!character.joint.at(i)) continue;
    fits.at(i) = fit_of(character, rest, joint_at(i), scale);
    // Hands go the way of their forearms: which way fingers point is not known.
    if (joint_at(i) == Joint::left_hand || joint_at(i) == Joint::right_hand)
      fits.at(i).turn = fits.at(static_cast<std::size_t>(kParent.at(i))).turn;
  }
  return fits;
}

}  // namespace

std::vector<CharacterPiece> conformed(const Character& character, const Skeleton& skeleton) {
  const std::array<BoneFit, kJointCount> fits = fits_of(character, skeleton);
  std::vector<CharacterPiece> pieces = character.pieces;
  for (CharacterPiece& piece : pieces) {
    for (std::size_t v = 0; v < piece.position.size(); ++v) {
      const CharacterWeights& weights = piece.weights[v];
      Vec3 at{}, normal{};
      for (std::size_t k = 0; k < 4; ++k) {
        if (weights.share.at(k) == 0) continue;
        const BoneFit& fit = fits[index(weights.joint.at(k))];
        const Vec3 off = fit.stretch * (piece.position[v] - fit.from);
        at += weights.share.at(k) * (fit.to + fit.turn * off);
        normal += weights.share.at(k) * (fit.turn * (glm::inverse(fit.stretch) * piece.normal[v]));
      }
      piece.position[v] = at;
      piece.normal[v] = normalized_or(normal, kUp);
    }
  }
  return pieces;
}

}  // namespace ringcraft
