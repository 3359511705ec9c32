// The memo and the store: what quantisation changes, and what remembering must not change.

#include "planner/impact_memo.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/random.h"
#include "base/tasks.h"
#include "capture/library_builder.h"
#include "planner/plan.h"

namespace ringcraft {
namespace {

class ImpactMemoTest : public testing::Test {
 protected:
  static const MotionLibrary& library() {
    static const MotionLibrary kLibrary =
        *build_library(assets_folder() / "kickboxing" / "library.toml");
    return kLibrary;
  }
  static const MotionTables& tables() {
    static const MotionTables kTables(library(), make_body({}));
    return kTables;
  }

  struct Met {
    LandedBlow blow;
    Blow exact;
    ImpactInput input;  // without `continued`
    std::vector<Pose> continued;
  };

  // Blows that land: a random attack before a random moment of a random action.
  static std::vector<Met> random_blows(std::size_t wanted, std::uint64_t seed) {
    Random random(seed);
    std::vector<ActionId> attacks, struck;
    for (const ActionId id : library().launchable()) {
      (library().action(id).attacks() ? attacks : struck).push_back(id);
      struck.push_back(id);
    }
    std::vector<Met> met;
    while (met.size() < wanted) {
      const ActionId attack =
          attacks[static_cast<std::size_t>(random.below(static_cast<int>(attacks.size())))];
      const ActionId other =
          struck[static_cast<std::size_t>(random.below(static_cast<int>(struck.size())))];
      const Strike& strike = library().action(attack).strikes.front();
      Launch a, b;
      a.action = attack;
      a.end = library().action(attack).length();
      b.action = other;
      b.start = -random.below(std::max<int>(1, library().action(other).length()));
      b.end = b.start + library().action(other).length();
      b.placement = {random.uniform(-0.15f, 0.15f), random.uniform(0.7f, 1.2f),
                     kPi + random.uniform(-0.5f, 0.5f)};
      const InFlight striker(tables(), a), target(tables(), b);
      for (Tick t = strike.active_begin; t < strike.active_end; ++t) {
        const auto contact = contact_at(striker, striker.table->strikes.front(), target, t);
        if (!contact) continue;
        met.push_back(met_of(striker, target, strike.kind, *contact, t));
        break;
      }
    }
    return met;
  }

  static Met met_of(const InFlight& striker, const InFlight& target, StrikeKind kind,
                    const Contact& contact, Tick t) {
    Met one;
    LandedBlow& blow = one.blow;
    blow.attack = {striker.table, striker.table->clamped(striker.age(t))};
    blow.struck = {target.table, target.table->clamped(target.age(t))};
    blow.kind = kind;
    blow.contact = contact;
    blow.attacker_yaw = striker.frame_at(t).yaw - target.frame_at(t).yaw;
    const Frame frame = relative(target.frame_at(t), striker.frame_at(t));
    const Placement seen = frame.placement();
    blow.striking = frame.to_inner(contact.point);
    const Pose attacker = placed(blow.attack.pose(), seen);
    const ActionTable& action = *target.table;
    one.exact =
        blow_of(tables().body(), attacker, tables().body(), blow.struck.pose(), contact, kind);
    one.input.pose = blow.struck.pose();
    one.input.pose_before = action.pose_at(blow.struck.age - 1);
    one.input.blow = one.exact;
    one.input.contacts = action.action->clip.contacts_at(blow.struck.age);
    for (Tick k = 0; k <= kImpulseStepTicks; ++k) {
      one.continued.push_back(action.pose_at(blow.struck.age + k));
    }
    return one;
  }
};

TEST_F(ImpactMemoTest, MostBlowsAreAnsweredAsTheUnquantisedStepWould) {
  ImpactMemo memo({&tables()});
  std::size_t asked = 0, same_kind = 0, same_cut = 0;
  for (Met& one : random_blows(300, 5)) {
    if (glm::length(one.exact.impulse) < kTouchImpulse) continue;
    one.input.continued = one.continued;
    const ImpactOutcome exact = impulse_step(tables().body(), one.input);
    const ImpactAnswer answer = memo.answer(one.blow);
    ++asked;
    same_kind += exact.response == answer.outcome.response ? 1u : 0u;
    const float impulse = glm::length(one.exact.impulse);
    same_cut += interrupts(one.exact.blocked, impulse, exact) ==
                        interrupts(one.exact.blocked, answer.impulse, answer.outcome)
                    ? 1u
                    : 0u;
  }
  std::printf("[ measured ] %zu blows: same kind of response %.3f, same cut %.3f, %zu entries\n",
              asked, static_cast<double>(same_kind) / static_cast<double>(asked),
              static_cast<double>(same_cut) / static_cast<double>(asked),
              static_cast<std::size_t>(memo.counts().entries));
  ASSERT_GT(asked, 150u);
  EXPECT_GT(same_kind, asked * 80 / 100);
  EXPECT_GT(same_cut, asked * 90 / 100);
}

TEST_F(ImpactMemoTest, ImpulsesAreThoseOfTheBlow) {
  ImpactMemo memo({&tables()});
  for (const Met& one : random_blows(100, 6)) {
    const float exact = glm::length(one.exact.impulse);
    EXPECT_NEAR(memo.answer(one.blow).impulse, exact, 1e-3f * exact);
  }
}

// What turns a head is that the blow passes beside its middle.
TEST_F(ImpactMemoTest, HeadsTurnAsFastAsTheUnquantisedStepSays) {
  ImpactMemo memo({&tables()});
  float exact = 0, answered = 0;
  std::size_t asked = 0;
  for (Met& one : random_blows(4000, 8)) {
    if (one.exact.part != Part::head || glm::length(one.exact.impulse) < 2 * kTouchImpulse)
      continue;
    one.input.continued = one.continued;
    exact += impulse_step(tables().body(), one.input).head_spin;
    answered += memo.answer(one.blow).outcome.head_spin;
    ++asked;
  }
  ASSERT_GE(asked, 20u);
  if (std::getenv("RINGCRAFT_PRINT") != nullptr)
    std::printf("[ measured ] %zu blows to the head: %.2f of the spin\n", asked,
                static_cast<double>(answered / exact));
  EXPECT_GT(answered, 0.8f * exact);
  EXPECT_LT(answered, 1.25f * exact);
}

TEST_F(ImpactMemoTest, StoreChangesNeitherAnswersNorCounts) {
  const auto store = std::make_shared<ImpactStore>();
  ImpactMemo alone({&tables()}), first({&tables()}, {}, store), second({&tables()}, {}, store);
  const std::vector<Met> blows = random_blows(30, 9);
  for (const Met& one : blows) {
    const ImpactAnswer expected = alone.answer(one.blow);
    EXPECT_EQ(first.answer(one.blow), expected);
    EXPECT_EQ(alone.recomputed(one.blow), expected);
  }
  const std::size_t held = store->answers.size();
  EXPECT_EQ(held, first.counts().entries);
  for (const Met& one : blows) EXPECT_EQ(second.answer(one.blow), alone.answer(one.blow));
  EXPECT_EQ(store->answers.size(), held);
  EXPECT_EQ(second.counts().entries, first.counts().entries);
  EXPECT_EQ(second.counts().lookups, first.counts().lookups);
}

TEST_F(ImpactMemoTest, ManyBlowsOnOnePoseAreAnsweredAsEachByItself) {
  ImpactMemo memo({&tables()});
  const std::vector<Met> blows = random_blows(4, 12);
  std::vector<LandedBlow> asked;
  for (const Met& one : blows) {
    for (const float harder : {1.0f, 1.5f, 2.0f}) {
      for (const float turned : {0.0f, 1.6f, -1.6f}) {
        LandedBlow blow = one.blow;
        blow.contact.velocity = harder * (yaw_rotation(turned) * blow.contact.velocity);
        blow.contact.normal = yaw_rotation(turned) * blow.contact.normal;
        asked.push_back(blow);
      }
    }
  }
  std::vector<ImpactAnswer> together(asked.size());
  run_tasks(asked.size(), 2, [&](std::size_t i) { together[i] = memo.answer(asked[i]); });
  std::size_t moved = 0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(together[i], memo.recomputed(asked[i])) << i;
    moved += together[i].outcome.response == ResponseKind::absorb ? 0u : 1u;
  }
  EXPECT_GT(moved, 2u);  // only for these is the own motion asked
}

// A motion in flight is like no other: the blow on it is answered as it is, turning to its aim or
// not, once, and forgotten with it.
TEST_F(ImpactMemoTest, BlowsOnAMotionInFlightAreNotQuantised) {
  ImpactMemo memo({&tables()});
  std::size_t same = 0, asked = 0, moved = 0;
  for (Met& one : random_blows(40, 15)) {
    ActionTable shown = *one.blow.struck.table;
    for (Tick t = 0; t <= shown.length; ++t) shown.clip_ages.push_back(t);
    shown.motion = memo.begin_motion();
    shown.tone = shown.motion % 2 == 0 ? 1.0f : 0.65f;         // every other body is tired
    const float turns = shown.motion % 3 == 0 ? 0.02f : 0.0f;  // rad a tick
    for (Tick t = 0; t <= shown.length && turns != 0; ++t) {
      shown.turn.push_back(turns * static_cast<float>(t));
    }
    const Tick now = one.blow.struck.age;
    const auto seen = [&](Tick age) {
      const auto ticks = static_cast<float>(shown.clamped(age) - now);
      return placed(shown.pose_at(age), {0, 0, turns * ticks});
    };
    one.blow.struck.table = &shown;
    one.input.pose_before = seen(now - 1);
    for (Tick k = 0; k <= kImpulseStepTicks; ++k) {
      one.continued[static_cast<std::size_t>(k)] = seen(now + k);
    }
    one.input.continued = one.continued;
    one.input.tone = one.blow.tone = shown.tone;
    const std::uint64_t before = memo.counts().entries;
    const ImpactAnswer answer = memo.answer(one.blow);
    EXPECT_EQ(memo.counts().entries, before + 1);
    EXPECT_EQ(memo.answer(one.blow), answer);
    EXPECT_EQ(memo.counts().entries, before + 1);
    EXPECT_EQ(memo.recomputed(one.blow), answer);
    if (glm::length(one.exact.impulse) < kTouchImpulse) continue;
    const ImpactOutcome exact = impulse_step(tables().body(), one.input);
    ++asked;
    same += answer.outcome.response == exact.response && answer.outcome.steps == exact.steps &&
            std::abs(answer.outcome.margin - exact.margin) < 1e-3f;
    moved += exact.response == ResponseKind::absorb ? 0u : 1u;
  }
  ASSERT_GT(asked, 15u);
  EXPECT_GT(moved, 2u);
  EXPECT_EQ(same, asked);
}

TEST_F(ImpactMemoTest, TiredBodiesAnswerByThemselves) {
  const auto store = std::make_shared<ImpactStore>();
  ImpactMemo memo({&tables()}, {}, store);
  int other = 0;
  for (Met& one : random_blows(60, 15)) {
    const ImpactAnswer fresh = memo.answer(one.blow);
    one.blow.tone = 0.65f;
    const ImpactAnswer tired = memo.answer(one.blow);
    EXPECT_EQ(tired, memo.recomputed(one.blow));
    other += tired.outcome == fresh.outcome ? 0 : 1;
  }
  EXPECT_GT(other, 20);
}

TEST_F(ImpactMemoTest, StoreKeepsBodiesApart) {
  BodySpec heavy;
  heavy.mass = 120;
  const MotionTables other(library(), make_body(heavy));
  const auto store = std::make_shared<ImpactStore>();
  ImpactMemo light({&tables()}, {}, store), shared({&other}, {}, store), own({&other});
  for (const Met& one : random_blows(15, 4)) {
    light.answer(one.blow);
    EXPECT_EQ(shared.answer(one.blow), own.answer(one.blow));
  }
}

TEST_F(ImpactMemoTest, PoseClassesHoldMomentsThatAreAlike) {
  const PoseClasses classes(tables(), 6), again(tables(), 6), exact(tables(), 6, 0);
  EXPECT_LT(classes.count(), classes.moments());
  EXPECT_EQ(exact.count(), exact.moments());
  for (std::size_t a = 0; a < library().actions().size(); ++a) {
    for (Tick age = 0; age <= tables().at(ActionId(a)).length; age += 6) {
      const PoseMoment of = classes.of(ActionId(a), age);
      EXPECT_EQ(of, again.of(ActionId(a), age));
      EXPECT_EQ(classes.of(of.action, of.age), of);  // who stands for others stands for itself
      const ActionTable &own = tables().at(ActionId(a)), &their = tables().at(of.action);
      EXPECT_EQ(own.action->clip.contacts_at(age), their.action->clip.contacts_at(of.age));
    }
  }
}

}  // namespace
}  // namespace ringcraft
