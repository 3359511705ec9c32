// The one writer of glTF.

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <tiny_gltf.h>

#include "io/events.h"
#include "io/mannequin.h"
#include "io/outputs.h"
#include "io/ring.h"
#include "io/root_motion.h"

namespace ringcraft {

namespace {

constexpr Tick kTicksPerKey = 2;  // 60 Hz

tinygltf::Value value_of(const nlohmann::json& json) {
  if (json.is_boolean()) return tinygltf::Value(json.get<bool>());
  if (json.is_number_integer()) {
    const double number = json.get<double>();
    if (std::abs(number) <= std::numeric_limits<int>::max()) {
      return tinygltf::Value(static_cast<int>(number));
    }
    return tinygltf::Value(number);
  }
  if (json.is_number()) return tinygltf::Value(json.get<double>());
  if (json.is_string()) return tinygltf::Value(json.get<std::string>());
  if (json.is_array()) {
    tinygltf::Value::Array array;
    for (const nlohmann::json& element : json) array.push_back(value_of(element));
    return tinygltf::Value(std::move(array));
  }
  tinygltf::Value::Object object;
  for (const auto& [key, element] : json.items()) object[key] = value_of(element);
  return tinygltf::Value(std::move(object));
}

// Text that is surely UTF-8: a name may come from anywhere.
std::string clean(const std::string& text) {
  const std::string quoted =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(quoted).get<std::string>();
}

struct Format {
  int component = TINYGLTF_COMPONENT_TYPE_FLOAT;
  int type = TINYGLTF_TYPE_VEC3;
  int target = 0;  // of the buffer view; 0 for what is no vertex data
  bool normalized = false;
};
constexpr Format kVertexVec3{TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                             TINYGLTF_TARGET_ARRAY_BUFFER, false};
constexpr Format kVertexVec2{TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2,
                             TINYGLTF_TARGET_ARRAY_BUFFER, false};
constexpr Format kVertexVec4{TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4,
                             TINYGLTF_TARGET_ARRAY_BUFFER, false};
constexpr Format kPicture{TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_SCALAR, 0, false};
constexpr Format kIndices{TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                          TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, false};
constexpr Format kShortIndices{TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR,
                               TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, false};
constexpr Format kShades{TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4,
                         TINYGLTF_TARGET_ARRAY_BUFFER, true};
constexpr Format kJoints{TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4,
                         TINYGLTF_TARGET_ARRAY_BUFFER, false};
constexpr Format kWeights{TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                          TINYGLTF_TARGET_ARRAY_BUFFER, true};
constexpr Format kKeyTimes{TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 0, false};
constexpr Format kKeyVec3{TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 0, false};
constexpr Format kKeyQuat{TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, 0, false};
constexpr Format kMatrices{TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4, 0, false};

class GlbBuilder {
 public:
  GlbBuilder() {
    model_.asset.version = "2.0";
    model_.asset.generator = "ringcraft " RINGCRAFT_VERSION;
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.scenes[0].name = "fight";
    model_.defaultScene = 0;
    model_.animations.emplace_back();
    model_.animations[0].name = "fight";
  }

  // Nodes, mesh, skin and channels of one fighter; `root_motion` moves what can be so to its root.
  void add_fighter(std::size_t number, const FighterLook& look, const FighterTrack& track,
                   bool root_motion);
  // Nodes and channels of one fighter's bones, as a VRM animation.
  void add_vrm_animation(const FighterLook& look, const FighterTrack& track);
  void add_ring(float half);
  // Key times, shared by all fighters: `count` keys at 60 Hz.
  void set_key_count(std::size_t count);
  void set_events(const Timeline& timeline);
  std::string bytes();

 private:
  // Writes `count` elements as one buffer view with one accessor; returns the accessor.
  template <class Element>
  int add_data(const std::vector<Element>& elements, const Format& format, bool bounds = false);
  void set_bounds(tinygltf::Accessor& accessor, const float* numbers, int components) const;
  int add_node(tinygltf::Node node) {
    model_.nodes.push_back(std::move(node));
    return static_cast<int>(model_.nodes.size()) - 1;
  }
  int add_indices(const std::vector<std::uint32_t>& triangles, std::size_t vertices);
  int single_time();
  int add_material(const std::string& name, Vec3 colour, double roughness);
  int add_mesh(const std::string& name, const FighterLook& look);
  int add_character(const std::string& name, const Character& character, const Skeleton& skeleton);
  int add_character_material(const std::string& name, const Character& character,
                             std::size_t number);
  int add_texture(const CharacterImage& image);
  std::array<int, kJointCount> add_skeleton(const Skeleton& skeleton);
  int add_skin(const Skeleton& skeleton, const std::array<int, kJointCount>& nodes);
  void add_channel(int node, const char* path, int input, int output);
  void add_placement(int node, const std::vector<Placement>& roots);
  void add_motion(const std::array<int, kJointCount>& nodes, const FighterTrack& track);

  tinygltf::Model model_;
  std::size_t key_count_ = 1;
  int key_times_ = -1;    // accessor of all key times
  int single_time_ = -1;  // accessor of the one key of a constant track
};

template <class Element>
int GlbBuilder::add_data(const std::vector<Element>& elements, const Format& format, bool bounds) {
  std::vector<unsigned char>& data = model_.buffers[0].data;
  while (data.size() % 4 != 0) data.push_back(0);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = elements.size() * sizeof(Element);
  view.target = format.target;
  const auto* first = reinterpret_cast<const unsigned char*>(elements.data());
  data.insert(data.end(), first, first + view.byteLength);
  model_.bufferViews.push_back(view);

  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
  accessor.componentType = format.component;
  accessor.type = format.type;
  accessor.normalized = format.normalized;
  accessor.count = elements.size();
  if (bounds) {
    set_bounds(accessor, reinterpret_cast<const float*>(elements.data()),
               tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(format.type)));
  }
  model_.accessors.push_back(accessor);
  return static_cast<int>(model_.accessors.size()) - 1;
}

// Two bytes an index where they suffice; 65535 would mean a restart.
int GlbBuilder::add_indices(const std::vector<std::uint32_t>& triangles, std::size_t vertices) {
  if (vertices > 65535) return add_data(triangles, kIndices);
  std::vector<std::uint16_t> narrow;
  narrow.reserve(triangles.size());
  for (const std::uint32_t v : triangles) narrow.push_back(static_cast<std::uint16_t>(v));
  return add_data(narrow, kShortIndices);
}

void GlbBuilder::set_bounds(tinygltf::Accessor& accessor, const float* numbers,
                            int components) const {
  for (int c = 0; c < components; ++c) {
    float low = numbers[c], high = numbers[c];
    for (std::size_t i = 0; i < accessor.count; ++i) {
      const float number = numbers[i * static_cast<std::size_t>(components) + c];
      low = std::min(low, number);
      high = std::max(high, number);
    }
    accessor.minValues.push_back(low);
    accessor.maxValues.push_back(high);
  }
}

int GlbBuilder::add_material(const std::string& name, Vec3 colour, double roughness) {
  tinygltf::Material material;
  material.name = name;
  const Vec3 shown = glm::clamp(colour, Vec3{0}, Vec3{1});
  material.pbrMetallicRoughness.baseColorFactor = {rounded(shown.x, 5), rounded(shown.y, 5),
                                                   rounded(shown.z, 5), 1.0};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = roughness;
  model_.materials.push_back(material);
  return static_cast<int>(model_.materials.size()) - 1;
}

struct Finish {
  Vec3 colour{};
  double roughness = 0.8;
};
Finish finish_of(const FighterLook& look, Region region) {
  switch (region) {
    case Region::skin:
      return {look.skin, 0.62};
    case Region::shorts:
      return {look.shorts, 0.55};
    case Region::gloves:
      return {look.gloves, 0.38};
    case Region::trim:
      return {{0.66f, 0.65f, 0.62f}, 0.75};
    case Region::hair:
      return {0.12f * look.skin * look.skin + Vec3{0.008f}, 0.9};
    case Region::eye_white:
      return {{0.70f, 0.68f, 0.65f}, 0.25};
    case Region::iris:
      return {{0.02f, 0.012f, 0.008f}, 0.15};
  }
  return {};
}

// PNG or JPEG, as it came.
int GlbBuilder::add_texture(const CharacterImage& image) {
  tinygltf::Image out;
  out.bufferView =
      model_
          .accessors[add_data(std::vector<char>(image.bytes.begin(), image.bytes.end()), kPicture)]
          .bufferView;
  model_.accessors.pop_back();  // a picture is a view without an accessor
  out.mimeType = image.mime_type;
  model_.images.push_back(std::move(out));
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model_.images.size()) - 1;
  model_.textures.push_back(std::move(texture));
  return static_cast<int>(model_.textures.size()) - 1;
}

int GlbBuilder::add_character_material(const std::string& name, const Character& character,
                                       std::size_t number) {
  const CharacterMaterial& from = character.materials.at(number);
  tinygltf::Material material;
  material.name = name + "_" + clean(from.name);
  auto& surface = material.pbrMetallicRoughness;
  surface.baseColorFactor.clear();
  for (const float value : from.colour) surface.baseColorFactor.push_back(rounded(value, 5));
  surface.metallicFactor = rounded(from.metallic, 4);
  surface.roughnessFactor = rounded(from.roughness, 4);
  if (from.image) surface.baseColorTexture.index = add_texture(character.images.at(*from.image));
  material.doubleSided = from.double_sided;
  material.alphaMode = from.alpha_mode;
  if (from.alpha_mode == "MASK") material.alphaCutoff = rounded(from.alpha_cutoff, 4);
  model_.materials.push_back(std::move(material));
  return static_cast<int>(model_.materials.size()) - 1;
}

int GlbBuilder::add_character(const std::string& name, const Character& character,
                              const Skeleton& skeleton) {
  tinygltf::Mesh mesh;
  mesh.name = name;
  std::vector<int> materials(character.materials.size(), -1);
  for (const CharacterPiece& piece : conformed(character, skeleton)) {
    std::vector<std::array<std::uint8_t, 4>> joints;
    std::vector<std::array<float, 4>> shares;
    for (const CharacterWeights& weights : piece.weights) {
      std::array<std::uint8_t, 4> joint{};
      for (std::size_t k = 0; k < 4; ++k)
        if (weights.share.at(k) > 0) joint.at(k) = static_cast<std::uint8_t>(weights.joint.at(k));
      joints.push_back(joint);
      shares.push_back(weights.share);
    }
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = add_data(piece.position, kVertexVec3, true);
    primitive.attributes["NORMAL"] = add_data(piece.normal, kVertexVec3);
    if (!piece.uv.empty() && character.materials.at(piece.material).image)
      primitive.attributes["TEXCOORD_0"] = add_data(piece.uv, kVertexVec2);
    primitive.attributes["JOINTS_0"] = add_data(joints, kJoints);
    primitive.attributes["WEIGHTS_0"] = add_data(shares, kVertexVec4);
    primitive.indices = add_indices(piece.triangles, piece.position.size());
    int& material = materials.at(piece.material);
    if (material < 0) material = add_character_material(name, character, piece.material);
    primitive.material = material;
    mesh.primitives.push_back(std::move(primitive));
  }
  model_.meshes.push_back(std::move(mesh));
  return static_cast<int>(model_.meshes.size()) - 1;
}

int GlbBuilder::add_mesh(const std::string& name, const FighterLook& look) {
  if (look.character) return add_character(name, *look.character, look.body.skeleton);
  const auto mannequin = mannequin_of(look.body);
  tinygltf::Mesh mesh;
  mesh.name = name;
  for (const MannequinPiece& piece : mannequin->pieces) {
    std::vector<std::array<std::uint8_t, 4>> joints;
    std::vector<std::array<std::uint16_t, 4>> shares;
    for (const SkinWeights& weights : piece.weights) {
      joints.push_back(weights.joint);
      shares.push_back(weights.share);
    }
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = add_data(piece.position, kVertexVec3, true);
    primitive.attributes["NORMAL"] = add_data(piece.normal, kVertexVec3);
    primitive.attributes["COLOR_0"] = add_data(piece.shade, kShades);
    primitive.attributes["JOINTS_0"] = add_data(joints, kJoints);
    primitive.attributes["WEIGHTS_0"] = add_data(shares, kWeights);
    primitive.indices = add_indices(piece.triangles, piece.position.size());
    const Finish finish = finish_of(look, piece.region);
    primitive.material = add_material(name + "_" + std::string(name_of(piece.region)),
                                      finish.colour, finish.roughness);
    mesh.primitives.push_back(std::move(primitive));
  }
  model_.meshes.push_back(std::move(mesh));
  return static_cast<int>(model_.meshes.size()) - 1;
}

std::array<int, kJointCount> GlbBuilder::add_skeleton(const Skeleton& skeleton) {
  std::array<int, kJointCount> nodes{};
  for (std::size_t i = 0; i < kJointCount; ++i) {
    tinygltf::Node node;
    node.name = std::string(vrm_name(joint_at(i)));
    const Vec3& offset = skeleton.offset[i];
    node.translation = {offset.x, offset.y, offset.z};
    nodes[i] = add_node(std::move(node));
    const auto parent = static_cast<std::size_t>(kParent[i]);
    if (i > 0) model_.nodes[nodes.at(parent)].children.push_back(nodes[i]);  // the hips have none
  }
  return nodes;
}

int GlbBuilder::add_skin(const Skeleton& skeleton, const std::array<int, kJointCount>& nodes) {
  const WorldPose rest = world_pose(skeleton, rest_pose(skeleton));
  std::vector<std::array<float, 16>> matrices;
  for (const Vec3& joint : rest.position) {
    matrices.push_back({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -joint.x, -joint.y, -joint.z, 1});
  }
  tinygltf::Skin skin;
  skin.joints.assign(nodes.begin(), nodes.end());
  skin.inverseBindMatrices = add_data(matrices, kMatrices);
  model_.skins.push_back(std::move(skin));
  return static_cast<int>(model_.skins.size()) - 1;
}

// The capsules that the contact test uses, for overlays.
nlohmann::json capsules_json(const BodyModel& body) {
  nlohmann::json capsules = nlohmann::json::array();
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const PartModel& part = body.parts[i];
    const auto point = [](Vec3 p) {
      return nlohmann::json::array({rounded(p.x, 4), rounded(p.y, 4), rounded(p.z, 4)});
    };
    capsules.push_back({{"part", name_of(part_at(i))},
                        {"joint", vrm_name(joint_of(part_at(i)))},
                        {"a", point(part.capsule_a)},
                        {"b", point(part.capsule_b)},
                        {"radius", rounded(part.radius, 4)}});
  }
  return capsules;
}

// Unit in double precision, so that rounding to float leaves no drift; x, y, z, w.
std::array<float, 4> key_of(Quat rotation) {
  const double x = rotation.x, y = rotation.y, z = rotation.z, w = rotation.w;
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(length > 1e-6)) return {0, 0, 0, 1};
  return {static_cast<float>(x / length), static_cast<float>(y / length),
          static_cast<float>(z / length), static_cast<float>(w / length)};
}

// The track as seen from its moving root.
FighterTrack below(const std::vector<Placement>& roots, FighterTrack track) {
  for (std::size_t i = 0; i < track.frames.size(); ++i)
    track.frames[i] = placed(track.frames[i], inverse(roots[i]));
  return track;
}

void GlbBuilder::add_fighter(std::size_t number, const FighterLook& look, const FighterTrack& track,
                             bool root_motion) {
  const std::string name = "fighter" + std::to_string(number);
  const std::array<int, kJointCount> nodes = add_skeleton(look.body.skeleton);
  const int skin = add_skin(look.body.skeleton, nodes);
  tinygltf::Node root;
  root.name = name;
  root.children = {nodes[0]};
  root.extras = value_of({{"name", clean(look.name)},
                          {"height_m", rounded(look.body.spec.height, 3)},
                          {"mass_kg", rounded(look.body.spec.mass, 2)},
                          {"capsules", capsules_json(look.body)}});
  const int root_node = add_node(std::move(root));
  model_.skins[skin].name = name;
  model_.skins[skin].skeleton = root_node;

  tinygltf::Node mesh;
  mesh.name = name + "_mesh";
  mesh.mesh = add_mesh(name, look);
  mesh.skin = skin;
  const int mesh_node = add_node(std::move(mesh));
  model_.scenes[0].nodes.push_back(root_node);
  model_.scenes[0].nodes.push_back(mesh_node);
  if (!root_motion || track.frames.empty()) {
    add_motion(nodes, track);
    return;
  }
  const std::vector<Placement> roots = ringcraft::root_motion(track);
  add_placement(root_node, roots);
  add_motion(nodes, below(roots, track));
}

// The extension VRMC_vrm_animation 1.0: which node is which bone.
void GlbBuilder::add_vrm_animation(const FighterLook& look, const FighterTrack& track) {
  const std::array<int, kJointCount> nodes = add_skeleton(look.body.skeleton);
  model_.scenes[0].nodes.push_back(nodes[0]);
  nlohmann::json bones;
  for (std::size_t i = 0; i < kJointCount; ++i)
    bones[std::string(vrm_name(joint_at(i)))] = {{"node", nodes.at(i)}};
  model_.extensions["VRMC_vrm_animation"] =
      value_of({{"specVersion", "1.0"}, {"humanoid", {{"humanBones", bones}}}});
  model_.extensionsUsed.emplace_back("VRMC_vrm_animation");
  add_motion(nodes, track);
}

// Keys of a node that stands on the ground.
void GlbBuilder::add_placement(int node, const std::vector<Placement>& roots) {
  std::vector<std::array<float, 3>> places;
  std::vector<std::array<float, 4>> turns;
  Quat last{1, 0, 0, 0};
  for (std::size_t key = 0; key < key_count_; ++key) {
    const Placement& root = roots[std::min(key * kTicksPerKey, roots.size() - 1)];
    places.push_back({root.x, 0, root.z});
    last = in_hemisphere_of(yaw_rotation(root.yaw), last);
    turns.push_back(key_of(last));
  }
  add_channel(node, "translation", key_times_, add_data(places, kKeyVec3));
  add_channel(node, "rotation", key_times_, add_data(turns, kKeyQuat));
}

void GlbBuilder::set_key_count(std::size_t count) {
  key_count_ = std::max<std::size_t>(count, 1);
  std::vector<float> times;
  for (std::size_t i = 0; i < key_count_; ++i) {
    times.push_back(static_cast<float>(static_cast<double>(i) * kTicksPerKey / kTicksPerSecond));
  }
  key_times_ = add_data(times, kKeyTimes, true);
}

// Made when a track first needs it: nothing in the file is unused.
int GlbBuilder::single_time() {
  if (single_time_ < 0) single_time_ = add_data(std::vector<float>{0}, kKeyTimes, true);
  return single_time_;
}

void GlbBuilder::add_channel(int node, const char* path, int input, int output) {
  tinygltf::Animation& animation = model_.animations[0];
  tinygltf::AnimationSampler sampler;
  sampler.input = input;
  sampler.output = output;
  sampler.interpolation = "LINEAR";
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size());
  channel.target_node = node;
  channel.target_path = path;
  animation.samplers.push_back(std::move(sampler));
  animation.channels.push_back(std::move(channel));
}

template <class Key>
bool constant(const std::vector<Key>& keys) {
  return std::all_of(keys.begin(), keys.end(), [&](const Key& key) {
    for (std::size_t c = 0; c < key.size(); ++c) {
      if (std::abs(key[c] - keys[0][c]) > 1e-6f) return false;
    }
    return true;
  });
}

void GlbBuilder::add_motion(const std::array<int, kJointCount>& nodes, const FighterTrack& track) {
  if (track.frames.empty()) return;
  const auto frame_at = [&](std::size_t key) -> const Pose& {
    return track.frames[std::min(key * kTicksPerKey, track.frames.size() - 1)];
  };
  std::vector<std::array<float, 3>> places;
  for (std::size_t key = 0; key < key_count_; ++key) {
    const Vec3 hips = frame_at(key).hips;
    places.push_back({hips.x, hips.y, hips.z});
  }
  const bool still = constant(places);
  if (still) places.resize(1);
  add_channel(nodes[0], "translation", still ? single_time() : key_times_,
              add_data(places, kKeyVec3));
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    std::vector<std::array<float, 4>> keys;
    Quat last{1, 0, 0, 0};
    for (std::size_t key = 0; key < key_count_; ++key) {
      last = in_hemisphere_of(frame_at(key).rotation[joint], last);
      keys.push_back(key_of(last));
    }
    const bool one = constant(keys);
    if (one) keys.resize(1);
    add_channel(nodes[joint], "rotation", one ? single_time() : key_times_,
                add_data(keys, kKeyQuat));
  }
}

void GlbBuilder::add_ring(float half) {
  tinygltf::Mesh mesh;
  mesh.name = "ring";
  for (const RingPart& part : make_ring(half)) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = add_data(part.position, kVertexVec3, true);
    primitive.attributes["NORMAL"] = add_data(part.normal, kVertexVec3);
    primitive.indices = add_indices(part.triangles, part.position.size());
    primitive.material =
        add_material(std::string("ring_") + part.name, part.colour, rounded(part.roughness, 3));
    mesh.primitives.push_back(std::move(primitive));
  }
  model_.meshes.push_back(std::move(mesh));
  tinygltf::Node node;
  node.name = "ring";
  node.mesh = static_cast<int>(model_.meshes.size()) - 1;
  model_.scenes[0].nodes.push_back(add_node(std::move(node)));
}

void GlbBuilder::set_events(const Timeline& timeline) {
  nlohmann::json events = nlohmann::json::array();
  for (const Event& event : timeline.events) {
    nlohmann::json object = event_json(event, false);
    // The writer's JSON must be UTF-8 throughout.
    object["action"] = clean(event.action);
    if (object.contains("part")) object["part"] = clean(event.part);
    events.push_back(std::move(object));
  }
  model_.animations[0].extras =
      value_of({{"ticks_per_second", kTicksPerSecond}, {"events", std::move(events)}});
}

std::string GlbBuilder::bytes() {
  if (model_.animations[0].channels.empty()) model_.animations.clear();  // none may be empty
  std::ostringstream stream(std::ios::binary);
  tinygltf::TinyGLTF writer;
  writer.WriteGltfSceneToStream(&model_, stream, false, true);
  return std::move(stream).str();
}

}  // namespace

std::string fight_glb(const Timeline& timeline, const std::vector<FighterLook>& looks,
                      const GlbSettings& settings) {
  GlbBuilder builder;
  std::size_t frames = 1;
  for (const FighterTrack& track : timeline.tracks) frames = std::max(frames, track.frames.size());
  builder.set_key_count((frames + kTicksPerKey - 1) / kTicksPerKey);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    builder.add_fighter(i, looks[i],
                        i < timeline.tracks.size() ? timeline.tracks[i] : FighterTrack{},
                        settings.root_motion);
  }
  if (settings.ring_half > 0) builder.add_ring(settings.ring_half);
  builder.set_events(timeline);
  return builder.bytes();
}

std::string fighter_vrma(const FighterLook& look, const FighterTrack& track) {
  GlbBuilder builder;
  builder.set_key_count((track.frames.size() + kTicksPerKey - 1) / kTicksPerKey);
  builder.add_vrm_animation(look, track);
  return builder.bytes();
}

}  // namespace ringcraft
