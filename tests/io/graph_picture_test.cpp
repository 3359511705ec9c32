#include "io/graph_picture.h"

#include <gmock/gmock.h>

#include "../motion/synthetic.h"

namespace ringcraft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two idles and a jab that follow each other, and an idle that only a second way leads to.
MotionLibrary small_library() {
  const Skeleton skeleton = canonical_skeleton();
  std::vector<Action> actions;
  actions.push_back(test::action_of("stand<1>", Kind::idle, test::idle_clip(skeleton)));
  actions.push_back(test::action_of("jab", Kind::attack, test::jab_clip(skeleton)));
  Strike strike;
  strike.active_begin = 20;
  strike.active_end = 30;
  actions.back().strikes.push_back(strike);
  actions.push_back(
      test::action_of("way", Kind::transition, test::step_clip(skeleton, Vec3(0, 0, 0.3f))));
  actions.back().connects = true;
  return MotionLibrary("small", std::move(actions));
}

TEST(ActionGraphPicture, StandsByKindWithoutWhatOnlyConnects) {
  const GraphPicture picture = action_graph(small_library());
  EXPECT_THAT(picture.names, ElementsAre("jab", "stand<1>"));
  EXPECT_THAT(picture.groups, ElementsAre("attack", "idle"));
}

TEST(ActionGraphPicture, SaysWhatTheStateMachineSays) {
  const MotionLibrary library = small_library();
  const GraphPicture picture = action_graph(library);
  for (std::size_t row = 0; row < picture.names.size(); ++row) {
    for (std::size_t column = 0; column < picture.names.size(); ++column) {
      const ActionId from = library.find(picture.names[row]),
                     to = library.find(picture.names[column]);
      const bool direct = library.machine().edge(from, to) != nullptr;
      EXPECT_EQ(picture.at(row, column) == 0, direct) << row << " " << column;
    }
  }
}

TEST(ActionGraphPicture, NamesAreEscapedAndFieldsDrawn) {
  const std::string svg = picture_svg(action_graph(small_library()), "graph");
  EXPECT_THAT(svg, HasSubstr("stand&lt;1&gt;"));
  EXPECT_THAT(svg, HasSubstr("id='graph'"));
  EXPECT_THAT(svg, HasSubstr("fill='#11623a' d='M"));
}

TEST(ClipGraphPicture, CountsTransitionsBetweenClips) {
  const MotionLibrary base = small_library();
  LibraryParts parts;
  parts.name = "small";
  parts.actions = base.actions();
  parts.machine = base.machine();
  for (const Action& action : base.actions())
    parts.graph.clips.push_back({action.name, action.length()});
  const auto clip_of = [&](const char* name) {
    return static_cast<std::int32_t>(base.find(name).at());
  };
  for (Tick t = 0; t < 5; ++t)
    parts.graph.transitions.push_back({clip_of("jab"), t, clip_of("stand<1>"), 0, {}});
  parts.graph.transitions.push_back({clip_of("stand<1>"), 3, clip_of("jab"), 0, {}});
  const GraphPicture picture = clip_graph(MotionLibrary(std::move(parts)));
  EXPECT_EQ(picture.at(0, 0), -1);
  EXPECT_EQ(picture.at(0, 1), 2);  // five of them
  EXPECT_EQ(picture.at(1, 0), 0);  // one
}

}  // namespace
}  // namespace ringcraft
