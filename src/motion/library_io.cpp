#include "motion/library_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include <fmt/format.h>

#include "base/hash.h"
#include "motion/library_io_actions.h"
#include "motion/library_io_bytes.h"

namespace ringcraft {

namespace {

constexpr std::string_view kMagic("ringlib\n", 8);
constexpr std::size_t kHeaderBytes = 8 + 4 + 4 + 8 + 8;
constexpr std::array<std::string_view, 7> kSections = {"skeleton", "actions", "clips", "edges",
                                                       "paths",    "graph",   "notes"};
constexpr std::size_t kLongestPath = 64;  // actions
constexpr std::size_t kSectionEntryBytes = 8 + 8 + 8;
constexpr const char* kRemedy = "build it again with `ringcraft library build`";

std::uint64_t hash_of(std::string_view bytes) {
  return hash_bytes(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

void put_alignment(BytesOut& out, const Alignment& alignment) {
  out.put(alignment.placement.x);
  out.put(alignment.placement.z);
  out.put(alignment.placement.yaw);
  out.put(alignment.distance);
}

Alignment get_alignment(BytesIn& in) {
  Alignment alignment;
  alignment.placement.x = in.get<float>();
  alignment.placement.z = in.get<float>();
  alignment.placement.yaw = in.get<float>();
  alignment.distance = in.get<float>();
  return alignment;
}

bool sound(const Alignment& alignment) {
  return in_bounds(alignment.placement) && std::isfinite(alignment.distance);
}

std::string skeleton_section(const Skeleton& skeleton) {
  BytesOut out;
  out.put(skeleton.height);
  out.put_count(kJointCount);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    out.put_text(vrm_name(joint_at(i)));
    out.put(static_cast<std::int32_t>(kParent[i]));
    for (const float v : {skeleton.offset[i].x, skeleton.offset[i].y, skeleton.offset[i].z}) {
      out.put(v);
    }
  }
  return out.take();
}

std::string actions_section(const MotionLibrary& library) {
  BytesOut out;
  out.put_text(library.name());
  out.put_count(library.actions().size());
  for (const Action& action : library.actions()) put_action(out, action);
  return out.take();
}

std::string clips_section(const MotionLibrary& library) {
  BytesOut out;
  for (const Action& action : library.actions()) put_clip(out, action.clip);
  return out.take();
}

std::string edges_section(const MotionLibrary& library) {
  BytesOut out;
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    const std::vector<Edge>& edges = library.machine().edges(ActionId(i));
    out.put_count(edges.size());
    for (const Edge& edge : edges) {
      out.put(edge.to.value);
      put_alignment(out, edge.alignment);
    }
  }
  return out.take();
}

std::string paths_section(const MotionLibrary& library) {
  BytesOut out;
  const std::size_t count = library.actions().size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const Path* path = library.machine().path(ActionId(i), ActionId(j));
      out.put(path != nullptr);
      if (path == nullptr) continue;
      out.put_count(path->via.size());
      for (const ActionId via : path->via) out.put(via.value);
    }
  }
  return out.take();
}

std::string graph_section(const MotionGraph& graph) {
  BytesOut out;
  out.put_count(graph.clips.size());
  for (const GraphClip& clip : graph.clips) {
    out.put_text(clip.name);
    out.put(clip.length);
  }
  out.put_count(graph.transitions.size());
  for (const Transition& transition : graph.transitions) {
    out.put(transition.from_clip);
    out.put(transition.from);
    out.put(transition.to_clip);
    out.put(transition.to);
    put_alignment(out, transition.alignment);
  }
  out.put(graph.pairs);
  out.put(graph.minima);
  out.put(graph.dropped);
  return out.take();
}

std::string notes_section(const MotionLibrary& library) {
  BytesOut out;
  for (const auto* lines : {&library.dropped(), &library.notes()}) {
    out.put_count(lines->size());
    for (const std::string& line : *lines) out.put_text(line);
  }
  return out.take();
}

// Reads the parts; each step says what is wrong with its section, or nothing.
class LibraryReader {
 public:
  using Step = std::string (LibraryReader::*)(BytesIn&);
  static constexpr std::array<Step, kSections.size()> kSteps();

  std::string read_skeleton(BytesIn& in) {
    const Skeleton ours = canonical_skeleton();
    bool same = in.get<float>() == ours.height;
    same = in.get_count(1) == kJointCount && same;
    for (std::size_t i = 0; i < kJointCount && in.ok(); ++i) {
      same = in.get_text() == vrm_name(joint_at(i)) && same;
      same = in.get<std::int32_t>() == kParent[i] && same;
      for (const float v : {ours.offset[i].x, ours.offset[i].y, ours.offset[i].z}) {
        same = in.get<float>() == v && same;
      }
    }
    return same ? "" : "it is for another skeleton than this build's";
  }

  std::string read_actions(BytesIn& in) {
    parts_.name = in.get_text();
    constexpr std::size_t kLeastActionBytes = 20;
    const std::size_t count = in.get_count(kLeastActionBytes);
    if (count > kMostActions) return fmt::format("{} actions, more than {}", count, kMostActions);
    parts_.actions.reserve(count);
    std::set<std::string> names;
    for (std::size_t i = 0; i < count && in.ok(); ++i) {
      parts_.actions.push_back(get_action(in));
      if (in.ok() && !names.insert(parts_.actions.back().name).second) {
        return fmt::format("two actions are called {}", parts_.actions.back().name);
      }
    }
    return "";
  }

  std::string read_clips(BytesIn& in) {
    for (Action& action : parts_.actions) {
      action.clip = get_clip(in);
      if (!in.ok()) return "";
      if (std::string wrong = wrong_with(action); !wrong.empty()) {
        return fmt::format("action {}: {}", action.name, wrong);
      }
    }
    return "";
  }

  std::string read_edges(BytesIn& in) {
    constexpr std::size_t kEdgeBytes = 4 + 16;
    edges_.resize(parts_.actions.size());
    if (std::all_of(parts_.actions.begin(), parts_.actions.end(),
                    [](const Action& a) { return a.forced() || a.connects; })) {
      return "no action in it can be launched";
    }
    for (std::size_t from = 0; from < edges_.size(); ++from) {
      std::vector<Edge>& edges = edges_[from];
      const std::size_t count = in.get_count(kEdgeBytes);
      edges.reserve(count);
      for (std::size_t i = 0; i < count; ++i) {
        const ActionId to(in.get<std::int32_t>());
        const Alignment alignment = get_alignment(in);
        if (!known(to) || !sound(alignment)) return "an edge leads nowhere";
        if (!may_follow(parts_.actions[from], parts_.actions[to.at()])) {
          return fmt::format("{} cannot follow {}", parts_.actions[to.at()].name,
                             parts_.actions[from].name);
        }
        edges.push_back({to, alignment});
      }
      if (in.ok() && edges.empty()) return "an action that nothing can follow";
    }
    return "";
  }

  std::string read_paths(BytesIn& in) {
    const std::size_t count = parts_.actions.size();
    joined_.resize(count * count);
    for (std::size_t i = 0; i < count; ++i) {
      for (const Edge& edge : edges_[i]) joined_[i * count + edge.to.at()] = true;
    }
    paths_.resize(count);
    for (std::size_t i = 0; i < count && in.ok(); ++i) {
      paths_[i].resize(count);
      for (std::size_t j = 0; j < count && in.ok(); ++j) {
        if (in.get_flag()) {
          paths_[i][j] = get_path(in);
          if (in.ok() && !stands(ActionId(i), *paths_[i][j], ActionId(j))) {
            return "a path leads over an edge that does not stand";
          }
        } else if (in.ok() && !parts_.actions[j].forced() && !parts_.actions[j].connects) {
          return fmt::format("no path from {} to {}", parts_.actions[i].name,
                             parts_.actions[j].name);
        }
      }
    }
    parts_.machine = StateMachine(std::move(edges_), std::move(paths_));
    return "";
  }

  std::string read_graph(BytesIn& in) {
    MotionGraph& graph = parts_.graph;
    const std::size_t clips = in.get_count(8);
    graph.clips.reserve(clips);
    for (std::size_t i = 0; i < clips; ++i) {
      std::string name = in.get_text();
      graph.clips.push_back({std::move(name), in.get<Tick>()});
    }
    constexpr std::size_t kTransitionBytes = 4 * 4 + 16;
    const std::size_t transitions = in.get_count(kTransitionBytes);
    graph.transitions.reserve(transitions);
    for (std::size_t i = 0; i < transitions; ++i) {
      Transition t;
      t.from_clip = in.get<std::int32_t>();
      t.from = in.get<Tick>();
      t.to_clip = in.get<std::int32_t>();
      t.to = in.get<Tick>();
      t.alignment = get_alignment(in);
      if (!inside(t.from_clip, t.from) || !inside(t.to_clip, t.to) || !sound(t.alignment)) {
        return "a transition leads nowhere";
      }
      graph.transitions.push_back(t);
    }
    graph.pairs = in.get<std::uint64_t>();
    graph.minima = in.get<std::uint32_t>();
    graph.dropped = in.get<std::uint32_t>();
    return "";
  }

  std::string read_notes(BytesIn& in) {
    for (auto* lines : {&parts_.dropped, &parts_.notes}) {
      const std::size_t count = in.get_count(4);
      lines->reserve(count);
      for (std::size_t i = 0; i < count; ++i) lines->push_back(in.get_text());
    }
    return "";
  }

  LibraryParts take() { return std::move(parts_); }

 private:
  bool known(ActionId id) const { return id.valid() && id.at() < parts_.actions.size(); }
  bool inside(std::int32_t clip, Tick tick) const {
    const auto& clips = parts_.graph.clips;
    return clip >= 0 && static_cast<std::size_t>(clip) < clips.size() && tick >= 0 &&
           tick <= clips[static_cast<std::size_t>(clip)].length;
  }
  Path get_path(BytesIn& in) const {
    Path path;
    const std::size_t count = std::min(in.get_count(4), kLongestPath);
    path.via.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      path.via.emplace_back(in.get<std::int32_t>());
      if (known(path.via.back())) path.ticks += parts_.actions[path.via.back().at()].length();
    }
    return path;
  }
  // Whether every step of the path is an edge.
  bool stands(ActionId from, const Path& path, ActionId to) const {
    for (const ActionId via : path.via) {
      if (!known(via) || !edge(from, via)) return false;
      from = via;
    }
    return edge(from, to);
  }
  bool edge(ActionId from, ActionId to) const {
    return joined_[from.at() * parts_.actions.size() + to.at()];
  }

  LibraryParts parts_;
  std::vector<std::vector<Edge>> edges_;
  std::vector<bool> joined_;  // whether an edge leads from one action to another, row by row
  std::vector<std::vector<std::optional<Path>>> paths_;
};

constexpr std::array<LibraryReader::Step, kSections.size()> LibraryReader::kSteps() {
  return {&LibraryReader::read_skeleton, &LibraryReader::read_actions, &LibraryReader::read_clips,
          &LibraryReader::read_edges,    &LibraryReader::read_paths,   &LibraryReader::read_graph,
          &LibraryReader::read_notes};
}

// The content after the header, if the header is ours and the content is what it says.
Result<std::string_view> content_of(std::string_view bytes, const std::string& file) {
  if (!looks_like_library(bytes)) {
    return input_error(file, "bytes 0-8", "not a motion library file",
                       "name a file that `ringcraft library build` wrote");
  }
  BytesIn header(bytes.substr(kMagic.size()));
  const auto version = header.get<std::uint32_t>();
  const auto sections = header.get<std::uint32_t>();
  const auto size = header.get<std::uint64_t>();
  const auto hash = header.get<std::uint64_t>();
  if (!header.ok()) return input_error(file, "header", "the file is cut off", kRemedy);
  if (version != kLibraryVersion) {
    return input_error(file, "header",
                       fmt::format("version {} of the library file, this build reads version {}",
                                   version, kLibraryVersion),
                       kRemedy);
  }
  const std::string_view content = bytes.substr(kHeaderBytes);
  if (content.size() != size) {
    return input_error(file, "header",
                       fmt::format("{} bytes should follow, {} do", size, content.size()), kRemedy);
  }
  if (hash_of(content) != hash) {
    return input_error(file, "", "its hash is not that of its content: the file is damaged",
                       kRemedy);
  }
  if (sections != kSections.size()) {
    return input_error(file, "header",
                       fmt::format("{} sections, not {}", sections, kSections.size()), kRemedy);
  }
  return content;
}

// A section's eight bytes of name.
std::string padded(std::string_view name) {
  std::string bytes(name);
  bytes.resize(8, '\0');
  return bytes;
}

}  // namespace

bool looks_like_library(std::string_view bytes) {
  return bytes.starts_with(kMagic);
}

std::string library_bytes(const MotionLibrary& library) {
  const std::array<std::string, kSections.size()> sections = {skeleton_section(library.skeleton()),
                                                              actions_section(library),
                                                              clips_section(library),
                                                              edges_section(library),
                                                              paths_section(library),
                                                              graph_section(library.graph()),
                                                              notes_section(library)};
  BytesOut table;
  std::uint64_t offset = kSections.size() * kSectionEntryBytes;
  for (std::size_t i = 0; i < kSections.size(); ++i) {
    for (const char c : padded(kSections[i])) table.put(c);
    table.put(offset);
    table.put(static_cast<std::uint64_t>(sections[i].size()));
    offset += sections[i].size();
  }
  std::string content = table.take();
  for (const std::string& section : sections) content += section;
  BytesOut header;
  for (const char c : kMagic) header.put(c);
  header.put(kLibraryVersion);
  header.put_count(kSections.size());
  header.put(static_cast<std::uint64_t>(content.size()));
  header.put(hash_of(content));
  return header.take() + content;
}

Result<MotionLibrary> library_from_bytes(std::string_view bytes, const std::string& file) {
  const auto content = content_of(bytes, file);
  if (!content) return tl::unexpected(content.error());
  constexpr std::size_t kTableBytes = kSections.size() * kSectionEntryBytes;
  LibraryReader reader;
  BytesIn table(content->substr(0, kTableBytes));
  std::uint64_t expected = kTableBytes;  // sections follow each other without gaps
  for (std::size_t i = 0; i < kSections.size(); ++i) {
    const std::string place = fmt::format("section {}", kSections[i]);
    std::string name;
    for (int c = 0; c < 8; ++c) name += table.get<char>();
    const auto offset = table.get<std::uint64_t>();
    const auto size = table.get<std::uint64_t>();
    if (!table.ok() || name != padded(kSections[i]) || offset != expected ||
        offset > content->size() || size > content->size() - offset) {
      return input_error(file, place, "the table of sections does not fit the file", kRemedy);
    }
    expected += size;
    BytesIn section(content->substr(offset, size));
    const std::string wrong = (reader.*LibraryReader::kSteps()[i])(section);
    if (!wrong.empty()) return input_error(file, place, wrong, kRemedy);
    if (!section.done()) {
      return input_error(file, place, "the section's size does not fit what it holds", kRemedy);
    }
  }
  if (expected != content->size()) {
    return input_error(file, "", "bytes after the last section", kRemedy);
  }
  return MotionLibrary(reader.take());
}

}  // namespace ringcraft
