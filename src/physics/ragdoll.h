#pragma once
// The ragdoll: one body in a fresh Bullet world on flat ground, its muscles tracking target poses.
//
// Recipe and figures: docs/sources.md, R. 17 parts, cone-twist joints, hinges at elbows and knees,
// muscles as angular servo rows inside the solver, 240 Hz, 20 iterations. Same calls, same bits.

#include <memory>

#include "physics/muscles.h"

namespace ringcraft {

inline constexpr float kRagdollStep = 1.0f / 240.0f;  // s

struct RagdollSettings {
  bool whole_body_contacts =
      false;              // all parts meet the ground and each other (falls); else feet only
  float friction = 0.9f;  // of parts on the ground
  bool gravity = true;
  bool ground = true;
  float step = kRagdollStep;  // s
};

// The motion of one part: its joint's frame, and the velocities of its centre of mass.
struct PartMotion {
  Vec3 origin{};
  Quat rotation;
  Vec3 velocity{};          // of the centre of mass, m/s
  Vec3 angular_velocity{};  // rad/s
};

class Ragdoll {
 public:
  // Starts at `pose` with the velocities of the two poses, `before` being `seconds` earlier. Joint
  // limits are widened where the pose lies beyond them.
  Ragdoll(const BodyModel& body, const Pose& pose, const Pose& before, float seconds,
          const RagdollSettings& settings = {});
  ~Ragdoll();
  Ragdoll(const Ragdoll&) = delete;
  Ragdoll& operator=(const Ragdoll&) = delete;

  // What the muscles track: `target`, and the velocity at which the target itself moves: from
  // `before` to `after`, `seconds` apart (feed-forward; without it tracking lags by centimetres).
  void track(const Pose& target, const Pose& before, const Pose& after, float seconds);
  void set_tone(const Tone& tone);
  // Time constant of the servo, s, and whether it gives like a muscle (stiffness-limited) or holds.
  void set_servo(float tau, bool gives);
  // Joint stops for the next step: a part that is `beyond` its range is driven to its place in
  // `back`, whatever its muscle's tone. (Bullet's cones are soft where they are wide.)
  void stop(const Pose& back, const std::array<bool, kPartCount>& beyond);
  void push(Part part, Vec3 point, Vec3 impulse);  // world, m and N s
  void quicken(Vec3 velocity);                     // the whole body, m/s
  void turn_faster(float yaw_rate);                // as one about the vertical, rad/s
  void step();

  Pose pose() const;  // what the body shows now, on the canonical skeleton
  PartMotion motion(Part part) const;
  Vec3 center_of_mass() const;
  Vec3 center_of_mass_velocity() const;
  Vec3 angular_momentum() const;  // about the centre of mass, kg m2/s
  float yaw_rate() const;         // of the whole body about the vertical there, rad/s
  float fastest() const;          // largest speed of any part's centre of mass, m/s

 private:
  struct World;
  std::unique_ptr<World> world_;
};

// The corners of a foot's sole, world, for a pose: heel, ball and tip of one edge, then of the
// other.
std::array<Vec3, 6> sole(const BodyModel& body, const WorldPose& world, Side side);

// The height of the lowest of them, m.
float sole_height(const BodyModel& body, const WorldPose& world, Side side);

// Whether pelvis, belly or chest touch the ground, within 3 cm.
bool trunk_down(const BodyModel& body, const Pose& pose);

}  // namespace ringcraft
