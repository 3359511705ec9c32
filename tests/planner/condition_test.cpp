// Fatigue, injuries, and what is learned of an opponent.

#include "planner/condition.h"

#include <algorithm>
#include <memory>

#include "motion/feints.h"
#include "planner/duel_fixture.h"
#include "planner/habits.h"
#include "planner/impact_store.h"
#include "planner/tree.h"

namespace ringcraft {
namespace {

Style wearing(double fatigue, double injury) {
  Style style;
  style.fatigue = fatigue;
  style.injury = injury;
  return style;
}

class ConditionTest : public DuelFixture {};

TEST_F(ConditionTest, WorkTiresRestRestoresAndNothingHappensWithoutAFactor) {
  Condition condition;
  for (int i = 0; i < 20; ++i) condition.launched(wearing(1, 0), 150);
  const double tired = condition.fatigue();
  EXPECT_GT(tired, 0.3);
  EXPECT_LT(condition.pace(), 0.96f);
  EXPECT_LT(condition.tone(), 0.9f);
  condition.rest(5);
  EXPECT_LT(condition.fatigue(), tired);
  condition.rest(1000);
  EXPECT_EQ(condition.fatigue(), 0);
  EXPECT_EQ(condition.pace(), 1);
  EXPECT_EQ(condition.tone(), 1);
  condition.launched(wearing(0, 1), 1e6);
  EXPECT_EQ(condition.fatigue(), 0);
}

TEST_F(ConditionTest, PaceAndToneStayInsideTheirLimits) {
  Condition condition;
  condition.launched(wearing(100, 0), 1e9);
  EXPECT_EQ(condition.fatigue(), 1);
  EXPECT_NEAR(condition.pace(), 0.85f, 1e-6f);
  EXPECT_GT(condition.tone(), kLeastStandingTone);  // a tired fighter stands
}

TEST_F(ConditionTest, BlowsToTheBodyTireMoreThanOthersAndLimbsAreHurt) {
  const Style style = wearing(1, 1);
  Condition body, leg;
  body.struck(style, Part::abdomen, 10);
  leg.struck(style, Part::left_thigh, 10);
  EXPECT_GT(body.fatigue(), leg.fatigue());
  EXPECT_EQ(body.injuries(), (std::array<double, kLimbs>{}));
  EXPECT_NEAR(leg.injury(2), 0.5, 1e-9);
  EXPECT_EQ(leg.injury(3), 0);
  leg.struck(style, Part::left_shin, 100);
  EXPECT_EQ(leg.injury(2), 1);
}

TEST_F(ConditionTest, AFasterMotionIsMoreWorkAndAHeldPoseIsNone) {
  const ActionTable& cross = tables().at(library().find("cross"));
  const double work = kinetic_work(tables().body(), cross.pose);
  EXPECT_GT(work, 20);
  EXPECT_LT(work, 1000);
  EXPECT_EQ(kinetic_work(tables().body(), std::vector<Pose>(30, cross.pose.front())), 0);
  std::vector<Pose> twice;  // every second frame: twice the speed, four times the energy
  for (std::size_t i = 0; i < cross.pose.size(); i += 2) twice.push_back(cross.pose[i]);
  EXPECT_GT(kinetic_work(tables().body(), twice), 3 * work);
}

TEST_F(ConditionTest, AHurtArmIsSparedAndATiredFighterSavesWork) {
  const Action& cross = library().action(library().find("cross"));
  const Action& step = library().action(library().find("step_back"));
  const Style style = wearing(1, 1);
  const auto limb = limb_of(*part_of(cross.strikes.front().joint));
  ASSERT_TRUE(limb);
  Condition hurt, other;
  hurt.struck(style, *limb == 0 ? Part::left_forearm : Part::right_forearm, 10);
  other.struck(style, *limb == 0 ? Part::right_forearm : Part::left_forearm, 10);
  Style unhurt = style;
  unhurt.fatigue = 0;
  EXPECT_GT(condition_cost(hurt, unhurt, cross, 100), 2);
  EXPECT_EQ(condition_cost(other, unhurt, cross, 100), 0);
  EXPECT_EQ(condition_cost(hurt, unhurt, step, 100), 0);
  EXPECT_EQ(condition_cost(hurt, wearing(0, 0), cross, 100), 0);
  Condition tired;
  tired.launched(style, 4000);
  EXPECT_GT(condition_cost(tired, style, cross, 200), condition_cost(tired, style, step, 50) + 1);
}

// Both fighters know how tired who is: whatever is launched in the tree lasts as long as it will.
TEST_F(ConditionTest, TheTreeRunsAtThePaceOfWhoLaunches) {
  Style style = wearing(1, 0);
  style.horizon_s = 1.5;
  const auto store = std::make_shared<ImpactStore>();
  const FightState state = facing(0.9f, 10);
  Condition tired;
  tired.launched(wearing(1, 0), 1e9);
  for (const std::size_t who : {0, 1}) {
    Planner planner(library(), contenders(2, style), {}, 5, store);
    planner.set_condition(FighterId(who), tired);
    const DecisionTree tree = planner.tree(state, FighterId(0), 120, 200);
    int slow = 0, others = 0;
    for (const TreeNode& node : tree.nodes) {
      const TreeEdge& edge = node.edge;
      if (node.parent < 0 || edge.forced || node.tick >= tree.start + tree.horizon) continue;
      const Action& action = library().action(library().find(edge.action));
      const Tick length = edge.action_end - edge.start;
      const bool cut = std::any_of(edge.events.begin(), edge.events.end(),
                                   [](const TreeEvent& one) { return one.cuts; });
      if (cut || !edge.then.empty()) continue;
      const bool paced = edge.who == FighterId(who);
      EXPECT_EQ(length,
                paced ? Pace(action, tired.pace()).reached(action.length()) : action.length())
          << action.name;
      ++(paced ? slow : others);
    }
    EXPECT_GT(slow, 3);
    EXPECT_GT(others, 3);
  }
}

// What is planned changes with it: a fighter with a ruined arm throws it less.
TEST_F(ConditionTest, APlanSparesTheHurtArm) {
  Style style = wearing(0, 1);
  style.horizon_s = 0.6;
  style.temperature = 0;
  const auto store = std::make_shared<ImpactStore>();
  const auto blows_by_limb = [&](const Condition& condition) {
    PlanSettings settings;
    settings.node_limit = 300;
    Planner planner(library(), contenders(2, style), settings, 5, store);
    planner.set_condition(FighterId(0), condition);
    std::array<int, kLimbs> count{};
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      const Plan plan = planner.plan(random_state(seed), FighterId(0));
      const Action& action = library().action(plan.launch.action);
      if (action.strikes.empty()) continue;
      ++count.at(*limb_of(*part_of(action.strikes.front().joint)));
    }
    return count;
  };
  const auto sound = blows_by_limb({});
  const auto busiest =
      static_cast<std::size_t>(std::max_element(sound.begin(), sound.end()) - sound.begin());
  constexpr Part kParts[] = {Part::left_forearm, Part::right_forearm, Part::left_shin,
                             Part::right_shin};
  Condition ruined;
  ruined.struck(style, kParts[busiest], 100);
  EXPECT_GT(sound[busiest], 0);
  EXPECT_LT(blows_by_limb(ruined)[busiest], sound[busiest]);
}

TEST(HabitsTest, CountsStandByFrequencyAndSituation) {
  Habits habits;
  const Situation near = situation_of(0.9f, Kind::idle, false),
                  far = situation_of(2.0f, Kind::idle, false);
  for (const int action : {3, 5, 5, 2}) habits.note(near, ActionId(action));
  ASSERT_EQ(habits.seen(near).size(), 3u);
  EXPECT_EQ(habits.seen(near)[0].action, ActionId(5));
  EXPECT_EQ(habits.seen(near)[1].action, ActionId(2));  // equal counts: the lower index
  EXPECT_EQ(habits.total(near), 4);
  EXPECT_EQ(habits.total(far), 0);
  EXPECT_EQ(habits.total(situation_of(0.9f, Kind::attack, false)), 0);
  EXPECT_EQ(habits.total(situation_of(0.9f, Kind::idle, true)), 0);
  EXPECT_EQ(Habits::belief(0), 0);
  EXPECT_LT(Habits::belief(3), Habits::belief(30));
}

TEST(HabitsTest, FeintsAreExpectedOfWhoFeints) {
  Habits habits;
  const ActionId jab(3), cross(4);
  EXPECT_EQ(habits.feint_expected(jab), 0);
  for (int i = 0; i < 20; ++i) habits.note_begun(jab, true);
  EXPECT_GT(habits.feint_expected(jab), 0.8);
  EXPECT_EQ(habits.feint_expected(cross), 0);
  for (int i = 0; i < 60; ++i) habits.note_begun(jab, false);
  EXPECT_LT(habits.feint_expected(jab), 0.3);
}

// Many sightings of one attack: the tree expects it, and nothing else.
TEST_F(ConditionTest, TheTreeExpectsWhatWasSeen) {
  prune_nothing();
  const FightState state = facing(0.95f, 0);
  DuelNode node = Duel::root(setup_, state);
  node.side[0].flight.launch.end = 60;  // the opponent acts
  Duel game(setup_, 120);
  std::vector<DuelMove> usual, expected;
  game.moves(node, usual);
  ASSERT_GT(usual.size(), 3u);
  const ActionId worst = usual.back().action;

  Habits habits;
  setup_.habits = &habits;
  setup_.learning = 1;
  game.moves(node, expected);
  EXPECT_EQ(expected.size(), usual.size());  // nothing was seen
  for (int i = 0; i < 100; ++i) habits.note(situation_of(0.95f, Kind::idle, false), worst);
  game.moves(node, expected);
  ASSERT_EQ(expected.size(), usual.size());  // a shorter list would make the planner hope
  EXPECT_EQ(expected.front().action, worst);
  for (const DuelMove& move : expected) {  // a hundred times to none
    EXPECT_EQ(move.unusual, move.action == worst ? 0 : thousandths(std::log(101)));
    DuelMove usual_one = move;
    usual_one.unusual = 0;
    EXPECT_EQ(game.step(node, move).node.gained - game.step(node, usual_one).node.gained,
              move.unusual);
  }
  setup_.learning = 0.5;
  game.moves(node, expected);
  EXPECT_EQ(expected.front().action, worst);
  EXPECT_EQ(expected.back().unusual, thousandths(0.5 * std::log(101)));
  setup_.learning = 1;
  // Where the habit cannot follow, nothing is dearer for it.
  for (int i = 0; i < 200; ++i) {
    habits.note(situation_of(0.95f, Kind::idle, false), library().find("absorb_back"));
  }
  game.moves(node, expected);
  EXPECT_EQ(expected.front().unusual, 0);
  EXPECT_EQ(expected.back().unusual, thousandths(std::log(101)));
  // Of its own moves the planner knows all.
  node.side[0].flight.launch.end = 0;
  node.side[1].flight.launch.end = 60;
  game.moves(node, expected);
  EXPECT_EQ(expected.size(), usual.size());
  for (const DuelMove& move : expected) EXPECT_EQ(move.unusual, 0);
}

TEST_F(ConditionTest, OnlyWhoLearnsPlansOtherwise) {
  Style style;
  style.horizon_s = 1.2;
  style.temperature = 0;
  Style student = style;
  student.learning = 1;
  const std::vector<Contender> both = {{make_body({}), student}, {make_body({}), style}};
  PlanSettings settings;
  settings.node_limit = 300;
  const auto store = std::make_shared<ImpactStore>();
  Planner planner(library(), both, settings, 5, store), fresh(library(), both, settings, 5, store);
  for (int i = 0; i < 40; ++i) {  // both were seen to hook, over and over, wherever they stood
    for (const float distance : {0.9f, 1.3f, 2.0f}) {
      const FightState state = facing(distance);
      for (const std::size_t who : {0u, 1u}) {
        planner.note_habit(state, FighterId(who), library().find("hook"));
      }
    }
  }
  int student_changed = 0, other_changed = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const FightState state = random_state(seed);
    const auto score = [&](Planner& of, std::size_t who) {
      return of.plan(state, FighterId(who)).record.lines.front().score;
    };
    student_changed += score(planner, 0) != score(fresh, 0);
    other_changed += score(planner, 1) != score(fresh, 1);
  }
  EXPECT_GT(student_changed, 0);
  EXPECT_EQ(other_changed, 0);
}

// A feint is taken for its attack until it has parted from it for as long as sight is late, unless
// he who learns has seen through it.
TEST_F(ConditionTest, AFeintIsTakenForItsAttack) {
  const std::vector<std::string> names{"hook"};
  static const MotionLibrary kWith = with_feints(library(), names);
  const ActionId hook = kWith.find("hook"), feint = kWith.find("hook_feint");
  Style style;
  style.horizon_s = 0.6;
  style.temperature = 0;
  style.learning = 1;
  PlanSettings settings;
  settings.node_limit = 300;
  const auto store = std::make_shared<ImpactStore>();
  Planner planner(kWith, contenders(2, style), settings, 5, store);
  const Tick seen_until = kWith.action(feint).feint->parted + ticks(style.late_sight_s);
  const auto in_flight = [&](ActionId action, Tick age) {
    FightState state = facing(0.8f);
    Launch& launch = state.fighters[1].launch;
    launch.action = action;
    launch.start = -age;
    launch.end = launch.start + kWith.action(action).length();
    return state;
  };
  const auto score = [&](ActionId action, Tick age) {
    return planner.plan(in_flight(action, age), FighterId(0)).record.lines.front().score;
  };
  ASSERT_LT(seen_until, kWith.action(feint).length());
  EXPECT_EQ(score(feint, seen_until - 1), score(hook, seen_until - 1));
  EXPECT_NE(score(feint, seen_until), score(hook, seen_until));
  EXPECT_NE(score(feint, 6), score(kWith.find("idle"), 6));
  EXPECT_EQ(score(feint, 6), score(hook, 6));
  for (int i = 0; i < 20; ++i) planner.note_habit(facing(0.8f), FighterId(1), feint);
  EXPECT_NE(score(feint, 6), score(hook, 6));
}

// The tree of one who feints, against an opponent that is taken in.
class FeignedTest : public DuelFixture {
 protected:
  static const MotionLibrary& with() {
    static const std::vector<std::string> names{"hook"};
    static const MotionLibrary kWith = with_feints(library(), names);
    return kWith;
  }
  static const MotionTables& own_tables() {
    static const MotionTables kTables(with(), make_body({}));
    return kTables;
  }

  FeignedTest() {
    clean_damage_ = damage_of_all(own_tables(), 5000);
    for (SideSetup& side : setup_.side) {
      side.tables = &own_tables();
      side.launch.assign(with().actions().size(), 0);
      side.clean_damage = clean_damage_;
    }
  }

  ActionId feint_ = with().find("hook_feint"), step_ = with().find("step_back");
};

TEST_F(FeignedTest, WhoIsTakenInDoesWhatIsExpectedOfIt) {
  const auto answers = [&] {
    FightState state = facing(0.8f);
    Launch& launch = state.fighters[0].launch;
    launch.action = feint_;
    launch.start = -6;
    Duel game(setup_, 200);
    DuelNode node = Duel::root(setup_, state);
    node.side[0].flight.launch.end = launch.start + with().action(feint_).length();
    std::vector<DuelMove> moves;
    game.moves(node, moves);
    std::vector<ActionId> actions;
    actions.reserve(moves.size());
    for (const DuelMove& move : moves) actions.push_back(move.side == 1 ? move.action : ActionId{});
    return actions;
  };
  const std::vector<ActionId> usual = answers();
  ASSERT_GT(usual.size(), 2u);
  setup_.feint = FeintAnswer{feint_, -6, 0, step_};
  EXPECT_EQ(answers(), std::vector<ActionId>{step_});
  setup_.feint = FeintAnswer{feint_, -5, 0, step_};  // another feint
  EXPECT_EQ(answers(), usual);
  setup_.feint = FeintAnswer{feint_, -6, 1, step_};  // it acts at another time
  EXPECT_EQ(answers(), usual);
}

TEST_F(FeignedTest, AFeintThatTakesInIsWeighed) {
  const auto place = [&] {  // in the list; its size where it is not there
    Duel game(setup_, 200);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, facing(0.8f, 12)), moves);
    const auto at = std::find_if(moves.begin(), moves.end(),
                                 [&](const DuelMove& move) { return move.action == feint_; });
    return at - moves.begin();
  };
  const auto before = place();
  EXPECT_GT(before, 0);
  setup_.feint = FeintAnswer{feint_, 0, 12, step_};
  EXPECT_EQ(place(), 0);
  setup_.feint = FeintAnswer{feint_, 5, 12, step_};
  EXPECT_EQ(place(), before);
}

TEST_F(FeignedTest, AlphaBetaStaysMinimax) {
  ImpactMemo memo({&own_tables()});
  setup_.memo = &memo;
  style_.candidates = 4;
  std::uint64_t all = 0, visited = 0;
  int feints = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const FightState state = random_state(seed);
    setup_.feint = FeintAnswer{feint_, 0, state.fighters[1].launch.end, step_};
    Duel game(setup_, 110);
    const DuelNode root = Duel::root(setup_, state);
    std::vector<DuelMove> line;
    game.moves(root, line);
    feints += std::any_of(line.begin(), line.end(),
                          [&](const DuelMove& move) { return move.action == feint_; });
    SearchCounts counts;
    const std::int32_t truth = minimax(game, root, counts);
    Search<Duel> search(SearchSettings{});
    EXPECT_EQ(search.run(game, root, kWorst, kBest, line), truth) << seed;
    all += counts.nodes;
    visited += search.counts().nodes;
  }
  EXPECT_LT(visited, all / 2);
  EXPECT_GT(feints, 0);
}

// What the tree expects of who is taken in is what it then does; of who need not act in time, or
// has learned better, nothing is expected.
TEST_F(FeignedTest, ThePlanKnowsWhatTheOtherWillDo) {
  Style style;
  style.horizon_s = 0.8;
  style.temperature = 0;
  Style student = style;
  student.learning = 1;
  PlanSettings settings;
  settings.node_limit = 0;
  const auto store = std::make_shared<ImpactStore>();
  const auto expected = [&](Planner& planner, const FightState& state) {
    const DecisionTree tree = planner.tree(state, FighterId(0), 96, 200);
    std::vector<std::string> answers;
    for (const int child : tree.nodes[0].children) {
      if (tree.nodes[static_cast<std::size_t>(child)].edge.action != "hook_feint") continue;
      for (const int answer : tree.nodes[static_cast<std::size_t>(child)].children) {
        answers.push_back(tree.nodes[static_cast<std::size_t>(answer)].edge.action);
      }
    }
    return answers;
  };
  Planner planner(with(), {{make_body({}), style}, {make_body({}), student}}, settings, 5, store);
  for (const float distance : {0.8f, 0.85f, 0.9f}) {
    const FightState state = facing(distance, 12);
    FightState then = state;
    then.now = 12;
    then.fighters[0].launch =
        following(with(), state.fighters[0].launch, feint_, 0, {0, 0, distance / 2}, 1, kMostAim);
    const ActionId answer = planner.plan(then, FighterId(1)).launch.action;
    EXPECT_EQ(expected(planner, state), std::vector{with().action(answer).name}) << distance;
  }
  const Tick seen_until = with().action(feint_).feint->parted + ticks(style.late_sight_s);
  EXPECT_NE(expected(planner, facing(0.8f, seen_until)).size(), 1u);
  for (int i = 0; i < 20; ++i) planner.note_habit(facing(0.8f), FighterId(0), feint_);
  EXPECT_NE(expected(planner, facing(0.8f, 12)).size(), 1u);
}

}  // namespace
}  // namespace ringcraft
