// Feints of the synthetic library's attacks: what they look like, and where they stand.

#include "motion/feints.h"

#include <gmock/gmock.h>

#include "fight/synthetic_fixture.h"

namespace ringcraft {
namespace {

using testing::HasSubstr;

class FeintsTest : public SyntheticFixture {
 protected:
  static const Action& hook() { return library().action(library().find("hook")); }
  static Vec3 hand(const Clip& clip, Tick tick, Joint joint) {
    return world_pose(library().skeleton(), clip.at(tick)).position[index(joint)];
  }
};

TEST_F(FeintsTest, IsTheAttackUntilItParts) {
  const Action feint = feint_of(hook());
  ASSERT_TRUE(feint.feint);
  EXPECT_EQ(feint.feint->of, "hook");
  EXPECT_TRUE(faults(feint.clip).empty());
  const Tick parted = feint.feint->parted;
  EXPECT_GT(parted, hook().strikes.front().active_begin / 3);
  EXPECT_LT(parted, hook().strikes.front().active_begin);
  const Joint fist = hook().strikes.front().joint;
  for (Tick tick = 0; tick < parted; ++tick) {
    EXPECT_LT(glm::distance(hand(feint.clip, tick, fist), hand(hook().clip, tick, fist)), 1e-6f);
  }
  EXPECT_GT(glm::distance(hand(feint.clip, parted + 2, fist), hand(hook().clip, parted + 2, fist)),
            1e-4f);
}

TEST_F(FeintsTest, ShowsAFistGoesBackToWhereItBeganAndHitsNobody) {
  const Action feint = feint_of(hook());
  const Joint fist = hook().strikes.front().joint;
  const Vec3 from = hand(feint.clip, 0, fist);
  float farthest = 0, fastest_change = 0;
  Vec3 before{};
  for (Tick tick = 1; tick <= feint.length(); ++tick) {
    const Vec3 at = hand(feint.clip, tick, fist);
    farthest = std::max(farthest, glm::distance(at, from));
    const Vec3 velocity =
        (at - hand(feint.clip, tick - 1, fist)) * static_cast<float>(kTicksPerSecond);
    if (tick > 1) fastest_change = std::max(fastest_change, glm::length(velocity - before));
    before = velocity;
  }
  EXPECT_GT(farthest, 0.08f);
  EXPECT_LT(fastest_change, 1.5f);  // m/s between ticks: no pop
  EXPECT_LT(glm::length(before), 0.3f);
  EXPECT_LT(glm::distance(hand(feint.clip, feint.length(), fist), from), 1e-5f);
  EXPECT_FALSE(feint.attacks());
  EXPECT_EQ(feint.kind, Kind::transition);
}

TEST_F(FeintsTest, StandBehindTheLibraryAndFollowWhatTheirAttackFollows) {
  const std::vector<std::string> names{"hook", "nonsense", "idle"};
  const MotionLibrary with = with_feints(library(), names);
  ASSERT_EQ(with.actions().size(), library().actions().size() + 1);
  const ActionId feint = with.find("hook_feint"), attack = with.find("hook");
  ASSERT_TRUE(feint.valid());
  for (std::size_t i = 0; i < library().actions().size(); ++i) {
    const ActionId from(i);
    EXPECT_EQ(with.action(from).name, library().action(from).name);
    EXPECT_EQ(with.machine().edge(from, feint) != nullptr,
              with.machine().edge(from, attack) != nullptr);
    for (std::size_t j = 0; j < with.actions().size(); ++j) {  // nobody feigns on his way
      const Path* path = with.machine().path(from, ActionId(j));
      if (path == nullptr) continue;
      EXPECT_EQ(std::count(path->via.begin(), path->via.end(), feint), 0);
    }
  }
  EXPECT_NE(with.machine().edge(feint, attack), nullptr);
  EXPECT_NE(with.hash(), library().hash());
  EXPECT_EQ(with_feints(library(), {}).hash(), library().hash());
}

}  // namespace
}  // namespace ringcraft
