// Writes the first inputs of the fuzzers: ringcraft_fuzz_seeds FOLDER
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/file.h"
#include "capture/small_files.h"

namespace {

bool write(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  return file.good();
}

// One of what the project itself reads for each schema, marked with the schema's number.
bool write_documents(const std::filesystem::path& folder) {
  const std::array<const char*, 6> files = {
      "scenes/duel.toml",        "styles/balanced.toml",         "bodies/middleweight.toml",
      "kickboxing/library.toml", "kickboxing/sheets/steps.toml", "profiles/vrm.toml"};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto text = ringcraft::read_file(ringcraft::assets_folder() / files[i]);
    if (!text) {
      std::fprintf(stderr, "%s\n", to_string(text.error()).c_str());
      return false;
    }
    const std::string start = text->substr(0, 4096);
    if (!write(folder / std::to_string(i), static_cast<char>(i) + start)) return false;
  }
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  using namespace ringcraft::testing;
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  GltfDraft skinned = small_gltf();
  std::vector<float> matrices(32);
  for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) matrices[i] = 1;
  skinned.json["skins"] = {
      {{"joints", {0, 1}}, {"inverseBindMatrices", skinned.add(matrices, "MAT4", 16)}}};
  GltfDraft shown = skinned;
  shown.json["nodes"][2]["mesh"] = 0;
  shown.json["nodes"][2]["skin"] = 0;
  shown.json["materials"] = {{{"name", "cloth"}, {"alphaMode", "MASK"}}};
  shown.json["meshes"] = {
      {{"primitives",
        {{{"attributes",
           {{"POSITION", shown.add({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3)},
            {"JOINTS_0", shown.add({0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4)},
            {"WEIGHTS_0", shown.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4)}}},
          {"material", 0}}}}}};
  const bool written = write(folder / "bvh/small.bvh", small_bvh()) &&
                       write(folder / "acclaim/small", small_asf() + '\0' + small_amc()) &&
                       write(folder / "gltf/small.glb", small_gltf().glb()) &&
                       write(folder / "gltf/skinned.glb", skinned.glb()) &&
                       write(folder / "looks/skinned.glb", shown.glb()) &&
                       write_documents(folder / "document");
  return written ? 0 : 1;
}
