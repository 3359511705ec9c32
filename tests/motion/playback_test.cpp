#include "motion/playback.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "motion/ik.h"
#include "motion/pose_near.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

constexpr std::array<Side, 2> kSides = {Side::left, Side::right};

// What is shown, tick by tick.
struct Shown {
  std::vector<Pose> poses;
  std::vector<WorldPose> world;
  std::vector<FootContacts> held;

  void add(const Playback& playback) {
    poses.push_back(playback.shown());
    world.push_back(world_pose(kSkeleton, playback.shown()));
    held.push_back(playback.held());
  }
  std::size_t size() const { return poses.size(); }
  Vec3 at(std::size_t tick, Joint joint) const { return world[tick].position[index(joint)]; }
};

// Plays `clip` at `start` for `count` ticks from its first frame on, stitched to what is shown.
void play(Playback& playback, const Clip& clip, const Placement& start, Tick count, Shown& shown) {
  playback.stitch(placed(clip.at(0), start), placed(clip.at(1), start));
  for (Tick tick = 0; tick < count; ++tick) {
    playback.next(placed(clip.at(tick), start), clip.contacts_at(tick));
    shown.add(playback);
  }
}

// Largest change of a joint's velocity between two frames at 60 Hz, m/s.
float velocity_jump(const Shown& shown, std::size_t from, std::size_t to) {
  float largest = 0;
  for (std::size_t t = std::max<std::size_t>(from, 4); t < std::min(to, shown.size()); ++t) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Vec3 a = shown.world[t - 4].position[j], b = shown.world[t - 2].position[j],
                 c = shown.world[t].position[j];
      largest = std::max(largest, glm::length(c - 2.0f * b + a) * 60);
    }
  }
  return largest;
}
float velocity_jump(const Shown& shown) {
  return velocity_jump(shown, 0, shown.size());
}

// Largest distance of a joint from where it would be had it gone on as before, m.
float position_jump(const Shown& shown) {
  float largest = 0;
  for (std::size_t t = 2; t < shown.size(); ++t) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Vec3 a = shown.world[t - 2].position[j], b = shown.world[t - 1].position[j],
                 c = shown.world[t].position[j];
      largest = std::max(largest, glm::length(c - 2.0f * b + a));
    }
  }
  return largest;
}

// The same of the clip alone.
Shown alone(const Clip& clip) {
  Shown shown;
  for (const Pose& pose : clip.frames) {
    shown.poses.push_back(pose);
    shown.world.push_back(world_pose(kSkeleton, pose));
  }
  return shown;
}

// Foot skate after docs/sources.md, V4, at 60 Hz: ankle and toes within 3 cm of their standing
// height while the slower of the two moves at 0.15-0.8 m/s over the ground, for 0.15 s on end.
float skate_ratio(const Shown& shown) {
  std::size_t skating = 0, total = 0;
  for (const Side side : kSides) {
    const Joint ankle = leg(side).end, ball = toes(side);
    std::size_t run = 0;
    for (std::size_t t = 2; t < shown.size(); t += 2) {
      const auto speed = [&](Joint joint) {
        const Vec3 v = shown.at(t, joint) - shown.at(t - 2, joint);
        return 60 * glm::length(Vec3(v.x, 0, v.z));
      };
      const bool low = shown.at(t, ankle).y < kSkeleton.ankle_height() + 0.03f &&
                       shown.at(t, ball).y < kSkeleton.toe_height() + 0.03f;
      const float slower = std::min(speed(ankle), speed(ball));
      run = low && slower > 0.15f && slower < 0.8f ? run + 1 : 0;
      if (run == 9) skating += 9;
      if (run > 9) ++skating;
      ++total;
    }
  }
  return static_cast<float>(skating) / static_cast<float>(total);
}

// Largest way of a ball of the foot within one tick while it is held, m.
float held_motion(const Shown& shown) {
  float largest = 0;
  for (std::size_t t = 1; t < shown.size(); ++t) {
    for (const Side side : kSides) {
      if (!shown.held[t].of(side) || !shown.held[t - 1].of(side)) continue;
      largest =
          std::max(largest, glm::distance(shown.at(t, toes(side)), shown.at(t - 1, toes(side))));
    }
  }
  return largest;
}

// Deepest a sole goes under the floor, m: ball, heel and tip of the toes.
float deepest_sole(const Shown& shown) {
  float deepest = 0;
  for (std::size_t t = 0; t < shown.size(); ++t) {
    for (const Side side : kSides) {
      const std::size_t ankle = index(leg(side).end), ball = index(toes(side));
      const WorldPose& w = shown.world[t];
      const Vec3 heel = w.position[ankle] - w.rotation[ankle] * (kUp * kSkeleton.ankle_height());
      const Vec3 tip = w.position[ball] + w.rotation[ball] * (kForward * 0.07f);
      deepest = std::max(deepest, kSkeleton.toe_height() - w.position[ball].y);
      deepest = std::max(deepest, -heel.y);
      deepest = std::max(deepest, kSkeleton.toe_height() - tip.y);
    }
  }
  return deepest;
}

// Largest change of a knee's flexion within one tick, rad.
float knee_speed(const Shown& shown) {
  float largest = 0;
  for (std::size_t t = 1; t < shown.size(); ++t) {
    for (const Side side : kSides) {
      const std::size_t knee = index(leg(side).middle);
      const Quat change =
          shown.poses[t].rotation[knee] * glm::inverse(shown.poses[t - 1].rotation[knee]);
      largest = std::max(largest, glm::length(rotation_vector(change)));
    }
  }
  return largest;
}

// Least flexion of an elbow about its hinge, rad.
float least_elbow(const Shown& shown) {
  float least = kPi;
  for (const Pose& pose : shown.poses) {
    for (const Side side : kSides) {
      const Vec3 turn = rotation_vector(pose.rotation[index(arm(side).middle)]);
      least = std::min(least, glm::dot(turn, hinge_axis(arm(side))));
    }
  }
  return least;
}

constexpr float kAddedJump = 1.5f;  // m/s within 1/60 s that a seam may add to the clips' own
constexpr float kStill = 0.001f;    // m within a tick

const std::vector<Clip>& boxing_clips() {
  static const std::vector<Clip> clips = {test::idle_clip(kSkeleton), test::jab_clip(kSkeleton),
                                          test::step_clip(kSkeleton, {0, 0, 0.15f}),
                                          test::step_clip(kSkeleton, {0.1f, 0, -0.1f})};
  return clips;
}

// Clips in a row, each where the last one ended but for an error like those of the state machine's
// edges, and each broken off after a random share of its length if `broken`.
Shown random_chain(std::uint64_t seed, int count, bool broken) {
  Random random(seed);
  Playback playback(kSkeleton);
  Shown shown;
  Placement at;
  for (int i = 0; i < count; ++i) {
    const Clip& clip = boxing_clips()[static_cast<std::size_t>(random.below(4))];
    const Tick ticks = broken ? 6 + random.below(clip.length() - 6) : clip.length();
    play(playback, clip, at, ticks, shown);
    const Placement error{random.uniform(-0.06f, 0.06f), random.uniform(-0.06f, 0.06f),
                          random.uniform(-0.2f, 0.2f)};
    at = at * clip.root_at(ticks) * error;
  }
  return shown;
}

TEST(Playback, ADecayStartsWithItsValueAndVelocityAndEndsAtRest) {
  Decay decay({0.2f, 0, -0.1f}, {1, -2, 0.5f}, 0.24f);
  EXPECT_POINT_NEAR(decay.value(), Vec3(0.2f, 0, -0.1f), 1e-4f);
  Decay next = decay;
  next.step(1e-4f);
  EXPECT_POINT_NEAR((next.value() - decay.value()) / 1e-4f, Vec3(1, -2, 0.5f), 1.0f);
  next.step(0.2398f);
  const Vec3 before = next.value();
  EXPECT_POINT_NEAR(before, Vec3(), 1e-3f);
  next.step(5e-5f);
  EXPECT_POINT_NEAR((next.value() - before) / 5e-5f, Vec3(), 1.0f);
  next.step(0.01f);
  EXPECT_TRUE(next.done());
  EXPECT_EQ(next.value(), Vec3());
}

// The least that gets there in the time: 4 x / T^2 from rest to rest, (1 + sqrt 2) v / T to be back
// with a speed taken off. Bollo's quintic takes 5.8 and 3.9.
TEST(Playback, ADecayTakesTheLeastAcceleration) {
  const auto most = [](Decay decay) {
    constexpr float kStep = 5e-3f;
    float acceleration = 0;
    std::array<float, 3> x{};
    for (int i = 0; i < 200; ++i) {
      x = {x[1], x[2], decay.value().x};
      decay.step(kStep);
      if (i > 1) acceleration = std::max(acceleration, std::abs(x[0] - 2 * x[1] + x[2]));
    }
    return acceleration / (kStep * kStep);
  };
  EXPECT_NEAR(most({Vec3{1, 0, 0}, Vec3{}, 1}), 4, .1f);
  EXPECT_NEAR(most({Vec3{}, Vec3{1, 0, 0}, 1}), 2.41f, .1f);
}

TEST(Playback, AVelocityThatIsGoneSoonerCarriesLessFar) {
  const auto farthest = [](Decay decay) {
    float far = 0;
    for (; !decay.done(); decay.step(kTickSeconds)) far = std::max(far, decay.value().x);
    return far;
  };
  const float whole = farthest({Vec3{}, {3, 0, 0}, 0.6f}),
              sooner = farthest({Vec3{}, {3, 0, 0}, 0.6f, 0.2f});
  EXPECT_NEAR(sooner, whole / 3, 0.02f * whole);
  Decay decay({1, 0, 0}, {3, 0, 0}, 0.6f, 0.2f);
  EXPECT_NEAR(decay.value().x, 1, 1e-5f);
  decay.step(0.599f);
  EXPECT_NEAR(decay.value().x, 0, 1e-4f);
}

TEST(Playback, ShowsAClipAsItIsWhereNothingNeedsMending) {
  const Clip kick = test::kick_clip(kSkeleton);
  std::vector<Clip> clips = boxing_clips();
  clips.push_back(kick);
  for (const Clip& clip : clips) {
    Playback playback(kSkeleton);
    Shown shown;
    play(playback, clip, {0.3f, -1, 2}, clip.length() + 1, shown);
    for (Tick tick = 0; tick <= clip.length(); ++tick) {
      EXPECT_POSE_NEAR(kSkeleton, shown.poses[static_cast<std::size_t>(tick)],
                       placed(clip.at(tick), {0.3f, -1, 2}), 0.3f);
    }
  }
}

TEST(Playback, ASeamNeitherJumpsNorJerks) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Shown shown = random_chain(seed, 12, false);
    EXPECT_LT(position_jump(shown), 0.02f) << "seed " << seed;
    EXPECT_LT(velocity_jump(shown), kAddedJump) << "seed " << seed;
  }
}

TEST(Playback, AClipBrokenOffInTheMiddleOfABlendNeitherJumpsNorJerks) {
  float clips = 0;
  for (const Clip& clip : boxing_clips()) clips = std::max(clips, velocity_jump(alone(clip)));
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Shown shown = random_chain(seed, 20, true);
    EXPECT_LT(position_jump(shown), 0.02f) << "seed " << seed;
    EXPECT_LT(velocity_jump(shown), clips + kAddedJump) << "seed " << seed;
  }
}

TEST(Playback, HeldFeetStandStillAndNothingSkates) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    for (const bool broken : {false, true}) {
      const Shown shown = random_chain(seed, 20, broken);
      EXPECT_LT(held_motion(shown), kStill) << "seed " << seed;
      // Clips played out never skate. Broken off at random every 0.3 s, a foot may be caught low.
      EXPECT_LE(skate_ratio(shown), broken ? 0.02f : 0.0f) << "seed " << seed;
    }
  }
}

TEST(Playback, OneFootCarriesWhileTheOtherIsMoved) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Shown shown = random_chain(seed, 20, false);
    std::size_t both_moved = 0;
    for (std::size_t t = 1; t < shown.size(); ++t) {
      const auto moved = [&](Side side) {
        return glm::distance(shown.at(t, toes(side)), shown.at(t - 1, toes(side))) > kStill;
      };
      both_moved += moved(Side::left) && moved(Side::right);
    }
    EXPECT_LT(both_moved, shown.size() / 50) << "seed " << seed;
  }
}

TEST(Playback, SolesStayAboveTheFloor) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EXPECT_LT(deepest_sole(random_chain(seed, 20, true)), 0.002f) << "seed " << seed;
  }
  // Even of a clip that wades.
  Clip wading = test::jab_clip(kSkeleton);
  for (Pose& pose : wading.frames) pose.hips.y -= 0.06f;
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, wading, {}, wading.length(), shown);
  EXPECT_LT(deepest_sole(shown), 0.002f);
}

TEST(Playback, AFootLeftBehindTakesAStepAndArrives) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, idle, {}, 30, shown);
  const Placement there{0.1f, 0.12f, 0.3f};
  play(playback, idle, there, 150, shown);
  const WorldPose wanted = world_pose(kSkeleton, placed(idle.at(149), there));
  for (const Side side : kSides) {
    float lift = 0;
    for (std::size_t t = 0; t < shown.size(); ++t) {
      lift = std::max(lift, shown.at(t, toes(side)).y - kSkeleton.toe_height());
    }
    EXPECT_GT(lift, 0.03f);
    EXPECT_LT(lift, 0.08f);
    EXPECT_POINT_NEAR(shown.world.back().position[index(toes(side))],
                      wanted.position[index(toes(side))], 0.5f);
  }
  EXPECT_LT(held_motion(shown), kStill);
  EXPECT_EQ(skate_ratio(shown), 0);
  EXPECT_LT(velocity_jump(shown), kAddedJump);
}

// What holds a foot off its way (the range of its leg) is not there any more once a new motion has
// begun from what is shown.
TEST(Playback, AStepThatWasHeldOffItsWayGoesOnFromWhereItIsShown) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, idle, {}, 30, shown);
  const Placement there{0.1f, 0.12f, 0.3f};
  playback.stitch(placed(idle.at(0), there), placed(idle.at(1), there));
  constexpr Tick kHeldOff = 14;
  float lifted = 0;
  for (Tick t = 0; t < kHeldOff; ++t) {
    Pose pose = playback.next(placed(idle.at(t), there), idle.contacts_at(t));
    const float off = .04f * glm::smoothstep(0.0f, 1.0f, static_cast<float>(t) / kHeldOff);
    for (const Side side : kSides) {
      if (playback.held().of(side)) continue;
      const WorldPose world = world_pose(kSkeleton, pose);
      lifted = std::max(lifted, world.position[index(toes(side))].y - kSkeleton.toe_height());
      const Vec3 ankle = world.position[index(leg(side).end)];
      move_limb_end(kSkeleton, leg(side), ankle + kUp * off, 1, pose);
      set_world_rotation(kSkeleton, leg(side).end, world.rotation[index(leg(side).end)], pose);
    }
    playback.amend(pose);
    shown.add(playback);
  }
  ASSERT_GT(lifted, .03f);
  play(playback, idle, {0.08f, 0.1f, 0.2f}, 150, shown);
  EXPECT_LT(velocity_jump(shown, 30 + kHeldOff, 30 + kHeldOff + 6), kAddedJump);
  EXPECT_LT(held_motion(shown), kStill);
}

TEST(Playback, AFootThatIsNearEnoughStaysWhereItIs) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, idle, {}, 30, shown);
  play(playback, idle, {0.03f, 0.02f, 0}, 150, shown);
  for (const Side side : kSides) {
    EXPECT_POINT_NEAR(shown.at(shown.size() - 1, toes(side)), shown.at(0, toes(side)), 0.1f);
  }
}

TEST(Playback, AFootInTheAirLandsWhereTheNewClipStandsOnIt) {
  const Clip kick = test::kick_clip(kSkeleton), idle = test::idle_clip(kSkeleton, 240);
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, kick, {}, kick.length() / 2, shown);
  ASSERT_GT(shown.at(shown.size() - 1, Joint::right_toes).y, 0.5f);
  play(playback, idle, {}, 120, shown);
  EXPECT_LT(position_jump(shown), 0.02f);
  EXPECT_LT(velocity_jump(shown), velocity_jump(alone(kick)) + kAddedJump);
  EXPECT_TRUE(shown.held.back().right);
  EXPECT_POINT_NEAR(shown.world.back().position[index(Joint::right_toes)],
                    world_pose(kSkeleton, idle.at(119)).position[index(Joint::right_toes)], 0.5f);
  EXPECT_EQ(skate_ratio(shown), 0);
  EXPECT_LT(deepest_sole(shown), 0.002f);
}

// The left foot comes down fast, from behind.
Clip comes_down() {
  return test::clip_of(
      kSkeleton, 60,
      [](float t) {
        test::Stance stance;
        stance.left_ball += Vec3{0, 0.5f, -0.7f} * (1 - t);
        return stance;
      },
      [](float) {
        return FootContacts{false, true};
      },
      test::in_place);
}

// A foot that is nearly down and goes too fast to stand takes a step that clears the floor.
TEST(Playback, AFootThatComesDownFastDoesNotSkimTheFloor) {
  const Clip stands = test::clip_of(
      kSkeleton, 60,
      [](float) {
        test::Stance stance;
        stance.left_ball.z += 0.15f;
        return stance;
      },
      test::both, test::in_place);
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, comes_down(), {}, 56, shown);
  play(playback, stands, {}, 60, shown);
  const auto left = [&](std::size_t t) {
    const Vec3 ahead = shown.world.back().position[index(Joint::left_toes)];
    return std::abs(ahead.z - shown.at(t, Joint::left_toes).z);
  };
  for (std::size_t t = 56; left(t) > 0.05f; ++t) {
    EXPECT_GT(shown.at(t, Joint::left_toes).y, kSkeleton.toe_height() + 0.015f) << t;
  }
  EXPECT_TRUE(shown.held.back().left);
  EXPECT_EQ(skate_ratio(shown), 0);
}

// A step of its own that comes down just when the clip lifts the foot: the floor stops it, and it
// goes up as the clip's does instead of along the floor.
TEST(Playback, AFootThatComesDownAsTheClipLiftsItIsNotDraggedOff) {
  constexpr Tick kLength = 120, kSwing = 24;
  float lowest = 1;
  for (Tick lifts = 10; lifts <= 34; ++lifts) {
    const auto swung = [&](float t) {
      return (t * kLength - static_cast<float>(lifts)) / static_cast<float>(kSwing);
    };
    const Clip steps = test::clip_of(
        kSkeleton, kLength,
        [&](float t) {
          test::Stance stance;
          const float s = swung(t);
          stance.left_ball +=
              Vec3{0.03f, 0.045f * test::bump(s, 0, 1), 0.14f - 0.24f * test::ramp(s, 0, 1)};
          return stance;
        },
        [&](float t) {
          const float s = swung(t);
          return FootContacts{s <= 0 || s >= 1, true};
        },
        test::in_place);
    Playback playback(kSkeleton);
    Shown shown;
    play(playback, comes_down(), {}, 56, shown);
    play(playback, steps, {}, kLength, shown);
    const auto over = [&](Tick tick) {
      return shown.at(static_cast<std::size_t>(56 + tick), Joint::left_toes).y -
             kSkeleton.toe_height();
    };
    lowest = std::min(lowest, over(lifts + kSwing / 2));
    EXPECT_EQ(skate_ratio(shown), 0) << lifts;
  }
  EXPECT_GT(lowest, 0.02f);
}

TEST(Playback, HipsSinkRatherThanAFootIsDragged) {
  // The clip stands up so tall that a foot held a little to the side is out of reach.
  const Clip tall = test::clip_of(
      kSkeleton, 120,
      [](float t) {
        test::Stance stance;
        stance.right_heel = 0;
        stance.hips.y = 0.84f + 0.075f * test::ramp(t, 0.2f, 0.6f);
        stance.left_ball = {0.1f, 0, 0.15f};
        stance.right_ball = {-0.1f, 0, -0.15f};
        return stance;
      },
      test::both, test::in_place);
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, tall, {}, 12, shown);
  play(playback, tall, {0, 0.05f, 0}, 120, shown);
  float sunk = 0;
  for (std::size_t t = 12; t < shown.size(); ++t) {
    sunk = std::max(sunk, tall.at(static_cast<Tick>(t) - 12).hips.y - shown.poses[t].hips.y);
    for (const Side side : kSides) {
      EXPECT_POINT_NEAR(shown.at(t, toes(side)), shown.at(0, toes(side)), 0.1f);
    }
  }
  EXPECT_GT(sunk, 0.01f);
  EXPECT_LT(knee_speed(shown), 0.1f);
  EXPECT_LT(velocity_jump(shown), kAddedJump);
}

TEST(Playback, AFootOutOfReachIsLetGoWhileTheOtherIsInTheAir) {
  // The clip stands on its left foot for a second, three quarters of a metre from where that
  // stands.
  const Clip one_leg = test::clip_of(
      kSkeleton, 120,
      [](float) {
        test::Stance stance;
        stance.right_ball.y += 0.3f;
        return stance;
      },
      [](float) {
        return FootContacts{true, false};
      },
      test::in_place);
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, one_leg, {}, 12, shown);
  const Placement there{0.3f, 0.7f, 0};
  play(playback, one_leg, there, 120, shown);
  float sunk = 0;
  for (std::size_t t = 12; t < shown.size(); ++t) {
    sunk = std::max(sunk, one_leg.at(0).hips.y - shown.poses[t].hips.y);
  }
  EXPECT_LT(sunk, 0.25f);
  const Vec3 wanted = placed(one_leg.at(119), there).hips;
  EXPECT_POINT_NEAR(shown.poses.back().hips, wanted, 0.5f);
  EXPECT_LT(deepest_sole(shown), 0.002f);
  EXPECT_LT(held_motion(shown), kStill);
}

// It comes down in 0.1 s, beside the right one or alone.
Clip left_foot_lands(bool right_stands) {
  return test::clip_of(
      kSkeleton, 60,
      [=](float t) {
        test::Stance stance;
        stance.left_ball.y += 0.1f * (1 - test::ramp(t, 0, 0.2f));
        if (!right_stands) stance.right_ball.y += 0.3f;
        return stance;
      },
      [=](float t) {
        return FootContacts{t > 0.15f, right_stands};
      },
      test::in_place);
}

// The foot that comes down is the only one that is to carry, and another body stands where it does.
TEST(Playback, HipsSinkBitByBitForAFootThatStandsAside) {
  const Clip lands = left_foot_lands(false);
  Playback playback(kSkeleton);
  Shown shown;
  bool aside = false;
  for (Tick t = 0; t < lands.length(); ++t) {
    playback.next(lands.at(t), lands.contacts_at(t));
    shown.add(playback);
    if (aside || !playback.presses_down(Side::left)) continue;
    aside = true;
    playback.stand_aside(Side::left, {0.4f, 0, 0});
  }
  EXPECT_TRUE(aside);
  float fastest = 0;  // m/s
  for (std::size_t t = 1; t < shown.size(); ++t) {
    fastest = std::max(fastest, (shown.poses[t - 1].hips.y - shown.poses[t].hips.y) / kTickSeconds);
  }
  EXPECT_LT(fastest, 2);
}

// It is still coming down when it has to step on: it would stand at once where it may not stay.
TEST(Playback, AFootThatMayNotStayIsLiftedThoughItPressesDown) {
  const Clip lands = left_foot_lands(true);
  constexpr float kNearlyDown = 0.008f;  // m
  Playback playback(kSkeleton);
  Shown shown;
  bool aside = false, strained = false;
  for (Tick t = 0; t < lands.length(); ++t) {
    playback.next(lands.at(t), lands.contacts_at(t));
    shown.add(playback);
    const float height = shown.at(shown.size() - 1, Joint::left_toes).y - kSkeleton.toe_height();
    if (!playback.presses_down(Side::left)) continue;
    if (!aside) playback.stand_aside(Side::left, {0.05f, 0, 0});
    aside = true;
    if (height > kNearlyDown || strained) continue;
    playback.strain(Side::left);
    strained = true;
  }
  EXPECT_TRUE(strained);
  const WorldPose clip = world_pose(kSkeleton, lands.at(lands.length() - 1));
  EXPECT_POINT_NEAR(shown.at(shown.size() - 1, Joint::left_toes),
                    clip.position[index(Joint::left_toes)], 0.1f);
}

TEST(Playback, KneesDoNotPop) {
  float clips = 0;
  for (const Clip& clip : boxing_clips()) {
    Shown shown = alone(clip);
    clips = std::max(clips, knee_speed(shown));
  }
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EXPECT_LT(knee_speed(random_chain(seed, 20, true)), clips + 0.08f) << "seed " << seed;
  }
}

// The knee of a leg that is nearly straight goes far where its foot goes little: uneased, it jumps
// by 1.1 m/s here.
TEST(Playback, TheKneeOfANearlyStraightLegStartsAndStopsGently) {
  const auto left_foot = [](float from, float to, bool planted) {
    return test::clip_of(
        kSkeleton, 60,
        [=](float t) {
          test::Stance stance;
          stance.right_heel = 0;
          stance.hips.y = 0.915f;
          stance.left_ball = {0.1f, glm::mix(from, to, t), 0.1f};
          stance.right_ball = {-0.1f, 0, -0.1f};
          return stance;
        },
        [=](float) {
          return FootContacts{planted, true};
        },
        test::in_place);
  };
  for (const float height : {0.15f, 0.3f}) {
    Playback playback(kSkeleton);
    Shown shown;
    play(playback, left_foot(height, 0, false), {}, 57, shown);
    play(playback, left_foot(0, 0, true), {}, 30, shown);
    play(playback, left_foot(0, height, false), {}, 57, shown);
    EXPECT_LT(velocity_jump(shown), 0.8f) << height;
  }
}

TEST(Playback, ElbowsDoNotBendBackwardsWhenAPunchIsBrokenOff) {
  const Clip jab = test::jab_clip(kSkeleton, 40), idle = test::idle_clip(kSkeleton);
  for (Tick ticks = 4; ticks < 40; ticks += 2) {
    Playback playback(kSkeleton);
    Shown shown;
    play(playback, idle, {}, 20, shown);
    play(playback, jab, {}, ticks, shown);
    play(playback, idle, {0.05f, 0, 0.1f}, 60, shown);
    EXPECT_GT(least_elbow(shown), 0) << "broken off at " << ticks;
    EXPECT_LT(position_jump(shown), 0.02f) << "broken off at " << ticks;
  }
}

// From a hand that hangs behind the hip to one before the chin: in a line it would pass the
// shoulder, and the elbow would be thrown aside.
TEST(Playback, AnArmWhoseHandWouldPassItsShoulderGoesByItsJoints) {
  const Clip idle = test::idle_clip(kSkeleton);
  Clip low = idle;
  for (Pose& pose : low.frames) {
    const WorldPose world = world_pose(kSkeleton, pose);
    const Vec3 shoulder = world.position[index(Joint::left_upper_arm)];
    move_limb_end(kSkeleton, arm(Side::left), shoulder + Vec3{.05f, -.28f, -.06f}, 1, pose);
  }
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, low, {}, 30, shown);
  play(playback, idle, {}, 60, shown);
  EXPECT_LT(velocity_jump(shown), kAddedJump);
  EXPECT_LT(position_jump(shown), 0.02f);
}

TEST(Playback, AFlatSoleLiesFlatWhileItIsHeld) {
  const auto standing = [](float left_heel, float left_yaw) {
    return test::clip_of(
        kSkeleton, 120,
        [=](float) {
          test::Stance stance;
          stance.left_heel = left_heel;
          stance.left_yaw = left_yaw;
          return stance;
        },
        test::both, test::in_place);
  };
  const auto tilt = [](const Shown& shown, std::size_t t) {
    return std::acos(std::min(1.0f, (shown.world[t].rotation[index(Joint::left_foot)] * kUp).y));
  };
  {  // Flat before and after, turned in between: flat all the time, while the hips rise and turn.
    Playback playback(kSkeleton);
    Shown shown;
    play(playback, standing(0, -0.1f), {}, 20, shown);
    play(playback, standing(0, 0.5f), {0.02f, 0.03f, 0.2f}, 60, shown);
    for (std::size_t t = 0; t < shown.size(); ++t) EXPECT_LT(tilt(shown, t), 0.01f) << t;
  }
  {  // The heel is up before: down as soon as the blend is over.
    Playback playback(kSkeleton);
    Shown shown;
    play(playback, standing(0.5f, -0.1f), {}, 20, shown);
    EXPECT_NEAR(tilt(shown, 19), 0.5f, 0.01f);
    play(playback, standing(0, -0.1f), {0.02f, 0.03f, 0.2f}, 60, shown);
    EXPECT_LT(tilt(shown, 20 + static_cast<std::size_t>(ticks(PlaybackSettings().blend_seconds))),
              0.01f);
    EXPECT_LT(deepest_sole(shown), 0.002f);
  }
}

// A body thrown back from `start`: the hips fly and sink, the trunk bends, an arm swings.
std::vector<Pose> thrown(const Pose& start, Vec3 velocity, float spin, Tick count) {
  std::vector<Pose> poses;
  for (Tick tick = 1; tick <= count; ++tick) {
    const float t = static_cast<float>(tick) * kTickSeconds, s = t * t / (t + 0.05f);
    Pose pose = start;
    pose.hips += velocity * s;
    pose.rotation[0] = glm::angleAxis(-0.3f * spin * s, kLeft) * pose.rotation[0];
    pose.rotation[index(Joint::chest)] =
        glm::angleAxis(-spin * s, kLeft) * pose.rotation[index(Joint::chest)];
    pose.rotation[index(Joint::left_upper_arm)] =
        glm::angleAxis(spin * s, kForward) * pose.rotation[index(Joint::left_upper_arm)];
    poses.push_back(pose);
  }
  return poses;
}

// A simulation leaves the body at rest.
void leave(Playback& playback, const Pose& pose, Shown& shown) {
  for (int i = 0; i < 5; ++i) {
    playback.next_simulated(pose);
    shown.add(playback);
  }
}

TEST(Playback, AfterASimulationTheBodyGoesOnFromItsPoseAndVelocity) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  for (const float spin : {1.0f, 3.0f, -2.0f}) {
    for (const Vec3& velocity : {Vec3(0, -0.1f, -0.8f), Vec3(0.7f, -0.3f, -0.2f)}) {
      Playback playback(kSkeleton);
      Shown shown;
      play(playback, idle, {}, 20, shown);
      for (const Pose& pose : thrown(playback.shown(), velocity, spin, 24)) {
        playback.next_simulated(pose);
        shown.add(playback);
        EXPECT_POSE_NEAR(kSkeleton, playback.shown(), pose, 0);
        EXPECT_EQ(playback.held(), FootContacts());
      }
      play(playback, idle, {0.1f * velocity.x, 0.1f * velocity.z, 0.2f}, 160, shown);
      EXPECT_LT(position_jump(shown), 0.02f);
      EXPECT_LT(velocity_jump(shown, 44, shown.size()), kAddedJump);
      EXPECT_EQ(shown.held.back(), (FootContacts{true, true}));
      EXPECT_LT(held_motion(shown), kStill);
    }
  }
}

TEST(Playback, ASpinningBodyGoesOnRoundAndStaysUpright) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  for (const float spin : {8.0f, 13.0f}) {  // rad/s
    Playback playback(kSkeleton);
    Shown shown;
    for (Tick tick = -12; tick <= 0; ++tick) {
      const float yaw = radians(160) + spin * static_cast<float>(tick) * kTickSeconds;
      Pose pose = placed(idle.at(0), {0, 0, yaw});
      pose.rotation[0] = pose.rotation[0] * glm::angleAxis(radians(20), kLeft);  // leans
      playback.next_simulated(pose);
      shown.add(playback);
    }
    const std::size_t seam = shown.size();
    play(playback, idle, {}, 160, shown);
    float least_upright = 1, turned = 0;
    for (std::size_t t = seam; t < shown.size(); ++t) {
      const Quat hips = shown.poses[t].rotation[0], before = shown.poses[t - 1].rotation[0];
      least_upright = std::min(least_upright, (hips * kUp).y);
      turned += wrapped_angle(yaw_of(hips * kForward) - yaw_of(before * kForward));
    }
    EXPECT_GT(least_upright, std::cos(radians(25))) << spin;
    EXPECT_NEAR(degrees(turned), 200, 20) << spin;  // not 160 back
  }
}

TEST(Playback, ATrunkThatWasThrownBackTakesItsTime) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  Pose bent = idle.at(0);
  for (const Joint joint : {Joint::spine, Joint::chest, Joint::upper_chest}) {
    Quat& turn = bent.rotation[index(joint)];
    turn = glm::normalize(turn * glm::angleAxis(radians(-15), kLeft));
  }
  Playback playback(kSkeleton);
  Shown shown;
  for (int i = 0; i < 4; ++i) playback.next_simulated(bent);
  play(playback, idle, {}, 120, shown);
  const auto off = [&](std::size_t t) {
    const WorldPose clip = world_pose(kSkeleton, idle.at(static_cast<Tick>(t)));
    return glm::distance(shown.at(t, Joint::head), clip.position[index(Joint::head)]);
  };
  EXPECT_GT(off(ticks(0.2f)), off(0) / 2);
  EXPECT_LT(off(119), 0.01f);
}

TEST(Playback, AFootSimulatedIntoTheFloorComesUpWithoutAJump) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  Playback playback(kSkeleton);
  Shown shown;
  Pose sunk = idle.at(0);
  sunk.hips.y -= 0.03f;
  leave(playback, sunk, shown);
  play(playback, idle, {}, 60, shown);
  EXPECT_LT(position_jump(shown), 0.005f);
  EXPECT_NEAR(shown.at(shown.size() - 1, Joint::left_toes).y, kSkeleton.toe_height(), 1e-3f);
}

// Where the body goes round by one side and a foot that stands would by the other, the ankle would
// be wrung off.
TEST(Playback, AFootTurnsTheWayRoundItsBodyDoes) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  for (const float sign : {1.0f, -1.0f}) {
    Pose turned = placed(idle.at(0), {0, 0, sign * radians(185)});
    for (const Side side : kSides) {
      Quat& hip = turned.rotation[index(leg(side).root)];
      hip = glm::angleAxis(sign * radians(-15), kUp) * hip;
    }
    Playback playback(kSkeleton);
    Shown shown;
    leave(playback, turned, shown);
    play(playback, idle, {}, 160, shown);
    for (std::size_t t = 0; t < shown.size(); ++t) {
      for (const Side side : kSides) {
        const auto ankle = [&](const Pose& pose) { return pose.rotation[index(leg(side).end)]; };
        const Quat off = ankle(shown.poses[t]) * glm::inverse(ankle(idle.at(0)));
        EXPECT_LT(degrees(glm::length(rotation_vector(off))), 60) << t;
      }
    }
    EXPECT_LT(position_jump(shown), 0.02f);
  }
}

// A body that was left at rest and facing elsewhere comes round no faster than fighters turn, and
// faces as its clip does in the end.
TEST(Playback, ABodyThatFacesElsewhereDoesNotWhirlRound) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  for (const float off : {60.0f, 100.0f, 140.0f, -140.0f}) {
    Playback playback(kSkeleton);
    Shown shown;
    leave(playback, placed(idle.at(0), {0, 0, radians(off)}), shown);
    play(playback, idle, {}, 160, shown);
    float fastest = 0;  // rad/s
    for (std::size_t t = 1; t < shown.size(); ++t) {
      const float turned = wrapped_angle(heading_of(shown.poses[t].rotation[0]) -
                                         heading_of(shown.poses[t - 1].rotation[0]));
      fastest = std::max(fastest, std::abs(turned) * kTicksPerSecond);
    }
    EXPECT_LT(fastest, 8.1f) << off;
    EXPECT_NEAR(heading_of(shown.poses.back().rotation[0]), heading_of(idle.at(0).rotation[0]),
                1e-3f);
  }
}

// It has no heading on its shoulders: by heading and lean it would go up and round to lie down.
TEST(Playback, ABodyOnItsShouldersRollsDownTheShortestWay) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  Clip lies = idle;
  for (Tick tick = 0; tick < lies.length(); ++tick) {
    Pose& pose = lies.frames[static_cast<std::size_t>(tick)];
    pose.hips.y = 0.12f;
    pose.rotation[0] = glm::angleAxis(radians(-90), kLeft);
  }
  for (const float aside : {0.0f, 15.0f, -40.0f}) {
    Pose on_shoulders = lies.at(0);
    on_shoulders.hips.y = 0.3f;
    on_shoulders.rotation[0] = glm::angleAxis(radians(aside), kForward) *
                               glm::angleAxis(radians(-75), kLeft) * on_shoulders.rotation[0];
    const Quat way = on_shoulders.rotation[0] * glm::inverse(lies.at(0).rotation[0]);
    Playback playback(kSkeleton);
    Shown shown;
    leave(playback, on_shoulders, shown);
    play(playback, lies, {}, 160, shown);
    float turned = 0;  // rad
    for (std::size_t t = 1; t < shown.size(); ++t) {
      turned += glm::length(rotation_vector(shown.poses[t].rotation[0] *
                                            glm::inverse(shown.poses[t - 1].rotation[0])));
    }
    EXPECT_NEAR(turned, glm::length(rotation_vector(way)), 0.02f) << aside;
    EXPECT_LT(velocity_jump(shown), 1.5f) << aside;
  }
}

// A leg that swings through where the clip puts its foot down goes on by its joints: led there, it
// would be thrown past and pulled straight.
TEST(Playback, ALegThatSwingsThroughItsPlaceDoesNotJerk) {
  const Clip idle = test::idle_clip(kSkeleton, 240);
  for (const float yaw : {0.2f, 0.4f, 0.6f}) {
    for (const float out : {1.2f, 1.5f}) {
      for (const float spin : {1.0f, 2.0f, 3.0f}) {
        Playback playback(kSkeleton);
        Shown shown;
        const Limb limb = leg(Side::left);
        for (Tick tick = -12; tick <= 0; ++tick) {
          const float s = static_cast<float>(tick) * kTickSeconds;
          Pose pose = placed(idle.at(0), {0, 0, yaw + spin * s});
          Quat& hip = pose.rotation[index(limb.root)];
          hip = glm::angleAxis(out + spin * s, kForward) * hip;
          pose.hips.y += 0.02f;
          playback.next_simulated(pose);
          shown.add(playback);
        }
        const std::size_t seam = shown.size();
        play(playback, idle, {}, 160, shown);
        EXPECT_LT(velocity_jump(shown, seam + 1, shown.size()), 1.3f) << yaw << out << spin;
      }
    }
  }
}

// A leg that comes down from a kick when its body is struck, and is still on its way when the body
// acts again: it slows before the floor as if there had been one seam only.
TEST(Playback, AThrownFootMeetsTheFloorGentlyThoughAnotherClipHasBegun) {
  const Limb limb = leg(Side::left);
  const Pose guard = test::idle_clip(kSkeleton, 240).at(0);
  for (const float behind : {0.0f, 0.3f}) {
    const Clip stands = test::clip_of(
        kSkeleton, 240,
        [behind](float) {
          test::Stance stance;
          stance.left_ball.z -= behind;
          return stance;
        },
        test::both, test::in_place);
    for (const Tick between : {6, 12, 18, 24}) {
      Playback playback(kSkeleton);
      Shown shown;
      for (Tick tick = -12; tick <= 0; ++tick) {
        Pose kicks = guard;
        Quat& hip = kicks.rotation[index(limb.root)];
        hip = glm::angleAxis(-1.2f + 8 * static_cast<float>(tick) * kTickSeconds, kLeft) * hip;
        playback.next_simulated(kicks);
        shown.add(playback);
      }
      const std::size_t seam = shown.size();
      play(playback, stands, {}, between, shown);
      play(playback, stands, {0.05f, 0, 0}, 120, shown);
      EXPECT_LT(velocity_jump(shown, seam + 1, shown.size()), 1.3f) << behind << between;
      for (std::size_t t = seam + 1; t < shown.size(); ++t) {
        const float from = shown.at(t - 1, Joint::left_toes).y;
        const float falls = (from - shown.at(t, Joint::left_toes).y) / kTickSeconds;
        if (from < kSkeleton.toe_height() + 0.05f) {
          EXPECT_LT(falls, 1.4f) << behind << between;
        }
      }
    }
  }
}

// A foot that touches the floor while it is still moved: it stands as soon as it has slowed, and is
// not taken back along the floor to where it should have landed.
TEST(Playback, AStepThatHasSlowedOnTheFloorStands) {
  constexpr Tick kNearlyDown = 36;
  const Clip step = test::step_clip(kSkeleton, {0, 0, 0.3f});
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, step, {}, kNearlyDown, shown);
  play(playback, test::idle_clip(kSkeleton, 240), {0, 0.3f, 0}, 80, shown);
  const float floor = kSkeleton.toe_height() + 0.004f;
  float slid = 0;
  for (std::size_t t = kNearlyDown + 1; t < shown.size(); ++t) {
    for (const Side side : kSides) {
      const Vec3 from = shown.at(t - 1, toes(side)), to = shown.at(t, toes(side));
      if (std::max(from.y, to.y) < floor) slid += std::hypot(to.x - from.x, to.z - from.z);
    }
  }
  EXPECT_LT(slid, 0.05f);
  EXPECT_EQ(shown.held.back(), (FootContacts{true, true}));
}

TEST(Playback, AScaledBodyStandsOnTheSameFloor) {
  const Skeleton tall = canonical_skeleton(1.95f);
  const float factor = tall.height / kCanonicalHeight;
  Playback playback(tall);
  const Clip jab = test::jab_clip(kSkeleton);
  for (Tick tick = 0; tick <= jab.length(); ++tick) {
    const Pose pose = scaled(jab.at(tick), factor);
    EXPECT_POSE_NEAR(tall, playback.next(pose, jab.contacts_at(tick)), pose, 0.3f);
  }
}

TEST(Playback, ACopyGoesOnBitByBit) {
  Playback playback(kSkeleton);
  Shown shown;
  play(playback, boxing_clips()[1], {}, 20, shown);
  play(playback, boxing_clips()[2], {0.05f, 0, 0.1f}, 11, shown);
  Playback twin = playback;
  Shown a, b;
  play(playback, boxing_clips()[0], {0.1f, 0, 0}, 50, a);
  play(twin, boxing_clips()[0], {0.1f, 0, 0}, 50, b);
  for (std::size_t t = 0; t < a.size(); ++t) {
    EXPECT_EQ(a.poses[t].hips, b.poses[t].hips);
    EXPECT_EQ(a.poses[t].rotation, b.poses[t].rotation);
    EXPECT_EQ(a.held[t], b.held[t]);
  }
}

}  // namespace
}  // namespace ringcraft
