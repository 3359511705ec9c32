#include "scene/library_check_seams.h"

#include <gtest/gtest.h>

#include "fight/synthetic_library.h"

namespace ringcraft {
namespace {

TEST(Seams, EveryEdgeIsMeasuredOnceAndPlaybackKeepsItsVelocity) {
  const MotionLibrary library = synthetic::library();
  const std::vector<SeamMeasures> seams = measure_seams(library);
  std::size_t edges = 0;
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    if (library.actions()[i].ends_lying == Lying::none)
      edges += library.machine().edges(ActionId(i)).size();
  }
  EXPECT_GT(edges, 0u);
  EXPECT_EQ(seams.size(), edges);
  for (const SeamMeasures& seam : seams) {
    EXPECT_LT(seam.jump, 1.5) << library.action(seam.from).name << " to "
                              << library.action(seam.to).name;
  }
}

}  // namespace
}  // namespace ringcraft
