#include "planner/search.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "planner/root_search.h"

namespace ringcraft {
namespace {

// An explicit tree. Nothing here knows of fights.
struct Toy {
  struct Vertex {
    Actor actor = Actor::maximizer;
    std::vector<std::int32_t> children;
    std::vector<std::int32_t> faults;  // of the edges
    std::int32_t value = 0;            // of a leaf, less what was gained on the way
    std::int32_t gain = 0;             // on the edge into it
    std::uint64_t hash = 0;
    ValueRange range;  // less what was gained on the way, that into it included
  };
  struct Node {
    std::int32_t at = 0;
    std::int32_t gained = 0;
  };
  using Move = std::int32_t;

  const std::vector<Vertex>* tree = nullptr;

  const Vertex& vertex(const Node& node) const {
    return (*tree)[static_cast<std::size_t>(node.at)];
  }
  bool terminal(const Node& node) { return vertex(node).children.empty(); }
  Actor actor(const Node& node) { return vertex(node).actor; }
  std::int32_t value(const Node& node) { return vertex(node).value + node.gained; }
  std::int32_t gained(const Node& node) { return node.gained; }
  ValueRange range(const Node& node) {
    const ValueRange& own = vertex(node).range;
    if (own.least == kWorst) return own;
    return {own.least + node.gained, own.most + node.gained};
  }
  std::uint64_t hash(const Node& node) { return vertex(node).hash; }
  void moves(const Node& node, std::vector<Move>& moves) {
    for (std::size_t i = 0; i < vertex(node).children.size(); ++i) {
      moves.push_back(static_cast<Move>(i));
    }
  }
  Child<Node> step(const Node& node, Move move) {
    const std::int32_t to = vertex(node).children[static_cast<std::size_t>(move)];
    return {{to, node.gained + (*tree)[static_cast<std::size_t>(to)].gain}, 0};
  }
  void check(const Node& node, Move move, Child<Node>& child) {
    const auto i = static_cast<std::size_t>(move);
    child.fault += vertex(node).faults.empty() ? 0 : vertex(node).faults[i];
  }
  Child<Node> apply(const Node& node, Move move) {
    Child<Node> child = step(node, move);
    check(node, move, child);
    return child;
  }
  std::uint32_t key(Move move) const { return static_cast<std::uint32_t>(move); }
};
static_assert(Game<Toy>);

// Unequal depth, the same side twice running, forced nodes, struck-off children, subtrees that are
// met on two ways (transpositions), and nodes whose range is known, more or less well.
class RandomTree {
 public:
  explicit RandomTree(std::uint64_t seed, bool faults, int deeper = 0)
      : random_(seed), faults_(faults) {
    depth_ = 2 + deeper + random_.below(5);
    width_ = 1 + random_.below(5);
    sound_ = random_.below(4);
    grow(0);
  }
  const std::vector<Toy::Vertex>& vertices() const { return vertices_; }

 private:
  std::int32_t grow(int depth) {
    const auto at = static_cast<std::int32_t>(vertices_.size());
    vertices_.emplace_back();
    Toy::Vertex vertex;
    vertex.hash = static_cast<std::uint64_t>(at) * 0x9e3779b97f4a7c15ULL;
    vertex.gain = random_.below(41) - 20;
    vertex.value = random_.below(61) - 30;
    const bool leaf = depth >= depth_ || (depth > 0 && random_.below(8) == 0);
    if (!leaf) {
      const int kind = random_.below(10);
      vertex.actor = kind < 2 ? Actor::forced : kind < 6 ? Actor::maximizer : Actor::minimizer;
      const int count = vertex.actor == Actor::forced ? 1 : 1 + random_.below(width_);
      for (int i = 0; i < count; ++i) {
        const bool again = !closed_.empty() && random_.below(6) == 0;
        const std::int32_t child =
            again
                ? closed_[static_cast<std::size_t>(random_.below(static_cast<int>(closed_.size())))]
                : grow(depth + 1);
        vertex.children.push_back(child);
        const bool struck = faults_ && vertex.actor != Actor::forced && random_.below(4) >= sound_;
        vertex.faults.push_back(struck ? 1 + random_.below(3) : 0);
      }
    }
    ValueRange below{vertex.value, vertex.value};
    if (!vertex.children.empty()) {
      below = {kBest, kWorst};
      for (const std::int32_t child : vertex.children) {
        const auto to = static_cast<std::size_t>(child);
        below.least = std::min(below.least, vertices_[to].gain + ranges_[to].least);
        below.most = std::max(below.most, vertices_[to].gain + ranges_[to].most);
      }
      if (random_.below(3) == 0) {
        vertex.range = {below.least - random_.below(10), below.most + random_.below(10)};
      }
    }
    ranges_.resize(vertices_.size());
    ranges_[static_cast<std::size_t>(at)] = below;
    vertices_[static_cast<std::size_t>(at)] = vertex;
    if (depth > 2) closed_.push_back(at);
    return at;
  }

  Random random_;
  bool faults_;
  int depth_ = 0, width_ = 0;
  int sound_ = 0;  // children in four that are not struck off; often all of a node are
  std::vector<Toy::Vertex> vertices_;
  std::vector<ValueRange> ranges_;    // of what is below each vertex
  std::vector<std::int32_t> closed_;  // finished subtrees: may be met again
};

SearchSettings variant(int bits) {
  SearchSettings settings;
  settings.table = (bits & 1) != 0;
  settings.killers = (bits & 2) != 0;
  settings.history = (bits & 4) != 0;
  settings.table_bits = settings.most_table_bits = 6;  // small, so that entries are replaced
  return settings;
}

std::int32_t followed(Toy& toy, const std::vector<Toy::Move>& line) {
  Toy::Node node;
  for (const Toy::Move move : line) node = toy.apply(node, move).node;
  return toy.terminal(node) ? toy.value(node) : kWorst;
}

TEST(SearchTest, AlphaBetaReturnsMinimaxValueOnRandomTrees) {
  int trees = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    const RandomTree tree(seed, seed % 2 == 0);
    Toy toy{&tree.vertices()};
    SearchCounts counts;
    const std::int32_t truth = minimax(toy, Toy::Node{}, counts);
    for (int bits = 0; bits < 8; ++bits) {
      Search<Toy> search(variant(bits));
      std::vector<Toy::Move> line;
      ASSERT_EQ(search.run(toy, {}, kWorst, kBest, line), truth) << seed << " variant " << bits;
      // An end that cannot matter is counted without being asked whether it is struck off.
      if (seed % 2 != 0) {
        ASSERT_LE(search.counts().nodes, counts.nodes) << seed;
      }
      if (!variant(bits).table) {
        ASSERT_EQ(followed(toy, line), truth) << seed;
      }
    }
    ++trees;
  }
  EXPECT_EQ(trees, 10'000);
}

TEST(SearchTest, WindowGivesTheValueInsideAndABoundOutside) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const RandomTree tree(seed, false);
    Toy toy{&tree.vertices()};
    SearchCounts counts;
    const std::int32_t truth = minimax(toy, Toy::Node{}, counts);
    for (const std::int32_t alpha : {-40, -5, 0, 20}) {
      Search<Toy> search(variant(7));
      std::vector<Toy::Move> line;
      const std::int32_t value = search.run(toy, {}, alpha, alpha + 15, line);
      if (truth > alpha && truth < alpha + 15) {
        EXPECT_EQ(value, truth);
      } else if (truth <= alpha) {
        EXPECT_LE(value, alpha);
        EXPECT_GE(value, truth);
      } else {
        EXPECT_GE(value, alpha + 15);
        EXPECT_LE(value, truth);
      }
    }
  }
}

// A uniform alternating tree whose leaves make every node's first child its best.
std::vector<Toy::Vertex> perfectly_ordered(int width, int depth) {
  std::vector<Toy::Vertex> tree;
  Random random(7);
  const auto grow = [&](auto&& self, int level, std::int32_t value) -> std::int32_t {
    const auto at = static_cast<std::int32_t>(tree.size());
    tree.emplace_back();
    Toy::Vertex vertex;
    const bool max = level % 2 == 0;
    vertex.actor = max ? Actor::maximizer : Actor::minimizer;
    vertex.value = value;
    vertex.hash = static_cast<std::uint64_t>(at) * 0x9e3779b97f4a7c15ULL;
    for (int i = 0; i < width && level < depth; ++i) {
      const int worse = i == 0 ? 0 : 1 + random.below(50);
      vertex.children.push_back(self(self, level + 1, max ? value - worse : value + worse));
    }
    tree[static_cast<std::size_t>(at)] = vertex;
    return at;
  };
  grow(grow, 0, 0);
  return tree;
}

std::uint64_t power(std::uint64_t base, int exponent) {
  std::uint64_t result = 1;
  while (exponent-- > 0) result *= base;
  return result;
}

TEST(SearchTest, PerfectOrderVisitsExactlyTheMinimalTree) {
  // Knuth and Moore 1975: w^ceil(d/2) + w^floor(d/2) - 1 leaves.
  SearchSettings plain;
  plain.table = plain.killers = plain.history = false;
  for (const int width : {2, 3, 5}) {
    for (int depth = 1; depth <= 6; ++depth) {
      const std::vector<Toy::Vertex> tree = perfectly_ordered(width, depth);
      Toy toy{&tree};
      Search<Toy> search(plain);
      std::vector<Toy::Move> line;
      EXPECT_EQ(search.run(toy, {}, kWorst, kBest, line), 0);
      const auto w = static_cast<std::uint64_t>(width);
      EXPECT_EQ(search.counts().leaves, power(w, (depth + 1) / 2) + power(w, depth / 2) - 1)
          << width << " " << depth;
      EXPECT_EQ(line, std::vector<Toy::Move>(static_cast<std::size_t>(depth), 0));
    }
  }
}

TEST(SearchTest, EveryOrderVisitsAtLeastTheMinimalTree) {
  SearchSettings plain;
  plain.table = false;
  Random random(3);
  for (int run = 0; run < 40; ++run) {
    std::vector<Toy::Vertex> tree = perfectly_ordered(3, 5);
    for (Toy::Vertex& vertex : tree) vertex.value = random.below(1000) * 1000 + run;
    std::int32_t next = 0;  // leaves with different values: no cut-offs by equality
    for (Toy::Vertex& vertex : tree) vertex.value += ++next;
    Toy toy{&tree};
    Search<Toy> search(plain);
    std::vector<Toy::Move> line;
    search.run(toy, {}, kWorst, kBest, line);
    EXPECT_GE(search.counts().leaves, power(3, 3) + power(3, 2) - 1);
    EXPECT_LE(search.counts().leaves, power(3, 5));
  }
}

TEST(SearchTest, NodeLimitAborts) {
  const std::vector<Toy::Vertex> tree = perfectly_ordered(4, 6);
  Toy toy{&tree};
  SearchSettings settings;
  settings.node_limit = 50;
  Search<Toy> search(settings);
  std::vector<Toy::Move> line;
  search.run(toy, {}, kWorst, kBest, line);
  EXPECT_TRUE(search.aborted());
  search.set_node_limit(0);
  EXPECT_EQ(search.run(toy, {}, kWorst, kBest, line), 0);
  EXPECT_FALSE(search.aborted());
}

TEST(SearchTest, LongerHorizonKeepsNoValues) {
  std::vector<Toy::Vertex> tree = perfectly_ordered(3, 4);
  Toy toy{&tree};
  Search<Toy> search({});
  std::vector<Toy::Move> line;
  EXPECT_EQ(search.run(toy, {}, kWorst, kBest, line), 0);
  for (Toy::Vertex& vertex : tree) vertex.value += 1000;  // the same states, other values
  search.next_horizon();
  EXPECT_EQ(search.run(toy, {}, kWorst, kBest, line), 1000);
}

// A table that was too small grows, and knows what one knows that was large from the beginning.
TEST(SearchTest, ATableGrowsWithWhatItHolds) {
  std::array<std::uint64_t, 3> nodes{};  // always small, growing, always large
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const RandomTree tree(seed, false, 5);
    Toy toy{&tree.vertices()};
    SearchCounts counts;
    const std::int32_t truth = minimax(toy, Toy::Node{}, counts);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      SearchSettings settings;
      settings.killers = settings.history = false;
      settings.table_bits = i == 2 ? 14 : 0;
      settings.most_table_bits = i == 0 ? 0 : 14;
      Search<Toy> search(settings);
      std::vector<Toy::Move> line;
      for (int horizon = 0; horizon < 2; ++horizon) {
        ASSERT_EQ(search.run(toy, {}, kWorst, kBest, line), truth) << seed;
        nodes[i] += search.counts().nodes;
        search.next_horizon();
      }
    }
  }
  EXPECT_LT(nodes[1], 0.9 * static_cast<double>(nodes[0]));
  EXPECT_LT(nodes[1], 1.01 * static_cast<double>(nodes[2]));
}

// What a search has done before, on another tree with the same names, changes nothing either.
TEST(RootSearchTest, TheLargestSumIsFoundForAnyNumberOfThreads) {
  SearchPool<Toy> worn;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    const RandomTree tree(seed, true);
    Toy toy{&tree.vertices()};
    if (toy.terminal({}) || toy.actor({}) != Actor::maximizer) continue;
    const auto preference = [&](std::uint32_t move) {  // ties too
      return static_cast<std::int32_t>((seed * 7 + move * 5) % 4) * 3;
    };
    SearchPool<Toy> fresh;
    RootSearch<Toy> one({}, 1, true, worn), two({}, 2, true, fresh), plain({}, 1, false, fresh);
    const auto a = one.run(toy, {}, preference, 0);
    const auto b = two.run(toy, {}, preference, 0);
    const auto truth = plain.run(toy, {}, preference, 0);
    ASSERT_EQ(a.size(), truth.size());
    EXPECT_EQ(a.front().move, truth.front().move);
    EXPECT_EQ(a.front().value, truth.front().value);
    EXPECT_TRUE(a.front().exact);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].move, b[i].move);
      EXPECT_EQ(a[i].value, b[i].value);
      EXPECT_EQ(a[i].line, b[i].line);
      EXPECT_EQ(a[i].counts.nodes, b[i].counts.nodes);
      const auto same = std::find_if(truth.begin(), truth.end(),
                                     [&](const auto& t) { return t.move == a[i].move; });
      if (a[i].exact) {
        EXPECT_EQ(a[i].value, same->value);
      }
      EXPECT_GE(a[i].value, same->value);
      EXPECT_LE(a[i].sum(), a.front().sum());
    }
  }
}

TEST(RootSearchTest, TooSmallANodeLimitGivesNothing) {
  const std::vector<Toy::Vertex> tree = perfectly_ordered(4, 6);
  Toy toy{&tree};
  SearchPool<Toy> pool;
  RootSearch<Toy> search({}, 1, true, pool);
  const auto none = [](std::uint32_t) { return 0; };
  EXPECT_TRUE(search.run(toy, {}, none, 100).empty());
  EXPECT_GT(search.spent(), 0u);
  EXPECT_EQ(search.run(toy, {}, none, 100'000).size(), 4u);
}

}  // namespace
}  // namespace ringcraft
