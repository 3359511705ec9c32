// Tables, pictures and intervals of studies; the checker on two motions.

#include "scene/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "fight/synthetic_library.h"
#include "physics/penetration.h"
#include "scene/study_clips.h"

namespace ringcraft {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Study small_study() {
  Study study;
  study.name = "small";
  study.title = "A < B & C";
  study.said = {"two rows"};
  study.table.columns = {"name", "value_m", "count"};
  study.table.rows = {{std::string("plain"), 0.125, std::int64_t{3}},
                      {std::string("a \"b\", c"), 1e-9, std::int64_t{-1}}};
  StudyChart chart{"Depth", "x, s", "y, m", {}, {}, true, 0.5, true};
  chart.series.push_back({"one", {{0, 0.25, 0.1, 0.4}, {1, 0.75, {}, {}}}});
  study.charts.push_back(chart);
  study.timing.columns = {"ms"};
  study.timing.rows = {{12.5}};
  return study;
}

TEST(StudyTest, CsvQuotesWhatHoldsACommaOrAQuote) {
  EXPECT_EQ(study_csv(small_study().table),
            "name,value_m,count\nplain,0.125,3\n\"a \"\"b\"\", c\",1e-09,-1\n");
}

TEST(StudyTest, FilesHoldTheSameRowsAndTheClockStandsApart) {
  const TemporaryFolder scratch;
  const auto folder = scratch.path() / "small_study";
  ASSERT_TRUE(make_output_folder(folder));
  ASSERT_TRUE(write_study(folder, small_study()));
  for (const auto& file : std::filesystem::directory_iterator(folder))
    EXPECT_THAT(study_file_names(), Contains(file.path().filename().string()));
  const auto json = nlohmann::json::parse(*read_file(folder / "study.json"));
  EXPECT_EQ(json.at("rows").size(), 2u);
  EXPECT_EQ(json.at("rows")[1].at("name"), "a \"b\", c");
  EXPECT_EQ(json.at("rows")[0].at("count"), 3);
  EXPECT_FALSE(json.contains("timing"));
  const auto timing = nlohmann::json::parse(*read_file(folder / "timing.json"));
  EXPECT_DOUBLE_EQ(timing.at("rows")[0].at("ms").get<double>(), 12.5);
  const std::string page = *read_file(folder / "study.html");
  EXPECT_THAT(page, HasSubstr("A &lt; B &amp; C"));
  EXPECT_THAT(page, Not(HasSubstr("A < B")));
}

TEST(StudyTest, PictureHasEveryPointAndEveryInterval) {
  const std::string svg = study_svg(small_study());
  std::size_t dots = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1))
    ++dots;
  EXPECT_EQ(dots, 3u);  // two points and the legend
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(svg, HasSubstr("m-4 0h8"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(StudyTest, OneValueHasNoInterval) {
  const MeanInterval one = mean_interval({3});
  EXPECT_EQ(one.mean, 3);
  EXPECT_FALSE(one.low || one.high);
  const StudyTable table{{"mean", "low"}, {{one.mean, cell_of(one.low)}}};
  EXPECT_EQ(study_csv(table), "mean,low\n3,\n");
  EXPECT_TRUE(mean_interval({3, 4}).low && mean_interval({3, 4}).high);
}

TEST(StudyTest, WilsonsIntervalHasThePublishedValues) {
  // Newcombe 1998, table I, method 3: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
  const auto near = [](Interval of, double low, double high) {
    EXPECT_NEAR(of.low, low, 5e-5);
    EXPECT_NEAR(of.high, high, 5e-5);
  };
  near(wilson(81, 263), 0.2553, 0.3662);
  near(wilson(15, 148), 0.0624, 0.1605);
  near(wilson(0, 20), 0.0000, 0.1611);
  near(wilson(1, 29), 0.0061, 0.1718);
  EXPECT_EQ(wilson(0, 0).high, 1);
}

class ClipsTest : public testing::Test {
 protected:
  ClipsTest() : library_(synthetic::library()), body_(make_body({})) {}
  PlacedClip motion(const char* name) const {
    return {name, &library_.action(library_.find(name)), &body_};
  }
  MotionLibrary library_;
  BodyModel body_;
};

TEST_F(ClipsTest, DepthsAreThoseOfThePosesAndNearerIsDeeper) {
  const ClipDepths near = clip_depths(motion("idle"), motion("idle"), {0.4f, 0, false});
  const ClipDepths far = clip_depths(motion("idle"), motion("idle"), {3.0f, 0, false});
  EXPECT_TRUE(far.pairs.empty());
  ASSERT_FALSE(near.pairs.empty());
  // Posed by hand at the worst tick of the deepest pair.
  const PairDepth& worst = near.pairs.front();
  const Clip& clip = library_.action(library_.find("idle")).clip;
  const auto shown = [&](const Placement& at) {
    const Pose pose = placed(scaled(clip.at(worst.worst), body_.scale), at);
    return capsules(body_, world_pose(body_.skeleton, pose));
  };
  const Penetration deepest = deepest_penetration(shown({}), shown({0, 0.4f, kPi}));
  EXPECT_FLOAT_EQ(deepest.depth, worst.depth);
  EXPECT_LE(worst.first, worst.worst);
  for (std::size_t i = 1; i < near.pairs.size(); ++i) {
    EXPECT_GE(near.pairs[i - 1].depth, near.pairs[i].depth);
  }
}

TEST_F(ClipsTest, StrikesContactIsLeftOutUnlessAskedFor) {
  const auto hand_ticks = [&](bool intended) {
    Tick ticks = 0;
    for (const PairDepth& pair :
         clip_depths(motion("cross"), motion("idle"), {0.75f, 0, intended}).pairs) {
      if (pair.a == Part::right_hand) ticks += pair.ticks;
    }
    return ticks;
  };
  EXPECT_GT(hand_ticks(false), 0);
  EXPECT_LT(hand_ticks(true), hand_ticks(false));
}

TEST_F(ClipsTest, WhoBeginsLaterIsShownLater) {
  const ClipDepths at_once = clip_depths(motion("cross"), motion("idle"), {0.75f, 0, false});
  const ClipDepths later = clip_depths(motion("idle"), motion("cross"), {0.75f, 40, false});
  const Tick cross = library_.action(library_.find("cross")).length();
  EXPECT_EQ(later.deepest.size(), static_cast<std::size_t>(40 + cross + 1));
  EXPECT_GE(later.deepest.size(), at_once.deepest.size());
}

TEST_F(ClipsTest, CaptureStartsOverTheOriginFacingForward) {
  Clip clip = library_.action(library_.find("idle")).clip;
  for (Pose& pose : clip.frames) pose = placed(pose, {2.5f, -1.0f, 1.2f});
  const Clip moved = from_origin(library_.skeleton(), clip);
  const WorldPose first = world_pose(library_.skeleton(), moved.frames.front());
  EXPECT_NEAR(first.position[0].x, 0, 1e-4);
  EXPECT_NEAR(first.position[0].z, 0, 1e-4);
  EXPECT_NEAR(heading_of(first.rotation[index(Joint::upper_chest)]), 0, 1e-3);
}

}  // namespace
}  // namespace ringcraft
