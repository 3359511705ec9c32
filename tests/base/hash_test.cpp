#include "base/hash.h"

#include <gtest/gtest.h>

#include <set>

namespace ringcraft {
namespace {

// XXH3_64bits of the empty input and of "abc": published values of xxHash 0.8.
TEST(HashTest, IsXxh3WithSeedZero) {
  EXPECT_EQ(hash_name(hash_text("")), "2d06800538d394c2");
  EXPECT_EQ(hash_name(hash_text("abc")), "78af5f94892f3950");
}

TEST(HashTest, NameHasSixteenDigits) {
  EXPECT_EQ(hash_name(0), "0000000000000000");
  EXPECT_EQ(hash_name(0xABCull), "0000000000000abc");
}

TEST(HashTest, EveryFieldAndItsOrderCount) {
  const std::set<std::uint64_t> seen{
      Hasher().add(1).add(2).digest(),    Hasher().add(2).add(1).digest(),
      Hasher().add(1).digest(),           Hasher().digest(),
      Hasher().add(1.0f).add(2).digest(), Hasher().add(std::int64_t{1}).add(2).digest()};
  EXPECT_EQ(seen.size(), 6u);
}

TEST(HashTest, TextsDoNotRunIntoOneAnother) {
  EXPECT_NE(Hasher().add(std::string_view("ab")).add(std::string_view("c")).digest(),
            Hasher().add(std::string_view("a")).add(std::string_view("bc")).digest());
}

TEST(HashTest, SameFieldsSameHash) {
  const auto digest = [] {
    return Hasher().add(3.5f).add(std::string_view("jab")).add(7).digest();
  };
  EXPECT_EQ(digest(), digest());
}

}  // namespace
}  // namespace ringcraft
