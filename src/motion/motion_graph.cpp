#include "motion/motion_graph.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <thread>
#include <tuple>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

#include "motion/motion_graph_map.h"

namespace ringcraft {

namespace {

constexpr float kSlack = 0.05f;  // m: a minimum of the coarse map may lie so much higher
constexpr std::size_t kRowsAtOnce = 96;

using Span = GraphSource::Span;

// One span of one source, with its frames on the coarse map.
struct Stretch {
  std::size_t source = 0;
  Span span;
  CloudMatrix coarse;
};

struct Prepared {
  std::vector<std::vector<Cloud>> clouds;  // of every frame of every source
  std::vector<Stretch> stretches;
};

// Every stride-th tick of a span, and its last.
std::vector<Tick> coarse_ticks(const Span& span, Tick stride) {
  std::vector<Tick> ticks;
  for (Tick t = span.first; t < span.last; t += stride) ticks.push_back(t);
  ticks.push_back(span.last);
  return ticks;
}

// Runs work(i) for i in [0, count) on some threads; what each does must not depend on the others.
template <class Work>
void in_parallel(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(std::max(0, threads - 1)));
  for (int t = 1; t < threads; ++t) others.emplace_back(run);
  run();
  for (std::thread& thread : others) thread.join();
}

Prepared prepare(const Skeleton& skeleton, const std::vector<GraphSource>& sources,
                 const GraphSettings& settings) {
  Prepared all;
  all.clouds.resize(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (const Span& span : sources[s].spans) all.stretches.push_back({s, span, {}});
  }
  in_parallel(sources.size(), settings.threads, [&](std::size_t s) {
    const Clip& clip = *sources[s].clip;
    all.clouds[s].reserve(clip.frames.size());
    for (Tick t = 0; t <= clip.length(); ++t) {
      all.clouds[s].push_back(cloud_at(skeleton, clip, t));
    }
  });
  in_parallel(all.stretches.size(), settings.threads, [&](std::size_t i) {
    Stretch& stretch = all.stretches[i];
    stretch.coarse = cloud_matrix(skeleton, *sources[stretch.source].clip,
                                  coarse_ticks(stretch.span, settings.stride));
  });
  return all;
}

// A search for minima: rows of one stretch against all others.
class MinimaSearch {
 public:
  MinimaSearch(const Prepared& all, const std::vector<GraphSource>& sources,
               const GraphSettings& settings)
      : all_(all), sources_(sources), settings_(settings) {}

  struct Rows {
    const Stretch* stretch = nullptr;
    std::size_t first = 0, count = 0;
  };

  std::vector<Transition> find(const Rows& rows, std::uint64_t& pairs) const {
    std::vector<Transition> found;
    for (const Stretch& columns : all_.stretches) {
      if (!columns.span.enter) continue;
      // One row more on each side, so that a minimum is seen to be one.
      const std::size_t before = rows.first > 0 ? 1 : 0;
      const std::size_t total = rows.stretch->coarse.ticks.size();
      const std::size_t after = rows.first + rows.count < total ? 1 : 0;
      const Eigen::MatrixXf map = distances(rows.stretch->coarse, rows.first - before,
                                            before + rows.count + after, columns.coarse);
      pairs += static_cast<std::uint64_t>(rows.count) *
               static_cast<std::uint64_t>(columns.coarse.ticks.size());
      add_minima(rows, before, columns, map, found);
    }
    return found;
  }

 private:
  // What a minimum is one of: of the whole map, of the row where a clip ends, of the column where
  // one starts, or the corner of both. What ends is left there, what starts is entered there.
  enum class Sort : std::uint8_t { inner, end, start, corner };
  struct Minimum {
    float distance = 0;
    Tick leave = 0, enter = 0;
  };

  void add_minima(const Rows& rows, std::size_t before, const Stretch& columns,
                  const Eigen::MatrixXf& map, std::vector<Transition>& found) const {
    const GraphSource &from = sources_[rows.stretch->source], &to = sources_[columns.source];
    const float threshold = threshold_of(from, to);
    std::array<std::vector<Minimum>, 4> minima;
    const auto add = [&](Sort sort, const Minimum& m) {
      minima[static_cast<std::size_t>(sort)].push_back(m);
    };
    for (std::size_t r = 0; r < rows.count; ++r) {
      const auto i = static_cast<Eigen::Index>(before + r);
      const Tick leave = rows.stretch->coarse.ticks[rows.first + r];
      const bool at_end = leave == from.clip->length();
      for (Eigen::Index j = 0; j < map.cols(); ++j) {
        if (map(i, j) > threshold + kSlack) continue;
        const Tick enter = columns.coarse.ticks[static_cast<std::size_t>(j)];
        const bool at_start = enter == 0 && to.starts;
        const Minimum minimum{map(i, j), leave, enter};
        if (lowest(map, i, j, true, true)) add(Sort::inner, minimum);
        if (at_end && lowest(map, i, j, false, true)) add(Sort::end, minimum);
        if (at_start && lowest(map, i, j, true, false)) add(Sort::start, minimum);
        if (at_end && at_start) add(Sort::corner, minimum);
      }
    }
    const std::size_t most =
        settings_.most * (1 + static_cast<std::size_t>(map.cols()) / kRowsAtOnce);
    for (const Sort sort : {Sort::inner, Sort::end, Sort::start, Sort::corner}) {
      std::vector<Minimum>& of = minima[static_cast<std::size_t>(sort)];
      std::stable_sort(of.begin(), of.end(),
                       [](const Minimum& a, const Minimum& b) { return a.distance < b.distance; });
      if (of.size() > most) of.resize(most);
      for (const Minimum& m : of) {
        refine(rows, columns, m, sort == Sort::inner || sort == Sort::start,
               sort == Sort::inner || sort == Sort::end, threshold, found);
      }
    }
  }

  // A get-up or response is quicker than a step, and less is seen of its feet.
  float threshold_of(const GraphSource& from, const GraphSource& to) const {
    const float answering = settings_.answering;
    return from.threshold >= answering ? answering : std::min(from.threshold, to.threshold);
  }

  // Whether no neighbour is lower; of equal ones the first is the minimum.
  static bool lowest(const Eigen::MatrixXf& map, Eigen::Index i, Eigen::Index j, bool over_rows,
                     bool over_columns) {
    for (Eigen::Index di = over_rows ? -1 : 0; di <= (over_rows ? 1 : 0); ++di) {
      for (Eigen::Index dj = over_columns ? -1 : 0; dj <= (over_columns ? 1 : 0); ++dj) {
        const Eigen::Index a = i + di, b = j + dj;
        if ((di == 0 && dj == 0) || a < 0 || b < 0 || a >= map.rows() || b >= map.cols()) continue;
        const bool earlier = di < 0 || (di == 0 && dj < 0);
        if (earlier ? map(a, b) <= map(i, j) : map(a, b) < map(i, j)) return false;
      }
    }
    return true;
  }

  // Refines a minimum of the coarse map to the tick: downhill within one step of the map.
  void refine(const Rows& rows, const Stretch& columns, const Minimum& minimum, bool move_leave,
              bool move_enter, float threshold, std::vector<Transition>& found) const {
    Tick leave = minimum.leave, enter = minimum.enter;
    const std::size_t a = rows.stretch->source, b = columns.source;
    const Tick stride = settings_.stride;
    const auto window = [&](const Span& span, Tick tick, bool moves) {
      return moves ? std::pair(std::max(span.first, tick - stride),
                               std::min(span.last, tick + stride))
                   : std::pair(tick, tick);
    };
    const auto [leave_first, leave_last] = window(rows.stretch->span, leave, move_leave);
    const auto [enter_first, enter_last] = window(columns.span, enter, move_enter);
    const auto at = [&](Tick from, Tick to) {
      return align(all_.clouds[a][static_cast<std::size_t>(from)],
                   all_.clouds[b][static_cast<std::size_t>(to)]);
    };
    Alignment best = at(leave, enter);
    for (bool better = true; better;) {
      better = false;
      const Tick from = leave, to = enter;
      for (Tick i = std::max(leave_first, from - 1); i <= std::min(leave_last, from + 1); ++i) {
        for (Tick j = std::max(enter_first, to - 1); j <= std::min(enter_last, to + 1); ++j) {
          const Alignment tried = at(i, j);
          if (tried.distance >= best.distance) continue;
          best = tried, leave = i, enter = j, better = true;
        }
      }
    }
    if (best.distance > threshold) return;
    if (a == b && std::abs(leave - enter) < settings_.apart) return;
    found.push_back(
        {static_cast<std::int32_t>(a), leave, static_cast<std::int32_t>(b), enter, best});
  }

  const Prepared& all_;
  const std::vector<GraphSource>& sources_;
  const GraphSettings& settings_;
};

auto order(const Transition& t) {
  return std::tuple(t.from_clip, t.from, t.to_clip, t.to);
}

// All minima under their thresholds, in order, each once.
std::vector<Transition> find_minima(const Prepared& all, const std::vector<GraphSource>& sources,
                                    const GraphSettings& settings, std::uint64_t& pairs) {
  std::vector<MinimaSearch::Rows> work;
  for (const Stretch& stretch : all.stretches) {
    if (!stretch.span.leave) continue;
    const std::size_t rows = stretch.coarse.ticks.size();
    for (std::size_t first = 0; first < rows; first += kRowsAtOnce) {
      work.push_back({&stretch, first, std::min(kRowsAtOnce, rows - first)});
    }
  }
  const MinimaSearch search(all, sources, settings);
  std::vector<std::vector<Transition>> found(work.size());
  std::vector<std::uint64_t> compared(work.size());
  in_parallel(work.size(), settings.threads,
              [&](std::size_t i) { found[i] = search.find(work[i], compared[i]); });
  std::vector<Transition> minima;
  for (std::size_t i = 0; i < work.size(); ++i) {
    pairs += compared[i];
    minima.insert(minima.end(), found[i].begin(), found[i].end());
  }
  std::sort(minima.begin(), minima.end(),
            [](const Transition& a, const Transition& b) { return order(a) < order(b); });
  minima.erase(
      std::unique(minima.begin(), minima.end(),
                  [](const Transition& a, const Transition& b) { return order(a) == order(b); }),
      minima.end());
  return minima;
}

// The transitions of the largest strongly connected component of frames, and those that lead into
// it from the end of what is never entered (responses).
std::vector<Transition> connected(const std::vector<Transition>& minima,
                                  const std::vector<GraphSource>& sources) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
  std::map<std::pair<std::int32_t, Tick>, std::size_t> nodes;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const auto clip = static_cast<std::int32_t>(s);
    if (sources[s].starts) nodes[{clip, 0}] = 0;
    nodes[{clip, sources[s].clip->length()}] = 0;
  }
  for (const Transition& t : minima) nodes[{t.from_clip, t.from}] = nodes[{t.to_clip, t.to}] = 0;
  std::size_t count = 0;
  for (auto& [place, number] : nodes) number = count++;
  Graph graph(count);
  for (auto it = nodes.begin(); it != nodes.end(); ++it) {  // a clip plays on
    const auto after = std::next(it);
    if (after != nodes.end() && after->first.first == it->first.first) {
      boost::add_edge(it->second, after->second, graph);
    }
  }
  for (const Transition& t : minima) {
    boost::add_edge(nodes[{t.from_clip, t.from}], nodes[{t.to_clip, t.to}], graph);
  }
  std::vector<int> component(count);
  const int components = count == 0 ? 0 : boost::strong_components(graph, component.data());
  std::vector<std::size_t> size(static_cast<std::size_t>(components));
  for (const int c : component) ++size[static_cast<std::size_t>(c)];
  const auto largest = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  std::vector<Transition> kept;
  for (const Transition& t : minima) {
    const bool enters = component[nodes[{t.to_clip, t.to}]] == largest;
    const bool inside = component[nodes[{t.from_clip, t.from}]] == largest;
    const bool answers = !sources[static_cast<std::size_t>(t.from_clip)].starts;
    if (enters && (inside || answers)) kept.push_back(t);
  }
  return kept;
}

// Quiet parts of an action: before its first blow or defense, and after its last.
std::vector<Span> quiet_spans(const Action& action) {
  const Tick length = action.length();
  Tick begin = length, end = 0;
  for (const Strike& strike : action.strikes) {
    begin = std::min(begin, strike.active_begin);
    end = std::max(end, strike.active_end);
  }
  if (action.defense) {
    begin = std::min(begin, action.defense->begin);
    end = std::max(end, action.defense->end);
  }
  if (begin >= end) return {{0, length, true, true}};
  std::vector<Span> spans;
  // What leaves a start-up is a feint that nobody chose.
  spans.push_back({0, std::clamp<Tick>(begin - 1, 0, length), false, true});
  const Tick over = std::clamp<Tick>(end, 0, length);
  if (over > spans[0].last) spans.push_back({over, length, true, true});
  return spans;
}

}  // namespace

std::vector<GraphSource> graph_sources(const std::vector<Action>& actions,
                                       const GraphSettings& settings) {
  std::vector<GraphSource> sources;
  sources.reserve(actions.size());
  for (const Action& action : actions) {
    GraphSource source;
    source.name = action.name;
    source.clip = &action.clip;
    if (action.forced()) {
      source.starts = false;
      source.threshold = settings.answering;
      const Tick end = action.length();
      if (action.ends_lying == Lying::none) source.spans.push_back({end, end, true, false});
    } else {
      const bool quiet = action.kind == Kind::transition || action.kind == Kind::idle;
      source.threshold = quiet ? settings.stepping : settings.striking;
      source.spans = quiet_spans(action);
    }
    sources.push_back(std::move(source));
  }
  return sources;
}

MotionGraph build_motion_graph(const Skeleton& skeleton, const std::vector<GraphSource>& sources,
                               const GraphSettings& settings) {
  MotionGraph graph;
  graph.clips.reserve(sources.size());
  for (const GraphSource& source : sources) {
    graph.clips.push_back({source.name, source.clip->length()});
  }
  const Prepared all = prepare(skeleton, sources, settings);
  const std::vector<Transition> minima = find_minima(all, sources, settings, graph.pairs);
  graph.transitions = connected(minima, sources);
  graph.minima = static_cast<std::uint32_t>(minima.size());
  graph.dropped = static_cast<std::uint32_t>(minima.size() - graph.transitions.size());
  return graph;
}

}  // namespace ringcraft
