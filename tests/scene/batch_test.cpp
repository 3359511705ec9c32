#include "scene/batch.h"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture/library_file.h"

namespace ringcraft {
namespace {

class BatchTest : public testing::Test {
 protected:
  static const SceneFile& scene() {
    static const SceneFile kScene = *read_scene("duel", {"duration_s=1.5", "seed=1"});
    return kScene;
  }
  static const MotionLibrary& library() {
    static const MotionLibrary kLibrary = *load_library(scene().library);
    return kLibrary;
  }
  static Batch ran(std::uint64_t first, int count, int threads) {
    Batch batch = batch_of(scene(), library());
    SceneFile from = scene();
    from.seed = first;
    StudyRun run;
    run.threads = threads;
    EXPECT_TRUE(
        run_batch(batch, library(), from, count, run, [](const Batch&) { return Result<void>(); }));
    return batch;
  }
};

TEST_F(BatchTest, AnyNumberOfThreadsAndMachinesGiveTheSameBatch) {
  const Batch whole = ran(1, 3, 2);
  EXPECT_EQ(whole.bouts.size(), 3u);
  Batch parts = ran(3, 1, 1);
  ASSERT_TRUE(add_bouts(parts, ran(1, 2, 1), "elsewhere"));
  EXPECT_EQ(bouts_jsonl(parts), bouts_jsonl(whole));
  EXPECT_EQ(study_csv(summary_of(parts).table), study_csv(summary_of(whole).table));
}

TEST_F(BatchTest, WhatIsWrittenIsReadAndGoesOn) {
  const Batch first = ran(1, 1, 1);
  auto read = read_bouts("bouts.jsonl", bouts_jsonl(first));
  ASSERT_TRUE(read);
  EXPECT_EQ(bouts_jsonl(*read), bouts_jsonl(first));
  int kept = 0;
  ASSERT_TRUE(run_batch(*read, library(), scene(), 2, {}, [&](const Batch& batch) {
    ++kept;
    EXPECT_EQ(batch.bouts.size(), 2u);
    return Result<void>();
  }));
  EXPECT_EQ(kept, 1);  // the bout that was there did not run again
}

TEST_F(BatchTest, WhereNothingCanBeKeptNoFurtherBoutBegins) {
  Batch batch = batch_of(scene(), library());
  int asked = 0;
  const auto ran = run_batch(batch, library(), scene(), 3, {}, [&](const Batch&) -> Result<void> {
    ++asked;
    return input_error("bouts.jsonl", "", "the disk is full", "make room");
  });
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.error().what, "the disk is full");
  EXPECT_EQ(asked, 1);
}

// Reports of four bouts in which one number goes 1, 2, 3, 6 and one stands still.
Batch by_hand() {
  Batch batch{"yard", "00"};
  std::uint64_t seed = 10;
  for (const int strikes : {1, 2, 3, 6}) {
    batch.bouts[seed] =
        R"({"fighters":[{"landed":1,"name":"A","strikes":)" + std::to_string(strikes) +
        R"(},{"name":"A","strikes":0}],"physics":{"deepest_at_s":)" + std::to_string(strikes) +
        R"(},"scene":"yard","seed":)" + std::to_string(seed) + "}";
    ++seed;
  }
  return batch;
}

TEST(BatchSummary, MeansHaveIntervalsAndNamesakesStandApart) {
  const Study study = summary_of(by_hand());
  const auto row = [&](const std::string& of, const std::string& measure) {
    for (const auto& cells : study.table.rows)
      if (std::get<std::string>(cells[0]) == of && std::get<std::string>(cells[1]) == measure)
        return cells;
    return std::vector<StudyCell>(8, 0.0);
  };
  const auto strikes = row("A 0", "strikes"), landed = row("A 0", "landed");
  EXPECT_EQ(std::get<std::int64_t>(strikes[2]), 4);
  EXPECT_DOUBLE_EQ(std::get<double>(strikes[3]), 3);
  // Standard deviation 2.160, Student's t of three degrees of freedom 3.182: 3 -+ 3.437.
  EXPECT_NEAR(std::get<double>(strikes[4]), -0.437, 0.05);
  EXPECT_NEAR(std::get<double>(strikes[5]), 6.437, 0.05);
  EXPECT_EQ(std::get<double>(strikes[6]), 1);
  EXPECT_EQ(std::get<double>(strikes[7]), 6);
  EXPECT_EQ(std::get<double>(landed[4]), 1);
  EXPECT_EQ(std::get<double>(row("A 1", "strikes")[7]), 0);
  EXPECT_EQ(std::get<std::int64_t>(row("A 1", "strikes")[2]), 4);
  for (const auto& cells : study.table.rows)
    EXPECT_NE(std::get<std::string>(cells[1]), "deepest_at_s") << "moments have no mean";
}

// The line of a bout of the yard between fighters of these names.
std::string with_fighters(const std::vector<std::string>& names) {
  std::string fighters;
  for (const std::string& name : names)
    fighters += (fighters.empty() ? "" : ",") + (R"({"name":")" + name + "\"}");
  return R"({"seed":1,"scene":"yard","fighters":[)" + fighters + "]}\n";
}

TEST(BatchSummary, WhatIsNotABatchIsRefusedWithItsLine) {
  const std::string good = bouts_jsonl(by_hand());
  ASSERT_TRUE(read_bouts("b", good));
  const std::size_t second = good.find('\n') + 1, third = good.find('\n', second) + 1;
  const std::string line = good.substr(second, third - second);
  for (const auto& [text, place, what] : std::vector<std::array<std::string, 3>>{
           {"", "line 1", "empty"},
           {"{}\n", "line 1", "header"},
           {"[]\n", "line 1", "object"},
           {good.substr(0, third - 3), "line 2", "cut off"},
           {good.substr(0, second) + "[1]\n", "line 2", "object"},
           {good.substr(0, second) + "{\"a\":" + std::string(99, '[') + std::string(99, ']') +
                "}\n",
            "line 2", "nested"},
           {good.substr(0, second) + R"({"seed":-1})" + "\n", "line 2", "seed"},
           {good.substr(0, second) + R"({"seed":1,"scene":"other"})" + "\n", "line 2", "yard"},
           {good.substr(0, second) + R"({"seed":1,"scene":"yard","fighters":[7]})" + "\n", "line 2",
            "fighter"},
           {good.substr(0, second) + with_fighters(std::vector<std::string>(17, "A")), "line 2",
            "17 fighters, at most 16"},
           {good.substr(0, second) + with_fighters({std::string(513, 'A')}), "line 2", "name"},
           {R"({"type":"header","scene":"ya\u001b[31mrd","setup":"00"})"
            "\n",
            "line 1", "header"},
           {good.substr(0, second) + with_fighters({R"(A\u001b[31m)"}), "line 2",
            "has control characters"},
           {good.substr(0, second) +
                R"({"seed":1,"scene":"yard","fighters":[{"name":"A","str\nikes":1}]})" + "\n",
            "line 2", "has control characters"},
           {good.substr(0, second) +
                R"({"seed":1,"scene":"yard","fighters":[{"name":"A","strikes":1.7e308}]})" + "\n",
            "line 2", "'strikes' of A is larger than any bout's"},
           {good.substr(0, second) +
                R"({"seed":1,"scene":"yard","fighters":[],"quality":{"skate":-1e200}})" + "\n",
            "line 2", "'skate' of quality is larger"},
           {good + line, "line 6", "twice"},
           {good.substr(0, third), "line 2",
            "counts 4 bouts, and 1 are there: the file is cut off"},
           {good + with_fighters({"A"}), "line 6",
            "counts 4 bouts, and 5 are there: lines were added"},
           {R"({"type":"header","scene":"yard","setup":"00","bouts":-1})"
            "\n",
            "line 1", "no count"}}) {
    const auto read = read_bouts("b", text);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().place, place) << text;
    EXPECT_NE(read.error().what.find(what), std::string::npos) << read.error().what;
  }
}

TEST(BatchSummary, SixteenFightersAreRead) {
  const std::string header = "{\"type\":\"header\",\"scene\":\"yard\",\"setup\":\"0\"}\n";
  EXPECT_TRUE(read_bouts("b", header + with_fighters(std::vector<std::string>(16, "A"))));
}

TEST(BatchSummary, OnlyBoutsOfOneSetupAreAdded) {
  Batch batch = by_hand();
  Batch other = by_hand();
  EXPECT_TRUE(add_bouts(batch, other, "there"));
  EXPECT_EQ(batch.bouts.size(), 4u);
  other.bouts[10].replace(other.bouts[10].find("\"strikes\":1"), 11, "\"strikes\":9");
  const auto differs = add_bouts(batch, other, "there");
  ASSERT_FALSE(differs);
  EXPECT_EQ(differs.error().place, "seed 10");
  other.setup = "01";
  EXPECT_FALSE(add_bouts(batch, other, "there"));
}

}  // namespace
}  // namespace ringcraft
