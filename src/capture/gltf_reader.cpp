#include "capture/gltf_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "base/file.h"
#include "capture/gltf_parts.h"
#include "capture/words.h"

namespace ringcraft {
namespace {

constexpr float kLargestNumber = 1e7f;
constexpr const char* kExportAgain = "export the file again";

// Buffers beside the file: only regular files of the folder and below, none too large.
bool may_read(const std::string& path, void* folder) {
  const auto& root = *static_cast<const std::filesystem::path*>(folder);
  if (root.empty()) return false;
  const std::filesystem::path inside = std::filesystem::path(path).lexically_relative(root);
  if (inside.empty() || inside.is_absolute() || *inside.begin() == "..") return false;
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault) || fault) return false;
  const std::uintmax_t size = std::filesystem::file_size(path, fault);
  return !fault && size <= kLargestInput;
}

bool read_buffer(std::vector<unsigned char>* out, std::string* fault, const std::string& path,
                 void* folder) {
  if (!may_read(path, folder)) return false;
  const auto bytes = read_file(path);
  if (!bytes) {
    *fault = to_string(bytes.error());
    return false;
  }
  out->assign(bytes->begin(), bytes->end());
  return true;
}

// A binary container around what was kept of the file.
std::string container_of(const GltfParts& parts) {
  std::string json = parts.json;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string binary(parts.binary);
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string out = "glTF";
  const auto put = [&](std::size_t value) {
    for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
  };
  put(2);
  put(20 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
  put(json.size());
  put(0x4E4F534A);
  out += json;
  if (!binary.empty()) {
    put(binary.size());
    put(0x004E4942);
    out += binary;
  }
  return out;
}

class Reader {
 public:
  Reader(const std::string& file, const CaptureLimits& limits) : file_(file), limits_(limits) {}

  // The skeleton.
  Result<void> open(const GltfParts& parts, std::filesystem::path folder) {
    if (auto ok = load(parts, std::move(folder)); !ok) return ok;
    if (auto ok = nodes(); !ok) return ok;
    if (auto ok = sort_nodes(); !ok) return ok;
    if (auto ok = skins(); !ok) return ok;
    for (const auto& [bone, node] : parts.bones)
      if (static_cast<std::size_t>(node) < out_.nodes.size())
        out_.nodes[static_cast<std::size_t>(node)].bone = bone;
    rows_of_skeleton_ = rows_read_;
    return {};
  }
  // Then one clip after another; each may read as much as the file may.
  Result<GltfFile> read(const std::string& clip) {
    rows_read_ = rows_of_skeleton_;
    out_.clips.clear();
    out_.animation = {};
    if (auto ok = animation(clip); !ok) return tl::unexpected(ok.error());
    return out_;
  }
  GltfFile skeleton() && { return std::move(out_); }

 private:
  tl::unexpected<Error> fault(std::string place, std::string what,
                              std::string remedy = kExportAgain) const {
    return input_error(file_, std::move(place), std::move(what), std::move(remedy));
  }

  Result<void> load(const GltfParts& parts, std::filesystem::path folder) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({&may_read, [](const std::string& path, void*) { return path; },
                           &read_buffer, nullptr, &folder});
    std::string wrong;
    std::string odd;
    bool loaded = false;
    try {
      const std::string bytes = container_of(parts);
      loaded = loader.LoadBinaryFromMemory(
          &model_, &wrong, &odd, reinterpret_cast<const unsigned char*>(bytes.data()),
          static_cast<unsigned int>(bytes.size()), folder.string());
    } catch (const std::exception& exception) {
      wrong = exception.what();
    }
    if (loaded) return {};
    while (wrong.ends_with('\n')) wrong.pop_back();
    std::replace(wrong.begin(), wrong.end(), '\n', ' ');
    return fault("", "no glTF 2.0 file that can be read: " + clean_name(wrong));
  }

  // `out` stays as it is where the file is silent.
  Result<void> numbers(const std::vector<double>& values, std::size_t count, float* out,
                       const std::string& place) const {
    if (values.empty()) return {};
    if (values.size() != count)
      return fault(place, fmt::format("{} numbers where {} should stand", values.size(), count));
    for (std::size_t i = 0; i < count; ++i) {
      if (!(std::abs(values[i]) <= static_cast<double>(kLargestNumber)))
        return fault(place, "a number that cannot be used");
      out[i] = static_cast<float>(values[i]);
    }
    return {};
  }

  Result<void> nodes() {
    if (model_.nodes.empty()) return fault("/nodes", "there are no nodes");
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      const tinygltf::Node& from = model_.nodes[i];
      const std::string place = fmt::format("/nodes/{}", i);
      GltfNode node;
      node.name = clean_name(from.name);
      if (node.name.empty()) node.name = fmt::format("node_{}", i);
      node.mesh = from.mesh >= 0;
      std::array<float, 16> matrix{};
      std::array<float, 4> turn = {0, 0, 0, 1};
      if (auto ok = numbers(from.translation, 3, &node.rest.translation.x, place); !ok) return ok;
      if (auto ok = numbers(from.scale, 3, &node.rest.scale.x, place); !ok) return ok;
      if (auto ok = numbers(from.rotation, 4, turn.data(), place); !ok) return ok;
      if (auto ok = numbers(from.matrix, 16, matrix.data(), place); !ok) return ok;
      const Quat rotation(turn[3], turn[0], turn[1], turn[2]);
      if (glm::length(rotation) < 1e-6f) return fault(place, "a rotation of length zero");
      node.rest.rotation = glm::normalize(rotation);
      if (!from.matrix.empty()) node.rest = taken_apart(matrix);
      out_.nodes.push_back(std::move(node));
    }
    return {};
  }

  static GltfTransform taken_apart(const std::array<float, 16>& m) {
    GltfTransform out;
    glm::mat3 axes(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
    out.translation = {m[12], m[13], m[14]};
    for (int i = 0; i < 3; ++i) {
      out.scale[i] = glm::length(axes[i]);
      axes[i] = normalized_or(axes[i], Vec3(0));
    }
    if (glm::determinant(axes) < 0) {
      out.scale = -out.scale;
      axes = -axes;
    }
    if (glm::determinant(axes) > 0.1f) out.rotation = glm::normalize(glm::quat_cast(axes));
    return out;
  }

  Result<void> sort_nodes() {
    const std::size_t count = model_.nodes.size();
    for (std::size_t i = 0; i < count; ++i)
      for (const int child : model_.nodes[i].children) {
        const std::string place = fmt::format("/nodes/{}/children", i);
        if (child < 0 || static_cast<std::size_t>(child) >= count)
          return fault(place, fmt::format("there is no node {}", child));
        if (out_.nodes[static_cast<std::size_t>(child)].parent >= 0)
          return fault(place, fmt::format("node {} hangs on two nodes", child));
        out_.nodes[static_cast<std::size_t>(child)].parent = static_cast<int>(i);
      }
    std::vector<std::size_t> depth(count);
    for (std::size_t i = 0; i < count; ++i)
      if (out_.nodes[i].parent < 0) out_.order.push_back(static_cast<int>(i));
    for (std::size_t at = 0; at < out_.order.size(); ++at) {
      const auto node = static_cast<std::size_t>(out_.order[at]);
      for (const int child : model_.nodes[node].children) {
        depth[static_cast<std::size_t>(child)] = depth[node] + 1;
        if (depth[node] + 1 >= limits_.depth)
          return fault(fmt::format("/nodes/{}", node),
                       fmt::format("nodes are nested deeper than {}", limits_.depth));
        out_.order.push_back(child);
      }
    }
    if (out_.order.size() != count)
      return fault("/nodes", "some nodes hang on each other in a ring");
    return {};
  }

  // The numbers of an accessor, `width` a row. Integers are taken as fractions of their range.
  Result<std::vector<float>> accessor(int index, int type, const std::string& place) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size())
      return fault(place, fmt::format("there is no accessor {}", index));
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    const std::string here = fmt::format("/accessors/{}", index);
    if (accessor.sparse.isSparse)
      return fault(here, "sparse animation data is not read", "export it without sparse accessors");
    if (accessor.type != type) return fault(here, "its type does not fit its use");
    std::size_t bytes = 0;
    float whole = 0;
    switch (accessor.componentType) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        bytes = 4;
        break;
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        bytes = 1;
        whole = 127;
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        bytes = 1;
        whole = 255;
        break;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        bytes = 2;
        whole = 32767;
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        bytes = 2;
        whole = 65535;
        break;
      default:
        return fault(here, "its component type does not fit its use");
    }
    const auto width = static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    auto span = bytes_of(accessor, bytes * width, here);
    if (!span) return tl::unexpected(span.error());
    // Many may read one accessor: a small file could ask for much.
    rows_read_ += accessor.count;
    if (rows_read_ > limits_.cells)
      return fault(place, "more keys than are read", "cut the file into shorter ones");
    std::vector<float> out;
    out.reserve(accessor.count * width);
    for (std::size_t row = 0; row < accessor.count; ++row)
      for (std::size_t i = 0; i < width; ++i) {
        const unsigned char* cell = span->first + row * span->second + i * bytes;
        const float value = component(cell, accessor.componentType, whole);
        if (!(std::abs(value) <= kLargestNumber))
          return fault(here, fmt::format("number {} of it cannot be used", row * width + i));
        out.push_back(value);
      }
    return out;
  }

  // First byte and stride, after every byte was found to lie in the buffer.
  Result<std::pair<const unsigned char*, std::size_t>> bytes_of(const tinygltf::Accessor& accessor,
                                                                std::size_t row,
                                                                const std::string& here) const {
    if (accessor.bufferView < 0 ||
        static_cast<std::size_t>(accessor.bufferView) >= model_.bufferViews.size())
      return fault(here, fmt::format("there is no buffer view {}", accessor.bufferView));
    const auto& view = model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size())
      return fault(here, fmt::format("there is no buffer {}", view.buffer));
    const auto& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    const std::size_t stride = view.byteStride == 0 ? row : view.byteStride;
    const bool view_fits =
        view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset;
    if (!view_fits || accessor.byteOffset > view.byteLength || stride < row || stride > 252 + row)
      return fault(here, "it runs beyond its buffer");
    const std::size_t room = view.byteLength - accessor.byteOffset;
    if (accessor.count == 0 || room < row || (accessor.count - 1) > (room - row) / stride)
      return fault(here, fmt::format("{} rows of it run beyond its buffer", accessor.count));
    return std::pair(data.data() + view.byteOffset + accessor.byteOffset, stride);
  }

  static float component(const unsigned char* cell, int type, float whole) {
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) {
      float value = 0;
      std::memcpy(&value, cell, 4);
      return value;
    }
    int value = cell[0];
    if (type == TINYGLTF_COMPONENT_TYPE_BYTE && value > 127) value -= 256;
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) value = cell[0] | cell[1] << 8;
    if (type == TINYGLTF_COMPONENT_TYPE_SHORT)
      value = static_cast<std::int16_t>(cell[0] | cell[1] << 8);
    return std::max(static_cast<float>(value) / whole, -1.0f);
  }

  Result<void> skins() {
    for (std::size_t s = 0; s < model_.skins.size(); ++s) {
      const tinygltf::Skin& skin = model_.skins[s];
      const std::string place = fmt::format("/skins/{}", s);
      for (const int joint : skin.joints)
        if (joint < 0 || static_cast<std::size_t>(joint) >= out_.nodes.size())
          return fault(place + "/joints", fmt::format("there is no node {}", joint));
      std::vector<float> inverse;
      if (skin.inverseBindMatrices >= 0) {
        auto read = accessor(skin.inverseBindMatrices, TINYGLTF_TYPE_MAT4, place);
        if (!read) return tl::unexpected(read.error());
        inverse = std::move(*read);
        if (inverse.size() < 16 * skin.joints.size())
          return fault(place, "fewer inverse bind matrices than joints");
      }
      for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        GltfNode& node = out_.nodes[static_cast<std::size_t>(skin.joints[j])];
        node.joint = true;
        if (inverse.empty() || node.bound) continue;
        glm::mat4 matrix(1);
        for (std::size_t cell = 0; cell < 16; ++cell)
          matrix[static_cast<int>(cell / 4)][static_cast<int>(cell % 4)] = inverse[16 * j + cell];
        bind(matrix, static_cast<int>(s), node);
      }
    }
    return {};
  }

  // A matrix that flattens space says nothing.
  static void bind(const glm::mat4& inverse, int skin, GltfNode& node) {
    const glm::mat3 axes(inverse);
    const float size = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
    if (!(size > 1e-18f) || !(glm::determinant(axes) > 0.1f * size)) return;
    const glm::mat4 bind = glm::inverse(inverse);
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row)
        if (!(std::abs(bind[column][row]) <= kLargestNumber)) return;
    node.bound = true;
    node.bind = bind;
    node.skin = skin;
  }

  Result<void> animation(const std::string& clip) {
    for (std::size_t i = 0; i < model_.animations.size(); ++i) {
      const std::string name = clean_name(model_.animations[i].name);
      out_.clips.push_back(name.empty() ? fmt::format("animation_{}", i) : name);
    }
    if (out_.clips.empty())
      return fault("/animations", "there is no motion in this file",
                   "give a file with animations (a character alone is no capture)");
    std::size_t chosen = clip.empty() ? 0 : out_.clips.size();
    for (std::size_t i = out_.clips.size(); i-- > 0 && !clip.empty();)
      if (out_.clips[i] == clip) chosen = i;
    for (std::size_t i = out_.clips.size(); i-- > 0 && chosen == out_.clips.size();)
      if (out_.clips[i].substr(out_.clips[i].rfind('|') + 1) == clip) chosen = i;
    if (chosen == out_.clips.size()) return no_clip(clip);
    out_.animation.name = out_.clips[chosen];
    return tracks(model_.animations[chosen], fmt::format("/animations/{}", chosen));
  }

  Result<void> no_clip(const std::string& clip) const {
    std::string known;
    for (const std::string& name : out_.clips) known += (known.empty() ? "" : ", ") + name;
    if (known.size() > 600) known = known.substr(0, 600) + " ...";
    return fault("/animations", fmt::format("no clip is called {}", in_quotes(clip)),
                 "name one of: " + known);
  }

  Result<void> tracks(const tinygltf::Animation& animation, const std::string& place) {
    std::vector<std::array<bool, 3>> taken(out_.nodes.size());
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      const tinygltf::AnimationChannel& channel = animation.channels[c];
      const std::string here = fmt::format("{}/channels/{}", place, c);
      GltfTrack track;
      if (channel.target_path == "translation")
        track.path = GltfPath::translation;
      else if (channel.target_path == "rotation")
        track.path = GltfPath::rotation;
      else if (channel.target_path == "scale")
        track.path = GltfPath::scale;
      else
        continue;  // weights of shapes, and what extensions move
      if (channel.target_node < 0) continue;
      if (static_cast<std::size_t>(channel.target_node) >= out_.nodes.size())
        return fault(here, fmt::format("there is no node {}", channel.target_node));
      if (channel.sampler < 0 ||
          static_cast<std::size_t>(channel.sampler) >= animation.samplers.size())
        return fault(here, fmt::format("there is no sampler {}", channel.sampler));
      track.node = channel.target_node;
      bool& before =
          taken[static_cast<std::size_t>(track.node)][static_cast<std::size_t>(track.path)];
      if (before) return fault(here, "a node's property is animated twice");
      before = true;
      if (auto ok =
              keys(animation.samplers[static_cast<std::size_t>(channel.sampler)], here, track);
          !ok)
        return ok;
      out_.animation.tracks.push_back(std::move(track));
    }
    if (out_.animation.tracks.empty()) return fault(place, "this clip moves no node");
    return {};
  }

  Result<void> keys(const tinygltf::AnimationSampler& sampler, const std::string& here,
                    GltfTrack& track) {
    if (sampler.interpolation == "STEP")
      track.interpolation = GltfInterpolation::step;
    else if (sampler.interpolation == "CUBICSPLINE")
      track.interpolation = GltfInterpolation::cubic;
    else if (sampler.interpolation != "LINEAR")
      return fault(here,
                   fmt::format("no interpolation is called {}", in_quotes(sampler.interpolation)));
    auto times = accessor(sampler.input, TINYGLTF_TYPE_SCALAR, here);
    if (!times) return tl::unexpected(times.error());
    track.times = std::move(*times);
    if (track.times.front() < 0 || !std::is_sorted(track.times.begin(), track.times.end()))
      return fault(here, "the times of its keys do not rise");
    const bool turns = track.path == GltfPath::rotation;
    auto values = accessor(sampler.output, turns ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, here);
    if (!values) return tl::unexpected(values.error());
    const std::size_t width = turns ? 4 : 3;
    const std::size_t rows = values->size() / width;
    const std::size_t a_key = track.interpolation == GltfInterpolation::cubic ? 3 : 1;
    if (rows != a_key * track.times.size())
      return fault(here, fmt::format("{} keys have {} values", track.times.size(), rows));
    for (std::size_t row = 0; row < rows; ++row) {
      glm::vec4 value(0);
      for (std::size_t i = 0; i < width; ++i)
        value[static_cast<int>(i)] = (*values)[row * width + i];
      if (turns && row % a_key == a_key / 2 && glm::length(value) < 1e-6f)
        return fault(here, "a rotation of length zero");
      track.values.push_back(value);
    }
    return {};
  }

  std::string file_;
  CaptureLimits limits_;
  tinygltf::Model model_;
  GltfFile out_;
  std::size_t rows_read_ = 0;
  std::size_t rows_of_skeleton_ = 0;
};

}  // namespace

struct GltfModel::Impl : Reader {
  using Reader::Reader;
};

GltfModel::GltfModel(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GltfModel::GltfModel(GltfModel&&) noexcept = default;
GltfModel& GltfModel::operator=(GltfModel&&) noexcept = default;
GltfModel::~GltfModel() = default;

Result<GltfModel> GltfModel::open(std::string_view bytes, const std::string& file,
                                  const std::filesystem::path& folder,
                                  const CaptureLimits& limits) {
  auto parts = gltf_parts(bytes, file);
  if (!parts) return tl::unexpected(parts.error());
  auto impl = std::make_unique<Impl>(file, limits);
  if (auto ok = impl->open(*parts, folder); !ok) return tl::unexpected(ok.error());
  return GltfModel(std::move(impl));
}

Result<GltfFile> GltfModel::read(const std::string& clip) {
  return impl_->read(clip);
}

Result<GltfFile> read_gltf_skeleton(std::string_view bytes, const std::string& file,
                                    const CaptureLimits& limits) {
  auto parts = gltf_parts(bytes, file);
  if (!parts) return tl::unexpected(parts.error());
  Reader reader(file, limits);
  if (auto ok = reader.open(*parts, {}); !ok) return tl::unexpected(ok.error());
  return std::move(reader).skeleton();
}

}  // namespace ringcraft
