#include "physics/ragdoll.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <btBulletDynamicsCommon.h>

#include "physics/joint_cones.h"
#include "physics/penetration.h"

namespace ringcraft {
namespace {

constexpr int kIterations = 20;
constexpr float kFastestServo = 12;        // rad/s toward a resting target
constexpr float kFastestFeedForward = 40;  // rad/s with the target's own motion
constexpr float kStopTau = .02f;           // s in which a joint beyond its range is back
constexpr float kStopStrength = 3;         // of the muscle's torque: a joint's stop holds more
constexpr float kMostStartSpeed = 25;      // m/s: a jump in the input must not explode
constexpr float kMostStartTurning = 60;    // rad/s
constexpr float kMostLimbSpin = 60;        // rad/s: whips beyond that of any limb go through floors
constexpr float kMargin = 0.004f;          // m: collision margin of the soles

constexpr int kGround = 1, kFeet = 2, kParts = 4;  // collision groups

btVector3 bt(Vec3 v) {
  return {v.x, v.y, v.z};
}
btQuaternion bt(Quat q) {
  return {q.x, q.y, q.z, q.w};
}
Vec3 vec(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}
Quat quat(const btQuaternion& q) {
  return Quat(q.w(), q.x(), q.y(), q.z());
}

Vec3 limited(Vec3 v, float most) {
  const float length = glm::length(v);
  return length > most ? v * (most / length) : v;
}

btMatrix3x3 basis(Quat turn, Vec3 x, Vec3 y) {
  const Vec3 a = turn * x, b = turn * y, c = turn * glm::cross(x, y);
  return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

}  // namespace

// Three angular rows that drive a child toward a wanted relative velocity, each limited by a torque
// (docs/sources.md, R1). An implicit velocity servo: stable for any tone and mass ratio, because
// the solver sees contacts and neighbours.
class Servo final : public btTypedConstraint {
 public:
  Servo(btRigidBody& child, btRigidBody& parent)
      : btTypedConstraint(MAX_CONSTRAINT_TYPE, child, parent) {}

  void aim(Quat relative, Vec3 turning_in_parent) {
    target_ = relative;
    turning_ = turning_in_parent;
  }

  void stop(const std::optional<Quat>& back, float most) {
    back_ = back;
    stop_torque_ = most;
  }

  float torque = 0;  // N m at the present tone
  float stiffness = 0, damping = 0;
  float tau = .05f;  // s
  bool gives = false;

  void getInfo1(btConstraintInfo1* info) override {
    info->m_numConstraintRows = 3;
    info->nub = 0;
  }

  void getInfo2(btConstraintInfo2* info) override {
    const Quat child = quat(m_rbA.getOrientation()), parent = quat(m_rbB.getOrientation());
    const Vec3 error = rotation_vector(parent * back_.value_or(target_) * glm::conjugate(child));
    const Vec3 feed = back_ ? Vec3{} : parent * turning_;
    Vec3 wanted = limited(error / (back_ ? kStopTau : tau), kFastestServo) + feed;
    wanted = limited(wanted, kFastestFeedForward);
    const float speed = glm::length(wanted);
    const Vec3 along = speed > 1e-6f ? wanted / speed : Vec3{1, 0, 0};
    btVector3 second, third;
    btPlaneSpace1(bt(along), second, third);
    const std::array<Vec3, 3> axes = {along, vec(second), vec(third)};
    const Vec3 relative = vec(m_rbA.getAngularVelocity() - m_rbB.getAngularVelocity()) - feed;
    const float dt = 1 / info->fps;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<std::ptrdiff_t>(k) * info->rowskip;
      for (int c = 0; c < 3; ++c) {
        info->m_J1angularAxis[row + c] = axes[k][c];
        info->m_J2angularAxis[row + c] = -axes[k][c];
      }
      info->m_constraintError[row] = k == 0 ? speed : 0;
      float most = back_ ? stop_torque_ : torque;
      if (gives && !back_) {
        const float turning = glm::dot(relative, axes[k]);
        most = k == 0
                   ? std::min(torque, std::abs(stiffness * glm::length(error) - damping * turning))
                   : std::min(torque, damping * std::abs(turning));
      }
      info->m_lowerLimit[row] = -most * dt;
      info->m_upperLimit[row] = most * dt;
    }
  }

  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  Quat target_;
  Vec3 turning_{};            // of the target, in the parent's frame, rad/s
  std::optional<Quat> back_;  // where a joint beyond its range goes
  float stop_torque_ = 0;     // N m
};

namespace {

// World rotations of the parts' joints for a pose.
std::array<Quat, kPartCount> part_rotations(const WorldPose& world) {
  std::array<Quat, kPartCount> r;
  for (std::size_t i = 0; i < kPartCount; ++i) r[i] = world.rotation[index(joint_of(part_at(i)))];
  return r;
}

Quat relative_rotation(const std::array<Quat, kPartCount>& r, std::size_t child) {
  return glm::conjugate(r[static_cast<std::size_t>(parent_of(part_at(child)))]) * r[child];
}

bool is_foot(std::size_t i) {
  return part_at(i) == Part::left_foot || part_at(i) == Part::right_foot;
}

}  // namespace

struct Ragdoll::World {
  World(const BodyModel& model, const Pose& pose, const Pose& before, float seconds,
        const RagdollSettings& s);
  ~World();

  void add_ground();
  void add_part(std::size_t i, const WorldPose& now, const WorldPose& then, float seconds);
  void add_joint(std::size_t i, const WorldPose& now);
  void add_hinge(std::size_t i, Quat relative, Vec3 pivot);
  void part_overlaps(const WorldPose& now);
  btCollisionShape* keep(std::unique_ptr<btCollisionShape> shape) {
    shapes.push_back(std::move(shape));
    return shapes.back().get();
  }
  btCollisionShape* foot_shape(const PartModel& part, Quat toes_turn);
  void add_box(btCompoundShape& to, Vec3 low, Vec3 high, const btTransform& frame);

  const BodyModel body;
  const RagdollSettings settings;
  Pose start;                           // keeps the rotations that no part carries
  std::array<Vec3, kPartCount> center;  // centre of mass in the joint's frame
  std::unique_ptr<btDefaultCollisionConfiguration> configuration;
  std::unique_ptr<btCollisionDispatcher> dispatcher;
  std::unique_ptr<btDbvtBroadphase> broadphase;
  std::unique_ptr<btSequentialImpulseConstraintSolver> solver;
  std::unique_ptr<btDiscreteDynamicsWorld> world;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::array<std::unique_ptr<btRigidBody>, kPartCount> bodies;
  std::unique_ptr<btRigidBody> ground;
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  std::array<std::unique_ptr<Servo>, kPartCount> servos;
};

Ragdoll::World::World(const BodyModel& model, const Pose& pose, const Pose& before, float seconds,
                      const RagdollSettings& s)
    : body(model), settings(s), start(pose) {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 256;  // 33 us a world instead of 360
  info.m_defaultMaxCollisionAlgorithmPoolSize = 256;
  configuration = std::make_unique<btDefaultCollisionConfiguration>(info);
  dispatcher = std::make_unique<btCollisionDispatcher>(configuration.get());
  broadphase = std::make_unique<btDbvtBroadphase>();
  solver = std::make_unique<btSequentialImpulseConstraintSolver>();
  world = std::make_unique<btDiscreteDynamicsWorld>(dispatcher.get(), broadphase.get(),
                                                    solver.get(), configuration.get());
  world->setGravity({0, settings.gravity ? -kGravity : 0.0f, 0});
  world->getSolverInfo().m_numIterations = kIterations;
  if (settings.ground) add_ground();
  const WorldPose now = world_pose(body.skeleton, pose), then = world_pose(body.skeleton, before);
  for (std::size_t i = 0; i < kPartCount; ++i) add_part(i, now, then, seconds);
  for (std::size_t i = 1; i < kPartCount; ++i) add_joint(i, now);
  if (settings.whole_body_contacts) part_overlaps(now);
}

// Parts that overlap in the rest pose or at the start do not collide with each other.
void Ragdoll::World::part_overlaps(const WorldPose& now) {
  const BodyCapsules here = capsules(body, now),
                     rest = capsules(body, world_pose(body.skeleton, rest_pose(body.skeleton)));
  const auto overlap = [](const Capsule& a, const Capsule& b) {
    return segment_distance(a.a, a.b, b.a, b.b).distance < a.radius + b.radius + .01f;
  };
  for (std::size_t i = 0; i < kPartCount; ++i) {
    for (std::size_t j = i + 1; j < kPartCount; ++j) {
      if (!overlap(here[i], here[j]) && !overlap(rest[i], rest[j])) continue;
      bodies[i]->setIgnoreCollisionCheck(bodies[j].get(), true);
      bodies[j]->setIgnoreCollisionCheck(bodies[i].get(), true);
    }
  }
}

Ragdoll::World::~World() {
  for (auto& servo : servos) {
    if (servo) world->removeConstraint(servo.get());
  }
  for (auto& joint : joints) world->removeConstraint(joint.get());
  for (auto& b : bodies) world->removeRigidBody(b.get());
  if (ground) world->removeRigidBody(ground.get());
}

void Ragdoll::World::add_ground() {
  btCollisionShape* shape = keep(std::make_unique<btBoxShape>(btVector3(20, 1, 20)));
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape);
  info.m_startWorldTransform.setOrigin({0, -1, 0});
  info.m_friction = 1;
  ground = std::make_unique<btRigidBody>(info);
  world->addRigidBody(ground.get(), kGround, kFeet | kParts);
}

void Ragdoll::World::add_box(btCompoundShape& to, Vec3 low, Vec3 high, const btTransform& frame) {
  auto box = std::make_unique<btBoxShape>(bt((high - low) * .5f));
  box->setMargin(kMargin);
  to.addChildShape(frame * btTransform(btQuaternion::getIdentity(), bt((low + high) * .5f)),
                   keep(std::move(box)));
}

// The foot is a box from heel to tip, 9 cm wide; with bent toes (a raised heel) a second box
// carries the toes. Frame: the centre of mass.
btCollisionShape* Ragdoll::World::foot_shape(const PartModel& part, Quat toes_turn) {
  constexpr float kBentToes = radians(8);
  const float ankle = body.skeleton.ankle_height(), unit = body.spec.height / 1.78f;
  const Vec3 joint = body.skeleton.offset[index(Joint::left_toes)];
  const float heel = part.capsule_a.z - part.radius, tip = part.capsule_b.z + part.radius;
  const float half_width = .045f * unit, thick = .064f * unit;
  auto compound = std::make_unique<btCompoundShape>();
  btTransform frame(btQuaternion::getIdentity(), bt(-part.center));
  const bool bent = std::abs(rotation_vector(toes_turn).x) > kBentToes;
  add_box(*compound, {-half_width, -ankle, heel}, {half_width, thick - ankle, bent ? joint.z : tip},
          frame);
  if (bent) {
    frame = frame * btTransform(bt(toes_turn), bt(Vec3{0, joint.y, joint.z}));
    add_box(*compound, {-half_width, -ankle - joint.y, 0},
            {half_width, .6f * thick - ankle - joint.y, tip - joint.z}, frame);
  }
  return keep(std::move(compound));
}

void Ragdoll::World::add_part(std::size_t i, const WorldPose& now, const WorldPose& then,
                              float seconds) {
  const PartModel& part = body.parts[i];
  const std::size_t j = index(joint_of(part_at(i)));
  // The chest's shape hangs on the upper chest, which keeps its turn within the part.
  const bool chest = part_at(i) == Part::chest;
  const Vec3 hinge = chest ? body.skeleton.offset[index(Joint::upper_chest)] : Vec3{};
  const Quat turn = chest ? start.rotation[index(Joint::upper_chest)] : Quat(1, 0, 0, 0);
  const auto carried = [&](Vec3 p) { return hinge + turn * (p - hinge); };
  center[i] = carried(part.center);

  btCollisionShape* shape;
  if (is_foot(i)) {
    shape =
        foot_shape(part, start.rotation[index(part_at(i) == Part::left_foot ? Joint::left_toes
                                                                            : Joint::right_toes)]);
  } else {
    const btVector3 ends[2] = {bt(carried(part.capsule_a) - center[i]),
                               bt(carried(part.capsule_b) - center[i])};
    const btScalar radii[2] = {part.radius, part.radius};
    shape = keep(std::make_unique<btMultiSphereShape>(ends, radii, 2));
  }
  const Vec3 at = now.position[j] + now.rotation[j] * center[i];
  const Vec3 was = then.position[j] + then.rotation[j] * center[i];
  btRigidBody::btRigidBodyConstructionInfo info(part.mass, nullptr, shape, bt(part.inertia));
  info.m_startWorldTransform = btTransform(bt(glm::normalize(now.rotation[j])), bt(at));
  info.m_friction = settings.friction;
  auto rigid = std::make_unique<btRigidBody>(info);
  rigid->setActivationState(DISABLE_DEACTIVATION);
  if (seconds > 0) {
    rigid->setLinearVelocity(bt(limited((at - was) / seconds, kMostStartSpeed)));
    const Vec3 turned = rotation_vector(now.rotation[j] * glm::conjugate(then.rotation[j]));
    rigid->setAngularVelocity(bt(limited(turned / seconds, kMostStartTurning)));
  }
  const bool meets = is_foot(i) || settings.whole_body_contacts;
  const int group = is_foot(i) ? kFeet : kParts;
  const int mask = !meets ? 0 : kGround | (settings.whole_body_contacts ? kParts | kFeet : 0);
  world->addRigidBody(rigid.get(), group, mask);
  bodies[i] = std::move(rigid);
}

void Ragdoll::World::add_hinge(std::size_t i, Quat relative, Vec3 pivot) {
  const Part part = part_at(i);
  const bool knee = index(part) >= index(Part::left_thigh);
  // The axis about which flexion is positive, rest frame.
  const Vec3 axis = knee ? kLeft : (part == Part::left_forearm ? -kUp : kUp);
  const Vec3 limb = knee ? -kUp : (part == Part::left_forearm ? kLeft : -kLeft);
  const float along = glm::dot(Vec3{relative.x, relative.y, relative.z}, axis);
  const float angle = wrapped_angle(2 * std::atan2(along, relative.w));
  // What the pose turns beside the hinge's axis stays with the parent.
  const Quat beside = relative * glm::conjugate(glm::angleAxis(angle, axis));
  const auto p = static_cast<std::size_t>(parent_of(part));
  const btTransform in_child(basis(Quat(1, 0, 0, 0), limb, glm::cross(axis, limb)), bt(-center[i]));
  const btTransform in_parent(basis(beside, limb, glm::cross(axis, limb)), bt(pivot - center[p]));
  auto hinge = std::make_unique<btHingeConstraint>(*bodies[i], *bodies[p], in_child, in_parent);
  hinge->setLimit(std::min(0.0f, angle - kWidening), std::max(radians(150), angle + kWidening),
                  1.0f, .3f, 1.0f);
  joints.push_back(std::move(hinge));
}

void Ragdoll::World::add_joint(std::size_t i, const WorldPose& now) {
  const Part part = part_at(i);
  const auto p = static_cast<std::size_t>(parent_of(part));
  const std::size_t j = index(joint_of(part)), pj = index(joint_of(part_at(p)));
  const Quat unturned = glm::conjugate(now.rotation[pj]);
  const Quat relative = glm::normalize(unturned * now.rotation[j]);
  const Vec3 pivot = unturned * (now.position[j] - now.position[pj]);
  if (is_hinge(part)) {
    add_hinge(i, relative, pivot);
  } else {
    const Cone cone = widened(cone_of(part), relative);
    const btTransform in_child(basis(Quat(1, 0, 0, 0), cone.axis, cone.across), bt(-center[i]));
    const btTransform in_parent(basis(cone.middle, cone.axis, cone.across), bt(pivot - center[p]));
    auto joint =
        std::make_unique<btConeTwistConstraint>(*bodies[i], *bodies[p], in_child, in_parent);
    joint->setLimit(cone.side, cone.flexion, cone.twist, 1.0f, .3f, 1.0f);
    joints.push_back(std::move(joint));
  }
  world->addConstraint(joints.back().get(), true);
  auto servo = std::make_unique<Servo>(*bodies[i], *bodies[p]);
  servo->aim(relative, Vec3{});
  world->addConstraint(servo.get(), true);
  servos[i] = std::move(servo);
}

Ragdoll::Ragdoll(const BodyModel& body, const Pose& pose, const Pose& before, float seconds,
                 const RagdollSettings& settings)
    : world_(std::make_unique<World>(body, pose, before, seconds, settings)) {}

Ragdoll::~Ragdoll() = default;

void Ragdoll::track(const Pose& target, const Pose& before, const Pose& after, float seconds) {
  const Skeleton& skeleton = world_->body.skeleton;
  const auto r = part_rotations(world_pose(skeleton, target));
  const auto r0 = part_rotations(world_pose(skeleton, before)),
             r1 = part_rotations(world_pose(skeleton, after));
  for (std::size_t i = 1; i < kPartCount; ++i) {
    const Quat q0 = relative_rotation(r0, i), q1 = relative_rotation(r1, i);
    const Vec3 turning = rotation_vector(q1 * glm::conjugate(q0)) / seconds;
    world_->servos[i]->aim(glm::normalize(relative_rotation(r, i)), turning);
  }
}

void Ragdoll::set_tone(const Tone& tone) {
  for (std::size_t i = 1; i < kPartCount; ++i) {
    const Muscle muscle = muscle_of(world_->body, part_at(i));
    world_->servos[i]->torque = tone[i] * muscle.torque;
    world_->servos[i]->stiffness = muscle.stiffness;
    world_->servos[i]->damping = muscle.damping();
  }
}

void Ragdoll::set_servo(float tau, bool gives) {
  for (std::size_t i = 1; i < kPartCount; ++i) {
    world_->servos[i]->tau = tau;
    world_->servos[i]->gives = gives;
  }
}

void Ragdoll::stop(const Pose& back, const std::array<bool, kPartCount>& beyond) {
  const auto r = part_rotations(world_pose(world_->body.skeleton, back));
  for (std::size_t i = 1; i < kPartCount; ++i) {
    std::optional<Quat> to;
    if (beyond[i]) to = glm::normalize(relative_rotation(r, i));
    world_->servos[i]->stop(to, kStopStrength * muscle_of(world_->body, part_at(i)).torque);
  }
}

void Ragdoll::push(Part part, Vec3 point, Vec3 impulse) {
  btRigidBody& b = *world_->bodies[index(part)];
  b.applyImpulse(bt(impulse), bt(point) - b.getCenterOfMassPosition());
}

void Ragdoll::quicken(Vec3 velocity) {
  for (const auto& b : world_->bodies) b->setLinearVelocity(b->getLinearVelocity() + bt(velocity));
}

void Ragdoll::turn_faster(float yaw_rate) {
  const btVector3 turning(0, yaw_rate, 0), at = bt(center_of_mass());
  for (const auto& b : world_->bodies) {
    b->setAngularVelocity(b->getAngularVelocity() + turning);
    b->setLinearVelocity(b->getLinearVelocity() + turning.cross(b->getCenterOfMassPosition() - at));
  }
}

void Ragdoll::step() {
  // With 0 substeps Bullet takes the whole time as one step.
  world_->world->stepSimulation(world_->settings.step, 0);
  for (std::size_t i = index(Part::left_upper_arm); i < kPartCount; ++i) {
    btRigidBody& b = *world_->bodies[i];
    const float spin = b.getAngularVelocity().length();
    if (spin > kMostLimbSpin) b.setAngularVelocity(b.getAngularVelocity() * (kMostLimbSpin / spin));
  }
}

PartMotion Ragdoll::motion(Part part) const {
  const btRigidBody& b = *world_->bodies[index(part)];
  PartMotion m;
  m.rotation = glm::normalize(quat(b.getOrientation()));
  m.origin = vec(b.getCenterOfMassPosition()) - m.rotation * world_->center[index(part)];
  m.velocity = vec(b.getLinearVelocity());
  m.angular_velocity = vec(b.getAngularVelocity());
  return m;
}

Pose Ragdoll::pose() const {
  Pose pose = world_->start;
  std::array<Quat, kJointCount> turn;  // world
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const Part part = *part_of(joint_at(j));
    const bool carried = joint_of(part) != joint_at(j);
    const int parent = kParent[j];
    const Quat above = parent < 0 ? Quat(1, 0, 0, 0) : turn[static_cast<std::size_t>(parent)];
    if (!carried) {
      pose.rotation[j] = glm::normalize(glm::conjugate(above) * motion(part).rotation);
    }
    turn[j] = above * pose.rotation[j];
  }
  pose.hips = motion(Part::pelvis).origin;
  // The solver leaves gaps of millimetres in the joints, centimetres in a hard landing. Put in one
  // chain they would add up from the pelvis outward: the chain lies where its parts are in the mean
  // instead.
  const WorldPose chain = world_pose(world_->body.skeleton, pose);
  Vec3 off{};
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const float share = world_->body.parts[i].mass / world_->body.spec.mass;
    off += share * (motion(part_at(i)).origin - chain.position[index(joint_of(part_at(i)))]);
  }
  pose.hips += off;
  return pose;
}

Vec3 Ragdoll::center_of_mass() const {
  Vec3 sum{};
  for (std::size_t i = 0; i < kPartCount; ++i) {
    sum += world_->body.parts[i].mass * vec(world_->bodies[i]->getCenterOfMassPosition());
  }
  return sum / world_->body.spec.mass;
}

Vec3 Ragdoll::center_of_mass_velocity() const {
  Vec3 sum{};
  for (std::size_t i = 0; i < kPartCount; ++i) {
    sum += world_->body.parts[i].mass * vec(world_->bodies[i]->getLinearVelocity());
  }
  return sum / world_->body.spec.mass;
}

Vec3 Ragdoll::angular_momentum() const {
  const Vec3 at = center_of_mass(), going = center_of_mass_velocity();
  Vec3 sum{};
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const btRigidBody& b = *world_->bodies[i];
    const Vec3 offset = vec(b.getCenterOfMassPosition()) - at;
    sum += world_->body.parts[i].mass * glm::cross(offset, vec(b.getLinearVelocity()) - going);
    const Quat turn = quat(b.getOrientation());
    const Vec3 spin = glm::conjugate(turn) * vec(b.getAngularVelocity());
    sum += turn * (world_->body.parts[i].inertia * spin);
  }
  return sum;
}

float Ragdoll::yaw_rate() const {
  const Vec3 at = center_of_mass();
  float inertia = 0;  // kg m2
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const btRigidBody& b = *world_->bodies[i];
    const Vec3 offset = vec(b.getCenterOfMassPosition()) - at;
    const Vec3 up = glm::conjugate(quat(b.getOrientation())) * kUp;
    inertia += world_->body.parts[i].mass * (offset.x * offset.x + offset.z * offset.z) +
               glm::dot(up * up, world_->body.parts[i].inertia);
  }
  return angular_momentum().y / inertia;
}

float Ragdoll::fastest() const {
  float fastest = 0;
  for (const auto& b : world_->bodies) fastest = std::max(fastest, b->getLinearVelocity().length());
  return fastest;
}

std::array<Vec3, 6> sole(const BodyModel& body, const WorldPose& world, Side side) {
  const PartModel& part =
      body.parts[index(side == Side::left ? Part::left_foot : Part::right_foot)];
  const std::size_t foot = index(leg(side).end), tip_joint = index(toes(side));
  const float ankle = body.skeleton.ankle_height(), half = .045f * body.spec.height / 1.78f;
  const Vec3 joint = body.skeleton.offset[tip_joint];
  const float heel = part.capsule_a.z - part.radius, tip = part.capsule_b.z + part.radius - joint.z;
  std::array<Vec3, 6> corners;
  std::size_t n = 0;
  for (const float x : {-half, half}) {
    corners[n++] = world.position[foot] + world.rotation[foot] * Vec3{x, -ankle, heel};
    corners[n++] = world.position[foot] + world.rotation[foot] * Vec3{x, -ankle, joint.z};
    corners[n++] =
        world.position[tip_joint] + world.rotation[tip_joint] * Vec3{x, -ankle - joint.y, tip};
  }
  return corners;
}

float sole_height(const BodyModel& body, const WorldPose& world, Side side) {
  const auto corners = sole(body, world, side);
  float low = corners[0].y;
  for (const Vec3& corner : corners) low = std::min(low, corner.y);
  return low;
}

bool trunk_down(const BodyModel& body, const Pose& pose) {
  constexpr float kDown = .03f;  // m
  const BodyCapsules c = capsules(body, world_pose(body.skeleton, pose));
  for (const Part p : {Part::pelvis, Part::abdomen, Part::chest}) {
    const Capsule& k = c[index(p)];
    if (std::min(k.a.y, k.b.y) - k.radius < kDown) return true;
  }
  return false;
}

}  // namespace ringcraft
