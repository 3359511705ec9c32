#include <fmt/format.h>

#include <algorithm>

#include "capture/cut.h"
#include "capture/sheet_keys.h"
#include "capture/sheet_track.h"

namespace ringcraft {

namespace {

using nlohmann::json;

constexpr std::array<ChannelInfo, kChannelCount> kChannels = {{
    {"root", 3},          {"pelvis", 3},     {"pelvis_yaw", 1}, {"pelvis_lean", 2},
    {"chest_yaw", 1},     {"lean", 2},       {"head", 2},       {"lead_wrist", 3},
    {"rear_wrist", 3},    {"lead_elbow", 3}, {"rear_elbow", 3}, {"lead_ankle", 3},
    {"rear_ankle", 3},    {"lead_knee", 3},  {"rear_knee", 3},  {"lead_foot_yaw", 1},
    {"rear_foot_yaw", 1}, {"lead_heel", 1},  {"rear_heel", 1},  {"lead_point", 1},
    {"rear_point", 1},    {"lead_palm", 1},  {"rear_palm", 1},
}};

float number(const json& value) {
  return value.get<float>();
}

Vec3 vector_of(const json& value) {
  if (!value.is_array()) return {number(value), 0, 0};
  Vec3 v{};
  for (std::size_t i = 0; i < std::min<std::size_t>(3, value.size()); ++i) {
    v[static_cast<int>(i)] = number(value[i]);
  }
  return v;
}

Vec2 pair_of(const json& value) {
  return {number(value[0]), number(value[1])};
}

Side foot_named(const json& foot) {
  return foot == "lead" ? Side::left : Side::right;
}

KeyValues values_of(const json& table) {
  KeyValues values;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto at = table.find(kChannels[i].name);
    if (at != table.end()) values[i] = vector_of(*at);
  }
  return values;
}

// Reads one document; remembers where it is, for messages.
class Reader {
 public:
  explicit Reader(const Document& document) : document_(document) {}

  Result<std::vector<SheetAction>> read() {
    if (auto poses = read_poses(); !poses) return tl::unexpected(poses.error());
    std::vector<SheetAction> actions;
    const json& list = document_.value.at("action");
    for (std::size_t i = 0; i < list.size(); ++i) {
      auto action = read_action(list[i], fmt::format("/action/{}", i));
      if (!action) return tl::unexpected(action.error());
      for (const SheetAction& other : actions) {
        if (other.action.name == action->action.name) {
          return fault(action->pointer + "/name",
                       fmt::format("a second action is called '{}'", other.action.name),
                       "give every action of a sheet its own name");
        }
      }
      actions.push_back(std::move(*action));
    }
    return actions;
  }

 private:
  tl::unexpected<Error> fault(const std::string& pointer, std::string what, std::string remedy) {
    return input_error(document_.path.string(), document_.place(pointer), std::move(what),
                       std::move(remedy));
  }

  void add_poses(const json& from) {
    const auto list = from.find("pose");
    if (list == from.end()) return;
    for (const auto& [name, table] : list->items()) {
      SheetPose pose;
      pose.values = values_of(table);
      if (table.contains("lead_ball")) pose.ball[0] = pair_of(table["lead_ball"]);
      if (table.contains("rear_ball")) pose.ball[1] = pair_of(table["rear_ball"]);
      poses_[name] = pose;
    }
  }

  Result<void> read_poses() {
    const auto file = document_.value.find("poses");
    if (file != document_.value.end()) {
      const auto path = document_.path.parent_path() / file->get<std::string>();
      std::error_code ignored;
      if (!std::filesystem::exists(path, ignored)) {
        return fault("/poses", fmt::format("the sheet {} is not there", path.string()),
                     "correct the path, from this sheet's folder");
      }
      auto other = read_document(path, "sheet");
      if (!other) return tl::unexpected(other.error());
      add_poses(other->value);
    }
    add_poses(document_.value);
    for (const auto& [name, pose] : poses_) {
      for (std::size_t side = 0; side < 2; ++side) {
        const Channel ankle = side == 0 ? Channel::lead_ankle : Channel::rear_ankle;
        if (!pose.ball[side] && !pose.values[index(ankle)]) {
          return fault(
              "/pose/" + name,
              fmt::format("pose '{}' says neither where the {} foot's ball stands nor where "
                          "its ankle is",
                          name, side == 0 ? "lead" : "rear"),
              "give a ball for a standing foot, an ankle for a foot off the ground");
        }
      }
    }
    return {};
  }

  Result<SheetPose> pose_of(const json& table, const char* which, const std::string& pointer) {
    const std::string name = table.value(which, "guard");
    const auto pose = poses_.find(name);
    if (pose != poses_.end()) return pose->second;
    return fault(
        table.contains(which) ? pointer + "/" + which : pointer,
        fmt::format("there is no pose '{}'", name),
        "define it as [pose." + name + "], or name the file that does with poses = \"...\"");
  }

  Result<SheetAction> read_action(const json& table, const std::string& pointer) {
    SheetAction result;
    result.pointer = pointer;
    result.length = number(table["length"]);
    read_header(table, result);
    auto start = pose_of(table, "start", pointer), end = pose_of(table, "end", pointer);
    if (!start) return tl::unexpected(start.error());
    if (!end) return tl::unexpected(end.error());
    result.start = *start;
    result.end = *end;
    if (defense_window_is_wrong(result)) {
      return fault(pointer + "/defense",
                   "the ticks over which it protects are empty, or outside the action",
                   "window = [from, to] with from < to <= length");
    }
    const Action& action = result.action;
    const bool strikes = table.contains("strike") && !table["strike"].empty();
    if (const auto wrong = misplaced(action.kind, strikes, action.response, action.starts_lying,
                                     action.ends_lying)) {
      return fault(pointer + "/" + wrong->key, action.name + ": " + wrong->what, wrong->remedy);
    }
    if (auto keys = read_keys(table, pointer, result); !keys) return tl::unexpected(keys.error());
    if (auto steps = read_steps(table, pointer, result); !steps)
      return tl::unexpected(steps.error());
    if (auto strikes = read_strikes(table, pointer, result); !strikes) {
      return tl::unexpected(strikes.error());
    }
    return result;
  }

  static bool defense_window_is_wrong(const SheetAction& sheet) {
    const auto& defense = sheet.action.defense;
    return defense && (defense->begin >= defense->end || defense->end > ticks(sheet.length));
  }

  void read_header(const json& table, SheetAction& result) {
    Action& action = result.action;
    action.name = table["name"];
    action.kind = kind_from_name(spelled(table["kind"])).value();
    action.source = fmt::format("{}: {}", document_.path.filename().string(), action.name);
    if (table.contains("starts_lying")) {
      action.starts_lying = lying_from_name(spelled(table["starts_lying"])).value();
    }
    if (table.contains("ends_lying")) {
      action.ends_lying = lying_from_name(spelled(table["ends_lying"])).value();
    }
    const json& said = table.contains("leads_to") ? table : document_.value;
    action.leads_to = said.value("leads_to", std::vector<std::string>());
    action.switches = table.value("switches", false);
    if (table.contains("defense")) {
      const json& d = table["defense"];
      action.defense = Defense{defense_kind_from_name(spelled(d["kind"])).value(),
                               ticks(number(d["window"][0])), ticks(number(d["window"][1]))};
    }
    if (table.contains("response")) {
      const json& r = table["response"];
      action.response = Response{response_kind_from_name(spelled(r["kind"])).value(),
                                 r.value("steps", 0), radians(r.value("direction", 0.0f)),
                                 zone_from_name(r.value("zone", std::string()))};
    }
    const bool stands = action.starts_lying == Lying::none && action.ends_lying == Lying::none;
    if (table.contains("end_at")) {
      const Vec3 at = vector_of(table["end_at"]);
      result.end_at = {at.x * kCanonicalHeight, at.y * kCanonicalHeight, radians(at.z)};
    }
    if (table.contains("pivot")) result.pivot = foot_named(table["pivot"]);
    result.turns = table.value("turns", 0);
    result.chain = table.value("chain", 0.0f);
    result.sway = table.value("sway", 0.007f);
    result.bounce_hz = 2.2f;
    result.bounce = stands ? 0.004f : 0.0f;
    if (table.contains("bounce")) {
      result.bounce_hz = number(table["bounce"][0]);
      result.bounce = number(table["bounce"][1]);
    }
    if (table.contains("variants")) {
      for (const auto& [name, by] : table["variants"].items()) result.variants[name] = number(by);
    }
    if (table.contains("root")) result.root_time = pair_of(table["root"]);
  }

  // The names of sheets and of action.h are the same words.
  static std::string spelled(const json& word) { return word.get<std::string>(); }

  Result<void> read_keys(const json& table, const std::string& pointer, SheetAction& result) {
    if (!table.contains("key")) return {};
    for (std::size_t i = 0; i < table["key"].size(); ++i) {
      const json& key = table["key"][i];
      const std::string at = fmt::format("{}/key/{}", pointer, i);
      SheetKey read{number(key["t"]), values_of(key)};
      if (read.t > result.length + 1e-4f) {
        return fault(at, "the key comes after the action's end", "move it, or lengthen the action");
      }
      if (!result.keys.empty() && read.t < result.keys.back().t + 1e-3f) {
        return fault(at, "the keys are not in the order of time", "sort them by t");
      }
      result.keys.push_back(read);
    }
    return {};
  }

  Result<void> read_steps(const json& table, const std::string& pointer, SheetAction& result) {
    if (!table.contains("step")) return {};
    std::array<float, 2> standing = {0, 0};  // s: since when each foot stands
    for (std::size_t i = 0; i < table["step"].size(); ++i) {
      const json& step = table["step"][i];
      SheetStep read;
      read.foot = foot_named(step["foot"]);
      read.lift = number(step["lift"]);
      if (step.contains("land")) read.land = number(step["land"]);
      if (step.contains("at")) read.at = vector_of(step["at"]);
      read.height = step.value("height", read.height);
      read.free = step.value("free", !read.land.has_value());
      float& since = standing[read.foot == Side::left ? 0 : 1];
      const float land = read.land.value_or(result.length + 1);
      const std::string at = fmt::format("{}/step/{}", pointer, i);
      if (read.lift < since - 1e-4f || land < read.lift + 0.05f ||
          (read.land && land > result.length + 1e-4f)) {
        return fault(at, "the foot lifts before it stands, or lands at an impossible time",
                     "order each foot's steps by time; lift < land <= length");
      }
      since = land;
      result.steps.push_back(read);
    }
    return {};
  }

  Result<void> read_strikes(const json& table, const std::string& pointer, SheetAction& result) {
    if (!table.contains("strike")) return {};
    for (std::size_t i = 0; i < table["strike"].size(); ++i) {
      const json& strike = table["strike"][i];
      const std::string at = fmt::format("{}/strike/{}", pointer, i);
      SheetStrike read;
      read.strike.kind = strike_kind_from_name(spelled(strike["kind"])).value();
      read.strike.joint = joint_from_vrm_name(spelled(strike["joint"])).value();
      read.strike.zone = zone_from_name(spelled(strike["zone"])).value();
      read.strike.aim = strike.value("aim", std::string());
      if (strike.contains("reach")) {
        const Vec2 reach = pair_of(strike["reach"]) * kCanonicalHeight;
        read.strike.nearest = reach.x;
        read.strike.farthest = reach.y;
        if (reach.x > reach.y) {
          return fault(at + "/reach", "the nearest distance is more than the farthest",
                       "reach = [near, far] with near <= far");
        }
      }
      read.start = number(strike["start"]);
      read.contact = number(strike["contact"]);
      if (read.contact < read.start + 0.04f || read.contact > result.length) {
        return fault(at, "the strike's contact does not come after its start",
                     "start + 0.04 <= contact <= length");
      }
      read.active_begin = std::max(read.start, read.contact - 0.05f);
      read.active_end = std::min(result.length, read.contact + 0.03f);
      if (strike.contains("active")) {
        read.active_begin = number(strike["active"][0]);
        read.active_end = number(strike["active"][1]);
      }
      const bool ordered = read.active_begin < read.active_end && read.active_end <= result.length;
      if (!ordered) {
        return fault(at, "the ticks at which it can hit are empty, or outside the action",
                     "active = [from, to] with from < to <= length");
      }
      for (const SheetStrike& other : result.strikes) {
        const bool apart = read.start >= other.contact || read.contact <= other.start;
        if (tip_of(other.strike.joint) == tip_of(read.strike.joint) && !apart) {
          return fault(at, "the same limb strikes twice at a time",
                       "let the second strike start after the first one's contact");
        }
      }
      const bool straight = read.strike.kind == StrikeKind::straight;
      const bool foot = is_foot(read.strike.joint);
      const bool lead = side_of(read.strike.joint) == Side::left;
      if (foot && !in_the_air(result, read)) {
        return fault(at, "the foot stands on the ground while it should strike",
                     "add a step of this foot with free = true that lasts from start to contact");
      }
      read.profile = strike.value("profile", foot        ? "kick"
                                             : !straight ? "body"
                                             : lead      ? "jab"
                                                         : "cross");
      read.snap = strike.value("snap", 0.0f);
      result.strikes.push_back(read);
    }
    return {};
  }

  static bool in_the_air(const SheetAction& action, const SheetStrike& strike) {
    const Side side = side_of(strike.strike.joint);
    return std::any_of(action.steps.begin(), action.steps.end(), [&](const SheetStep& step) {
      return step.foot == side && step.free && step.lift <= strike.start &&
             step.land.value_or(action.length + 1) > strike.contact;
    });
  }

  const Document& document_;
  std::map<std::string, SheetPose> poses_;
};

}  // namespace

const ChannelInfo& info(Channel channel) {
  return kChannels[index(channel)];
}

Result<std::vector<SheetAction>> sheet_actions(const Document& document) {
  return Reader(document).read();
}

}  // namespace ringcraft
