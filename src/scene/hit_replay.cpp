#include "scene/hit_replay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/json_object.h"
#include "base/tasks.h"
#include "base/utf8.h"
#include "io/events.h"
#include "physics/response.h"
#include "scene/replay_bytes.h"

namespace ringcraft {
namespace {

using nlohmann::json;

constexpr std::uint8_t kVersion = 2;
constexpr int kHashBytes = 8;
constexpr std::size_t kLongestText = 16'384;
constexpr std::size_t kLongestLine = 1u << 20;  // bytes: a parsed line takes many times its size
constexpr std::size_t kLongestWord = 64;        // bytes, of a compared value
constexpr float kFarthestFigure = 10'000;       // m, m/s, N s, rad: beyond it nothing is a fight

std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
  return hash_bytes(std::as_bytes(bytes));
}

bool same(const Pose& a, const Pose& b) {
  return a.hips == b.hips && a.rotation == b.rotation;
}

std::uint8_t flags(bool a, bool b, bool c) {
  return static_cast<std::uint8_t>((a ? 1u : 0u) | (b ? 2u : 0u) | (c ? 4u : 0u));
}

void write_outcome(ByteWriter& writer, const ImpactOutcome& outcome) {
  writer.byte(static_cast<std::uint8_t>(outcome.response));
  writer.byte(static_cast<std::uint8_t>(outcome.steps));
  writer.byte(outcome.knockout ? 1 : 0);
  writer.byte(static_cast<std::uint8_t>(outcome.zone));
  for (const float v : {outcome.direction, outcome.head_spin, outcome.margin}) writer.number(v);
  writer.vector(outcome.com_velocity);
  for (const Vec3& moved : outcome.moved) writer.vector(moved);
  writer.number(outcome.knee_moved);
}

ImpactOutcome read_outcome(ByteReader& reader) {
  ImpactOutcome outcome;
  outcome.response = static_cast<ResponseKind>(reader.byte());
  outcome.steps = reader.byte();
  outcome.knockout = reader.byte() != 0;
  outcome.zone = static_cast<TargetZone>(reader.byte());
  outcome.direction = reader.number();
  outcome.head_spin = reader.number();
  outcome.margin = reader.number();
  outcome.com_velocity = reader.vector();
  for (Vec3& moved : outcome.moved) moved = reader.vector();
  outcome.knee_moved = reader.number();
  return outcome;
}

HitReplay read_fields(ByteReader& reader) {
  HitReplay replay;
  replay.body.height = reader.number();
  replay.body.mass = reader.number();
  replay.body.toughness = reader.number();
  replay.body.sex = reader.byte() != 0 ? Sex::female : Sex::male;
  replay.health = static_cast<std::int32_t>(static_cast<std::uint32_t>(reader.word(4)));
  Blow& blow = replay.input.blow;
  blow.part = part_at(reader.byte());
  blow.point = reader.vector();
  blow.impulse = reader.vector();
  blow.effective_mass = reader.number();
  blow.speed = reader.number();
  replay.input.tone = reader.number();
  const std::uint8_t set = reader.byte();
  blow.blocked = (set & 1u) != 0;
  replay.input.contacts = {(set & 2u) != 0, (set & 4u) != 0};
  const bool apart = reader.byte() != 0;  // the continued motion does not begin with the pose
  const std::size_t count = std::min<std::size_t>(reader.byte(), kImpulseStepTicks + 1);
  const std::size_t more = count + (apart ? 1 : 0);
  std::vector<Pose> poses = reader.poses(1 + std::max<std::size_t>(1, more));
  if (!reader.good()) return replay;
  replay.input.pose_before = poses[0];
  replay.input.pose = poses[1];
  if (count > 0) replay.continued.assign(poses.begin() + (apart ? 2 : 1), poses.end());
  replay.outcome = read_outcome(reader);
  return replay;
}

bool plausible(float value) {
  return std::isfinite(value) && std::abs(value) < kFarthestFigure;
}
bool plausible(Vec3 v) {
  return plausible(v.x) && plausible(v.y) && plausible(v.z);
}
bool plausible(const Pose& pose) {
  const auto unit = [](const Quat& q) {
    const float length2 = glm::dot(q, q);
    return std::isfinite(length2) && std::abs(length2 - 1) < 0.01f;
  };
  return plausible(pose.hips) && std::all_of(pose.rotation.begin(), pose.rotation.end(), unit);
}

// What no hit can be, however well its hash fits.
std::string impossible(const HitReplay& replay) {
  const auto within = [](float v, float least, float most) { return v >= least && v <= most; };
  const BodySpec& body = replay.body;
  if (!within(body.height, 1.2f, 2.3f)) return "a body's height";
  if (!within(body.mass, 30, 200)) return "a body's mass";
  if (!within(body.toughness, 0, 1000)) return "a toughness";
  if (!within(replay.input.tone, 0, 1)) return "a tone";
  const Blow& blow = replay.input.blow;
  if (index(blow.part) >= kPartCount) return "a body part";
  if (!plausible(blow.point) || !plausible(blow.impulse) || !plausible(blow.speed) ||
      !plausible(blow.effective_mass)) {
    return "a blow";
  }
  const auto good = [](const Pose& pose) { return plausible(pose); };
  if (!good(replay.input.pose) || !good(replay.input.pose_before) ||
      !std::all_of(replay.continued.begin(), replay.continued.end(), good)) {
    return "a pose";
  }
  if (replay.outcome.response > ResponseKind::knockdown) return "a response";
  if (replay.outcome.zone > TargetZone::leg) return "a zone";
  return "";
}

// The event as the recomputed outcome writes it.
json recomputed(const HitReplay& replay, ImpactOutcome outcome) {
  const Blow& blow = replay.input.blow;
  const std::int32_t damage = damage_of(blow, outcome);
  if (replay.health <= damage) {  // nobody stands without health
    outcome.response = ResponseKind::knockdown;
    outcome.knockout = true;
  }
  Event event;
  event.type = blow.blocked ? EventType::block : EventType::hit;
  event.part = std::string(name_of(blow.part));
  event.point = blow.point;
  event.impulse = blow.impulse;
  event.speed = blow.speed;
  event.effective_mass = blow.effective_mass;
  event.head_spin = outcome.head_spin;
  event.damage = static_cast<float>(damage) / 1000;
  outcome = answered(interrupts(blow.blocked, glm::length(blow.impulse), outcome), outcome);
  event.response = outcome.response;
  event.steps = outcome.steps;
  event.direction = outcome.direction;
  event.knockout = outcome.knockout;
  return event_json(event, false);
}

// What of a hit's event is computed, and compared.
constexpr const char* kCompared[] = {"type",
                                     "part",
                                     "point",
                                     "impulse",
                                     "impulse_Ns",
                                     "speed_mps",
                                     "effective_mass_kg",
                                     "head_spin_radps",
                                     "damage",
                                     "response",
                                     "steps",
                                     "direction_rad",
                                     "knockout"};

// A word, a number or three: no more than a hit has, so that what is kept of a line is small.
bool short_value(const json& value) {
  if (value.is_array()) {
    return value.size() <= 3 &&
           std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
  }
  if (value.is_string()) return value.get_ref<const std::string&>().size() <= kLongestWord;
  return !value.is_object();
}

// In ASCII: it may hold any character, and goes to the terminal.
std::string text_of(const json& value) {
  return value.dump(-1, ' ', true, json::error_handler_t::replace);
}

// What stands otherwise in the event than the replay gives it; empty where nothing does.
std::string differences(const HitReplay& replay, const json& event) {
  std::vector<Pose> continued = replay.continued;
  ImpactInput input = replay.input;
  input.continued = continued;
  const ImpactOutcome outcome = impulse_step(make_body(replay.body), input);
  std::string found;
  if (!(outcome == replay.outcome)) {
    found = fmt::format(
        "the outcome differs to the bit (margin {} m, recomputed {} m; head {} rad/s, "
        "recomputed {} rad/s)",
        replay.outcome.margin, outcome.margin, replay.outcome.head_spin, outcome.head_spin);
  }
  const json again = recomputed(replay, outcome);
  for (const char* key : kCompared) {
    const auto said = event.find(key);
    const bool there = said != event.end();
    if (there && *said == again[key]) continue;
    found += fmt::format("{}{} is {}, recomputed {}", found.empty() ? "" : "; ", key,
                         there ? text_of(*said) : "missing", text_of(again[key]));
  }
  return found;
}

struct HitLine {
  std::size_t number = 0;  // of the line, from 1
  json event;              // what is compared of it
  HitReplay replay;
};

tl::unexpected<Error> event_fault(const std::string& file, std::size_t line, std::string what) {
  return input_error(file, fmt::format("line {}", line), std::move(what),
                     "give an events.jsonl as `ringcraft fight` wrote it");
}

bool is_event_type(std::string_view name) {
  for (int i = 0; i <= static_cast<int>(EventType::getup); ++i) {
    if (name == name_of(static_cast<EventType>(i))) return true;
  }
  return false;
}

struct HitLines {
  std::string version;                // of the program that wrote them, where the header says so
  std::optional<std::size_t> events;  // lines that follow the header, where it says so
  std::vector<HitLine> hits;
};

// Every hit and block of the file.
Result<HitLines> hits_of(const std::string& file, std::string_view events) {
  HitLines all;
  std::size_t number = 0;
  while (!events.empty()) {
    ++number;
    const std::size_t end = events.find('\n');
    const std::string_view line = events.substr(0, end);
    if (end == std::string_view::npos) {
      return event_fault(file, number, "the file ends inside a line: it is cut off");
    }
    events.remove_prefix(end + 1);
    if (line.size() > kLongestLine) return event_fault(file, number, "longer than 1 MiB");
    std::string why;
    auto read = json_object(line, why);
    if (!read) return event_fault(file, number, why);
    json& event = *read;
    const auto type = event.find("type");
    if (type == event.end() || !type->is_string()) return event_fault(file, number, "no 'type'");
    if (number == 1) {
      if (*type != "header") return event_fault(file, number, "not the header line");
      const auto version = event.find("version");
      if (version != event.end() && version->is_string())
        all.version = clean_name(version->get<std::string>());
      if (const auto count = event.find("events"); count != event.end()) {
        if (!count->is_number_unsigned()) return event_fault(file, number, "'events' is no count");
        all.events = *count;
      }
    } else if (const auto& name = type->get_ref<const std::string&>(); !is_event_type(name)) {
      return event_fault(file, number, fmt::format("no event is a '{}'", clean_name(name, 24)));
    }
    if (*type != "hit" && *type != "block") continue;
    const auto text = event.find("replay");
    if (text == event.end() || !text->is_string()) {
      return event_fault(file, number, "the hit has no 'replay'");
    }
    auto replay = read_replay(text->get_ref<const std::string&>(), why);
    if (!replay) return event_fault(file, number, "'replay' " + why);
    json compared;
    for (const char* key : kCompared) {
      const auto said = event.find(key);
      if (said == event.end()) continue;
      if (!short_value(*said)) {
        return event_fault(file, number, fmt::format("'{}' is nothing that a hit has", key));
      }
      compared[key] = std::move(*said);
    }
    all.hits.push_back({number, std::move(compared), std::move(*replay)});
  }
  if (number == 0) return event_fault(file, 1, "the file is empty");
  if (all.events && *all.events != number - 1) {
    return event_fault(
        file, number,
        fmt::format("the header counts {} events, and {} are there: {}", *all.events, number - 1,
                    *all.events < number ? "lines were added" : "the file is cut off"));
  }
  return all;
}

}  // namespace

std::string replay_text(const BodyModel& body, const ImpactInput& input,
                        const ImpactOutcome& outcome, std::int32_t health) {
  ByteWriter writer;
  writer.byte(kVersion);
  for (const float v : {body.spec.height, body.spec.mass, body.spec.toughness}) writer.number(v);
  writer.byte(body.spec.sex == Sex::female ? 1 : 0);
  writer.word(static_cast<std::uint32_t>(health), 4);
  const Blow& blow = input.blow;
  writer.byte(static_cast<std::uint8_t>(blow.part));
  writer.vector(blow.point);
  writer.vector(blow.impulse);
  for (const float v : {blow.effective_mass, blow.speed, input.tone}) writer.number(v);
  writer.byte(flags(blow.blocked, input.contacts.left, input.contacts.right));
  const auto continued =
      input.continued.first(std::min<std::size_t>(input.continued.size(), kImpulseStepTicks + 1));
  const bool apart = continued.empty() || !same(continued.front(), input.pose);
  writer.byte(apart ? 1 : 0);
  writer.byte(static_cast<std::uint8_t>(continued.size()));
  std::vector<Pose> poses{input.pose_before};
  if (apart) poses.push_back(input.pose);
  poses.insert(poses.end(), continued.begin(), continued.end());
  writer.poses(poses);
  write_outcome(writer, outcome);
  writer.word(hash_of(writer.bytes()), kHashBytes);
  return base64(writer.bytes());
}

std::optional<HitReplay> read_replay(std::string_view text, std::string& why) {
  if (text.size() > kLongestText) {
    why = "is too long";
    return std::nullopt;
  }
  const auto bytes = from_base64(text);
  if (!bytes || bytes->size() <= kHashBytes) {
    why = "is not base64";
    return std::nullopt;
  }
  const std::span<const std::uint8_t> all(*bytes);
  const auto content = all.first(all.size() - kHashBytes);
  if (ByteReader(all.last(kHashBytes)).word(kHashBytes) != hash_of(content)) {
    why = "is damaged: its hash does not fit";
    return std::nullopt;
  }
  ByteReader reader(content);
  if (const int version = reader.byte(); version != kVersion) {
    why = fmt::format("is of form {}, this program reads form {}", version, kVersion);
    return std::nullopt;
  }
  HitReplay replay = read_fields(reader);
  if (!reader.good() || !reader.at_end()) {
    why = "has the wrong length";
    return std::nullopt;
  }
  if (const std::string what = impossible(replay); !what.empty()) {
    why = "holds " + what + " that cannot be";
    return std::nullopt;
  }
  return replay;
}

Result<ReplayReport> replay_hits(const std::string& file, std::string_view events, int threads,
                                 const std::atomic<bool>* interrupted) {
  const auto read = hits_of(file, events);
  if (!read) return tl::unexpected(read.error());
  const std::vector<HitLine>& hits = read->hits;
  std::vector<std::string> found(hits.size());
  std::atomic<std::size_t> done = 0;
  run_tasks(hits.size(), threads, [&](std::size_t i) {
    if (interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) return;
    found[i] = differences(hits[i].replay, hits[i].event);
    ++done;
  });
  ReplayReport report;
  report.hits = done;
  report.interrupted = done < hits.size();
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) continue;
    ++report.differ;
    report.lines.push_back(fmt::format("{}: line {}: {}", file, hits[i].number, found[i]));
  }
  if (report.differ > 0 && !read->version.empty() && read->version != RINGCRAFT_VERSION) {
    report.lines.push_back(
        fmt::format("{}: line 1: written by ringcraft {}, and this is {}: replay "
                    "it with the version that wrote it",
                    file, read->version, RINGCRAFT_VERSION));
  }
  return report;
}

}  // namespace ringcraft
