#include "scene/bench.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "io/events.h"
#include "io/report.h"
#include "planner/motion_tables.h"
#include "scene/study.h"

namespace ringcraft {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Two actions in flight at one tick of a fight.
struct FramePair {
  std::size_t a = 0, b = 0;  // in `flights`
  Tick tick = 0;
};

// The frame pairs of the first fighter and its opponent, one a tick, as the tree would ask for
// them.
class FramePairs {
 public:
  FramePairs(const MotionLibrary& library, const FightRecord& record) {
    for (std::size_t i = 0; i < 2; ++i) tables_.emplace_back(library, record.bodies[i]);
    std::vector<std::size_t> of[2];
    for (std::size_t i = 0; i < 2; ++i) {
      for (const Segment& segment : record.timeline.tracks[i].segments) {
        of[i].push_back(flights_.size());
        flights_.emplace_back(tables_[i], segment.launch);
      }
    }
    std::size_t at[2] = {0, 0};
    for (Tick tick = 0; tick < record.timeline.end; ++tick) {
      for (std::size_t i = 0; i < 2; ++i) {
        while (at[i] + 1 < of[i].size() && flights_[of[i][at[i]]].launch.end <= tick) ++at[i];
      }
      if (!of[0].empty() && !of[1].empty()) pairs_.push_back({of[0][at[0]], of[1][at[1]], tick});
    }
  }

  // Frame pairs a second, over at least a quarter of a second.
  double checked_per_second(float least) const {
    if (pairs_.empty()) return 0;
    constexpr double kLongEnough_s = 0.25;
    double checked = 0, took = 0;
    float deepest = 0;
    const auto begin = Clock::now();
    do {
      for (const FramePair& pair : pairs_)
        deepest =
            std::max(deepest, penetration_at(flights_[pair.a], flights_[pair.b], pair.tick, least));
      checked += static_cast<double>(pairs_.size());
      took = seconds_since(begin);
    } while (took < kLongEnough_s);
    return deepest < 0 ? 0 : checked / took;  // what was computed is used
  }

 private:
  std::deque<MotionTables> tables_;
  std::vector<InFlight> flights_;
  std::vector<FramePair> pairs_;
};

void add(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

double per_second(double count, double seconds) {
  return seconds > 0 ? count / seconds : 0;
}

// Decisions and nodes of all rounds.
double all_rounds(std::uint64_t of_one, const Bench& bench) {
  return static_cast<double>(of_one) * bench.rounds;
}

}  // namespace

FightSignature signature_of(const FightRecord& record) {
  FightSignature signature;
  for (const Event& event : record.timeline.events) {
    signature.decisions += event.type == EventType::decision ? 1 : 0;
    signature.nodes += event.decision.nodes;
    signature.leaves += event.decision.leaves;
  }
  signature.impacts = record.counts.impacts;
  signature.memo_misses = record.counts.memo_misses;
  signature.timeline = record.timeline.hash();
  return signature;
}

std::string signature_text(const FightSignature& signature) {
  return fmt::format("signature nodes {} leaves {} impacts {} memo {} timeline {}", signature.nodes,
                     signature.leaves, signature.impacts, signature.memo_misses,
                     hash_name(signature.timeline));
}

Bench run_bench(const MotionLibrary& library, const SceneFile& scene, int rounds,
                const StudyRun& run) {
  Bench bench;
  FightOptions options;
  options.threads = run.threads;
  options.interrupted = run.interrupted;
  for (int round = 0; round < rounds; ++round) {
    run.say(fmt::format("round {} of {}: {:g} s of {}", round + 1, rounds, seconds(scene.duration),
                        scene.name));
    const auto begin = Clock::now();
    const FightRecord record = simulate_fight(library, scene, options);
    const double took = seconds_since(begin);
    if (record.interrupted) {
      bench.interrupted = true;
      break;
    }
    const FightSignature signature = signature_of(record);
    if (round == 0) bench.signature = signature;
    bench.differs |= signature != bench.signature;
    ++bench.rounds;
    bench.wall_s += took;
    bench.fought_s += seconds(record.timeline.end);
    add(bench.decision_ms, record.decision_ms);
    add(bench.impulse_step_us, record.impulse_step_us);
    if (round > 0) continue;
    const FramePairs pairs(library, record);
    bench.frame_pairs_per_s =
        pairs.checked_per_second(static_cast<float>(scene.planner.prune.penetration_m));
  }
  bench.deciding_s =
      std::accumulate(bench.decision_ms.begin(), bench.decision_ms.end(), 0.0) / 1000;
  return bench;
}

nlohmann::json bench_json(const Bench& bench, const SceneFile& scene,
                          const MotionLibrary& library) {
  const FightSignature& signature = bench.signature;
  return {{"version", RINGCRAFT_VERSION},
          {"scene", scene.name},
          {"seed", scene.seed},
          {"duration_s", seconds(scene.duration)},
          {"library", {{"name", library.name()}, {"hash", hash_name(library.hash())}}},
          {"rounds", bench.rounds},
          {"rounds_differ", bench.differs},
          {"interrupted", bench.interrupted},
          {"signature",
           {{"decisions", signature.decisions},
            {"nodes", signature.nodes},
            {"leaves", signature.leaves},
            {"impacts", signature.impacts},
            {"memo_misses", signature.memo_misses},
            {"timeline", hash_name(signature.timeline)}}}};
}

nlohmann::json bench_timing_json(const Bench& bench, int threads) {
  Timeline length;
  length.end = ticks(bench.fought_s);
  nlohmann::json timing =
      timing_json(length, {bench.wall_s, threads, bench.decision_ms, bench.impulse_step_us});
  const auto whole = [](double value) { return rounded(value, 0); };
  timing["decisions_per_s"] =
      rounded(per_second(all_rounds(bench.signature.decisions, bench), bench.deciding_s), 1);
  timing["nodes_per_s"] =
      whole(per_second(all_rounds(bench.signature.nodes, bench), bench.deciding_s));
  timing["penetration_frame_pairs_per_s"] = whole(bench.frame_pairs_per_s);
  return timing;
}

std::string bench_text(const nlohmann::json& timing) {
  StudyTable table{{"measure", "value", "unit"}, {}};
  const auto row = [&](const char* measure, const char* pointer, const char* unit) {
    const auto value = timing.at(nlohmann::json::json_pointer(pointer)).get<double>();
    const std::string text = value <= 0     ? "-"  // nothing of it happened
                             : value < 1000 ? fmt::format("{:.4g}", value)
                                            : fmt::format("{:.0f}", value);
    table.rows.push_back({std::string(measure), text, std::string(unit)});
  };
  row("fight", "/realtime_factor", "x real time");
  row("decisions", "/decisions_per_s", "1/s");
  row("decision p50", "/decision_ms/p50", "ms");
  row("decision p99", "/decision_ms/p99", "ms");
  row("nodes", "/nodes_per_s", "1/s");
  row("impulse step p50", "/impulse_step_us/p50", "us");
  row("impulse step p99", "/impulse_step_us/p99", "us");
  row("penetration frame pairs", "/penetration_frame_pairs_per_s", "1/s");
  return study_text(table);
}

}  // namespace ringcraft
