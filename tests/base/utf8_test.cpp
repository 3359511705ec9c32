#include "base/utf8.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ringcraft {
namespace {

TEST(Utf8Test, WhatIsNoUtf8IsTakenForLatin1) {
  EXPECT_TRUE(is_utf8("Box\u00e9"));
  EXPECT_FALSE(is_utf8("Box\xe9"));
  EXPECT_EQ(clean_name("Box\xe9.bvh"), "Box\u00e9.bvh");
  EXPECT_EQ(clean_name("a\nb"), "a?b");
  EXPECT_EQ(clean_name(std::string(300, 'a')).size(), 200u);
  EXPECT_EQ(clean_name(std::string(300, 'a'), std::string::npos).size(), 300u);
}

TEST(Utf8Test, JsonOfAnyTextIsWritten) {
  EXPECT_EQ(json_text(nlohmann::json{{"name", "n\xff"}}), "{\"name\":\"n\ufffd\"}");
  EXPECT_EQ(json_text(nlohmann::ordered_json{{"name", "n\xff"}}), "{\"name\":\"n\ufffd\"}");
}

}  // namespace
}  // namespace ringcraft
