#include "base/error.h"

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

TEST(ErrorTest, IsOneLineWithFilePlaceFaultAndRemedy) {
  const Error error{ErrorKind::input, "a.bvh", "line 12", "a number is missing", "export it again"};
  EXPECT_EQ(to_string(error), "a.bvh: line 12: a number is missing; export it again");
}

TEST(ErrorTest, LeavesOutWhatIsEmpty) {
  EXPECT_EQ(to_string({ErrorKind::input, "", "", "no memory", ""}), "no memory");
  EXPECT_EQ(to_string({ErrorKind::input, "a.bvh", "", "is empty", ""}), "a.bvh: is empty");
}

TEST(ErrorTest, StaysOneLineWhateverTheInputHolds) {
  const std::string line = to_string({ErrorKind::input, "a\nb", "line\r1", "x\ny", "z\n"});
  EXPECT_EQ(line.find_first_of("\n\r"), std::string::npos);
}

TEST(ErrorTest, CommandsNoTerminalWhateverTheInputHolds) {
  const Error error{ErrorKind::input, "\x1b[2Ja.toml", "line\t1", "unknown key '\x1b[31mevil\x7f'",
                    "\xc2\x9b"
                    "31m Gr\xc3\xbc\xc3\x9f"
                    "e"};
  EXPECT_EQ(to_string(error),
            "?[2Ja.toml: line 1: unknown key '?[31mevil?'; ?31m Gr\xc3\xbc\xc3\x9f"
            "e");
  // No UTF-8: taken for Latin-1, whose 9b is a control character.
  EXPECT_EQ(to_string({ErrorKind::input,
                       "Gr\xfc\xdf"
                       "e\x9b",
                       "", "", ""}),
            "Gr\xc3\xbc\xc3\x9f"
            "e?");
}

TEST(ErrorTest, KindsAreTheExitCodes) {
  const Result<int> usage = usage_error("", "", "x", "y");
  const Result<int> input = input_error("", "", "x", "y");
  EXPECT_EQ(static_cast<int>(usage.error().kind), 2);
  EXPECT_EQ(static_cast<int>(input.error().kind), 3);
  EXPECT_EQ(static_cast<int>(ErrorKind::simulation), 4);
}

}  // namespace
}  // namespace ringcraft
