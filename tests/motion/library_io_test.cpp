#include "motion/library_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <span>

#include "base/hash.h"
#include "base/random.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

using test::action_of;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t kHeader = 32, kEntry = 24;

// One of everything that an action can hold.
MotionLibrary sample() {
  const Skeleton skeleton = canonical_skeleton();
  std::vector<Action> actions = {
      action_of("idle", Kind::idle, test::idle_clip(skeleton, 20)),
      action_of("jab_left", Kind::attack, test::jab_clip(skeleton, 24)),
      action_of("guard", Kind::defense, test::idle_clip(skeleton, 16)),
      action_of("step", Kind::transition, test::step_clip(skeleton, {0, 0, 0.25f}, 30)),
      action_of("stagger", Kind::response, test::step_clip(skeleton, {0, 0, -0.25f}, 30))};
  actions[1].strikes = {
      {StrikeKind::straight, Joint::left_hand, TargetZone::head, 6, 12, "chin", 0.8f, 1.1f}};
  actions[2].defense = Defense{DefenseKind::slip, 2, 9};
  actions[4].response =
      Response{ResponseKind::recovery_steps, 2, 1.5f, std::optional(TargetZone::body)};
  actions[1].leads_to = {"idle", "gu*"};
  const MotionLibrary built("sample", std::move(actions));
  MotionGraph graph;
  graph.clips = {{"idle", 20}, {"jab_left", 24}};
  graph.transitions = {{0, 10, 1, 20, {{0.1f, 0.2f, 0.3f}, 0.05f}}};
  graph.pairs = 12345678901;
  graph.minima = 7;
  graph.dropped = 6;
  return MotionLibrary({built.name(),
                        built.actions(),
                        built.machine(),
                        graph,
                        {"gone: no way back"},
                        {"idle: stands for 0.2 s"},
                        {}});
}

std::string rehashed(std::string bytes) {
  const std::uint64_t hash =
      hash_bytes(std::as_bytes(std::span(bytes.data() + kHeader, bytes.size() - kHeader)));
  std::memcpy(bytes.data() + 24, &hash, 8);
  return bytes;
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, 8);
  return value;
}

// Where section `i` begins and how long it is, in the whole file.
std::pair<std::size_t, std::size_t> section(const std::string& bytes, std::size_t i) {
  return {kHeader + number_at(bytes, kHeader + i * kEntry + 8),
          number_at(bytes, kHeader + i * kEntry + 16)};
}

void expect_equal(const Action& a, const Action& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.connects, b.connects);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.leads_to, b.leads_to);
  EXPECT_EQ(a.starts_lying, b.starts_lying);
  EXPECT_EQ(a.ends_lying, b.ends_lying);
  ASSERT_EQ(a.strikes.size(), b.strikes.size());
  for (std::size_t i = 0; i < a.strikes.size(); ++i) {
    const Strike &s = a.strikes[i], &t = b.strikes[i];
    EXPECT_EQ(std::tie(s.kind, s.joint, s.zone, s.active_begin, s.active_end, s.aim, s.nearest,
                       s.farthest),
              std::tie(t.kind, t.joint, t.zone, t.active_begin, t.active_end, t.aim, t.nearest,
                       t.farthest));
  }
  ASSERT_EQ(a.defense.has_value(), b.defense.has_value());
  if (a.defense) {
    EXPECT_EQ(std::tie(a.defense->kind, a.defense->begin, a.defense->end),
              std::tie(b.defense->kind, b.defense->begin, b.defense->end));
  }
  ASSERT_EQ(a.response.has_value(), b.response.has_value());
  if (a.response) {
    EXPECT_EQ(
        std::tie(a.response->kind, a.response->steps, a.response->direction, a.response->zone),
        std::tie(b.response->kind, b.response->steps, b.response->direction, b.response->zone));
  }
  EXPECT_EQ(a.clip.root, b.clip.root);
  EXPECT_EQ(a.clip.contacts, b.clip.contacts);
  ASSERT_EQ(a.clip.frames.size(), b.clip.frames.size());
  for (std::size_t i = 0; i < a.clip.frames.size(); ++i) {
    EXPECT_EQ(a.clip.frames[i].hips, b.clip.frames[i].hips);
    EXPECT_EQ(a.clip.frames[i].rotation, b.clip.frames[i].rotation);
  }
}

TEST(LibraryIo, WhatIsReadIsWhatWasWritten) {
  const MotionLibrary built = sample();
  const auto read = library_from_bytes(library_bytes(built), "x.ringlib");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->name(), built.name());
  EXPECT_EQ(read->hash(), built.hash());
  EXPECT_EQ(read->dropped(), built.dropped());
  EXPECT_EQ(read->notes(), built.notes());
  EXPECT_EQ(read->launchable(), built.launchable());
  EXPECT_EQ(read->responses(), built.responses());
  ASSERT_EQ(read->actions().size(), built.actions().size());
  const std::size_t count = built.actions().size();
  for (std::size_t i = 0; i < count; ++i) {
    const ActionId from(i);
    expect_equal(read->action(from), built.action(from));
    const auto& edges = built.machine().edges(from);
    ASSERT_EQ(read->machine().edges(from).size(), edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Edge& edge = read->machine().edges(from)[e];
      EXPECT_EQ(edge.to, edges[e].to);
      EXPECT_EQ(edge.alignment.placement, edges[e].alignment.placement);
      EXPECT_EQ(edge.alignment.distance, edges[e].alignment.distance);
    }
    for (std::size_t j = 0; j < count; ++j) {
      const Path *path = built.machine().path(from, ActionId(j)),
                 *got = read->machine().path(from, ActionId(j));
      ASSERT_EQ(path == nullptr, got == nullptr);
      if (path == nullptr) continue;
      EXPECT_EQ(got->via, path->via);
      EXPECT_EQ(got->ticks, path->ticks);
    }
  }
  ASSERT_EQ(read->graph().clips.size(), 2u);
  EXPECT_EQ(read->graph().clips[1].name, "jab_left");
  ASSERT_EQ(read->graph().transitions.size(), 1u);
  EXPECT_EQ(read->graph().transitions[0].to, 20);
  EXPECT_EQ(read->graph().pairs, 12345678901u);
}

TEST(LibraryIo, TheSameLibraryGivesTheSameBytesAndSoDoesTheOneThatWasRead) {
  const std::string bytes = library_bytes(sample());
  EXPECT_EQ(library_bytes(sample()), bytes);
  EXPECT_EQ(library_bytes(*library_from_bytes(bytes, "x")), bytes);
}

TEST(LibraryIo, AForeignFileIsRefused) {
  for (const char* text : {"", "ring", "HIERARCHY\nROOT Hips", "name = \"kickboxing\"\n"}) {
    const auto read = library_from_bytes(text, "x.ringlib");
    ASSERT_FALSE(read);
    EXPECT_THAT(to_string(read.error()), HasSubstr("x.ringlib: bytes 0-8: not a motion library"));
    EXPECT_EQ(read.error().kind, ErrorKind::input);
  }
}

TEST(LibraryIo, AnotherVersionIsRefusedByItsNumber) {
  std::string bytes = library_bytes(sample());
  bytes[8] = 99;
  const auto read = library_from_bytes(bytes, "x");
  ASSERT_FALSE(read);
  EXPECT_THAT(to_string(read.error()), HasSubstr("version 99"));
  EXPECT_THAT(to_string(read.error()), HasSubstr("ringcraft library build"));
}

TEST(LibraryIo, CutOffAnywhereItIsRefused) {
  const std::string bytes = library_bytes(sample());
  for (std::size_t size = 0; size < bytes.size(); size += size < 400 ? 1 : 997) {
    EXPECT_FALSE(library_from_bytes(std::string_view(bytes).substr(0, size), "x")) << size;
  }
  EXPECT_FALSE(library_from_bytes(bytes + "x", "x"));
}

TEST(LibraryIo, AFlippedBitInAnySectionIsFound) {
  const std::string bytes = library_bytes(sample());
  for (std::size_t i = 0; i < 7; ++i) {
    const auto [begin, size] = section(bytes, i);
    ASSERT_GT(size, 0u);
    for (const std::size_t at : {begin, begin + size / 2, begin + size - 1}) {
      std::string flipped = bytes;
      flipped[at] = static_cast<char>(flipped[at] ^ 16);
      const auto read = library_from_bytes(flipped, "x");
      ASSERT_FALSE(read) << i;
      EXPECT_THAT(to_string(read.error()), HasSubstr("damaged"));
    }
  }
}

TEST(LibraryIo, ACutOffSectionIsFoundThoughTheHashIsRight) {
  const std::string bytes = library_bytes(sample());
  for (std::size_t size = kHeader; size < bytes.size(); size += size < 400 ? 1 : 1511) {
    std::string cut = bytes.substr(0, size);
    const std::uint64_t content = size - kHeader;
    std::memcpy(cut.data() + 16, &content, 8);
    EXPECT_FALSE(library_from_bytes(rehashed(cut), "x")) << size;
  }
}

TEST(LibraryIo, HugeCountsAndSizesAreRefusedBeforeAnythingIsMadeOfThem) {
  const std::string bytes = library_bytes(sample());
  const std::uint32_t huge = 0xfffffff0u;
  for (std::size_t i = 0; i < 7; ++i) {
    std::string table = bytes;  // of the section, in the table
    std::memset(table.data() + kHeader + i * kEntry + 16, 0xff, 8);
    EXPECT_FALSE(library_from_bytes(rehashed(table), "x")) << i;
  }
  // The first count of every section: bytes from its beginning.
  const std::size_t counts[] = {4, 0, 0, 0, 1, 0, 0};
  for (std::size_t i = 0; i < 7; ++i) {
    std::string counted = bytes;
    std::memcpy(counted.data() + section(bytes, i).first + counts[i], &huge, 4);
    const auto read = library_from_bytes(rehashed(counted), "x");
    ASSERT_FALSE(read) << i;
    EXPECT_THAT(to_string(read.error()), HasSubstr("section")) << i;
  }
}

TEST(LibraryIo, ThatAnActionCannotBePlayedIsSaidByItsName) {
  const auto refused = [](auto change) {
    const MotionLibrary good = sample();
    std::vector<Action> actions = good.actions();
    change(actions);
    const MotionLibrary bad({"bad", actions, good.machine(), {}, {}, {}, {}});
    const auto read = library_from_bytes(library_bytes(bad), "x");
    return read ? std::string() : to_string(read.error());
  };
  EXPECT_EQ(refused([](auto&) {}), "");
  EXPECT_THAT(refused([](auto& a) { a[1].strikes[0].active_end = 400; }), HasSubstr("jab_left"));
  EXPECT_THAT(refused([](auto& a) { a[1].strikes[0].joint = Joint::spine; }), HasSubstr("strike"));
  EXPECT_THAT(refused([](auto& a) { a[1].strikes.resize(9, a[1].strikes[0]); }),
              HasSubstr("jab_left"));
  EXPECT_THAT(
      refused([](auto& a) { a[1].strikes[0].active_begin = a[1].strikes[0].active_end = 25; }),
      HasSubstr("jab_left: a strike outside"));
  for (const float reach : {-1e30f, 1e6f, std::nanf("")}) {
    EXPECT_THAT(refused([&](auto& a) { a[1].strikes[0].nearest = reach; }), HasSubstr("no blow"));
    EXPECT_THAT(refused([&](auto& a) { a[1].strikes[0].farthest = reach; }), HasSubstr("no blow"));
  }
  EXPECT_THAT(refused([](auto& a) { a[3].clip = cut(a[3].clip, 0, 11); }), HasSubstr("0.1 s"));
  EXPECT_EQ(refused([](auto& a) { a[3].clip = cut(a[3].clip, 0, 12); }), "");
  EXPECT_THAT(refused([](auto& a) { a[1].strikes.clear(); }), HasSubstr("strikes nothing"));
  EXPECT_THAT(refused([](auto& a) { a[4].response->steps = 0; }), HasSubstr("steps do not fit"));
  EXPECT_THAT(refused([](auto& a) { a[4].ends_lying = Lying::back; }), HasSubstr("'knockdown'"));
  EXPECT_THAT(refused([](auto& a) { a[0].starts_lying = Lying::back; }), HasSubstr("get-up"));
  EXPECT_THAT(refused([](auto& a) { a[2].defense->begin = -1; }), HasSubstr("guard"));
  EXPECT_THAT(refused([](auto& a) { a[4].response.reset(); }), HasSubstr("stagger"));
  EXPECT_THAT(refused([](auto& a) { a[0].clip.frames[3].hips.y = std::nanf(""); }),
              HasSubstr("not finite"));
  EXPECT_THAT(refused([](auto& a) { a[0].name = "step"; }), HasSubstr("two actions"));
  EXPECT_THAT(refused([](auto& a) { a[0].name = "step\xff"; }), HasSubstr("section"));
  EXPECT_THAT(refused([](auto& a) { a[0].name = "step\x1b[31m"; }), HasSubstr("control char"));
  EXPECT_THAT(refused([](auto& a) { a[0].source = "Box\xe9.bvh"; }), HasSubstr("section"));
}

TEST(LibraryIo, OneThatNobodyCanFightWithIsRefused) {
  const MotionLibrary good = sample();
  std::vector<Action> actions = good.actions();
  for (Action& action : actions) action.kind = Kind::get_up;
  for (const auto& forced : {actions, std::vector<Action>{}}) {
    const MotionLibrary bad(LibraryParts{"bad", forced, good.machine(), {}, {}, {}, {}});
    const auto read = library_from_bytes(library_bytes(bad), "x");
    ASSERT_FALSE(read);
  }
}

TEST(LibraryIo, AnEdgeToWhatIsForcedIsRefused) {
  // What follows a blow or a fall is never launched: a planner that is led there finds no launch.
  const MotionLibrary good = sample();
  std::vector<Action> actions = good.actions();
  for (Action& action : actions) {
    if (action.name != "step") continue;
    action.kind = Kind::get_up;
  }
  const MotionLibrary bad({"bad", actions, good.machine(), {}, {}, {}, {}});
  const auto read = library_from_bytes(library_bytes(bad), "x");
  ASSERT_FALSE(read);
  EXPECT_THAT(to_string(read.error()), HasSubstr("step cannot follow"));
}

TEST(LibraryIo, WhatFollowsBeyondAllBoundsIsRefused) {
  // The first edge: after its section's first count and its own number, x, z, yaw and distance.
  const std::string bytes = library_bytes(sample());
  const std::size_t edge = section(bytes, 3).first + 8;
  for (const auto& [place, number] : {std::pair<std::size_t, float>{0, 1001},
                                      {1, -1e30f},
                                      {2, 6300},
                                      {2, std::nanf("")},
                                      {3, std::numeric_limits<float>::infinity()}}) {
    std::string far = bytes;
    std::memcpy(far.data() + edge + 4 * place, &number, 4);
    const auto read = library_from_bytes(rehashed(far), "x");
    ASSERT_FALSE(read) << place << ": " << number;
    EXPECT_THAT(to_string(read.error()), HasSubstr("edges"));
  }
  std::string near = bytes;
  const float metres = 999;
  std::memcpy(near.data() + edge, &metres, 4);
  EXPECT_TRUE(library_from_bytes(rehashed(near), "x"));

  const MotionLibrary good = sample();
  MotionGraph graph = good.graph();
  graph.transitions[0].alignment.placement.yaw = 6300;
  const MotionLibrary bad(LibraryParts{"bad", good.actions(), good.machine(), graph, {}, {}, {}});
  const auto read = library_from_bytes(library_bytes(bad), "x");
  ASSERT_FALSE(read);
  EXPECT_THAT(to_string(read.error()), HasSubstr("graph"));
}

TEST(LibraryIo, NoBytesMakeItCrash) {
  const std::string bytes = library_bytes(sample());
  const std::size_t clips = section(bytes, 2).first, after = section(bytes, 3).first;
  Random random(5);
  int read_again = 0;
  for (int n = 0; n < 3000; ++n) {
    std::string bad = bytes;
    for (int k = random.below(3); k >= 0; --k) {
      // Seldom in the frames, which are most of the file.
      std::size_t at = kHeader + static_cast<std::size_t>(
                                     random.below(static_cast<int>(bytes.size() - kHeader)));
      if (at > clips + 64 && at < after) {
        at = after + at % (bytes.size() - after);
      }
      bad[at] = static_cast<char>(random.bits());
    }
    const auto read = library_from_bytes(rehashed(bad), "x");
    if (read) {
      ++read_again;
      EXPECT_FALSE(read->launchable().empty());
    } else {
      EXPECT_THAT(to_string(read.error()), Not(HasSubstr("\n")));
    }
  }
  EXPECT_GT(read_again, 0);  // names and notes may say anything
}

}  // namespace
}  // namespace ringcraft
