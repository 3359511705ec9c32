#include "capture/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/utf8.h"
#include "capture/gltf_parts.h"
#include "capture/words.h"

namespace ringcraft {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostVertices = std::size_t{1} << 20;
constexpr std::size_t kMostRows = 12 * kMostVertices;  // of all tables: five a vertex, corners
constexpr std::size_t kMostMaterials = 256;
constexpr float kLargestNumber = 1e7f;
constexpr const char* kExportAgain = "export the character again";

class Looks {
 public:
  Looks(const GltfChunks& chunks, const std::string& file) : chunks_(chunks), file_(file) {}

  Result<GltfLooks> read() {
    if (auto ok = parse(); !ok) return tl::unexpected(ok.error());
    if (auto ok = compression(); !ok) return tl::unexpected(ok.error());
    if (auto ok = images(); !ok) return tl::unexpected(ok.error());
    if (auto ok = materials(); !ok) return tl::unexpected(ok.error());
    if (auto ok = surfaces(); !ok) return tl::unexpected(ok.error());
    return std::move(out_);
  }

 private:
  tl::unexpected<Error> fault(std::string place, std::string what,
                              std::string remedy = kExportAgain) const {
    return input_error(file_, std::move(place), std::move(what), std::move(remedy));
  }

  Result<void> parse() {
    auto json = gltf_json(chunks_.json, file_, [](int, const std::string&) { return true; });
    if (!json) return tl::unexpected(json.error());
    json_ = std::move(*json);
    return {};
  }

  Result<void> compression() const {
    for (const Json& name : list("extensionsRequired"))
      if (name.is_string() && name.get_ref<const std::string&>() != "KHR_materials_unlit" &&
          name.get_ref<const std::string&>() != "KHR_texture_transform")
        return fault("/extensionsRequired",
                     fmt::format("needs '{}'", clean_name(name.get_ref<const std::string&>())),
                     "export it without compression");
    return {};
  }

  const Json& list(const char* key) const {
    static const Json kNone = Json::array();
    const auto at = json_.find(key);
    return at == json_.end() || !at->is_array() ? kNone : *at;
  }

  // A whole number of an object that may be missing or something else: then `missing`.
  static std::int64_t whole(const Json& object, const char* key, std::int64_t missing) {
    if (!object.is_object()) return missing;
    const auto at = object.find(key);
    return at == object.end() || !at->is_number_integer() ? missing : at->get<std::int64_t>();
  }
  static float real(const Json& object, const char* key, float missing) {
    if (!object.is_object()) return missing;
    const auto at = object.find(key);
    if (at == object.end() || !at->is_number()) return missing;
    const auto value = at->get<float>();
    return std::abs(value) <= kLargestNumber ? value : missing;
  }
  static const Json& part(const Json& object, const char* key) {
    static const Json kNone;
    if (!object.is_object()) return kNone;
    const auto at = object.find(key);
    return at == object.end() ? kNone : *at;
  }
  static std::string text(const Json& object, const char* key) {
    const Json& value = part(object, key);
    return value.is_string() ? clean_name(value.get<std::string>()) : std::string();
  }

  // The bytes of a buffer view.
  Result<std::string_view> view(std::int64_t number, const std::string& place) const {
    const Json& views = list("bufferViews");
    if (number < 0 || static_cast<std::size_t>(number) >= views.size())
      return fault(place, fmt::format("there is no buffer view {}", number));
    const Json& view = views[static_cast<std::size_t>(number)];
    if (whole(view, "buffer", 0) != 0 ||
        part(list("buffers").empty() ? Json() : list("buffers")[0], "uri").is_string())
      return fault(place, "its data lies outside the file", "export it as one .glb");
    const std::int64_t offset = whole(view, "byteOffset", 0),
                       length = whole(view, "byteLength", -1);
    const auto size = static_cast<std::int64_t>(chunks_.binary.size());
    if (offset < 0 || length < 0 || offset > size || length > size - offset)
      return fault(place, fmt::format("buffer view {} runs beyond its buffer", number));
    return chunks_.binary.substr(static_cast<std::size_t>(offset),
                                 static_cast<std::size_t>(length));
  }

  struct Table {
    std::vector<float> values;  // rows x width
    std::size_t rows = 0;
  };

  static std::size_t width_of(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    if (type == "MAT4") return 16;
    return 0;
  }

  static std::size_t bytes_of(std::int64_t component) {
    switch (component) {
      case 5120:
      case 5121:
        return 1;
      case 5122:
      case 5123:
        return 2;
      case 5125:
      case 5126:
        return 4;
      default:
        return 0;
    }
  }

  // Whole numbers come as they are, normalised ones as shares.
  static float component(const char* cell, std::int64_t kind, bool normalized) {
    const auto byte = [&](int i) {
      return static_cast<unsigned>(static_cast<unsigned char>(cell[i]));
    };
    if (kind == 5126) {
      float value = 0;
      std::memcpy(&value, cell, 4);
      return value;
    }
    if (kind == 5125)
      return static_cast<float>(byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24);
    const bool wide = kind == 5122 || kind == 5123, is_signed = kind == 5120 || kind == 5122;
    int value = static_cast<int>(wide ? byte(0) | byte(1) << 8 : byte(0));
    const int range = wide ? 65536 : 256;
    if (is_signed && value >= range / 2) value -= range;
    if (!normalized) return static_cast<float>(value);
    return std::max(-1.0f, static_cast<float>(value) /
                               static_cast<float>(is_signed ? range / 2 - 1 : range - 1));
  }

  Result<Table> table(std::int64_t number, std::size_t width, const std::string& place) {
    const Json& accessors = list("accessors");
    if (number < 0 || static_cast<std::size_t>(number) >= accessors.size())
      return fault(place, fmt::format("there is no accessor {}", number));
    const Json& accessor = accessors[static_cast<std::size_t>(number)];
    const std::int64_t kind = whole(accessor, "componentType", 0),
                       rows = whole(accessor, "count", -1);
    if (part(accessor, "sparse").is_object()) return fault(place, "sparse accessors are not read");
    if (width_of(text(accessor, "type")) != width || bytes_of(kind) == 0)
      return fault(place, fmt::format("accessor {} is of another type", number));
    if (rows < 1 || static_cast<std::size_t>(rows) > 6 * kMostVertices)
      return fault(place, fmt::format("{} rows cannot be read", rows));
    const std::int64_t in = whole(accessor, "bufferView", -1);
    auto bytes = view(in, place);
    if (!bytes) return tl::unexpected(bytes.error());
    const std::size_t cell = bytes_of(kind), row = cell * width;
    const std::int64_t apart =
        whole(list("bufferViews")[static_cast<std::size_t>(in)], "byteStride", 0);
    const std::int64_t begin = whole(accessor, "byteOffset", 0);
    const std::size_t stride =
        apart > 0 ? static_cast<std::size_t>(std::min<std::int64_t>(apart, 4096)) : row;
    if (begin < 0 || stride < row || static_cast<std::size_t>(begin) > bytes->size() ||
        (static_cast<std::size_t>(rows) - 1) * stride + row >
            bytes->size() - static_cast<std::size_t>(begin))
      return fault(place, fmt::format("{} rows of accessor {} run beyond its view", rows, number));
    if (auto ok = count(static_cast<std::size_t>(rows), place); !ok)
      return tl::unexpected(ok.error());
    const bool normalized = part(accessor, "normalized") == Json(true);
    Table out;
    out.rows = static_cast<std::size_t>(rows);
    out.values.reserve(out.rows * width);
    for (std::size_t r = 0; r < out.rows; ++r)
      for (std::size_t c = 0; c < width; ++c) {
        const float value =
            component(bytes->data() + static_cast<std::size_t>(begin) + r * stride + c * cell, kind,
                      normalized);
        if (!(std::abs(value) <= kLargestNumber) && kind == 5126)
          return fault(place, "a number that cannot be used");
        out.values.push_back(value);
      }
    return out;
  }

  // Many may read one table or skin: a small file could ask for much.
  Result<void> count(std::size_t rows, const std::string& place) {
    rows_ += rows;
    if (rows_ > kMostRows)
      return fault(place, fmt::format("with it {} rows are read, more than {}", rows_, kMostRows),
                   "reduce the character's mesh");
    return {};
  }

  Result<void> images() {
    const Json& given = list("images");
    std::size_t total = 0;
    for (std::size_t i = 0; i < std::min(given.size(), kMostMaterials); ++i) {
      const std::string place = fmt::format("/images/{}", i);
      CharacterImage image;
      image.mime_type = text(given[i], "mimeType");
      if (image.mime_type != "image/png" && image.mime_type != "image/jpeg")
        return fault(place, "its picture does not lie in the file as PNG or JPEG",
                     "export it as one .glb");
      auto bytes = view(whole(given[i], "bufferView", -1), place);
      if (!bytes) return tl::unexpected(bytes.error());
      total += bytes->size();
      if (total > kLargestInput)  // many may name one view
        return fault(place,
                     fmt::format("up to it the pictures have {} bytes, more than 256 MiB", total),
                     "give the character smaller pictures");
      image.bytes = *bytes;
      out_.images.push_back(std::move(image));
    }
    return {};
  }

  Result<void> materials() {
    const Json& given = list("materials");
    if (given.size() > kMostMaterials)
      return fault("/materials", fmt::format("more than {} materials", kMostMaterials));
    for (std::size_t i = 0; i < given.size(); ++i) {
      CharacterMaterial material;
      material.name = text(given[i], "name");
      const Json& surface = part(given[i], "pbrMetallicRoughness");
      const Json& colour = part(surface, "baseColorFactor");
      for (std::size_t c = 0; c < 4 && colour.is_array() && colour.size() == 4; ++c)
        if (colour[c].is_number())
          material.colour.at(c) = std::clamp(colour[c].get<float>(), 0.0f, 1.0f);
      material.metallic = std::clamp(real(surface, "metallicFactor", 1), 0.0f, 1.0f);
      material.roughness = std::clamp(real(surface, "roughnessFactor", 1), 0.0f, 1.0f);
      material.double_sided = part(given[i], "doubleSided") == Json(true);
      const std::string alpha = text(given[i], "alphaMode");
      if (alpha == "MASK" || alpha == "BLEND") material.alpha_mode = alpha;
      material.alpha_cutoff = std::clamp(real(given[i], "alphaCutoff", 0.5f), 0.0f, 1.0f);
      const Json& picture = part(surface, "baseColorTexture");
      if (picture.is_object()) {
        const std::int64_t texture = whole(picture, "index", -1);
        const Json& textures = list("textures");
        const std::int64_t image =
            texture >= 0 && static_cast<std::size_t>(texture) < textures.size()
                ? whole(textures[static_cast<std::size_t>(texture)], "source", -1)
                : -1;
        if (image < 0 || static_cast<std::size_t>(image) >= out_.images.size())
          return fault(fmt::format("/materials/{}", i), "there is no such picture");
        if (whole(picture, "texCoord", 0) == 0)
          material.image = static_cast<std::size_t>(image);
        else
          out_.notes.push_back(
              fmt::format("material {}: a second set of texture coordinates is "
                          "not read, shown without its picture",
                          material.name));
      }
      out_.materials.push_back(std::move(material));
    }
    out_.materials.emplace_back();
    return {};
  }

  Result<void> surfaces() {
    const Json& nodes = list("nodes");
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::int64_t mesh = whole(nodes[n], "mesh", -1);
      if (mesh < 0) continue;
      const std::string name = text(nodes[n], "name");
      if (whole(nodes[n], "skin", -1) < 0) {
        out_.notes.push_back(fmt::format("{} hangs on a bone without a skin: left out", name));
        continue;
      }
      if (static_cast<std::size_t>(mesh) >= list("meshes").size())
        return fault(fmt::format("/nodes/{}", n), fmt::format("there is no mesh {}", mesh));
      const Json& primitives = part(list("meshes")[static_cast<std::size_t>(mesh)], "primitives");
      for (std::size_t p = 0; primitives.is_array() && p < primitives.size(); ++p) {
        const std::string place = fmt::format("/meshes/{}/primitives/{}", mesh, p);
        if (auto ok = surface(nodes[n], primitives[p], place); !ok) return ok;
      }
    }
    if (out_.surfaces.empty())
      return fault("/meshes", "no skinned mesh", "give a character whose mesh has a skin");
    return {};
  }

  Result<void> surface(const Json& node, const Json& primitive, const std::string& place) {
    if (whole(primitive, "mode", 4) != 4) return fault(place, "no triangles");
    const Json& attributes = part(primitive, "attributes");
    GltfSurface out;
    const std::int64_t material = whole(primitive, "material", -1);
    out.piece.material =
        material < 0 ? out_.materials.size() - 1 : static_cast<std::size_t>(material);
    if (out.piece.material >= out_.materials.size())
      return fault(place, fmt::format("there is no material {}", material));
    auto positions = table(whole(attributes, "POSITION", -1), 3, place);
    if (!positions) return tl::unexpected(positions.error());
    vertices_ += positions->rows;
    if (vertices_ > kMostVertices)
      return fault(place, fmt::format("more than {} vertices", kMostVertices),
                   "reduce the character's mesh");
    out.piece.position = vectors(*positions);
    if (auto ok = shape(attributes, primitive, place, out); !ok) return ok;
    if (auto ok = joints(whole(node, "skin", -1), place, out); !ok) return ok;
    if (auto ok = weights(attributes, place, out); !ok) return ok;
    out_.surfaces.push_back(std::move(out));
    return {};
  }

  static std::vector<Vec3> vectors(const Table& table) {
    std::vector<Vec3> out;
    out.reserve(table.rows);
    for (std::size_t i = 0; i < table.rows; ++i)
      out.emplace_back(table.values[3 * i], table.values[3 * i + 1], table.values[3 * i + 2]);
    return out;
  }

  // Normals, texture coordinates and triangles.
  Result<void> shape(const Json& attributes, const Json& primitive, const std::string& place,
                     GltfSurface& out) {
    const std::size_t count = out.piece.position.size();
    if (const std::int64_t uv = whole(attributes, "TEXCOORD_0", -1); uv >= 0) {
      auto read = table(uv, 2, place);
      if (!read) return tl::unexpected(read.error());
      if (read->rows != count) return fault(place, "texture coordinates of another number");
      for (std::size_t i = 0; i < count; ++i)
        out.piece.uv.emplace_back(read->values[2 * i], read->values[2 * i + 1]);
    }
    if (const std::int64_t indices = whole(primitive, "indices", -1); indices >= 0) {
      auto read = table(indices, 1, place);
      if (!read) return tl::unexpected(read.error());
      for (const float index : read->values) {
        if (!(index >= 0 && index < static_cast<float>(count)))
          return fault(place, "a corner that does not exist");
        out.piece.triangles.push_back(static_cast<std::uint32_t>(index));
      }
    } else {
      for (std::uint32_t i = 0; i < count; ++i) out.piece.triangles.push_back(i);
    }
    out.piece.triangles.resize(out.piece.triangles.size() / 3 * 3);
    if (out.piece.triangles.empty()) return fault(place, "no triangles");
    if (const std::int64_t normals = whole(attributes, "NORMAL", -1); normals >= 0) {
      auto read = table(normals, 3, place);
      if (!read) return tl::unexpected(read.error());
      if (read->rows != count) return fault(place, "normals of another number");
      out.piece.normal = vectors(*read);
    } else {
      add_normals(out.piece);
    }
    return {};
  }

  // Mean of the faces around, weighted by their areas.
  static void add_normals(CharacterPiece& piece) {
    piece.normal.assign(piece.position.size(), Vec3{});
    for (std::size_t t = 0; t + 2 < piece.triangles.size(); t += 3) {
      const std::array<std::uint32_t, 3> corner = {piece.triangles[t], piece.triangles[t + 1],
                                                   piece.triangles[t + 2]};
      const Vec3 a = piece.position[corner[0]];
      const Vec3 face = glm::cross(piece.position[corner[1]] - a, piece.position[corner[2]] - a);
      for (const std::uint32_t c : corner) piece.normal[c] += face;
    }
    for (Vec3& normal : piece.normal) normal = normalized_or(normal, kUp);
  }

  Result<void> joints(std::int64_t number, const std::string& place, GltfSurface& out) {
    if (static_cast<std::size_t>(number) >= list("skins").size())
      return fault(place, fmt::format("there is no skin {}", number));
    const Json& skin = list("skins")[static_cast<std::size_t>(number)];
    const Json& given = part(skin, "joints");
    if (auto ok = count(given.size(), place); !ok) return ok;
    for (std::size_t i = 0; given.is_array() && i < given.size(); ++i) {
      const auto node = given[i].is_number_integer() ? given[i].get<std::int64_t>() : -1;
      if (node < 0 || static_cast<std::size_t>(node) >= list("nodes").size())
        return fault(fmt::format("/skins/{}", number), fmt::format("there is no node {}", node));
      out.joints.push_back({static_cast<int>(node), glm::mat4(1)});
    }
    const std::int64_t matrices = whole(skin, "inverseBindMatrices", -1);
    if (matrices < 0) return {};
    auto read = table(matrices, 16, fmt::format("/skins/{}", number));
    if (!read) return tl::unexpected(read.error());
    if (read->rows < out.joints.size())
      return fault(fmt::format("/skins/{}", number), "fewer inverse bind matrices than joints");
    for (std::size_t i = 0; i < out.joints.size(); ++i)
      for (std::size_t cell = 0; cell < 16; ++cell)
        out.joints[i].inverse_bind[static_cast<int>(cell / 4)][static_cast<int>(cell % 4)] =
            read->values[16 * i + cell];
    return {};
  }

  Result<void> weights(const Json& attributes, const std::string& place, GltfSurface& out) {
    auto which = table(whole(attributes, "JOINTS_0", -1), 4, place);
    if (!which) return tl::unexpected(which.error());
    auto shares = table(whole(attributes, "WEIGHTS_0", -1), 4, place);
    if (!shares) return tl::unexpected(shares.error());
    const std::size_t count = out.piece.position.size();
    if (which->rows != count || shares->rows != count)
      return fault(place, "weights of another number");
    for (std::size_t v = 0; v < count; ++v) {
      std::array<std::size_t, 4> joint{};
      std::array<float, 4> share{};
      float sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        share.at(k) = std::max(0.0f, shares->values[4 * v + k]);
        sum += share.at(k);
        if (share.at(k) == 0) continue;
        joint.at(k) = static_cast<std::size_t>(std::max(0.0f, which->values[4 * v + k]));
        if (joint.at(k) >= out.joints.size())
          return fault(place, fmt::format("there is no joint {} in its skin", joint.at(k)));
      }
      if (!(sum > 1e-6f)) return fault(place, fmt::format("vertex {} follows no joint", v));
      for (float& part_of : share) part_of /= sum;
      out.which.push_back(joint);
      out.share.push_back(share);
    }
    return {};
  }

  GltfChunks chunks_;
  std::string file_;
  Json json_;
  GltfLooks out_;
  std::size_t vertices_ = 0;
  std::size_t rows_ = 0;  // of tables and skins
};

}  // namespace

Result<GltfLooks> read_gltf_looks(std::string_view bytes, const std::string& file) {
  const auto chunks = gltf_chunks(bytes, file);
  if (!chunks) return tl::unexpected(chunks.error());
  return Looks(*chunks, file).read();
}

}  // namespace ringcraft
