// One hit: a fighter in guard, an impulse, and what the body answers.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "motion/ik.h"
#include "physics/impact.h"

using namespace ringcraft;

namespace {

// A guard: left foot forward, knees bent, gloves before the chin.
Pose guard(const Skeleton& skeleton) {
  Pose pose = rest_pose(skeleton);
  pose.hips += Vec3{0, -.06f, .02f};
  const float ankle = skeleton.ankle_height();
  for (const Side side : {Side::left, Side::right}) {
    const float out = side == Side::left ? 1.0f : -1.0f;
    solve_limb(skeleton, leg(side), {{.13f * out, ankle, .20f * out}, kForward}, pose);
    set_world_rotation(skeleton, leg(side).end, Quat(), pose);
    solve_limb(skeleton, arm(side), {{.09f * out, 1.45f, .30f}, {.5f * out, -1, 0}}, pose);
  }
  return pose;
}

const char* side_of(float direction) {
  const std::array<const char*, 4> names = {"fore", "left", "back", "right"};
  const auto quarter = static_cast<int>(std::lround(wrapped_angle(direction) / (kPi / 2)));
  return names[static_cast<std::size_t>((quarter + 4) % 4)];
}

void hit(const BodyModel& body, const Pose& pose, const std::string& name, Part part,
         Vec3 impulse) {
  const Capsule struck = capsules(body, world_pose(body.skeleton, pose))[index(part)];
  const std::vector<Pose> standing(kImpulseStepTicks + 1, pose);  // the action goes on: it stands

  ImpactInput input;
  input.pose = input.pose_before = pose;
  input.continued = standing;
  input.contacts = {true, true};
  input.blow.part = part;
  input.blow.point = (struck.a + struck.b) * .5f + Vec3{0, 0, struck.radius};
  input.blow.impulse = impulse;

  const ImpactOutcome outcome = impulse_step(body, input);
  const std::vector<Pose> shown = simulate_response(body, input, outcome, {}, kTicksPerSecond);
  const WorldPose end = world_pose(body.skeleton, shown.back());
  std::printf("%-28s %5.0f N s  %-14s steps %d %-5s  head %4.1f rad/s  head at %.2f m after 1 s\n",
              name.c_str(), static_cast<double>(glm::length(impulse)),
              outcome.knockout ? "knockout" : std::string(name_of(outcome.response)).c_str(),
              outcome.steps, side_of(outcome.direction), static_cast<double>(outcome.head_spin),
              static_cast<double>(end.position[index(Joint::head)].y));
}

}  // namespace

int main() {
  const BodyModel body = make_body({"middleweight", 1.78f, 75.0f, Sex::male});
  const Pose pose = guard(body.skeleton);
  hit(body, pose, "jab to the head", Part::head, {0, 0, -12});
  hit(body, pose, "cross to the head", Part::head, {0, -2, -26});
  hit(body, pose, "hook to the body", Part::abdomen, {-30, 0, -10});
  hit(body, pose, "roundhouse to the thigh", Part::left_thigh, {-55, -5, 0});
  hit(body, pose, "front kick to the chest", Part::chest, {0, 10, -90});
  hit(body, pose, "side kick to the chest", Part::chest, {0, 10, -170});
  hit(body, pose, "roundhouse to the head", Part::head, {-55, 0, -10});
  return 0;
}
