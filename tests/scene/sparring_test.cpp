#include "scene/sparring.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fight/synthetic_library.h"
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
  EXPECT_EQ(records_csv(corner().library, again.records),
            records_csv(corner().library, sparring().records));
}

TEST(Sparring, FilesHoldEveryRecordAndEveryAttack) {
  const MotionLibrary& library = corner().library;
  const std::string csv = records_csv(library, sparring().records);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            sparring().records.size() + 1);
  const OffenseDefenseTable table(sparring().records);
  const std::string json = table_json(library, table), page = table_page(library, table);
  EXPECT_NE(json.find("\"attack\": \"jab\""), std::string::npos);
  EXPECT_NE(page.find("<th>jab<td"), std::string::npos);
  EXPECT_NE(table_text(library, sparring(), table).find("straight to the head:"),
            std::string::npos);
}

}  // namespace
}  // namespace ringcraft
