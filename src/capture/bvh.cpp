#include "capture/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/file.h"
#include "capture/words.h"

namespace ringcraft {
namespace {

constexpr std::size_t kMissingRows = 2;  // that exporters miscount; more are a file cut off
constexpr const char* kExportAgain = "export the file again";

enum class Channel : std::uint8_t {
  x_position,
  y_position,
  z_position,
  x_rotation,
  y_rotation,
  z_rotation
};

std::optional<Channel> channel_from(std::string_view word) {
  static constexpr std::array<std::string_view, 6> kNames = {"xposition", "yposition", "zposition",
                                                             "xrotation", "yrotation", "zrotation"};
  const std::string low = lowered(word);
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (low == kNames[i]) return static_cast<Channel>(i);
  return std::nullopt;
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const CaptureLimits& limits)
      : words_(text), limits_(limits) {
    clip_.file = file;
  }

  Result<RawClip> read() {
    if (auto ok = hierarchy(); !ok) return tl::unexpected(ok.error());
    if (auto ok = motion_header(); !ok) return tl::unexpected(ok.error());
    if (auto ok = rows(); !ok) return tl::unexpected(ok.error());
    return std::move(clip_);
  }

 private:
  tl::unexpected<Error> fault(int line, std::string what, std::string remedy = kExportAgain) const {
    return input_error(clip_.file, fmt::format("line {}", line), std::move(what),
                       std::move(remedy));
  }
  tl::unexpected<Error> unexpected_word(std::string_view word, std::string_view wanted) const {
    if (word.empty())
      return fault(words_.line(), fmt::format("the file ends where {} should stand", wanted));
    return fault(words_.line(),
                 fmt::format("{} should stand here, not {}", wanted, in_quotes(word)));
  }

  Result<float> read_number() {
    const std::string_view word = words_.next();
    if (const auto value = number(word)) return *value;
    return unexpected_word(word, "a number");
  }
  // With or without a space between.
  Result<float> read_number_after(std::string_view key) {
    const std::string_view word = words_.next();
    if (!lowered(word).starts_with(lowered(key)))
      return unexpected_word(word, fmt::format("'{}'", key));
    if (word.size() == key.size()) return read_number();
    if (const auto value = number(word.substr(key.size()))) return *value;
    return unexpected_word(word, fmt::format("'{}' and a number", key));
  }
  Result<Vec3> read_vector() {
    Vec3 v;
    for (int i = 0; i < 3; ++i) {
      auto value = read_number();
      if (!value) return tl::unexpected(value.error());
      v[i] = *value;
    }
    return v;
  }

  Result<void> hierarchy() {
    std::string_view word = words_.next();
    if (word.starts_with("\xEF\xBB\xBF")) word.remove_prefix(3);
    if (lowered(word) != "hierarchy")
      return input_error(clip_.file, "line 1", "no BVH file: it does not begin with HIERARCHY",
                         "give a BVH file");
    word = words_.next();
    if (lowered(word) != "root") return unexpected_word(word, "ROOT");
    if (auto ok = skeleton(); !ok) return ok;
    while (lowered(words_.peek()) == "root") {  // another person, or a thing
      words_.next();
      if (auto ok = skeleton(); !ok) return ok;
    }
    return {};
  }

  // After ROOT.
  Result<void> skeleton() {
    if (auto ok = begin_joint(-1); !ok) return ok;
    while (!open_.empty())
      if (auto ok = joint_item(); !ok) return ok;
    return {};
  }

  // After ROOT or JOINT: the name and the opening brace.
  Result<void> begin_joint(int parent) {
    if (clip_.joints.size() >= limits_.joints)
      return fault(words_.line(), fmt::format("more than {} joints", limits_.joints));
    if (open_.size() >= limits_.depth)
      return fault(words_.line(), fmt::format("joints are nested deeper than {}", limits_.depth));
    std::string_view name = words_.rest_of_line();
    bool braced = false;
    if (name.ends_with('{')) {
      braced = true;
      name.remove_suffix(1);
      while (!name.empty() && is_space(name.back())) name.remove_suffix(1);
    }
    if (!braced) {
      const std::string_view brace = words_.next();
      if (brace != "{") return unexpected_word(brace, "'{'");
    }
    RawJoint joint;
    joint.name = clean_name(name);
    joint.parent = parent;
    open_.push_back(static_cast<int>(clip_.joints.size()));
    clip_.joints.push_back(std::move(joint));
    channels_.emplace_back();
    return {};
  }

  Result<void> joint_item() {
    const std::string_view word = words_.next();
    const std::string key = lowered(word);
    const auto joint = static_cast<std::size_t>(open_.back());
    if (key == "}") {
      open_.pop_back();
      return {};
    }
    if (key == "offset") {
      auto v = read_vector();
      if (!v) return tl::unexpected(v.error());
      clip_.joints[joint].offset = *v;
      return {};
    }
    if (key == "channels") return joint_channels(joint);
    if (key == "joint") return begin_joint(open_.back());
    if (key == "end") return end_site(joint);
    return unexpected_word(word, "OFFSET, CHANNELS, JOINT, End Site or '}'");
  }

  Result<void> joint_channels(std::size_t joint) {
    auto count = read_number();
    if (!count) return tl::unexpected(count.error());
    if (*count != std::floor(*count) || *count < 0 || *count > 6)
      return fault(words_.line(), fmt::format("a joint has 0 to 6 channels, not {}", *count));
    if (!channels_[joint].empty())
      return fault(words_.line(), "CHANNELS stands twice in one joint");
    for (int i = 0; i < static_cast<int>(*count); ++i) {
      const std::string_view word = words_.next();
      const auto channel = channel_from(word);
      if (!channel) return unexpected_word(word, "a channel such as Zrotation");
      if (std::count(channels_[joint].begin(), channels_[joint].end(), *channel) != 0)
        return fault(words_.line(),
                     fmt::format("channel {} stands twice in one joint", in_quotes(word)));
      channels_[joint].push_back(*channel);
    }
    channel_count_ += channels_[joint].size();
    return {};
  }

  Result<void> end_site(std::size_t joint) {
    std::string_view word;
    if (!words_.rest_of_line().ends_with('{')) {
      word = words_.next();
      if (word != "{") return unexpected_word(word, "'{'");
    }
    word = words_.next();
    if (lowered(word) != "offset") return unexpected_word(word, "OFFSET");
    auto v = read_vector();
    if (!v) return tl::unexpected(v.error());
    word = words_.next();
    if (word != "}") return unexpected_word(word, "'}'");
    if (glm::length(*v) == 0) return {};
    if (clip_.joints.size() >= limits_.joints)
      return fault(words_.line(), fmt::format("more than {} joints", limits_.joints));
    clip_.joints.push_back({clip_.joints[joint].name + kEndSite, static_cast<int>(joint), *v});
    channels_.emplace_back();
    return {};
  }

  Result<void> motion_header() {
    std::string_view word = words_.next();
    if (lowered(word) != "motion") return unexpected_word(word, "MOTION");
    auto frames = read_number_after("Frames:");
    if (!frames) return tl::unexpected(frames.error());
    if (*frames < 1 || *frames != std::floor(*frames))
      return fault(words_.line(), fmt::format("Frames: {} is no count of frames", *frames));
    if (static_cast<double>(*frames) * static_cast<double>(clip_.joints.size()) >
        static_cast<double>(limits_.cells))
      return fault(
          words_.line(),
          fmt::format("{} frames of {} joints are more than is read", *frames, clip_.joints.size()),
          "cut the file into shorter ones");
    frames_said_ = static_cast<std::size_t>(*frames);
    word = words_.next();
    if (lowered(word) != "frame") return unexpected_word(word, "'Frame Time:'");
    const int line = words_.line();
    auto time = read_number_after("Time:");
    if (!time) return tl::unexpected(time.error());
    if (*time < 1e-4f || *time > 1.0f)
      return fault(line, fmt::format("a frame time of {} s is not between 0.0001 and 1", *time));
    clip_.frame_seconds = static_cast<double>(*time);
    words_.rest_of_line();
    return {};
  }

  Result<void> rows() {
    if (channel_count_ == 0) return fault(words_.line(), "no joint has channels");
    std::vector<float> row;
    while (!words_.done()) {
      const int line = words_.line();
      Words cells(words_.rest_of_line());
      row.clear();
      for (std::string_view word = cells.next(); !word.empty(); word = cells.next()) {
        const auto value = number(word);
        if (!value)
          return fault(line, fmt::format("{} is not a number that can be used", in_quotes(word)),
                       word.find(',') == word.npos ? kExportAgain : "write decimals with points");
        row.push_back(*value);
        if (row.size() > channel_count_) break;
      }
      if (row.empty()) continue;
      if (row.size() != channel_count_)
        return fault(line,
                     fmt::format("this row has {} numbers, the hierarchy has {} channels",
                                 row.size() > channel_count_ ? "more" : std::to_string(row.size()),
                                 channel_count_),
                     "the file is cut off or damaged: fetch it again");
      if ((clip_.frames + 1) * clip_.joints.size() > limits_.cells)
        return fault(line, "more frames than are read", "cut the file into shorter ones");
      add_frame(row);
    }
    if (clip_.frames == 0) return fault(words_.line(), "there are no rows after Frame Time");
    if (clip_.frames + kMissingRows < frames_said_)
      return fault(words_.line(),
                   fmt::format("Frames: says {}, but the file ends after {} rows", frames_said_,
                               clip_.frames),
                   "the file is cut off: fetch it again");
    if (clip_.frames != frames_said_)
      clip_.notes.push_back(fmt::format("Frames: says {}, the file has {} rows: read the rows",
                                        frames_said_, clip_.frames));
    return {};
  }

  void add_frame(const std::vector<float>& row) {
    std::size_t cell = 0;
    for (std::size_t j = 0; j < clip_.joints.size(); ++j) {
      Vec3 translation = clip_.joints[j].offset;
      Quat rotation(1, 0, 0, 0);
      for (const Channel channel : channels_[j]) {
        const float value = row[cell++];
        const int axis = static_cast<int>(channel) % 3;
        if (channel <= Channel::z_position) {
          translation[axis] = value;
        } else {
          Vec3 about{};
          about[axis] = 1;
          rotation = rotation * glm::angleAxis(radians(std::remainder(value, 360.0f)), about);
        }
      }
      clip_.translation.push_back(translation);
      clip_.rotation.push_back(glm::normalize(rotation));
    }
    ++clip_.frames;
  }

  Words words_;
  CaptureLimits limits_;
  RawClip clip_;
  std::vector<std::vector<Channel>> channels_;
  std::size_t channel_count_ = 0;
  std::size_t frames_said_ = 0;
  std::vector<int> open_;
};

}  // namespace

Result<RawClip> parse_bvh(std::string_view text, const std::string& file,
                          const CaptureLimits& limits) {
  return Reader(text, file, limits).read();
}

Result<RawClip> read_bvh(const std::filesystem::path& path) {
  auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_bvh(*text, path.string());
}

}  // namespace ringcraft
