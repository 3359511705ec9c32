#include "capture/gltf_parts.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "capture/words.h"
#include "motion/skeleton.h"

namespace ringcraft {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 32;
constexpr std::size_t kLongestJson = std::size_t{16} << 20;  // bytes
constexpr std::size_t kMostNodes = 16384;
constexpr std::size_t kMostClips = 4096;
constexpr const char* kExportAgain = "export the file again";

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// Keys that concern motion, at the top and below.
bool concerns_motion(int depth, const std::string& key) {
  static constexpr std::array<std::string_view, 9> kTop = {
      "asset",       "nodes",   "skins",      "animations",        "accessors",
      "bufferViews", "buffers", "extensions", "extensionsRequired"};
  if (depth == 1) return std::find(kTop.begin(), kTop.end(), key) != kTop.end();
  // Extras, extensions of parts, and what VRM says of looks.
  static constexpr std::array<std::string_view, 8> kDropped = {
      "extras",      "extensions", "materialProperties", "blendShapeMaster",
      "firstPerson", "meta",       "secondaryAnimation", "expressions"};
  return std::find(kDropped.begin(), kDropped.end(), key) == kDropped.end();
}

const Json* member(const Json& value, const char* key) {
  if (!value.is_object()) return nullptr;
  const auto at = value.find(key);
  return at == value.end() ? nullptr : &*at;
}

void add_bone(const Json* name, const Json* node, GltfParts& out) {
  if (name == nullptr || !name->is_string() || node == nullptr || !node->is_number_integer())
    return;
  const auto index = node->get<std::int64_t>();
  if (index < 0 || index > 1 << 24) return;
  if (joint_from_vrm_name(name->get_ref<const std::string&>()))
    out.bones.emplace_back(name->get<std::string>(), static_cast<int>(index));
}

void find_bones(const Json& extensions, GltfParts& out) {
  for (const char* key : {"VRM", "VRMC_vrm", "VRMC_vrm_animation"}) {
    const Json* extension = member(extensions, key);
    const Json* humanoid = extension == nullptr ? nullptr : member(*extension, "humanoid");
    const Json* bones = humanoid == nullptr ? nullptr : member(*humanoid, "humanBones");
    if (bones == nullptr || !out.bones.empty()) continue;
    if (bones->is_array())
      for (const Json& bone : *bones) add_bone(member(bone, "bone"), member(bone, "node"), out);
    if (bones->is_object())
      for (const auto& [name, bone] : bones->items()) {
        const Json text = name;
        add_bone(&text, member(bone, "node"), out);
      }
  }
}

// Buffers may all name one file, or the binary chunk: a small file could ask for much. What one of
// them holds is not other than it says, or it is refused when it is read.
Result<void> few_bytes(const Json& json, const std::string& file) {
  const Json* buffers = member(json, "buffers");
  if (buffers == nullptr || !buffers->is_array()) return {};
  double total = 0;
  for (std::size_t i = 0; i < buffers->size(); ++i) {
    const Json* bytes = member((*buffers)[i], "byteLength");
    if (bytes != nullptr && bytes->is_number()) total += std::max(0.0, bytes->get<double>());
    if (total > static_cast<double>(kLargestInput))
      return input_error(
          file, fmt::format("/buffers/{}", i),
          fmt::format("up to it the buffers have {:.0f} bytes, more than 256 MiB", total),
          "cut the file into shorter ones");
  }
  return {};
}

// tinygltf makes much of each.
Result<void> few_parts(const Json& json, const std::string& file) {
  const auto count = [&](const char* key) {
    const Json* list = member(json, key);
    return list == nullptr ? 0 : list->size();
  };
  if (count("nodes") > kMostNodes)
    return input_error(file, "/nodes", fmt::format("more than {} nodes", kMostNodes), kExportAgain);
  if (count("animations") > kMostClips)
    return input_error(file, "/animations", fmt::format("more than {} clips", kMostClips),
                       "export fewer of them in one file");
  return {};
}

// Takes out what is not kept; false where the rest is nested too deep. `depth`: that of what stands
// in `value`.
bool keep_only(Json& value, int depth, GltfKeyFilter kept) {
  if (!value.is_structured() || value.empty()) return true;
  if (depth > kDeepest) return false;
  if (value.is_array())
    return std::all_of(value.begin(), value.end(),
                       [&](Json& element) { return keep_only(element, depth + 1, kept); });
  for (auto at = value.begin(); at != value.end();) {
    if (!kept(depth, at.key())) {
      at = value.erase(at);
      continue;
    }
    if (!keep_only(*at, depth + 1, kept)) return false;
    ++at;
  }
  return true;
}

}  // namespace

Result<GltfChunks> gltf_chunks(std::string_view bytes, const std::string& file) {
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  if (!bytes.starts_with("glTF")) return GltfChunks{bytes, {}};
  if (bytes.size() < 20 || little_endian(bytes, 4) != 2)
    return input_error(file, "bytes 0-20", "no header of a binary glTF 2.0 file", kExportAgain);
  GltfChunks chunks;
  std::size_t at = 12;
  while (bytes.size() - at >= 8) {
    const std::size_t length = little_endian(bytes, at);
    const std::uint32_t kind = little_endian(bytes, at + 4);
    if (length > bytes.size() - at - 8)
      return input_error(file, fmt::format("byte {}", at),
                         fmt::format("a chunk of {} bytes runs beyond the file's end", length),
                         "the file is cut off: fetch it again");
    const std::string_view chunk = bytes.substr(at + 8, length);
    if (at == 12 && kind != kJson)
      return input_error(file, "byte 16", "the first chunk is not JSON", kExportAgain);
    if (at == 12)
      chunks.json = chunk;
    else if (kind == kBinary && chunks.binary.empty())
      chunks.binary = chunk;
    at += 8 + length;
  }
  return chunks;
}

Result<Json> gltf_json(std::string_view text, const std::string& file, GltfKeyFilter kept) {
  if (text.size() > kLongestJson)
    return input_error(file, "", fmt::format("{} bytes of JSON are more than is read", text.size()),
                       "give a smaller file");
  try {
    // Not with the parser's own filter: that looks through an array again at each of its objects.
    Json json = Json::parse(text);
    if (!keep_only(json, 1, kept))
      return input_error(file, "", fmt::format("JSON nested deeper than {}", kDeepest),
                         kExportAgain);
    if (!json.is_object())
      return input_error(file, "", "no glTF file: its JSON is no object", "give a glTF 2.0 file");
    return json;
  } catch (const Json::parse_error& fault) {
    const std::size_t at = std::min(fault.byte, text.size() + 1) - 1;
    const std::string place = fmt::format("byte {} of its JSON", at);
    if (at == text.size())
      return input_error(file, place, "it ends there",
                         "the file is empty or cut off: fetch it again");
    return input_error(file, place, "what stands there is no JSON", kExportAgain);
  } catch (const Json::exception&) {
    return input_error(file, "", "its JSON has a number that cannot be used", kExportAgain);
  }
}

Result<GltfParts> gltf_parts(std::string_view bytes, const std::string& file) {
  auto chunks = gltf_chunks(bytes, file);
  if (!chunks) return tl::unexpected(chunks.error());
  auto json = gltf_json(chunks->json, file, concerns_motion);
  if (!json) return tl::unexpected(json.error());
  GltfParts parts;
  parts.binary = chunks->binary;
  if (auto ok = few_bytes(*json, file); !ok) return tl::unexpected(ok.error());
  if (auto ok = few_parts(*json, file); !ok) return tl::unexpected(ok.error());
  if (const Json* required = member(*json, "extensionsRequired"); required != nullptr)
    for (const Json& name : *required)
      if (name.is_string() &&
          name.get_ref<const std::string&>().find("meshopt") != std::string::npos)
        return input_error(file, "/extensionsRequired", "its buffers are compressed (meshopt)",
                           "export it without compression");
  if (const Json* extensions = member(*json, "extensions"); extensions != nullptr)
    find_bones(*extensions, parts);
  json->erase("extensions");
  json->erase("extensionsRequired");
  parts.json = json->dump(-1, ' ', true, Json::error_handler_t::replace);
  return parts;
}

}  // namespace ringcraft
