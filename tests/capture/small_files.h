#pragma once
// Captures of a few joints, written by hand, in each format that is read.

#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ringcraft::testing {

inline std::string small_bvh() {
  return "HIERARCHY\nROOT Hips\n{\n OFFSET 0 1 0\n CHANNELS 6 Xposition Yposition Zposition "
         "Zrotation Xrotation Yrotation\n JOINT Arm\n {\n  OFFSET 2 0 0\n  CHANNELS 3 Zrotation "
         "Xrotation Yrotation\n  End Site\n  {\n   OFFSET 3 0 0\n  }\n }\n}\nMOTION\nFrames: "
         "3\nFrame Time: 0.008333\n0 1 0 0 0 0 0 0 0\n0 1 0.5 10 0 0 0 20 0\n0 1 1 20 0 0 0 40 "
         "0\n";
}

// Three bones: root, an upper arm along x whose own frame is turned by 90 degrees about z, a
// forearm.
inline std::string small_asf() {
  return "# a comment\n:version 1.10\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n:root\n"
         "   order TX TY TZ RX RY RZ\n   axis XYZ\n   position 0 0 0\n   orientation 0 0 0\n"
         ":bonedata\n  begin\n    id 1\n    name upper\n    direction 1 0 0\n    length 9\n"
         "    axis 0 0 90 XYZ\n    dof rx rz\n    limits (-10 10)\n           (-10 10)\n  end\n"
         "  begin\n    id 2\n    name fore\n    direction 1 0 0\n    length 4.5\n"
         "    axis 0 0 0 XYZ\n    dof rz\n  end\n:hierarchy\n  begin\n    root upper\n"
         "    upper fore\n  end\n";
}

inline std::string small_amc() {
  return "#!OML:ASF somewhere\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot 0 18 0 0 0 0\nupper 0 0\nfore "
         "0\n2\nroot 0 18 9 0 0 0\nupper 90 0\nfore 90\n";
}

// Collects numbers into buffer 0 with one accessor each.
struct GltfDraft {
  nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                         {"accessors", nlohmann::json::array()},
                         {"bufferViews", nlohmann::json::array()}};
  std::string binary;

  int add(const std::vector<float>& values, const char* type, int width) {
    const std::size_t bytes = values.size() * 4;
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes}});
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", 5126},
                                 {"count", values.size() / static_cast<std::size_t>(width)},
                                 {"type", type}});
    binary.append(reinterpret_cast<const char*>(values.data()), bytes);
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  void add_clip(const std::string& name) {
    json["animations"].push_back({{"name", name},
                                  {"channels", nlohmann::json::array()},
                                  {"samplers", nlohmann::json::array()}});
  }
  // A track of the last clip.
  void add_track(int node, const std::string& path, const std::string& interpolation,
                 const std::vector<float>& times, const std::vector<float>& values) {
    nlohmann::json& clip = json["animations"].back();
    const bool turns = path == "rotation";
    clip["samplers"].push_back({{"input", add(times, "SCALAR", 1)},
                                {"output", add(values, turns ? "VEC4" : "VEC3", turns ? 4 : 3)},
                                {"interpolation", interpolation}});
    clip["channels"].push_back(
        {{"sampler", clip["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }
  std::string glb() {
    json["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    const auto put = [&](std::size_t value) {
      for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
    };
    put(2), put(28 + text.size() + binary.size());
    put(text.size()), put(0x4E4F534A);
    bytes += text;
    put(binary.size()), put(0x004E4942);
    return bytes + binary;
  }
};

inline constexpr float kHalf = 0.70710678f;  // sine and cosine of 45 degrees

// root (0 1 0), below it arm (1 0 0), below it hand (2 0 0). One second: the arm turns by 90
// degrees about z, the root steps aside at half time.
inline GltfDraft small_gltf() {
  GltfDraft draft;
  draft.json["nodes"] = {
      {{"name", "root"}, {"translation", {0, 1, 0}}, {"children", {1}}},
      {{"name", "arm"}, {"translation", {1, 0, 0}}, {"children", {2}}},
      {{"name", "hand"}, {"translation", {2, 0, 0}}},
  };
  draft.add_clip("Rig|Wave");
  draft.add_track(1, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, kHalf, kHalf});
  draft.add_track(0, "translation", "STEP", {0, 0.5f, 1}, {0, 1, 0, 0, 1, 3, 0, 1, 3});
  return draft;
}

}  // namespace ringcraft::testing
