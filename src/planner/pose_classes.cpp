#include "planner/pose_classes.h"

#include <algorithm>

#include "physics/impact.h"

namespace ringcraft {
namespace {

constexpr Tick kAhead = kImpulseStepTicks;  // the muscles track the action that far

struct Shape {
  std::array<Vec3, 2 * kJointCount> joints{};  // seen from the root now: now, and kAhead ticks on
  FootContacts contacts;
};

Shape shape_of(const MotionTables& tables, const ActionTable& action, Tick age) {
  Shape shape;
  shape.contacts = action.action->clip.contacts_at(action.clamped(age));
  const Frame root(action.root_at(age));
  for (std::size_t half = 0; half < 2; ++half) {
    const WorldPose world =
        world_pose(tables.body().skeleton, action.pose_at(age + static_cast<Tick>(half) * kAhead));
    for (std::size_t i = 0; i < kJointCount; ++i) {
      shape.joints[half * kJointCount + i] = root.to_inner(world.position[i]);
    }
  }
  return shape;
}

// Sum of the squared distances, or something above `most`.
float unlike(const Shape& a, const Shape& b, float most) {
  float sum = 0;
  for (std::size_t i = 0; i < a.joints.size() && sum <= most; ++i) {
    sum += glm::distance2(a.joints[i], b.joints[i]);
  }
  return sum;
}

}  // namespace

PoseClasses::PoseClasses(const MotionTables& tables, Tick every, float alike) : every_(every) {
  struct Class {
    Shape shape;
    PoseMoment moment;
  };
  std::vector<Class> classes;
  const float most = alike * alike * static_cast<float>(2 * kJointCount);
  const std::size_t actions = tables.count();
  stands_for_.resize(actions);
  for (std::size_t a = 0; a < actions; ++a) {
    const ActionTable& action = tables.at(ActionId(a));
    for (Tick age = 0; age <= action.length; age += every) {
      Shape shape = shape_of(tables, action, age);
      const Class* nearest = nullptr;
      float least = most;
      for (const Class& one : classes) {
        if (!(one.shape.contacts == shape.contacts)) continue;
        const float apart = unlike(one.shape, shape, least);
        if (apart < least) least = apart, nearest = &one;
      }
      const PoseMoment self{ActionId(a), age};
      stands_for_[a].push_back(nearest != nullptr ? nearest->moment : self);
      if (nearest == nullptr) classes.push_back({std::move(shape), self});
      ++moments_;
    }
  }
  count_ = classes.size();
}

PoseMoment PoseClasses::of(ActionId action, Tick age) const {
  const std::vector<PoseMoment>& steps = stands_for_[action.at()];
  const auto step = static_cast<std::size_t>(std::max<Tick>(0, age) / every_);
  return steps[std::min(step, steps.size() - 1)];
}

}  // namespace ringcraft
