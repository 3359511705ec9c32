#pragma once
// Replay: every committed hit of a fight recomputed from events.jsonl alone, bit for bit.
//
// A hit event carries in `replay` what the impulse step needs, as base64 of little-endian bytes
// with their hash at the end: body, blow, tone, feet, health, the struck body's poses (each joint
// value as the difference, in units of its last bit, to where the two poses before it were going),
// and the outcome to the last bit. About 5 kB a hit.

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "physics/impact.h"

namespace ringcraft {

// What a committed hit was computed from, and what came out.
struct HitReplay {
  BodySpec body;                // of the struck fighter, without its name
  ImpactInput input;            // without `continued`
  std::vector<Pose> continued;  // at most kImpulseStepTicks + 1: no more are looked at
  std::int32_t health = 0;      // of the struck fighter before the hit, thousandths of a point
  ImpactOutcome outcome;        // of the impulse step
};

// `health`: of the struck fighter before the hit. `outcome`: as the impulse step gave it.
std::string replay_text(const BodyModel& body, const ImpactInput& input,
                        const ImpactOutcome& outcome, std::int32_t health);

// Nothing where the text is damaged or holds what no hit can be; `why` then says what.
std::optional<HitReplay> read_replay(std::string_view text, std::string& why);

struct ReplayReport {
  std::size_t hits = 0, differ = 0;  // recomputed; of these, not as the file says
  // One a difference, in the file's order; last, where there is one, that another version wrote it.
  std::vector<std::string> lines;
  bool interrupted = false;
};

// Recomputes every hit and block of an events.jsonl. `file`: its name, for errors. Any thread count
// gives the same report.
Result<ReplayReport> replay_hits(const std::string& file, std::string_view events, int threads,
                                 const std::atomic<bool>* interrupted = nullptr);

}  // namespace ringcraft
