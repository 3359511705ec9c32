#include "io/mannequin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace ringcraft {
namespace {

struct Bodies : testing::TestWithParam<BodySpec> {};

INSTANTIATE_TEST_SUITE_P(Mannequin, Bodies,
                         testing::Values(BodySpec{"light", 1.55f, 48.0f, Sex::female, 1.0f},
                                         BodySpec{"middle", 1.78f, 75.0f, Sex::male, 1.0f},
                                         BodySpec{"heavy", 2.05f, 150.0f, Sex::male, 1.0f},
                                         BodySpec{"roundest", 1.20f, 200.0f, Sex::male, 1.0f},
                                         BodySpec{"thinnest", 2.30f, 30.0f, Sex::female, 1.0f}),
                         [](const auto& info) { return info.param.name; });

TEST_P(Bodies, IsAsTallAsTheBodyAndStandsOnTheGround) {
  const Mannequin mannequin = make_mannequin(make_body(GetParam()));
  float low = 1e9f, high = -1e9f;
  for (const MannequinPiece& piece : mannequin.pieces) {
    for (const Vec3& p : piece.position) {
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
  }
  EXPECT_NEAR(low, 0.0f, 0.005f);
  EXPECT_NEAR(high - low, GetParam().height, 0.03f * GetParam().height);
}

TEST_P(Bodies, EveryNumberIsSaneAndEveryVertexWeighted) {
  const Mannequin mannequin = make_mannequin(make_body(GetParam()));
  for (const MannequinPiece& piece : mannequin.pieces) {
    SCOPED_TRACE(name_of(piece.region));
    ASSERT_FALSE(piece.position.empty());
    ASSERT_EQ(piece.normal.size(), piece.position.size());
    ASSERT_EQ(piece.weights.size(), piece.position.size());
    ASSERT_EQ(piece.shade.size(), piece.position.size());
    for (std::size_t i = 0; i < piece.position.size(); ++i) {
      ASSERT_TRUE(std::isfinite(piece.position[i].x + piece.position[i].y + piece.position[i].z));
      ASSERT_NEAR(glm::length(piece.normal[i]), 1.0f, 1e-4f);
      int sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        sum += piece.weights[i].share[k];
        ASSERT_LT(piece.weights[i].joint[k], kJointCount);
      }
      ASSERT_EQ(sum, 65535);
    }
    for (const std::uint32_t v : piece.triangles) ASSERT_LT(v, piece.position.size());
  }
}

TEST_P(Bodies, EveryPieceIsClosedAndTurnedOutward) {
  const Mannequin mannequin = make_mannequin(make_body(GetParam()));
  for (const MannequinPiece& piece : mannequin.pieces) {
    SCOPED_TRACE(name_of(piece.region));
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> walks;
    double volume = 0;
    for (std::size_t i = 0; i < piece.triangles.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = piece.triangles[i + k], b = piece.triangles[i + (k + 1) % 3];
        walks[std::minmax(a, b)] += a < b ? 1 : -1;
      }
      volume += glm::dot(piece.position[piece.triangles[i]],
                         glm::cross(piece.position[piece.triangles[i + 1]],
                                    piece.position[piece.triangles[i + 2]])) /
                6.0;
    }
    EXPECT_TRUE(
        std::all_of(walks.begin(), walks.end(), [](const auto& w) { return w.second == 0; }));
    EXPECT_GT(volume, 0);
  }
}

TEST_P(Bodies, LeftAndRightAreMirrored) {
  const Mannequin mannequin = make_mannequin(make_body(GetParam()));
  const auto key = [](Vec3 p, float side) {
    const auto grid = [](float v) { return std::lround(v * 20000.0f); };
    return std::tuple(grid(side * p.x), grid(p.y), grid(p.z));
  };
  for (const MannequinPiece& piece : mannequin.pieces) {
    SCOPED_TRACE(name_of(piece.region));
    std::set<std::tuple<long, long, long>> places;
    for (const Vec3& p : piece.position) places.insert(key(p, 1));
    std::size_t matched = 0;
    for (const Vec3& p : piece.position) matched += places.count(key(p, -1));
    // Rounding of the key may part a few pairs.
    EXPECT_GE(matched, piece.position.size() - piece.position.size() / 200);
  }
}

TEST(Mannequin, WeighsAboutWhatTheBodyWeighs) {
  // Volume of the skin, gloves aside, times the density of a body (1.0 kg/l) against the mass.
  for (const BodySpec& spec :
       {BodySpec{"a", 1.78f, 75.0f, Sex::male, 1.0f}, BodySpec{"b", 1.90f, 98.0f, Sex::male, 1.0f},
        BodySpec{"c", 1.65f, 56.0f, Sex::female, 1.0f}}) {
    const Mannequin mannequin = make_mannequin(make_body(spec));
    const MannequinPiece& skin = mannequin.pieces.front();
    double volume = 0;
    for (std::size_t i = 0; i < skin.triangles.size(); i += 3) {
      volume += glm::dot(skin.position[skin.triangles[i]],
                         glm::cross(skin.position[skin.triangles[i + 1]],
                                    skin.position[skin.triangles[i + 2]])) /
                6.0;
    }
    EXPECT_NEAR(1000.0 * volume, spec.mass, 0.15 * spec.mass) << spec.name;
  }
}

TEST(Mannequin, HeavierIsThickerAndNoTaller) {
  const auto girth = [](float mass) {
    const Mannequin mannequin = make_mannequin(make_body({"x", 1.78f, mass, Sex::male, 1.0f}));
    float widest = 0;
    for (const Vec3& p : mannequin.pieces.front().position) {
      if (p.y > 1.0f && p.y < 1.2f) widest = std::max(widest, p.x);
    }
    return widest;
  };
  const float light = girth(60), heavy = girth(110);
  EXPECT_GT(heavy, 1.2f * light);
  EXPECT_LT(heavy, 1.6f * light);
}

TEST(Mannequin, ArmsDoNotDragTheRibsNorThighsEachOther) {
  const BodyModel body = make_body({"x", 1.78f, 75.0f, Sex::male, 1.0f});
  const Mannequin mannequin = make_mannequin(body);
  const WorldPose rest = world_pose(body.skeleton, rest_pose(body.skeleton));
  const float hip = rest.position[index(Joint::left_upper_leg)].y;
  const float armpit = rest.position[index(Joint::left_upper_arm)].y - 0.16f;
  const auto share_of = [](const SkinWeights& weights, Joint joint) {
    int share = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (weights.joint[k] == index(joint)) share += weights.share[k];
    }
    return static_cast<float>(share) / 65535.0f;
  };
  for (const MannequinPiece& piece : mannequin.pieces) {
    for (std::size_t i = 0; i < piece.position.size(); ++i) {
      const Vec3 p = piece.position[i];
      const SkinWeights& w = piece.weights[i];
      if (p.y < armpit) {
        EXPECT_LT(share_of(w, Joint::left_upper_arm) + share_of(w, Joint::right_upper_arm), 0.05f);
      }
      if (p.y < hip - 0.2f && p.x > 0.04f) {
        EXPECT_EQ(share_of(w, Joint::right_upper_leg), 0.0f);
      }
      if (p.y < hip - 0.2f && p.x < -0.04f) {
        EXPECT_EQ(share_of(w, Joint::left_upper_leg), 0.0f);
      }
    }
  }
}

// The girth of a limb at its bent joint, measured on the skinned vertices, must not collapse.
TEST(Mannequin, BentKneesAndElbowsKeepTheirVolume) {
  const BodyModel body = make_body({"x", 1.78f, 75.0f, Sex::male, 1.0f});
  const Mannequin mannequin = make_mannequin(body);
  const MannequinPiece& skin = mannequin.pieces.front();
  Pose pose = rest_pose(body.skeleton);
  pose.rotation[index(Joint::left_lower_arm)] = glm::angleAxis(radians(-120), kUp);
  pose.rotation[index(Joint::left_lower_leg)] = glm::angleAxis(radians(120), kLeft);
  const WorldPose rest = world_pose(body.skeleton, rest_pose(body.skeleton));
  const WorldPose bent = world_pose(body.skeleton, pose);
  for (const Joint joint : {Joint::left_lower_arm, Joint::left_lower_leg}) {
    const Vec3 before = rest.position[index(joint)], after = bent.position[index(joint)];
    float widest_before = 0, widest_after = 0;
    for (std::size_t i = 0; i < skin.position.size(); ++i) {
      const Vec3 p = skin.position[i];
      if (glm::distance(p, before) > 0.075f) continue;
      Vec3 moved{};
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t j = skin.weights[i].joint[k];
        moved += skin.weights[i].share[k] / 65535.0f *
                 (bent.position[j] + bent.rotation[j] * (p - rest.position[j]));
      }
      // Across the plane of the bend nothing shrinks; out of the joint the cap stays on.
      widest_before = std::max(widest_before, glm::distance(p, before));
      widest_after = std::max(widest_after, glm::distance(moved, after));
    }
    EXPECT_GT(widest_after, 0.65f * widest_before) << vrm_name(joint);
  }
}

TEST(Mannequin, IsTheSameEveryTimeAndMadeOnce) {
  const BodyModel body = make_body({"x", 1.70f, 66.0f, Sex::male, 1.0f});
  const Mannequin first = make_mannequin(body), second = make_mannequin(body);
  ASSERT_EQ(first.pieces.size(), second.pieces.size());
  for (std::size_t i = 0; i < first.pieces.size(); ++i) {
    EXPECT_TRUE(first.pieces[i].position == second.pieces[i].position);
    EXPECT_TRUE(first.pieces[i].normal == second.pieces[i].normal);
    EXPECT_TRUE(first.pieces[i].triangles == second.pieces[i].triangles);
  }
  EXPECT_EQ(mannequin_of(body).get(), mannequin_of(body).get());
}

TEST(Mannequin, AWomanWearsATopAndAManDoesNot) {
  const auto highest_cloth = [](Sex sex) {
    const Mannequin mannequin = make_mannequin(make_body({"x", 1.70f, 62.0f, sex, 1.0f}));
    float highest = 0;
    for (const MannequinPiece& piece : mannequin.pieces) {
      if (piece.region != Region::shorts) continue;
      for (const Vec3& p : piece.position) highest = std::max(highest, p.y);
    }
    return highest;
  };
  EXPECT_GT(highest_cloth(Sex::female), 1.3f);
  EXPECT_LT(highest_cloth(Sex::male), 1.1f);
}

}  // namespace
}  // namespace ringcraft
