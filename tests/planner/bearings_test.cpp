#include "planner/bearings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "default_library.h"
#include "planner/duel.h"

namespace ringcraft {
namespace {

// Every candidate of every action is where its launch, aimed by the fight's own rules, ends.
TEST(Bearings, AreWhereTheAimedLaunchesStartAndEnd) {
  const MotionTables tables(default_library(), make_body({}));
  const float scale = tables.body().scale;
  const AimLimit attack{std::sin(kMostAttackAim), std::cos(kMostAttackAim)};
  const AimLimit other{std::sin(kMostAim), std::cos(kMostAim)};
  Random random(17);
  std::vector<BearingLanes> bearings;
  int looked_at = 0, turned = 0, full = 0;
  for (std::size_t from = 0; from < default_library().actions().size(); from += 3) {
    const Followers& follow = tables.after(tables.at(ActionId(from)));
    const Placement root{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-3, 3)};
    const Vec3 opponent(root.x + random.uniform(-2, 2), 0, root.z + random.uniform(-2, 2));
    const Vec3 then(opponent.x + random.uniform(-.5f, .5f), 0, opponent.z);
    NextLanes::Lanes all_x, all_z;
    all_x.fill(then.x), all_z.fill(then.z);
    const std::vector<NextLanes::Lanes> then_x(follow.next_lanes.size(), all_x);
    const std::vector<NextLanes::Lanes> then_z(follow.next_lanes.size(), all_z);
    find_bearings(follow.next_lanes, Frame(root), opponent, attack, other, then_x, then_z,
                  bearings);
    ASSERT_EQ(bearings.size(), (follow.next.size() + kLanes - 1) / kLanes);
    for (std::size_t i = 0; i < follow.next.size(); ++i) {
      const NextAction& next = follow.next[i];
      const Action& action = *next.table->action;
      Launch launch;
      launch.action = next.to;
      launch.end = next.length;
      launch.placement = (Frame(root) * next.alignment).placement();
      const float most = action.attacks() ? kMostAttackAim : kMostAim;
      launch.aim = aim_at(action, launch.placement, opponent, scale, most);
      const Placement end = InFlight(tables, launch).root_at(next.length);
      const BearingLanes& bearing = bearings[i / kLanes];
      const std::size_t lane = i % kLanes;
      const std::string what = default_library().actions()[from].name + " to " + action.name;
      EXPECT_NEAR(bearing.start_x[lane], launch.placement.x, 1e-4f) << what;
      EXPECT_NEAR(bearing.start_z[lane], launch.placement.z, 1e-4f) << what;
      EXPECT_NEAR(bearing.aim_sine[lane], std::sin(launch.aim), 1e-3f) << what;
      EXPECT_NEAR(bearing.x[lane], end.x, 2e-3f) << what;
      EXPECT_NEAR(bearing.z[lane], end.z, 2e-3f) << what;
      const float apart = std::hypot(then.x - end.x, then.z - end.z);
      EXPECT_NEAR(bearing.apart[lane], apart, 3e-3f) << what;
      const float ahead =
          (then.x - end.x) * std::sin(end.yaw) + (then.z - end.z) * std::cos(end.yaw);
      if (apart > .1f) {
        EXPECT_NEAR(bearing.facing[lane], ahead / apart, .05f) << what;
      }
      ++looked_at;
      turned += launch.aim != 0 ? 1 : 0;
      full += std::abs(std::abs(launch.aim) - most) < 1e-4f ? 1 : 0;
    }
  }
  EXPECT_GT(looked_at, 3000);
  EXPECT_GT(turned, 1000);
  EXPECT_GT(full, 500);
}

}  // namespace
}  // namespace ringcraft
