#include "capture/amc.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/file.h"
#include "capture/words.h"

namespace ringcraft {
namespace {

RawClip resting(const AsfSkeleton& skeleton, const std::string& file, double frames_per_second) {
  RawClip clip;
  clip.file = file;
  clip.frame_seconds = 1 / frames_per_second;
  clip.notes = skeleton.notes;
  std::vector<bool> carries(skeleton.bones.size());
  for (const AsfBone& bone : skeleton.bones) {
    if (bone.parent >= 0) carries[static_cast<std::size_t>(bone.parent)] = true;
    clip.joints.push_back({bone.name, bone.parent, bone.start});
  }
  for (std::size_t j = 0; j < carries.size(); ++j)
    if (const AsfBone& bone = skeleton.bones[j]; !carries[j] && glm::length(bone.along) > 0)
      clip.joints.push_back({bone.name + kEndSite, static_cast<int>(j), bone.along});
  return clip;
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const AsfSkeleton& skeleton,
         double frames_per_second, const CaptureLimits& limits)
      : lines_(text),
        skeleton_(skeleton),
        limits_(limits),
        clip_(resting(skeleton, file, frames_per_second)),
        degrees_(skeleton.degrees) {
    for (std::size_t j = 0; j < skeleton.bones.size(); ++j) names_[skeleton.bones[j].name] = j;
  }

  Result<RawClip> read() {
    while (!lines_.done())
      if (auto ok = line(); !ok) return tl::unexpected(ok.error());
    line_ = lines_.line();
    if (clip_.frames == 0) return fault("there are no frames", "give an AMC file");
    if (auto ok = end_frame(); !ok) return tl::unexpected(ok.error());
    std::string still;
    for (std::size_t j = 0; j < moves_.size(); ++j)
      if (!moves_[j] && !skeleton_.bones[j].channels.empty())
        still += (still.empty() ? "" : ", ") + skeleton_.bones[j].name;
    if (!still.empty())
      clip_.notes.push_back("no motion for " + still.substr(0, 200) + ": kept at rest");
    return std::move(clip_);
  }

 private:
  tl::unexpected<Error> fault(std::string what, std::string remedy) const {
    return input_error(clip_.file, fmt::format("line {}", line_), std::move(what),
                       std::move(remedy));
  }

  Result<void> line() {
    line_ = lines_.line();
    std::string_view rest = lines_.rest_of_line();
    if (line_ == 1 && rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    if (rest.empty() || rest.front() == '#') return {};
    if (rest.front() == ':') {
      const std::string key = lowered(rest);
      if (key == ":degrees") degrees_ = true;
      if (key == ":radians") degrees_ = false;
      return {};
    }
    Words words(rest);
    const std::string_view first = words.next();
    if (const auto value = number(first); value && words.peek().empty()) return begin_frame(first);
    if (clip_.frames == 0)
      return fault(
          fmt::format("the number of the first frame should stand here, not {}", in_quotes(first)),
          "give an AMC file");
    return bone(first, words);
  }

  Result<void> begin_frame(std::string_view word) {
    if (clip_.frames > 0)
      if (auto ok = end_frame(); !ok) return ok;
    const float value = *number(word);
    if (value != std::floor(value) || value < 0)
      return fault(fmt::format("{} is no number of a frame", in_quotes(word)),
                   "export the file again");
    const auto frame = static_cast<std::size_t>(value);
    if (clip_.frames > 0 && frame != frame_ + 1)
      return fault(fmt::format("frame {} follows frame {}", frame, frame_),
                   "frames are missing or doubled: fetch the file again");
    if ((clip_.frames + 1) * clip_.joints.size() > limits_.cells)
      return fault("more frames than are read", "cut the file into shorter ones");
    frame_ = frame;
    ++clip_.frames;
    for (const RawJoint& joint : clip_.joints) {
      clip_.translation.push_back(joint.offset);
      clip_.rotation.emplace_back(1.0f, 0.0f, 0.0f, 0.0f);
    }
    given_.assign(skeleton_.bones.size(), false);
    return {};
  }

  // Every frame moves the bones that the first one moves.
  Result<void> end_frame() {
    if (clip_.frames == 1) {
      moves_ = given_;
      if (!moves_[0]) return fault("the first frame does not place the root", "fetch it again");
      return {};
    }
    for (std::size_t j = 0; j < given_.size(); ++j)
      if (given_[j] != moves_[j])
        return fault(fmt::format("frame {} {} bone {}, unlike the first frame", frame_,
                                 given_[j] ? "moves" : "lacks", in_quotes(clip_.joints[j].name)),
                     "the file is cut off or damaged: fetch it again");
    return {};
  }

  Result<void> bone(std::string_view name, Words& words) {
    const auto at = names_.find(clean_name(name));
    if (at == names_.end())
      return fault(fmt::format("the skeleton {} has no bone {}", skeleton_.file, in_quotes(name)),
                   "name this motion's own skeleton");
    const std::size_t j = at->second;
    if (given_[j])
      return fault(fmt::format("bone {} stands twice in frame {}", in_quotes(name), frame_),
                   "fetch the file again");
    given_[j] = true;
    const AsfBone& bone = skeleton_.bones[j];
    Vec3 moved{};
    Quat turned(1, 0, 0, 0);
    for (const AsfChannel channel : bone.channels) {
      const std::string_view word = words.next();
      const auto value = number(word);
      if (!value)
        return fault(word.empty() ? fmt::format("bone {} has {} numbers, not fewer",
                                                in_quotes(name), bone.channels.size())
                                  : in_quotes(word) + " is not a number that can be used",
                     "the file is cut off or damaged: fetch it again");
      const int axis = static_cast<int>(channel) % 3;
      if (channel <= AsfChannel::tz) {
        moved[axis] = *value * skeleton_.metres_per_unit;
      } else if (channel <= AsfChannel::rz) {
        Vec3 about{};
        about[axis] = 1;
        const float angle = degrees_ ? radians(std::remainder(*value, 360.0f)) : *value;
        turned = glm::angleAxis(angle, about) * turned;
      }
    }
    if (!words.next().empty())
      return fault(
          fmt::format("bone {} has {} numbers, not more", in_quotes(name), bone.channels.size()),
          "name this motion's own skeleton");
    const std::size_t cell = clip_.at(clip_.frames - 1, j);
    clip_.rotation[cell] = glm::normalize(bone.axis * turned * glm::inverse(bone.axis));
    clip_.translation[cell] += bone.parent < 0 ? moved : bone.axis * moved;
    return {};
  }

  Words lines_;
  const AsfSkeleton& skeleton_;
  CaptureLimits limits_;
  RawClip clip_;
  bool degrees_;
  std::map<std::string, std::size_t> names_;
  std::vector<bool> given_, moves_;  // bones of this frame, and of the first
  std::size_t frame_ = 0;            // as the file counts
  int line_ = 1;
};

}  // namespace

Result<RawClip> parse_amc(std::string_view text, const std::string& file,
                          const AsfSkeleton& skeleton, double frames_per_second,
                          const CaptureLimits& limits) {
  return Reader(text, file, skeleton, frames_per_second, limits).read();
}

Result<RawClip> read_asf_amc(const std::filesystem::path& asf, const std::filesystem::path& amc,
                             double frames_per_second) {
  auto bones = read_file(asf);
  if (!bones) return tl::unexpected(bones.error());
  auto skeleton = parse_asf(*bones, asf.string());
  if (!skeleton) return tl::unexpected(skeleton.error());
  auto motion = read_file(amc);
  if (!motion) return tl::unexpected(motion.error());
  return parse_amc(*motion, amc.string(), *skeleton, frames_per_second);
}

Result<std::filesystem::path> skeleton_beside(const std::filesystem::path& amc) {
  std::string stem = amc.stem().string();
  for (;;) {
    for (const char* extension : {".asf", ".ASF"}) {
      std::filesystem::path beside = amc.parent_path() / (stem + extension);
      std::error_code ignored;
      if (std::filesystem::is_regular_file(beside, ignored)) return beside;
    }
    const std::size_t underscore = stem.rfind('_');
    if (underscore == std::string::npos || underscore == 0) break;
    stem.resize(underscore);
  }
  return input_error(amc.string(), "",
                     fmt::format("its skeleton {}.asf does not lie beside it", stem),
                     "put it there, or name it with skeleton = \"...\"");
}

}  // namespace ringcraft
