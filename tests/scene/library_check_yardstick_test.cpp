#include "scene/library_check_yardstick.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "capture/canonical.h"
#include "default_library.h"

namespace ringcraft {
namespace {

class YardstickTest : public testing::Test {
 protected:
  void SetUp() override {
    const char* capture = "/usr/share/assimp/models/BVH/Boxing_Toes.bvh";
    if (!std::filesystem::exists(capture)) GTEST_SKIP() << "needs the package assimp-testmodels";
    const auto read = read_canonical(capture, canonical_skeleton());
    ASSERT_TRUE(read.has_value()) << to_string(read.error());
    EXPECT_EQ(read->profile.name, "boxing_toes");
    real_ = mirrored(read->clip);  // a southpaw
  }
  // He boxes from 2.3 to 16 s; later he staggers.
  Yardstick against_real(const MotionLibrary& library) const {
    return yardstick(library, real_, ticks(2.3), ticks(16));
  }
  // The default library with every clip changed.
  template <class Change>
  static MotionLibrary changed(Change change) {
    std::vector<Action> actions = default_library().actions();
    for (Action& action : actions) change(action.clip);
    return {"changed", std::move(actions)};
  }

 private:
  Clip real_;
};

// Two captured boxers are 14 and 20 cm apart (median, 90 %); one boxer's strike frames find the
// other's at 18 and 22 with the longer velocity weight.
TEST_F(YardstickTest, AuthoredBoxingAndACapturedBoxerAreNearBothWays) {
  const Yardstick measured = against_real(default_library());
  EXPECT_LT(measured.authored_median, 0.14);
  EXPECT_LT(measured.authored_90, 0.20);
  EXPECT_LT(measured.strikes_median, 0.18);
  EXPECT_LT(measured.strikes_90, 0.22);
  EXPECT_FALSE(measured.farthest.empty());
}

TEST_F(YardstickTest, AFrozenGuardIsNearRealFramesButRealBlowsAreFarFromIt) {
  const Yardstick frozen = against_real(changed([](Clip& clip) {
    for (Pose& pose : clip.frames)
      pose.rotation = default_library().actions()[0].clip.at(0).rotation;
  }));
  EXPECT_LT(frozen.authored_median, 0.20);
  EXPECT_GT(frozen.strikes_90, 0.22);
  EXPECT_LT(frozen.fast_hand, 4.2);
}

TEST_F(YardstickTest, ATwistedTrunkIsFarFromEveryRealFrame) {
  const Yardstick bent = against_real(changed([](Clip& clip) {
    for (Pose& pose : clip.frames) {
      pose.rotation[index(Joint::spine)] =
          glm::angleAxis(radians(60), kLeft) * pose.rotation[index(Joint::spine)];
    }
  }));
  EXPECT_GT(bent.authored_median, 0.20);
}

}  // namespace
}  // namespace ringcraft
