#include "scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temporary_folder.h"

namespace ringcraft {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHead = "duration_s = 5\nlibrary = \"kickboxing\"\n";

std::string fighter(const std::string& name, const std::string& position,
                    const std::string& more = "", const std::string& body = "middleweight",
                    const std::string& style = "balanced") {
  return "[[fighter]]\nname = \"" + name + "\"\nbody = \"" + body + "\"\nstyle = \"" + style +
         "\"\nposition = " + position + "\n" + more;
}

class SceneFileTest : public ::testing::Test {
 protected:
  Result<SceneFile> read(const std::string& text, const std::vector<std::string>& sets = {}) {
    const auto path = folder_.path() / "sample.toml";
    EXPECT_TRUE(write_file(path, text));
    return read_scene(path.string(), sets);
  }
  TemporaryFolder folder_;
};

TEST_F(SceneFileTest, EveryPublishedSceneCanBeRead) {
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "scenes")) {
    const auto scene = read_scene(entry.path().stem().string());
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_EQ(scene->name, entry.path().stem().string());
    ++seen;
  }
  EXPECT_GE(seen, 2);
}

TEST_F(SceneFileTest, EveryPublishedBodyMakesABody) {
  for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "bodies")) {
    const auto body = read_body(entry.path());
    ASSERT_TRUE(body) << to_string(body.error());
    EXPECT_EQ(body->name, entry.path().stem().string());
  }
}

TEST_F(SceneFileTest, ANameFromAFileNameIsUtf8) {
  const auto path = folder_.path() / "n\xff.toml";
  ASSERT_TRUE(write_file(path, kHead + fighter("a", "[0, -1]") + fighter("b", "[0, 1]")));
  const auto scene = read_scene(path.string());
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_EQ(scene->name, "n\u00ff");
}

TEST_F(SceneFileTest, AFileNameOfDotsIsNoName) {
  const auto path = folder_.path() / "...toml";
  ASSERT_TRUE(write_file(path, kHead + fighter("a", "[0, -1]") + fighter("b", "[0, 1]")));
  const auto scene = read_scene(path.string());
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_EQ(scene->name, "scene");
}

TEST_F(SceneFileTest, SettlesWhatTheFightLoopNeeds) {
  const auto scene = read(std::string(kHead) + "seed = 7\nring_m = 8\n" +
                          fighter("a", "[0, -1]", "horizon_s = 1.25\nhealth = 12.5\n") +
                          fighter("b", "[0, 1]", "gloves = \"#ff0080\"\n", "heavyweight") +
                          "[planner]\nnode_limit = 500\nprune = {back_turned = false}\n");
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_EQ(scene->name, "sample");
  EXPECT_EQ(scene->duration, 600);
  EXPECT_EQ(scene->seed, 7u);
  EXPECT_EQ(scene->library, assets_folder() / "kickboxing");
  EXPECT_EQ(scene->planner.ring_half_m, 4.0);
  EXPECT_EQ(scene->planner.node_limit, 500u);
  EXPECT_FALSE(scene->planner.prune.back_turned);
  EXPECT_TRUE(scene->planner.prune.unanswered_hit);
  ASSERT_EQ(scene->fighters.size(), 2u);
  const SceneFighter& a = scene->fighters[0];
  const SceneFighter& b = scene->fighters[1];
  EXPECT_EQ(a.style.horizon_s, 1.25);
  EXPECT_NE(b.style.horizon_s, 1.25);
  EXPECT_EQ(a.health, 12'500);
  EXPECT_GT(b.body.mass, a.body.mass);
  EXPECT_EQ(b.gloves.x, 1.0f);
  EXPECT_EQ(b.gloves.y, 0.0f);
  EXPECT_NEAR(b.gloves.z, 0.2159f, 1e-3f);  // sRGB 128 in linear light
  EXPECT_NE(a.team, b.team);
}

TEST_F(SceneFileTest, FightersFaceTheNearestOpponentNotTheNearestFriend) {
  const auto scene = read(std::string(kHead) + fighter("a", "[0, 0]", "team = \"x\"\n") +
                          fighter("friend", "[0, 0.6]", "team = \"x\"\n") +
                          fighter("near", "[1, 0]") + fighter("far", "[0, -2]", "yaw_deg = 270\n"));
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_EQ(scene->fighters[0].team, scene->fighters[1].team);
  EXPECT_NEAR(scene->fighters[0].placement.yaw, kPi / 2, 1e-5f);  // toward +X
  EXPECT_NEAR(scene->fighters[2].placement.yaw, -kPi / 2, 1e-5f);
  EXPECT_NEAR(scene->fighters[3].placement.yaw, -kPi / 2, 1e-5f);
}

TEST_F(SceneFileTest, TeamsHaveColoursOfTheirOwn) {
  std::string crowd = kHead;
  for (int i = 0; i < 16; ++i) {
    const std::string at = std::to_string(i - 8);
    crowd += fighter("f" + at, "[" + at + ", 0]", i < 2 ? "team = \"x\"\n" : "");
  }
  const auto scene = read("ring_m = 20\n" + crowd);
  ASSERT_TRUE(scene) << to_string(scene.error());
  for (const SceneFighter& one : scene->fighters) {
    EXPECT_EQ(one.shorts, one.gloves);
    for (const SceneFighter& other : scene->fighters) {
      EXPECT_EQ(one.shorts == other.shorts, one.team == other.team);
    }
  }
}

TEST_F(SceneFileTest, SetsAreDoneBeforeTheCheck) {
  const std::string text = kHead + fighter("a", "[0, -1]") + fighter("b", "[0, 1]");
  const auto scene = read(text, {"seed=9", "fighter.1.horizon_s=0.5", "duration_s=2"});
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_EQ(scene->seed, 9u);
  EXPECT_EQ(scene->duration, 240);
  EXPECT_EQ(scene->fighters[1].style.horizon_s, 0.5);
  const auto faulty = read(text, {"fighter.1.horizon_s=-0.5"});
  ASSERT_FALSE(faulty);
  EXPECT_EQ(faulty.error().kind, ErrorKind::usage);
  EXPECT_EQ(faulty.error().place, "--set");
}

TEST_F(SceneFileTest, AnUnknownSceneIsAnInputErrorThatNamesTheKnownOnes) {
  const auto scene = read_scene("duell");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::input);
  EXPECT_THAT(scene.error().remedy, HasSubstr("did you mean 'duel'?"));
  EXPECT_THAT(scene.error().remedy, HasSubstr("brawl3"));
  const auto missing = read_scene((folder_.path() / "missing.toml").string());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::input);
}

struct BadScene {
  const char* name;
  std::string text;
  ErrorKind kind;
  const char* place;
  const char* what;
  const char* remedy;
};
void PrintTo(const BadScene& scene, std::ostream* out) {
  *out << scene.name;
}

class BadSceneTest : public SceneFileTest, public ::testing::WithParamInterface<BadScene> {};

TEST_P(BadSceneTest, GivesOneLineWithPlaceAndRemedy) {
  const auto scene = read(GetParam().text);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, GetParam().kind);
  EXPECT_THAT(scene.error().file, HasSubstr("sample.toml"));
  EXPECT_EQ(scene.error().place, GetParam().place) << to_string(scene.error());
  EXPECT_THAT(scene.error().what, HasSubstr(GetParam().what));
  EXPECT_THAT(scene.error().remedy, HasSubstr(GetParam().remedy));
  EXPECT_EQ(to_string(scene.error()).find('\n'), std::string::npos);
}

const std::string kA = fighter("a", "[0, -1]");
const std::string kB = fighter("b", "[0, 1]");

INSTANTIATE_TEST_SUITE_P(
    Scenes, BadSceneTest,
    ::testing::Values(
        BadScene{"UnknownKey", kHead + kA + "horizont_s = 2\n" + kB, ErrorKind::usage, "line 8",
                 "unknown key 'horizont_s'", "did you mean 'horizon_s'?"},
        BadScene{"OneFighter", kHead + kA, ErrorKind::usage, "line 3",
                 "'fighter' has 1 entry, at least 2 are needed", "a fight needs an opponent"},
        BadScene{"NoFighter", kHead, ErrorKind::usage, "line 1", "'fighter' is missing", "two"},
        BadScene{"SeventeenFighters",
                 [] {
                   std::string text = kHead;
                   for (int i = 0; i < 17; ++i) text += fighter("f" + std::to_string(i), "[0, 0]");
                   return text;
                 }(),
                 ErrorKind::usage, "line 3", "17 entries, at most 16", "remove"},
        BadScene{"NegativeHorizon", kHead + kA + "horizon_s = -1\n" + kB, ErrorKind::usage,
                 "line 8", "'fighter.0.horizon_s' is -1, out of range", "above 0 and at most 5"},
        BadScene{"ZeroDuration", "duration_s = 0\nlibrary = \"kickboxing\"\n" + kA + kB,
                 ErrorKind::usage, "line 1", "out of range", "above 0"},
        BadScene{"MissingBody", kHead + kA + fighter("b", "[0, 1]", "", "middelweight"),
                 ErrorKind::input, "line 10", "middelweight.toml", "did you mean 'middleweight'?"},
        BadScene{"MissingBodyPath", kHead + kA + fighter("b", "[0, 1]", "", "my/body.toml"),
                 ErrorKind::input, "line 10", "my/body.toml", "check the path"},
        BadScene{"MissingStyle", kHead + kA + fighter("b", "[0, 1]", "", "heavyweight", "balancd"),
                 ErrorKind::input, "line 11", "balancd.toml", "did you mean 'balanced'?"},
        BadScene{"MissingLibrary", "duration_s = 1\nlibrary = \"none\"\n" + kA + kB,
                 ErrorKind::input, "line 2", "no such folder", "kickboxing"},
        BadScene{"SameName", kHead + kA + fighter("a", "[0, 1]"), ErrorKind::usage, "line 9",
                 "two fighters are called 'a'", "name of its own"},
        BadScene{"OutsideTheRing", kHead + kA + fighter("b", "[0, 3.5]"), ErrorKind::usage,
                 "line 12", "'b' stands outside the ring", "within 3 m"},
        BadScene{"InsideOneAnother", kHead + kA + fighter("b", "[0.1, -1]"), ErrorKind::usage,
                 "line 12", "'b' stands inside 'a'", "at least 0.4 m"},
        BadScene{"OneTeam",
                 kHead + fighter("a", "[0, -1]", "team = \"x\"\n") +
                     fighter("b", "[0, 1]", "team = \"x\"\n"),
                 ErrorKind::usage, "line 8", "all fighters are of one team", "another team"},
        BadScene{"ColourWord", kHead + kA + "gloves = \"red\"\n" + kB, ErrorKind::usage, "line 8",
                 "'fighter.0.gloves' is \"red\"", "#rrggbb"},
        BadScene{"PositionIn3D", kHead + fighter("a", "[0, 0, -1]") + kB, ErrorKind::usage,
                 "line 7", "'fighter.0.position' has 3 entries", "[x, z]"},
        BadScene{"YawBeyondATurn", kHead + kA + "yaw_deg = 450\n" + kB, ErrorKind::usage, "line 8",
                 "'fighter.0.yaw_deg' is 450, out of range", "at most 360"},
        BadScene{"SeedText", "seed = \"x\"\n" + (kHead + kA + kB), ErrorKind::usage, "line 1",
                 "'seed' is a string", "an integer"}),
    [](const auto& test) { return test.param.name; });

TEST_F(SceneFileTest, AFaultInABodyFileNamesThatFile) {
  ASSERT_TRUE(write_file(folder_.path() / "giant.toml", "height_m = 9\nmass_kg = 80\n"));
  const auto scene = read(kHead + kA + fighter("b", "[0, 1]", "", "giant.toml"));
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::usage);
  EXPECT_THAT(scene.error().file, HasSubstr("giant.toml"));
  EXPECT_EQ(scene.error().place, "line 1");
}

// A batch goes on only with bouts of the same settings: a style or a body that was changed makes
// another fight of the same scene.
TEST_F(SceneFileTest, StylesAndBodiesArePartOfTheSettingsAndTheSeedIsNot) {
  const std::string text = kHead + kA + fighter("b", "[0, 1]", "", "own.toml", "own_style.toml");
  const auto settings = [&](const std::string& body, const std::string& style,
                            const std::string& seed) {
    EXPECT_TRUE(write_file(folder_.path() / "own.toml", body));
    EXPECT_TRUE(write_file(folder_.path() / "own_style.toml", style));
    const auto scene = read(text, {"seed=" + seed});
    EXPECT_TRUE(scene) << to_string(scene.error());
    return scene->settings;
  };
  const std::string body = "height_m = 1.8\nmass_kg = 80\n", style = "distance_m = 1.1\n";
  const std::uint64_t first = settings(body, style, "1");
  EXPECT_EQ(settings(body, style, "2"), first);
  EXPECT_NE(settings("height_m = 1.8\nmass_kg = 81\n", style, "1"), first);
  EXPECT_NE(settings(body, "distance_m = 1.2\n", "1"), first);
}

}  // namespace
}  // namespace ringcraft
