#include "base/markup.h"

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

TEST(Markup, NothingInATextOpensAnElementOrAnEntityOrEndsAnAttribute) {
  EXPECT_EQ(escaped("a<b>&amp; \"c\" 'd'"), "a&lt;b&gt;&amp;amp; &quot;c&quot; &#39;d&#39;");
  EXPECT_EQ(escaped("</script><script>"), "&lt;/script&gt;&lt;script&gt;");
}

TEST(Markup, ControlCharactersBecomeSpacesAndOtherBytesStay) {
  EXPECT_EQ(escaped(std::string("a\0b\nc", 5)), "a b c");
  EXPECT_EQ(escaped("Gr\xC3\xBC\xC3\x9F"), "Gr\xC3\xBC\xC3\x9F");
}

}  // namespace
}  // namespace ringcraft
