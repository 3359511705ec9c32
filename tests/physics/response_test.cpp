#include "physics/response.h"

#include <gtest/gtest.h>

#include "fight/synthetic_library.h"
#include "physics/hit.h"

namespace ringcraft {
namespace {

class ResponseChoice : public testing::Test {
 protected:
  MotionLibrary library = synthetic::library();
  BodyModel body = make_body({"b", kCanonicalHeight, 75, Sex::male});

  const std::string& chosen(ResponseKind kind, int steps, float direction, float facing = 0) const {
    ImpactOutcome outcome;
    outcome.response = kind;
    outcome.steps = steps;
    outcome.direction = direction;
    const ActionId id = choose_response(library, body, outcome, facing);
    EXPECT_TRUE(id.valid());
    return library.action(id).name;
  }
};

TEST_F(ResponseChoice, KindStepsAndDirectionDecide) {
  EXPECT_EQ(chosen(ResponseKind::absorb, 0, kPi), "absorb_back");
  EXPECT_EQ(chosen(ResponseKind::absorb, 0, .4f), "absorb_fore");
  EXPECT_EQ(chosen(ResponseKind::recovery_steps, 1, radians(170)), "steps_back_1");
  EXPECT_EQ(chosen(ResponseKind::recovery_steps, 2, radians(-175)), "steps_back_2");
  EXPECT_EQ(chosen(ResponseKind::recovery_steps, 3, kPi), "steps_back_3");
  EXPECT_EQ(chosen(ResponseKind::recovery_steps, 1, radians(80)), "steps_left_1");
  EXPECT_EQ(chosen(ResponseKind::recovery_steps, 1, radians(-80)), "steps_right_1");
  EXPECT_EQ(chosen(ResponseKind::knockdown, 0, radians(30)), "knockdown_back");
}

TEST_F(ResponseChoice, DirectionIsSeenFromTheBody) {
  EXPECT_EQ(chosen(ResponseKind::absorb, 0, kPi, kPi), "absorb_fore");
  EXPECT_EQ(chosen(ResponseKind::recovery_steps, 1, kPi, radians(90)), "steps_left_1");
}

TEST_F(ResponseChoice, AWrongDirectionIsWorseThanAWrongCount) {  // docs/sources.md, V4
  EXPECT_EQ(chosen(ResponseKind::recovery_steps, 2, kPi / 2), "steps_left_1");
}

TEST_F(ResponseChoice, OfLikeResponsesTheOneThatBendsAsTheBodyDoesIsTaken) {
  // The same tag twice: one throws the trunk back, one bends it forward.
  synthetic::Builder builder;
  synthetic::Key idle;
  idle.tick = 36;
  builder.add("idle", Kind::idle, {synthetic::Key{}, idle});
  synthetic::Key fore, back, end;
  fore.tick = back.tick = 20;
  fore.lean = .6f;
  back.lean = -.4f;
  end.tick = 50;
  const Response tag{ResponseKind::absorb, 0, kPi};
  builder.add("thrown_back", Kind::response, {synthetic::Key{}, back, end}).response = tag;
  builder.add("bent_fore", Kind::response, {synthetic::Key{}, fore, end}).response = tag;
  const MotionLibrary two("two", builder.take());
  ASSERT_EQ(two.responses().size(), 2u);
  ImpactOutcome outcome;
  outcome.direction = kPi;
  outcome.moved = {Vec3{0, 0, -.10f}, Vec3{0, 0, -.03f}, Vec3{}};  // a blow to the head
  EXPECT_EQ(two.action(choose_response(two, body, outcome, 0)).name, "thrown_back");
  outcome.moved = {Vec3{}, Vec3{0, 0, -.06f}, Vec3{0, 0, -.08f}};  // a blow to the belly
  EXPECT_EQ(two.action(choose_response(two, body, outcome, 0)).name, "bent_fore");
}

// A clip may be shown in part: what counts is which way it goes, the hips with the rest.
TEST_F(ResponseChoice, OfLikeResponsesTheOneThatGoesTheSameWayIsTaken) {
  const auto chosen_of_two = [&](synthetic::Key first, synthetic::Key second,
                                 const std::array<Vec3, 3>& moved) {
    synthetic::Builder builder;
    synthetic::Key idle, end;
    idle.tick = 36;
    end.tick = 50;
    first.tick = second.tick = 20;
    builder.add("idle", Kind::idle, {synthetic::Key{}, idle});
    const Response tag{ResponseKind::absorb, 0, kPi};
    builder.add("first", Kind::response, {synthetic::Key{}, first, end}).response = tag;
    builder.add("second", Kind::response, {synthetic::Key{}, second, end}).response = tag;
    const MotionLibrary two("two", builder.take());
    ImpactOutcome outcome;
    outcome.direction = kPi;
    outcome.moved = moved;
    return two.action(choose_response(two, body, outcome, 0)).name;
  };
  synthetic::Key nods, thrown_back, leans, goes;
  nods.lean = .05f;
  thrown_back.lean = -.4f;
  leans.lean = -.05f;
  goes.root.z = -.3f;
  EXPECT_EQ(chosen_of_two(nods, thrown_back, {Vec3{0, 0, -.03f}, Vec3{0, 0, -.01f}, Vec3{}}),
            "second");
  EXPECT_EQ(chosen_of_two(leans, goes, {Vec3{0, 0, -.05f}, Vec3{0, 0, -.044f}, Vec3{0, 0, -.03f}}),
            "second");
  EXPECT_EQ(chosen_of_two(leans, goes, {Vec3{0, 0, -.03f}, Vec3{0, 0, -.01f}, Vec3{}}), "first");
}

TEST_F(ResponseChoice, OfLikeStepsThoseThatCatchTheBodyAreTaken) {
  synthetic::Builder builder;
  synthetic::Key idle;
  idle.tick = 36;
  builder.add("idle", Kind::idle, {synthetic::Key{}, idle});
  for (const auto& [name, way] : {std::pair{"short", .2f}, std::pair{"long", .7f}}) {
    synthetic::Key end;
    end.tick = 60;
    end.root.z = -way;
    builder.add(name, Kind::response, {synthetic::Key{}, end}).response =
        Response{ResponseKind::recovery_steps, 1, kPi};
  }
  const MotionLibrary two("two", builder.take());
  ImpactOutcome outcome;
  outcome.response = ResponseKind::recovery_steps;
  outcome.steps = 1;
  outcome.direction = kPi;
  outcome.margin = .06f;  // to be caught by a step of 0.15 m
  EXPECT_EQ(two.action(choose_response(two, body, outcome, 0)).name, "short");
  outcome.margin = .25f;
  EXPECT_EQ(two.action(choose_response(two, body, outcome, 0)).name, "long");
}

TEST(Interrupts, ABlowThatCutsNothingIsAbsorbedAndOneThatCutsIsAnsweredAsItIs) {
  ImpactOutcome outcome;
  outcome.response = ResponseKind::recovery_steps;
  outcome.steps = 2;
  outcome.direction = kPi;
  outcome.margin = .1f;
  EXPECT_EQ(answered(true, outcome), outcome);
  ImpactOutcome touch = outcome;
  touch.response = ResponseKind::absorb;
  touch.steps = 0;
  EXPECT_EQ(answered(false, outcome), touch);
}

TEST_F(ResponseChoice, AnImpactOnALibraryPoseLeadsToAResponseOfItsKind) {
  const Pose pose = library.action(library.find("idle")).clip.at(0);
  for (const float impulse : {4.0f, 75.0f, 250.0f}) {
    const ImpactOutcome outcome =
        stance::outcome_of(body, pose, Part::chest, {0, 0, -impulse}, {0, 0, .1f});
    const Action& answer = library.action(choose_response(library, body, outcome, 0));
    EXPECT_EQ(answer.response->kind, outcome.response) << impulse;
    EXPECT_GT(std::abs(answer.response->direction), radians(60)) << impulse;
  }
}

TEST_F(ResponseChoice, TheGetUpStartsWhereTheBodyLies) {
  const Action& fall = library.action(library.find("knockdown_back"));
  const Pose lying = placed(fall.clip.at(fall.length()), {3, -2, 2.5f});
  const ActionId id = choose_get_up(library, library.skeleton(), lying);
  ASSERT_TRUE(id.valid());
  EXPECT_EQ(library.action(id).starts_lying, Lying::back);
}

}  // namespace
}  // namespace ringcraft
