#include "capture/asf.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "capture/words.h"

namespace ringcraft {
namespace {

constexpr float kMetresPerInch = 0.0254f;

std::optional<AsfChannel> channel_from(std::string_view word) {
  static constexpr std::array<std::string_view, 7> kNames = {"tx", "ty", "tz", "rx",
                                                             "ry", "rz", "l"};
  const auto at = std::find(kNames.begin(), kNames.end(), lowered(word));
  if (at == kNames.end()) return std::nullopt;
  return static_cast<AsfChannel>(at - kNames.begin());
}

// Angles as the file has them, with the order in which they apply.
struct Axis {
  Vec3 angles{};
  std::string order = "xyz";
};

// A bone as its block has it: file units, angles in the file's unit.
struct Block {
  std::string name;
  Vec3 direction{};
  float length = 0;
  Axis axis;
  std::vector<AsfChannel> channels;
  int line = 0;
  std::vector<std::size_t> children;
  bool carried = false;
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const CaptureLimits& limits)
      : lines_(text), limits_(limits) {
    skeleton_.file = file;
    Block root;
    root.name = "root";
    blocks_.push_back(root);
    names_["root"] = 0;
  }

  Result<AsfSkeleton> read() {
    while (!lines_.done())
      if (auto ok = line(); !ok) return tl::unexpected(ok.error());
    if (in_block_)
      return fault("the file ends within a bone", "the file is cut off: fetch it again");
    if (!has_hierarchy_)
      return fault("there is no :hierarchy", "give an ASF file; if it is one, it is cut off");
    if (blocks_[0].channels.empty())
      return fault("the root has no order of channels", "export the file again");
    if (auto ok = lay_out(); !ok) return tl::unexpected(ok.error());
    return std::move(skeleton_);
  }

 private:
  tl::unexpected<Error> fault(std::string what, std::string remedy = "export the file again") {
    return input_error(skeleton_.file, fmt::format("line {}", line_), std::move(what),
                       std::move(remedy));
  }

  Result<void> line() {
    line_ = lines_.line();
    std::string_view rest = lines_.rest_of_line();
    if (line_ == 1 && rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    if (rest.empty() || rest.front() == '#') return {};
    Words words(rest);
    if (rest.front() == ':') {
      if (in_block_) return fault("a new section begins within a bone");
      section_ = lowered(words.next());
      has_hierarchy_ = has_hierarchy_ || section_ == ":hierarchy";
      return {};
    }
    if (section_ == ":units") return unit(words);
    if (section_ == ":root") return root_item(words);
    if (section_ == ":bonedata") return bone_item(words);
    if (section_ == ":hierarchy") return children(words);
    if (section_.empty())
      return fault("no ASF file: it does not begin with a section", "give an ASF file");
    return {};  // documentation, skin, and what is not known
  }

  Result<float> read_number(Words& words) {
    const std::string_view word = words.next();
    if (const auto value = number(word)) return *value;
    if (word.empty()) return fault("the line ends where a number should stand");
    return fault(fmt::format("a number should stand here, not {}", in_quotes(word)));
  }
  Result<void> read_vector(Words& words, Vec3& out) {
    for (int i = 0; i < 3; ++i) {
      auto value = read_number(words);
      if (!value) return tl::unexpected(value.error());
      out[i] = *value;
    }
    return {};
  }
  Result<void> read_order(std::string_view word, Axis& axis) {
    std::string order = lowered(word);
    std::string sorted = order;
    std::sort(sorted.begin(), sorted.end());
    if (sorted != "xyz")
      return fault(fmt::format("an axis order is XYZ in some order, not {}", in_quotes(word)));
    axis.order = std::move(order);
    return {};
  }
  Result<void> read_channels(Words& words, Block& bone) {
    bone.channels.clear();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const auto channel = channel_from(word);
      if (!channel) return fault(fmt::format("{} is none of TX TY TZ RX RY RZ L", in_quotes(word)));
      if (std::count(bone.channels.begin(), bone.channels.end(), *channel) > 0)
        return fault(fmt::format("{} stands twice in one bone", in_quotes(word)));
      bone.channels.push_back(*channel);
    }
    return {};
  }

  Result<void> unit(Words& words) {
    const std::string key = lowered(words.next());
    if (key == "length") {
      auto value = read_number(words);
      if (!value) return tl::unexpected(value.error());
      if (*value < 1e-4f || *value > 1e4f)
        return fault(fmt::format("a unit length of {} makes no sense", *value));
      skeleton_.metres_per_unit = kMetresPerInch / *value;
      has_length_ = true;
    } else if (key == "angle") {
      const std::string_view word = words.next();
      const std::string angle = lowered(word);
      if (!angle.starts_with("deg") && !angle.starts_with("rad"))
        return fault(fmt::format("angles are in deg or rad, not {}", in_quotes(word)));
      skeleton_.degrees = angle.starts_with("deg");
    }
    return {};
  }

  Result<void> root_item(Words& words) {
    const std::string key = lowered(words.next());
    Block& root = blocks_[0];
    if (key == "order") return read_channels(words, root);
    if (key == "axis") return read_order(words.next(), root.axis);
    if (key == "position") return read_vector(words, root_position_);
    if (key == "orientation") return read_vector(words, root.axis.angles);
    return {};
  }

  Result<void> bone_item(Words& words) {
    const std::string_view word = words.next();
    const std::string key = lowered(word);
    if (key == "begin") {
      if (in_block_) return fault("a bone begins within a bone");
      if (blocks_.size() >= limits_.joints)
        return fault(fmt::format("more than {} bones", limits_.joints));
      in_block_ = true;
      blocks_.emplace_back();
      blocks_.back().line = line_;
      return {};
    }
    if (!in_block_) return fault(fmt::format("{} stands outside of a bone", in_quotes(word)));
    Block& bone = blocks_.back();
    if (key == "end") {
      in_block_ = false;
      if (bone.name.empty()) return fault("a bone has no name");
      if (!names_.emplace(bone.name, blocks_.size() - 1).second)
        return fault(fmt::format("a second bone is called {}", in_quotes(bone.name)));
      return {};
    }
    if (key == "name") {
      bone.name = clean_name(words.rest_of_line());
    } else if (key == "direction") {
      return read_vector(words, bone.direction);
    } else if (key == "length") {
      auto value = read_number(words);
      if (!value) return tl::unexpected(value.error());
      if (*value < 0) return fault("a bone has a negative length");
      bone.length = *value;
    } else if (key == "axis") {
      if (auto ok = read_vector(words, bone.axis.angles); !ok) return ok;
      return read_order(words.next(), bone.axis);
    } else if (key == "dof") {
      return read_channels(words, bone);
    }
    return {};  // id, limits, masses
  }

  Result<std::size_t> bone_named(std::string_view word) {
    const auto at = names_.find(clean_name(word));
    if (at == names_.end()) return fault(fmt::format("no bone is called {}", in_quotes(word)));
    return at->second;
  }

  Result<void> children(Words& words) {
    const std::string_view first = words.next();
    if (const std::string key = lowered(first); key == "begin" || key == "end") return {};
    auto parent = bone_named(first);
    if (!parent) return tl::unexpected(parent.error());
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      auto child = bone_named(word);
      if (!child) return tl::unexpected(child.error());
      if (*child == 0 || blocks_[*child].carried)
        return fault(fmt::format("{} hangs on two bones", in_quotes(word)));
      blocks_[*child].carried = true;
      blocks_[*parent].children.push_back(*child);
    }
    return {};
  }

  float angle(float value) const { return skeleton_.degrees ? radians(value) : value; }

  Quat frame_of(const Axis& axis) const {
    Quat turned(1, 0, 0, 0);
    for (const char letter : axis.order) {
      Vec3 about{};
      about[letter - 'x'] = 1;
      turned = glm::angleAxis(angle(axis.angles[letter - 'x']), about) * turned;
    }
    return glm::normalize(turned);
  }

  AsfBone bone_from(const Block& block, int parent) const {
    AsfBone bone;
    bone.name = block.name;
    bone.parent = parent;
    bone.axis = frame_of(block.axis);
    bone.channels = block.channels;
    bone.along = normalized_or(block.direction, Vec3(0)) * block.length * skeleton_.metres_per_unit;
    if (parent < 0)
      bone.start = root_position_ * skeleton_.metres_per_unit;
    else
      bone.start = skeleton_.bones[static_cast<std::size_t>(parent)].along;
    return bone;
  }

  // Parents before children. A bone that is reached from the root is reached once: every bone hangs
  // on one bone at most, and nothing carries the root.
  Result<void> lay_out() {
    struct Open {
      std::size_t block;
      int parent;
      std::size_t depth;
    };
    std::vector<Open> open = {{0, -1, 0}};
    while (!open.empty()) {
      const Open at = open.back();
      open.pop_back();
      const Block& block = blocks_[at.block];
      if (at.depth >= limits_.depth)
        return fault(fmt::format("bones are nested deeper than {}", limits_.depth));
      const int index = static_cast<int>(skeleton_.bones.size());
      skeleton_.bones.push_back(bone_from(block, at.parent));
      for (auto child = block.children.rbegin(); child != block.children.rend(); ++child)
        open.push_back({*child, index, at.depth + 1});
    }
    if (skeleton_.bones.size() != blocks_.size())
      for (const Block& block : blocks_)
        if (&block != &blocks_[0] && !block.carried)
          return input_error(skeleton_.file, fmt::format("line {}", block.line),
                             fmt::format("bone {} hangs on nothing", in_quotes(block.name)),
                             "put it into :hierarchy");
    if (skeleton_.bones.size() != blocks_.size())
      return fault("some bones hang on each other in a ring", "correct :hierarchy");
    if (!has_length_) skeleton_.notes.emplace_back("no unit of length: read as inches");
    for (const AsfBone& bone : skeleton_.bones)
      if (std::count(bone.channels.begin(), bone.channels.end(), AsfChannel::length) > 0)
        skeleton_.notes.push_back(
            fmt::format("bone {} changes its length: not followed", in_quotes(bone.name)));
    return {};
  }

  Words lines_;
  CaptureLimits limits_;
  AsfSkeleton skeleton_;
  std::vector<Block> blocks_;
  std::map<std::string, std::size_t> names_;
  Vec3 root_position_{};
  std::string section_;
  int line_ = 1;
  bool in_block_ = false;
  bool has_hierarchy_ = false;
  bool has_length_ = false;
};

}  // namespace

Result<AsfSkeleton> parse_asf(std::string_view text, const std::string& file,
                              const CaptureLimits& limits) {
  return Reader(text, file, limits).read();
}

}  // namespace ringcraft
