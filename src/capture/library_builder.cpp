#include "capture/library_builder.h"

#include <fnmatch.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/document.h"
#include "base/file.h"
#include "base/utf8.h"
#include "capture/cut.h"
#include "capture/library_file.h"
#include "capture/library_responses.h"
#include "capture/profile.h"
#include "capture/read_capture.h"
#include "capture/retarget.h"
#include "capture/segment.h"
#include "capture/sheet.h"
#include "capture/words.h"
#include "motion/library_io.h"
#include "motion/strike_fit.h"

namespace ringcraft {
namespace {

using Json = nlohmann::json;

constexpr float kGuardYaw = -58;  // degrees, median of two boxers' guards (orthodox)

std::string text_of(const Json& value, const char* key, const char* otherwise = "") {
  const auto it = value.find(key);
  return it == value.end() ? otherwise : it->get<std::string>();
}
double number_of(const Json& value, const char* key, double otherwise = 0) {
  const auto it = value.find(key);
  return it == value.end() ? otherwise : it->get<double>();
}
bool flag_of(const Json& value, const char* key) {
  const auto it = value.find(key);
  return it != value.end() && it->get<bool>();
}

// The schema has checked that every name is one of those known.
ActionCut cut_from(const Json& value) {
  ActionCut cut;
  cut.name = text_of(value, "name");
  cut.kind = *kind_from_name(text_of(value, "kind"));
  cut.begin = number_of(value, "begin");
  cut.end = number_of(value, "end");
  cut.turn = radians(static_cast<float>(number_of(value, "facing_degrees")));
  for (const Json& strike : value.value("strike", Json::array())) {
    StrikeCut s;
    s.kind = *strike_kind_from_name(text_of(strike, "kind"));
    s.joint = *joint_from_vrm_name(text_of(strike, "joint"));
    s.zone = *zone_from_name(text_of(strike, "zone"));
    s.at = number_of(strike, "at");
    s.aim = text_of(strike, "aim");
    cut.strikes.push_back(s);
  }
  if (const auto it = value.find("defense"); it != value.end())
    cut.defense = Defense{*defense_kind_from_name(text_of(*it, "kind")),
                          ticks(number_of(*it, "begin")), ticks(number_of(*it, "end"))};
  if (const auto it = value.find("response"); it != value.end()) {
    cut.response = Response{*response_kind_from_name(text_of(*it, "kind")),
                            static_cast<int>(number_of(*it, "steps")),
                            radians(static_cast<float>(number_of(*it, "direction_degrees")))};
    cut.response->zone = zone_from_name(text_of(*it, "zone", ""));
    cut.measure_direction = !it->contains("direction_degrees");
  }
  cut.starts_lying = *lying_from_name(text_of(value, "starts_lying", "none"));
  cut.ends_lying = *lying_from_name(text_of(value, "ends_lying", "none"));
  return cut;
}

Result<SkeletonProfile> profile_for(const Document& manifest, const std::string& pointer,
                                    const Json& entry, const RawClip& raw) {
  if (const std::string name = text_of(entry, "profile"); !name.empty())
    return profile_named(name).map_error([&](Error error) {
      if (!error.file.empty()) return error;  // of a profile's file
      error.kind = ErrorKind::input;
      error.file = manifest.path.string();
      error.place = manifest.place(pointer + "/profile");
      return error;
    });
  auto profiles = read_profiles(assets_folder() / "profiles");
  if (!profiles) return tl::unexpected(profiles.error());
  return best_profile(*profiles, raw);
}

using Sheets = std::map<std::string, std::filesystem::path>;  // by the actions' names

struct Collector {
  std::vector<Action> actions;
  std::set<std::string> names;
  Sheets sheets;
  std::vector<std::string>* notes = nullptr;

  void note(std::string text) {
    if (notes != nullptr) notes->push_back(std::move(text));
  }
  Result<void> add(Action action, const std::string& file, const std::string& place) {
    const std::vector<std::string> wrong = faults(action);
    if (!wrong.empty())
      return input_error(file, place, fmt::format("action {}: {}", action.name, wrong.front()),
                         "mend its source");
    if (!names.insert(action.name).second)
      return input_error(file, place, fmt::format("a second action is called {}", action.name),
                         "rename one of them");
    actions.push_back(std::move(action));
    return {};
  }
};

std::string clip_suffix(const std::string& clip) {
  return clip.empty() ? "" : " " + clip;
}

struct CaptureEntry {
  const Document& manifest;
  const std::string& pointer;
  const Json& entry;
  std::string source;  // the file and its clip, for the actions' source
};

// Whether it begins and ends within its action and protects in between, as a sheet's has to.
bool is_inside(const Defense& defense, const ActionCut& cut) {
  return ticks(cut.begin) <= defense.begin && defense.begin < defense.end &&
         defense.end <= ticks(cut.end);
}

// The listed actions, then those found where none is listed.
Result<void> add_cuts(const CaptureEntry& of, const Clip& clip, const Segmentation& found,
                      Collector& out) {
  const Skeleton skeleton = canonical_skeleton();
  const std::string file = of.manifest.path.string();
  const float yaw =
      of.entry.contains("guard_yaw_degrees") || found.segments.empty()
          ? radians(static_cast<float>(number_of(of.entry, "guard_yaw_degrees", kGuardYaw)))
          : found.guard_yaw;
  const double guard_at = number_of(of.entry, "guard_at", found.guard_at);
  if (guard_at > seconds(clip.length()))
    return input_error(file, of.manifest.place(of.pointer + "/guard_at"),
                       fmt::format("the capture ends at {:.2f} s", seconds(clip.length())),
                       "name a moment at which it stands in guard");
  const CaptureTracks tracks = tracks_of(clip, guard_at, yaw);
  std::vector<ActionCut> listed;
  for (const Json& action : of.entry.value("action", Json::array()))
    listed.push_back(cut_from(action));
  const auto cut_out = [&](const ActionCut& cut, const std::string& place) {
    auto action = cut_action(skeleton, clip, tracks, cut, file, place);
    if (action) action->source = fmt::format("{} {:.2f}-{:.2f} s", of.source, cut.begin, cut.end);
    return action;
  };
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const std::string place = of.manifest.place(fmt::format("{}/action/{}/name", of.pointer, i));
    const ActionCut& cut = listed[i];
    if (const auto wrong = misplaced(cut.kind, !cut.strikes.empty(), cut.response, cut.starts_lying,
                                     cut.ends_lying)) {
      const std::string key = fmt::format("{}/action/{}/{}", of.pointer, i, wrong->key);
      return input_error(file, of.manifest.place(key), cut.name + ": " + wrong->what,
                         wrong->remedy);
    }
    if (listed[i].defense && !is_inside(*listed[i].defense, listed[i])) {
      const std::string defense = fmt::format("{}/action/{}/defense", of.pointer, i);
      return input_error(
          file, fmt::format("{}, {}", of.manifest.place(defense), defense),
          fmt::format("the seconds over which {} protects are empty, or outside of its {} to {} s",
                      listed[i].name, listed[i].begin, listed[i].end),
          "count them from the capture's first frame, with begin < end");
    }
    auto action = cut_out(listed[i], place);
    if (!action) return tl::unexpected(action.error());
    if (auto ok = out.add(std::move(*action), file, place); !ok) return ok;
  }
  for (const FoundAction& segment : not_listed(found.segments, listed)) {
    auto action = cut_out(segment.cut, of.manifest.place(of.pointer + "/segment"));
    const bool fits = action && faults(*action).empty() && !out.names.contains(action->name);
    out.note(fmt::format("{}: {} {:.2f}-{:.2f} s{}: {}", of.source, segment.cut.name,
                         segment.cut.begin, segment.cut.end, fits ? "" : " passed over",
                         action ? segment.evidence : to_string(action.error())));
    if (!fits) continue;
    if (auto ok = out.add(std::move(*action), file, ""); !ok) return ok;
  }
  return {};
}

Result<void> add_capture(const Document& manifest, std::size_t number, const Json& entry,
                         Collector& out) {
  const std::string pointer = fmt::format("/capture/{}", number);
  const std::filesystem::path path = manifest.path.parent_path() / text_of(entry, "path");
  if (!flag_of(entry, "segment") && !(entry.contains("guard_at") && entry.contains("action")))
    return input_error(manifest.path.string(), manifest.place(pointer),
                       "a capture needs guard_at and its actions",
                       "list them, or set segment = true to have them found");
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    if (flag_of(entry, "optional")) {
      out.note(fmt::format("{}: not there, passed over", path.string()));
      return {};
    }
    const std::string package = text_of(entry, "package");
    return input_error(manifest.path.string(), manifest.place(pointer + "/path"),
                       fmt::format("the capture {} is not there", path.string()),
                       package.empty() ? "correct the path" : "apt-get install " + package);
  }
  CaptureSource source;
  source.clip = text_of(entry, "clip");
  if (entry.contains("skeleton"))
    source.skeleton = manifest.path.parent_path() / text_of(entry, "skeleton");
  if (entry.contains("frame_rate")) source.frames_per_second = number_of(entry, "frame_rate");
  if (const auto wrong = misplaced(path, source))
    return input_error(manifest.path.string(), manifest.place(pointer + "/" + wrong->key),
                       wrong->key + " " + wrong->what, "take it out");
  if (!source.skeleton.empty() && !std::filesystem::exists(source.skeleton, ignored))
    return input_error(manifest.path.string(), manifest.place(pointer + "/skeleton"),
                       fmt::format("the skeleton {} is not there", source.skeleton.string()),
                       "correct the path");
  auto raw = read_capture(path, source);
  if (!raw) return tl::unexpected(raw.error());
  replace_junk_start(*raw);
  mend_jumps(*raw);
  for (const std::string& note : raw->notes) out.note(path.string() + ": " + note);
  auto profile = profile_for(manifest, pointer, entry, *raw);
  if (!profile) return tl::unexpected(profile.error());
  const Skeleton skeleton = canonical_skeleton();
  auto clip = retarget(*raw, *profile, skeleton);
  if (!clip) return tl::unexpected(clip.error());
  if (flag_of(entry, "mirror")) *clip = mirrored(*clip);
  Segmentation found;
  if (flag_of(entry, "segment")) {
    const std::string name = path.stem().string();
    found = segment(skeleton, *clip, name);
    if (found.southpaw && !entry.contains("mirror")) {
      out.note(path.string() + ": southpaw, mirrored");
      *clip = mirrored(*clip);
      found = segment(skeleton, *clip, name);
    }
  }
  return add_cuts({manifest, pointer, entry, path.filename().string() + clip_suffix(source.clip)},
                  *clip, found, out);
}

// Files that a pattern names, sorted; * in the file name stands for any part of it.
std::vector<std::filesystem::path> files_like(const std::filesystem::path& pattern) {
  const std::string name = pattern.filename().string();
  if (name.find('*') == std::string::npos) return {pattern};
  std::vector<std::filesystem::path> found;
  std::error_code fault;
  for (std::filesystem::directory_iterator it(pattern.parent_path(), fault), end;
       !fault && it != end; it.increment(fault)) {
    const std::string file = it->path().filename().string();
    if (fnmatch(name.c_str(), file.c_str(), 0) == 0) found.push_back(it->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

Result<void> add_sheets(const Document& manifest, std::size_t number, const std::string& pattern,
                        Collector& out) {
  const std::string place = manifest.place(fmt::format("/sheets/{}", number));
  const auto files = files_like(manifest.path.parent_path() / pattern);
  if (files.empty())
    return input_error(manifest.path.string(), place, fmt::format("no sheet is called {}", pattern),
                       "correct the name or take it out");
  for (const auto& file : files) {
    auto actions = compile_sheet_file(file);
    if (!actions) return tl::unexpected(actions.error());
    for (Action& action : *actions) {
      out.sheets[action.name] = file;
      if (auto ok = out.add(std::move(action), file.string(), ""); !ok) return ok;
    }
  }
  return {};
}

// Captured blows of shadow work are thrown at nobody: those that name an aim are led to it.
void lead_to_aims(std::vector<Action>& actions) {
  const Pose* guard = standing_guard(actions);
  if (guard == nullptr) return;
  const Pose standing = *guard;
  for (Action& action : actions) {
    const bool names = std::any_of(action.strikes.begin(), action.strikes.end(),
                                   [](const Strike& strike) { return !strike.aim.empty(); });
    if (is_authored(action) || !names) continue;
    action = aimed(canonical_skeleton(), action, standing);
  }
}

Result<void> collect(const Document& manifest, Collector& out) {
  const Json captures = manifest.value.value("capture", Json::array());
  for (std::size_t i = 0; i < captures.size(); ++i)
    if (auto ok = add_capture(manifest, i, captures[i], out); !ok) return ok;
  const Json sheets = manifest.value.value("sheets", Json::array());
  for (std::size_t i = 0; i < sheets.size(); ++i)
    if (auto ok = add_sheets(manifest, i, sheets[i].get<std::string>(), out); !ok) return ok;
  lead_to_aims(out.actions);
  if (out.actions.empty())
    return input_error(manifest.path.string(), "", "the manifest leads to no action",
                       "name captures or sheets");
  return {};
}

// A word of leads_to, and what is wrong with it.
struct WrongLead {
  std::string word, what;
};

// The first word that names actions of which there is none.
std::optional<WrongLead> unknown_lead(const std::vector<Action>& actions, const Action& from) {
  for (const std::string& word : from.leads_to) {
    const bool known =
        kind_from_name(word) || std::any_of(actions.begin(), actions.end(),
                                            [&](const Action& to) { return means(word, to); });
    if (!known)
      return WrongLead{word, fmt::format("leads to '{}', and no action is called so", word)};
  }
  return std::nullopt;
}

// What a sheet says of where an action leads is held against the poses: the first word that names
// actions of which none begins where it ends.
std::optional<WrongLead> wrong_lead(const MotionLibrary& library, ActionId from) {
  const Action& action = library.action(from);
  for (const std::string& word : action.leads_to) {
    if (kind_from_name(word)) continue;
    float nearest = std::numeric_limits<float>::max();
    for (const Action& to : library.actions()) {
      if (!means(word, to)) continue;
      nearest = std::min(nearest, aligned(library.skeleton(), action.clip, to.clip).distance);
    }
    const auto& edges = library.machine().edges(from);
    const bool leads = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      return means(word, library.action(edge.to));
    });
    if (leads) continue;
    if (nearest == std::numeric_limits<float>::max()) {
      return WrongLead{word, fmt::format("leads to '{}', which was dropped", word)};
    }
    return WrongLead{word, fmt::format("leads to '{}', which begins {:.0f} cm from where it ends",
                                       word, 100 * nearest)};
  }
  return std::nullopt;
}

// Where the sheet says it, of the action or one that it is a variant of, or of all its actions.
std::string place_of_lead(const std::filesystem::path& sheet, const std::string& action,
                          const std::string& word) {
  const auto document = read_document(sheet, "sheet");
  if (!document) return "";
  const auto place_in = [&](const Json& said, const std::string& pointer) -> std::string {
    const Json words = said.value("leads_to", Json::array());
    const auto at = std::find(words.begin(), words.end(), word);
    if (at == words.end()) return "";
    return document->place(fmt::format("{}/leads_to/{}", pointer, at - words.begin()));
  };
  const Json& actions = document->value.at("action");
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const std::string name = text_of(actions[i], "name");
    if (action != name && !action.starts_with(name + "_")) continue;
    std::string place = place_in(actions[i], fmt::format("/action/{}", i));
    if (!place.empty()) return place;
  }
  return place_in(document->value, "");
}

// So many that the library can be read back.
Result<void> few_enough(const std::filesystem::path& source, const std::vector<Action>& actions,
                        std::string remedy) {
  if (actions.size() <= kMostActions) return {};
  return input_error(
      source.string(), "",
      fmt::format("{} actions, more than the {} of a library", actions.size(), kMostActions),
      std::move(remedy));
}

// The library of `actions`; what cannot be a library is refused before the work where it shows.
Result<MotionLibrary> connected(const std::filesystem::path& source, const std::string& name,
                                std::vector<Action> actions, const Sheets& sheets,
                                std::vector<std::string> notes,
                                const LibraryBuildSettings& settings) {
  if (auto ok = few_enough(source, actions, "take out captures or sheets"); !ok)
    return tl::unexpected(ok.error());
  const auto fault = [&](const Action& action, const WrongLead& wrong) {
    const auto sheet = sheets.find(action.name);
    const bool known = sheet != sheets.end();
    return input_error(known ? sheet->second.string() : source.string(),
                       known ? place_of_lead(sheet->second, action.name, wrong.word) : "",
                       action.name + " " + wrong.what,
                       "correct leads_to, or the poses at which the two meet");
  };
  for (const Action& action : actions) {
    if (const auto wrong = unknown_lead(actions, action)) return fault(action, *wrong);
  }
  MotionLibrary library = connected_library(name, std::move(actions), std::move(notes), settings);
  if (auto ok = few_enough(source, library.actions(), "build it with --not-connected"); !ok)
    return tl::unexpected(ok.error());
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    if (const auto wrong = wrong_lead(library, ActionId(i)))
      return fault(library.actions()[i], *wrong);
  }
  if (library.launchable().empty())
    return input_error(source.string(), "", "no action can follow another",
                       "let actions start and end near one guard");
  return library;
}

void add_blends(std::vector<Action>& actions, const LibraryBuildSettings& settings,
                std::vector<std::string>& notes) {
  std::vector<Action> made =
      interpolated(canonical_skeleton(), actions, InterpolationSettings{}, settings.judge, notes);
  actions.reserve(actions.size() + made.size());
  for (Action& action : made) actions.push_back(std::move(action));
}

Result<MotionLibrary> build_folder(const std::filesystem::path& folder,
                                   const LibraryBuildSettings& settings) {
  std::vector<std::string> notes;
  FolderSettings of_folder;
  of_folder.mirrored = settings.mirrored;
  auto actions = collect_folder_actions(folder, &notes, of_folder);
  if (!actions) return tl::unexpected(actions.error());
  if (actions->empty())
    return input_error(folder.string(), "", "no action was found in its captures",
                       notes.empty() ? "name a folder that holds captures" : notes.front());
  if (settings.interpolate.value_or(true)) add_blends(*actions, settings, notes);
  if (!settings.responses_from.empty()) {
    const std::filesystem::path manifest =
        library_source(std::filesystem::path(settings.responses_from));
    auto others = collect_actions(manifest);
    if (!others) return tl::unexpected(others.error());
    add_missing_responses(*actions, std::move(*others), settings.responses_from, notes);
  }
  const std::string name =
      clean_name(std::filesystem::weakly_canonical(folder).filename().string());
  return connected(folder, name, std::move(*actions), {}, std::move(notes), settings);
}

Result<Document> read_manifest(const std::filesystem::path& path) {
  if (begins_as_library(path))
    return input_error(path.string(), "", "a library that is built already",
                       "name the manifest or the captures that it was built from");
  std::error_code ignored;
  const bool capture = is_capture_file(path) || lowered(path.extension().string()) == ".asf";
  if (capture && std::filesystem::exists(path, ignored))
    return input_error(path.string(), "", "a capture, not a library",
                       "name its folder to `ringcraft library build`, or a manifest that names it");
  return read_document(path, "manifest");
}

}  // namespace

Result<std::vector<Action>> collect_actions(const std::filesystem::path& manifest,
                                            std::vector<std::string>* notes) {
  auto document = read_manifest(manifest);
  if (!document) return tl::unexpected(document.error());
  Collector out;
  out.notes = notes;
  if (auto ok = collect(*document, out); !ok) return tl::unexpected(ok.error());
  return std::move(out.actions);
}

std::vector<std::filesystem::path> files_of_library(const std::filesystem::path& library) {
  std::vector<std::filesystem::path> files = {library_source(library)};
  const auto manifest = read_manifest(files.front());
  if (!manifest) return files;  // whoever loads it says what is wrong
  const std::filesystem::path folder = manifest->path.parent_path();
  for (const Json& capture : manifest->value.value("capture", Json::array()))
    files.push_back(folder / text_of(capture, "path"));
  for (const Json& pattern : manifest->value.value("sheets", Json::array())) {
    const auto sheets = files_like(folder / pattern.get<std::string>());
    files.insert(files.end(), sheets.begin(), sheets.end());
  }
  return files;
}

Result<MotionLibrary> build_library(const std::filesystem::path& source,
                                    const LibraryBuildSettings& settings) {
  std::vector<std::string> notes;
  std::error_code ignored;
  if (std::filesystem::is_directory(source, ignored)) return build_folder(source, settings);
  auto document = read_manifest(source);
  if (!document) return tl::unexpected(document.error());
  Collector out;
  out.notes = &notes;
  if (auto ok = collect(*document, out); !ok) return tl::unexpected(ok.error());
  if (settings.interpolate.value_or(false)) add_blends(out.actions, settings, notes);
  return connected(source, document->value["name"].get<std::string>(), std::move(out.actions),
                   out.sheets, std::move(notes), settings);
}

}  // namespace ringcraft
