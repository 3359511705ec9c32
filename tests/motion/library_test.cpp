#include "motion/library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/synthetic.h"

namespace ringcraft {
namespace {

using test::action_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<Action> boxing() {
  const Skeleton skeleton = canonical_skeleton();
  return {action_of("idle", Kind::idle, test::idle_clip(skeleton)),
          action_of("jab_left", Kind::attack, test::jab_clip(skeleton)),
          action_of("step", Kind::transition, test::step_clip(skeleton, {0, 0, 0.25f})),
          action_of("stagger", Kind::response, test::step_clip(skeleton, {0, 0, -0.25f}))};
}

TEST(Library, SortsItsActionsByWhoMayChooseThem) {
  const MotionLibrary library("boxing", boxing());
  EXPECT_THAT(library.dropped(), IsEmpty());
  EXPECT_THAT(library.launchable(), ElementsAre(ActionId(0), ActionId(1), ActionId(2)));
  EXPECT_THAT(library.responses(), ElementsAre(ActionId(3)));
  EXPECT_THAT(library.get_ups(), IsEmpty());
  EXPECT_EQ(library.count(Kind::attack), 1u);
  EXPECT_EQ(library.find("step"), ActionId(2));
  EXPECT_FALSE(library.find("kick").valid());
}

TEST(Library, SaysWhatItDroppedAndFromWhere) {
  auto actions = boxing();
  Clip sink = test::jab_clip(canonical_skeleton());
  for (std::size_t i = 0; i < sink.frames.size(); ++i) {
    sink.frames[i].hips.y -= 0.01f * static_cast<float>(i);
  }
  actions.insert(actions.begin(), action_of("sink", Kind::defense, sink));
  const MotionLibrary library("boxing", std::move(actions));
  EXPECT_THAT(library.dropped(), ElementsAre(AllOf(HasSubstr("sink"), HasSubstr("synthetic"))));
  EXPECT_EQ(library.find("idle"), ActionId(0));
}

TEST(Library, AnEmptyOneIsALibraryToo) {
  const MotionLibrary library("empty", {});
  EXPECT_THAT(library.launchable(), IsEmpty());
}

TEST(Library, ItsHashTellsEveryDifferenceThatCanChangeAFight) {
  const std::uint64_t hash = MotionLibrary("boxing", boxing()).hash();
  EXPECT_EQ(MotionLibrary("of another name", boxing()).hash(), hash);
  const auto changed = [&](auto change) {
    auto actions = boxing();
    change(actions[1]);
    return MotionLibrary("boxing", std::move(actions)).hash() != hash;
  };
  EXPECT_TRUE(changed([](Action& a) { a.strikes.push_back({}); }));
  EXPECT_TRUE(changed([](Action& a) { a.defense = Defense{}; }));
  EXPECT_TRUE(changed([](Action& a) { a.clip.contacts[3].left = false; }));
  EXPECT_TRUE(changed([](Action& a) { a.clip.root[3].z += 0.001f; }));
  EXPECT_TRUE(changed([](Action& a) { a.clip.frames[3].hips.y += 0.001f; }));
  EXPECT_FALSE(changed([](Action& a) { a.source = "elsewhere"; }));
}

}  // namespace
}  // namespace ringcraft
