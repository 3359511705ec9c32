#include "io/filmstrip.h"

#include <gmock/gmock.h>

#include "default_library.h"

namespace ringcraft {
namespace {

using testing::HasSubstr;

TEST(Filmstrip, ShowsEveryActionOfTheDefaultLibrary) {
  const std::string svg = filmstrip_svg(default_library());
  for (const Action& action : default_library().actions())
    EXPECT_THAT(svg, HasSubstr(">" + action.name + " ")) << action.name;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace ringcraft
