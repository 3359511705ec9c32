#include "planner/sparring.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fight/synthetic_library.h"
#include "scene/pair_sparring.h"
#include "scene/sparring_files.h"

namespace ringcraft {
namespace {

struct Corner {
  MotionLibrary library = synthetic::library();
  BodyModel body = make_body({"middleweight", 1.75f, 73.0f, Sex::male, 1.0f});
  MotionTables tables{library, body};
};

const Corner& corner() {
  static const Corner kCorner;
  return kCorner;
}

const Sparring& sparring() {
  static const Sparring kSparring = spar(corner().tables, corner().tables);
  return kSparring;
}

TEST(Sparring, EveryAttackMeetsEveryDefenseOrIsNamed) {
  const MotionLibrary& library = corner().library;
  const OffenseDefenseTable table(sparring().records);
  for (const ActionId attack : library.launchable()) {
    if (!library.action(attack).attacks()) continue;
    const auto& unlanded = sparring().unlanded;
    if (std::find(unlanded.begin(), unlanded.end(), attack) != unlanded.end()) continue;
    for (const ActionId defense : library.launchable()) {
      if (!library.action(defense).defense) continue;
      EXPECT_NE(table.entry(attack, defense), nullptr)
          << library.action(attack).name << " " << library.action(defense).name;
    }
  }
  EXPECT_FALSE(sparring().records.empty());
}

// Placements are those from which the blow lands: a defense that is over before the attack begins
// to reach does not help.
TEST(Sparring, TheDuckUnderAJabWorksInTimeAndFailsTooLate) {
  const MotionLibrary& library = corner().library;
  const ActionId jab = library.find("jab"), duck = library.find("duck");
  ASSERT_TRUE(jab.valid());
  ASSERT_TRUE(duck.valid());
  const OffenseDefenseTable table(sparring().records);
  const DefenseEntry* entry = table.entry(jab, duck);
  ASSERT_NE(entry, nullptr);
  const auto all = timings(*entry);
  EXPECT_GT(best_timing(*entry).share(), 0.8f);
  EXPECT_LT(all.back().share(), 0.3f);  // launched as the blow arrives
}

TEST(Sparring, ThreadsChangeNothing) {
  SparringSettings settings;
  settings.threads = 3;
  const Sparring again = spar(corner().tables, corner().tables, settings);
  const auto& actions = corner().library.actions();
  EXPECT_EQ(records_csv(actions, again.records), records_csv(actions, sparring().records));
}

TEST(Sparring, FilesHoldEveryRecordAndEveryAttack) {
  const auto& actions = corner().library.actions();
  const std::string csv = records_csv(actions, sparring().records);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            sparring().records.size() + 1);
  const OffenseDefenseTable table(sparring().records);
  const std::string json = table_json("gym", actions, table);
  const std::string page = table_page("gym", actions, table);
  EXPECT_NE(json.find("\"attack\": \"jab\""), std::string::npos);
  EXPECT_NE(page.find("<th>jab<td"), std::string::npos);
  EXPECT_NE(table_text(actions, table).find("straight to the head:"), std::string::npos);
}

// Two people in one capture space: one stands where its jab lands on the other, jabs, and the other
// does something about it or nothing.
class Pair : public testing::Test {
 protected:
  static constexpr Tick kLength = 240, kJabAt = 100;

  // The library's idle, then the action from `at` on, at a placement of the space.
  Clip played(ActionId action, Tick at, const Placement& placement) const {
    const MotionLibrary& library = corner().library;
    Launch idle, launch;
    idle.action = library.find("idle");
    launch.action = action;
    launch.start = at;
    idle.placement = launch.placement = placement;
    Clip clip;
    for (Tick t = 0; t <= kLength; ++t) {
      const Tick end = at + library.action(action).length();
      const bool acts = t >= at && t <= end;
      clip.frames.push_back(pose_at(library, acts ? launch : idle,
                                    acts ? t : t % library.action(idle.action).length(), 1));
      clip.root.emplace_back();
      clip.contacts.emplace_back();
    }
    return clip;
  }

  // From where simulated sparring found the attack to land on a standing guard, straight ahead.
  static Placement landing_place(ActionId attack) {
    for (const SparringRecord& record : sparring().records)
      if (record.attack == attack && std::abs(wrapped_angle(record.relative.yaw - kPi)) < 1e-3f)
        return record.relative;
    ADD_FAILURE() << "the attack lands nowhere";
    return {};
  }

  std::vector<SparringRecord> spar(const char* defense, Tick at) const {
    const MotionLibrary& library = corner().library;
    const ActionId jab = library.find("jab"), answer = library.find(defense);
    const Placement other = landing_place(jab);
    const Clip attacker = played(jab, kJabAt, {}), defender = played(answer, at, other);
    const PairTake a{&attacker, {{jab, &library.action(jab), kJabAt, {}}}};
    const PairTake d{&defender, {{answer, &library.action(answer), at, other}}};
    EXPECT_TRUE(pair_records(corner().body, d, a).empty());  // the other does not attack
    return pair_records(corner().body, a, d);
  }
};

TEST_F(Pair, ADefenseInTimeWorksAndALateOneIsStruck) {
  const auto in_time = spar("duck", kJabAt - 6);
  ASSERT_EQ(in_time.size(), 1u);
  EXPECT_EQ(in_time[0].end, ExchangeEnd::evaded);
  EXPECT_EQ(in_time[0].offset, -6);
  EXPECT_GT(in_time[0].relative.z, 0.4f);
  const Tick reach = corner().library.action(corner().library.find("jab")).strikes[0].active_end;
  const auto late = spar("duck", kJabAt + reach - 2);
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(late[0].end, ExchangeEnd::struck);
}

TEST_F(Pair, WhatBeganLongBeforeOrAfterAnswersNothing) {
  EXPECT_TRUE(spar("duck", kJabAt - 40).empty());
  EXPECT_TRUE(spar("duck", kJabAt + 60).empty());
}

}  // namespace
}  // namespace ringcraft
