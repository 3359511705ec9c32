#include "cli/help.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace ringcraft {
namespace {

TEST(Help, SaysTheDefaultThatTheCodeHas) {
  CLI::App app;
  app.option_defaults()->always_capture_default();
  CLI::App* below = app.add_subcommand("below");
  double tone = .5;
  std::optional<double> none, elsewhere;
  std::string word, needed = "x";
  std::vector<std::string> list;
  bool flag = false;
  below->add_option("--tone", tone, "Tone");
  below->add_option("--none", none, "None");
  below->add_option("--elsewhere", elsewhere, "Elsewhere")->default_str("7");
  below->add_option("--word", word, "Word");
  below->add_option("--needed", needed, "Needed")->required();
  below->add_option("--list", list, "List");
  below->add_flag("--flag", flag, "Flag");
  say_defaults(app);
  const auto says = [&](const char* option) {
    return below->get_option(option)->get_description();
  };
  EXPECT_EQ(says("--tone"), "Tone [0.5]");
  EXPECT_EQ(says("--elsewhere"), "Elsewhere [7]");
  EXPECT_EQ(says("--none"), "None");
  EXPECT_EQ(says("--word"), "Word");
  EXPECT_EQ(says("--needed"), "Needed");
  EXPECT_EQ(says("--list"), "List");
  EXPECT_EQ(says("--flag"), "Flag");
  app.parse("below --needed y");
  EXPECT_EQ(tone, .5);  // said, not set
  EXPECT_FALSE(elsewhere);
}

}  // namespace
}  // namespace ringcraft
