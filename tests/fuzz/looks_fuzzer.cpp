#include "capture/gltf_mesh.h"
#include "fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace ringcraft;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto looks = read_gltf_looks(bytes, "fuzz.glb");
  if (!looks) {
    fuzzing::require(!looks.error().what.empty() && !looks.error().remedy.empty());
    return 0;
  }
  for (const GltfSurface& surface : looks->surfaces) {
    const std::size_t count = surface.piece.position.size();
    fuzzing::require(surface.which.size() == count && surface.piece.normal.size() == count);
    fuzzing::require(surface.piece.material < looks->materials.size());
    for (const std::uint32_t corner : surface.piece.triangles) fuzzing::require(corner < count);
  }
  return 0;
}
