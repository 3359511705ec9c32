#include "cli/completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace ringcraft {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

// A small command of the same kinds of arguments as the real one.
class CompletionTest : public ::testing::Test {
 protected:
  CompletionTest() {
    CLI::App* fight = app_.add_subcommand("fight", "Simulate");
    fight->add_option("SCENE", text_, "Scene");
    fight->add_option("-o,--out", text_, "Folder");
    fight->add_option("--export", list_, "Formats")
        ->check(CLI::IsMember({"bvh", "vrma"}))
        ->delimiter(',')
        ->allow_extra_args(false);
    fight->add_option("--captures", list_, "Two files")->expected(2);
    fight->add_flag("-q,--quiet", flag_, "No progress");
    app_.add_subcommand("find", "Another");
    app_.add_subcommand("fine-print")->group("");
    CLI::App* library = app_.add_subcommand("library", "Libraries");
    library->add_subcommand("build", "One")->add_option("SOURCE", text_, "Where from");
  }

  std::vector<std::string> words(const std::vector<std::string>& typed) {
    std::vector<std::string> found;
    for (const Completion& one : complete(app_, typed).words) found.push_back(one.word);
    return found;
  }
  Completions::Paths paths(const std::vector<std::string>& typed) {
    return complete(app_, typed).paths;
  }

  CLI::App app_;
  std::string text_;
  std::vector<std::string> list_;
  bool flag_ = false;
};

TEST_F(CompletionTest, CommandsThatBeginSo) {
  EXPECT_THAT(words({"fi"}), ElementsAre("fight", "find"));
  EXPECT_THAT(words({"library", ""}), ElementsAre("build"));
}

TEST_F(CompletionTest, HiddenCommandsAreNotOffered) {
  EXPECT_THAT(words({""}), Not(Contains("fine-print")));
}

TEST_F(CompletionTest, OptionsOfTheCommandAfterADash) {
  EXPECT_THAT(words({"fight", "--q"}), ElementsAre("--quiet"));
  EXPECT_THAT(words({"fight", "-"}), IsSupersetOf({"--out", "-o", "--export", "-q", "--help"}));
}

TEST_F(CompletionTest, ValuesThatTheParserChecksFor) {
  EXPECT_THAT(words({"fight", "--export", ""}), ElementsAre("bvh", "vrma"));
  EXPECT_THAT(words({"fight", "--export=v"}), ElementsAre("--export=vrma"));
  EXPECT_THAT(words({"fight", "--export", "bvh,v"}), ElementsAre("bvh,vrma"));
}

TEST_F(CompletionTest, NamesAreThoseOfTheAssets) {
  EXPECT_THAT(words({"fight", "du"}), ElementsAre("duel"));
  EXPECT_THAT(words({"library", "build", ""}), Contains("kickboxing"));
  EXPECT_EQ(paths({"fight", "du"}), Completions::Paths::files);
}

TEST_F(CompletionTest, AnOptionTakesAsManyWordsAsItNeeds) {
  EXPECT_EQ(paths({"fight", "--out", ""}), Completions::Paths::folders);
  EXPECT_EQ(paths({"fight", "--captures", "a", ""}), Completions::Paths::files);
  EXPECT_THAT(words({"fight", "--captures", "a", "b", "d"}), ElementsAre("duel"));
  EXPECT_THAT(words({"fight", "--out=x", "d"}), ElementsAre("duel"));
  EXPECT_THAT(words({"fight", "-q", "d"}), ElementsAre("duel"));
}

TEST_F(CompletionTest, AfterTwoDashesAWordIsNoOption) {
  EXPECT_THAT(words({"fight", "--", "--q"}), IsEmpty());
  EXPECT_THAT(words({"fight", "--", "du"}), ElementsAre("duel"));
}

TEST_F(CompletionTest, APositionalIsFilledOnce) {
  EXPECT_THAT(words({"fight", "duel", "du"}), IsEmpty());
}

TEST_F(CompletionTest, UnknownWordsDoNoHarm) {
  EXPECT_THAT(words({}), Contains("fight"));
  EXPECT_THAT(words({"nonsense", "--what", "=", "x"}), IsEmpty());
  EXPECT_THAT(words({"fight", "--nope=", "--out"}), ElementsAre("--out"));
  EXPECT_THAT(words({"fight", "--nope=x"}), IsEmpty());
}

TEST_F(CompletionTest, EveryShellHasItsScriptAndNoOther) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const auto script = completion_script(shell);
    ASSERT_TRUE(script);
    EXPECT_THAT(*script, ::testing::HasSubstr("complete-words ringcraft"));
  }
  EXPECT_FALSE(completion_script("csh"));
}

}  // namespace
}  // namespace ringcraft
