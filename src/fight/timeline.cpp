#include "fight/timeline.h"

#include "base/hash.h"

namespace ringcraft {
namespace {

void add(Hasher& hasher, Vec3 v) {
  hasher.add(v.x).add(v.y).add(v.z);
}

void add(Hasher& hasher, const Launch& launch) {
  hasher.add(launch.action.value).add(launch.start).add(launch.end).add(launch.placement.x);
  hasher.add(launch.placement.z).add(launch.placement.yaw).add(launch.aim).add(launch.forced);
  hasher.add(launch.share).add(launch.pace.factor());
}

void add(Hasher& hasher, const DecisionRecord& record) {
  hasher.add(record.lines.size()).add(record.chosen).add(record.nodes).add(record.leaves);
  for (const Line& line : record.lines) {
    hasher.add(line.score).add(line.at_most).add(line.actions.size());
    for (const std::string& action : line.actions) hasher.add(std::string_view(action));
  }
}

void add(Hasher& hasher, const Event& event) {
  hasher.add(event.tick).add(event.type).add(event.who.value).add(event.whom.value);
  hasher.add(std::string_view(event.action)).add(std::string_view(event.part)).add(event.strike);
  add(hasher, event.point);
  add(hasher, event.impulse);
  hasher.add(event.speed).add(event.damage).add(event.response).add(event.steps);
  hasher.add(event.direction).add(event.knockout).add(event.foreseen).add(event.fall);
  add(hasher, event.decision);
}

}  // namespace

std::string_view name_of(EventType type) {
  switch (type) {
    case EventType::decision:
      return "decision";
    case EventType::strike:
      return "strike";
    case EventType::hit:
      return "hit";
    case EventType::block:
      return "block";
    case EventType::miss:
      return "miss";
    case EventType::response:
      return "response";
    case EventType::knockdown:
      return "knockdown";
    case EventType::getup:
      return "getup";
  }
  return "";
}

std::uint64_t Timeline::hash() const {
  Hasher hasher;
  hasher.add(end).add(tracks.size()).add(events.size());
  for (const FighterTrack& track : tracks) {
    hasher.add(track.segments.size());
    for (const Segment& segment : track.segments) {
      add(hasher, segment.launch);
      hasher.add(std::string_view(segment.name)).add(segment.kind);
    }
  }
  for (const Event& event : events) add(hasher, event);
  return hasher.digest();
}

}  // namespace ringcraft
