// Every gate over all actions falls on a library that was made bad for it.
#include "scene/library_check_gates.h"

#include <gtest/gtest.h>

#include "default_library.h"

namespace ringcraft {
namespace {

const Gate& row(const LibraryCheck& check, const std::string& name) {
  for (const Gate& gate : check.gates) {
    if (gate.name == name) return gate;
  }
  throw std::runtime_error("no gate " + name);
}

// The default library with the same edges, but other actions.
template <class Change>
LibraryCheck changed(Change change) {
  LibraryParts parts;
  parts.name = "changed";
  parts.actions = default_library().actions();
  parts.machine = default_library().machine();
  for (Action& action : parts.actions) change(action);
  return check_library(MotionLibrary(std::move(parts)), std::nullopt);
}

const LibraryCheck& good() {
  static const LibraryCheck kCheck = check_library(default_library(), std::nullopt);
  return kCheck;
}

void expect_falls(const LibraryCheck& bad, const std::string& name) {
  EXPECT_TRUE(row(good(), name).passed()) << name << " is " << row(good(), name).value;
  EXPECT_FALSE(row(bad, name).passed()) << name << " is " << row(bad, name).value;
}

TEST(LibraryGates, AnElbowBentBackwardsIsALimitViolation) {
  const LibraryCheck bad = changed([](Action& action) {
    if (action.name != "jab") return;
    action.clip.frames[20].rotation[index(Joint::left_lower_arm)] =
        glm::angleAxis(radians(20), kUp);
  });
  expect_falls(bad, "joints beyond their range");
  expect_falls(bad, "joints beyond their range, worst");
  EXPECT_EQ(row(bad, "joints beyond their range").value, 1);
  EXPECT_NEAR(row(bad, "joints beyond their range, worst").value, 10, 3);  // 10 are within it
}

TEST(LibraryGates, ABodyThatGlidesSkates) {
  const auto glide = [](Action& action) {
    for (std::size_t i = 0; i < action.clip.frames.size(); ++i)
      action.clip.frames[i].hips.x += 0.4f * kTickSeconds * static_cast<float>(i);
  };
  const LibraryCheck one = changed([&](Action& action) {
    if (action.name == "jab") glide(action);
  });
  expect_falls(one, "foot skate, worst action");
  EXPECT_TRUE(row(one, "foot skate, mean over time").passed());
  expect_falls(changed(glide), "foot skate, mean over time");
}

TEST(LibraryGates, AHandInTheChestIsSelfPenetration) {
  const auto fold = [](Action& action) {
    for (Pose& pose : action.clip.frames) {
      pose.rotation[index(Joint::left_upper_arm)] = glm::angleAxis(radians(100), -kUp);
      pose.rotation[index(Joint::left_lower_arm)] = glm::angleAxis(radians(130), -kUp);
    }
  };
  const LibraryCheck one = changed([&](Action& action) {
    if (action.name == "jab") fold(action);
  });
  expect_falls(one, "self-penetration, 99 % of worst authored");
  expect_falls(changed(fold), "self-penetration, 99 % of all frames");
}

TEST(LibraryGates, ABlowThatGoesPastItsAimIsCounted) {
  const LibraryCheck bad = changed([](Action& action) {
    if (action.name != "cross") return;
    for (Pose& pose : action.clip.frames) pose.hips.x += 0.06f;
  });
  expect_falls(bad, "aims met within 3 cm over their reach");
  expect_falls(bad, "aims, farthest miss within a reach");
  EXPECT_GT(row(bad, "aims met within 3 cm over their reach").value, 95);
}

TEST(LibraryGates, ABlowThatSaysNoReachIsNotMet) {
  const LibraryCheck bad = changed([](Action& action) {
    if (action.name == "cross") action.strikes[0].farthest = 0;
  });
  expect_falls(bad, "aims met within 3 cm over their reach");
}

TEST(LibraryGates, AStepThatJerksIsNamed) {
  const LibraryCheck bad = changed([](Action& action) {
    if (action.name == "step_back") action.clip.frames[20].hips.x += 0.03f;
    if (action.name == "jab" || action.name == "knockdown_back")
      action.clip.frames[20].hips.x += 0.03f;  // asked of who steps or rises only
  });
  expect_falls(bad, "steps and get-ups, jump of velocity, worst");
  std::vector<std::string> jerks;
  for (const std::string& fault : bad.faults)
    if (fault.find("a joint jumps by") != std::string::npos) jerks.push_back(fault);
  ASSERT_EQ(jerks.size(), 1u);
  EXPECT_EQ(jerks[0].find("step_back: "), 0u) << jerks[0];
}

TEST(LibraryGates, ASeamToSomethingFarAwayJumps) {
  const LibraryCheck bad = changed([](Action& action) {
    if (action.kind != Kind::attack) return;
    for (Pose& pose : action.clip.frames)
      pose.rotation[0] = glm::angleAxis(radians(150), kUp) * pose.rotation[0];
  });
  expect_falls(bad, "seams, jump of velocity, 99 %");
  expect_falls(bad, "seams, jump of velocity, worst");
}

}  // namespace
}  // namespace ringcraft
