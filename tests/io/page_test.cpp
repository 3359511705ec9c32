#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "io/outputs.h"

namespace ringcraft {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kTemplate =
    "<script id=\"fight-glb\">@@RINGCRAFT_GLB@@</script>\n"
    "<script id=\"fight-events\">@@RINGCRAFT_EVENTS@@</script>\n"
    "<script id=\"fight-report\">@@RINGCRAFT_REPORT@@</script>\n"
    "<script>code</script>\n";

// A folder of its own that RINGCRAFT_VIEWER names for the length of a test.
class PageTest : public testing::Test {
 protected:
  void SetUp() override { ::setenv("RINGCRAFT_VIEWER", folder_.path().c_str(), 1); }
  void TearDown() override { ::unsetenv("RINGCRAFT_VIEWER"); }
  void put_template(const std::string& text) {
    ASSERT_TRUE(write_file(folder_.path() / "page.html", text));
  }

  TemporaryFolder folder_;
};

// What stands between `<script id="ID">` and the first `</script` after it, as an HTML parser
// reads.
std::string script(const std::string& html, const std::string& id) {
  const std::string open = "<script id=\"" + id + "\">";
  const std::size_t from = html.find(open) + open.size();
  return html.substr(from, html.find("</script", from) - from);
}

TEST_F(PageTest, FillsEachPlace) {
  put_template(kTemplate);
  const auto html = fight_html("glTF", "{\"t\":1}\n", {{"seed", 7}});
  ASSERT_TRUE(html) << to_string(html.error());
  EXPECT_EQ(script(*html, "fight-glb"), "Z2xURg==");
  EXPECT_EQ(script(*html, "fight-events"), "{\"t\":1}\n");
  EXPECT_EQ(script(*html, "fight-report"), "{\"seed\":7}");
  EXPECT_THAT(*html, HasSubstr("<script>code</script>"));
  EXPECT_THAT(*html, Not(HasSubstr("@@RINGCRAFT")));
}

TEST_F(PageTest, EncodesEveryTailOfBase64) {
  put_template(kTemplate);
  const auto encoded = [](const std::string& bytes) {
    return script(fight_html(bytes, "", {}).value(), "fight-glb");
  };
  // The test vectors of RFC 4648 section 10, and the two digits that they lack.
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded(std::string("\xfb\xff\x00", 3)), "+/8A");
}

TEST_F(PageTest, ANameCannotEndTheScript) {
  put_template(kTemplate);
  const nlohmann::json hostile = {{"name", "</script><script>alert(1)</script><!--"}};
  const auto html = fight_html("", hostile.dump() + "\n", hostile);
  ASSERT_TRUE(html);
  for (const char* id : {"fight-events", "fight-report"}) {
    EXPECT_EQ(nlohmann::json::parse(script(*html, id)), hostile) << id;
    EXPECT_THAT(script(*html, id), Not(HasSubstr("<"))) << id;
  }
}

TEST_F(PageTest, AFightThatNamesAPlaceIsNotTakenForIt) {
  put_template(kTemplate);
  const std::string events = "{\"name\":\"@@RINGCRAFT_REPORT@@\"}";
  const auto html = fight_html("", events, {{"name", "@@RINGCRAFT_GLB@@"}});
  ASSERT_TRUE(html);
  EXPECT_EQ(script(*html, "fight-events"), events);
  EXPECT_EQ(script(*html, "fight-report"), "{\"name\":\"@@RINGCRAFT_GLB@@\"}");
}

TEST_F(PageTest, ANameThatIsNoUtf8IsReplaced) {
  put_template(kTemplate);
  const auto html = fight_html("", "", {{"name", "\xff"}});
  ASSERT_TRUE(html);
  EXPECT_EQ(script(*html, "fight-report"), "{\"name\":\"\xef\xbf\xbd\"}");
}

TEST_F(PageTest, AMissingTemplateSaysHowToBuildIt) {
  const auto html = fight_html("", "", {});
  ASSERT_FALSE(html);
  EXPECT_EQ(html.error().kind, ErrorKind::input);
  EXPECT_EQ(html.error().file, (folder_.path() / "page.html").string());
  EXPECT_THAT(html.error().remedy, HasSubstr("npm ci && npm run build"));
}

TEST_F(PageTest, AnotherFileInItsPlaceIsAnError) {
  const std::string good = kTemplate;
  for (const std::string& bad : {std::string("<html></html>"), good + "@@RINGCRAFT_GLB@@",
                                 good.substr(0, good.find("@@RINGCRAFT_REPORT"))}) {
    put_template(bad);
    const auto html = fight_html("", "", {});
    ASSERT_FALSE(html) << bad;
    EXPECT_THAT(html.error().what, HasSubstr("@@RINGCRAFT_")) << bad;
    EXPECT_THAT(html.error().remedy, HasSubstr("npm run build")) << bad;
  }
}

}  // namespace
}  // namespace ringcraft
