#include "base/json_object.h"

#include <gtest/gtest.h>

#include <chrono>

namespace ringcraft {
namespace {

std::string nested(std::size_t levels) {
  return "{\"a\":" + std::string(levels - 1, '[') + "7" + std::string(levels - 1, ']') + "}";
}

TEST(JsonObject, OnlyObjectsThatAreNotDeepAreRead) {
  std::string why;
  const auto read = json_object(R"({"a": [1, {"b": "c"}]})", why);
  ASSERT_TRUE(read) << why;
  EXPECT_EQ(read->dump(), R"({"a":[1,{"b":"c"}]})");
  ASSERT_TRUE(json_object(nested(kDeepestJson), why)) << why;
  for (const char* text : {"", "{", "[]", "7", "{} x", "\xff", "{\"a\":\"\xff\"}"}) {
    EXPECT_FALSE(json_object(text, why)) << text;
    EXPECT_EQ(why, "not a JSON object") << text;
  }
  for (const std::size_t levels : {std::size_t{kDeepestJson} + 1, std::size_t{400'000}}) {
    EXPECT_FALSE(json_object(nested(levels), why)) << levels;
    EXPECT_EQ(why, "JSON nested deeper than 32");
  }
  EXPECT_FALSE(json_object(std::string(400'000, '['), why));  // cut off as well
}

TEST(JsonObject, ManyObjectsInOneListTakeNoTime) {
  std::string text = R"({"a": [{})";
  for (int i = 0; i < 300000; ++i) text += ",{}";
  text += "]}";
  const auto begin = std::chrono::steady_clock::now();
  std::string why;
  EXPECT_TRUE(json_object(text, why)) << why;
  // The parser's own filter took a minute.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

}  // namespace
}  // namespace ringcraft
