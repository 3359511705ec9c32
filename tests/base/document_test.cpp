#include "base/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/file.h"
#include "base/random.h"
#include "base/schema.h"
#include "base/temporary_folder.h"

namespace ringcraft {
namespace {

using ::testing::HasSubstr;

constexpr const char* kSchema = R"({
  "type": "object", "additionalProperties": false, "required": ["name"],
  "properties": {
    "name": {"type": "string", "minLength": 1, "maxLength": 400},
    "horizon_s": {"type": "number", "exclusiveMinimum": 0, "maximum": 5,
                  "description": "planning horizon in seconds"},
    "rounds": {"type": "integer", "minimum": 1},
    "live": {"type": "boolean"},
    "stance": {"type": "string", "enum": ["orthodox", "southpaw"]},
    "colour": {"type": ["string", "array"], "pattern": "^#[0-9a-f]{6}$",
               "items": {"type": "number"}, "minItems": 3, "maxItems": 3},
    "liked": {"type": "object", "additionalProperties": {"type": "number"}},
    "named": {"type": "object", "propertyNames": {"type": "string", "pattern": "^[a-z]+$"}},
    "fighter": {"type": "array", "minItems": 2, "maxItems": 9,
                "items": {"$ref": "#/definitions/fighter"}}
  },
  "definitions": {
    "fighter": {"type": "object", "additionalProperties": false, "required": ["style"],
                "properties": {"style": {"type": "string"}, "health": {"type": "number"}}}
  }
})";

// Documents are read against the schema above, not against the published ones.
class DocumentTest : public ::testing::Test {
 protected:
  DocumentTest() {
    std::filesystem::create_directories(folder_.path() / "schemas");
    EXPECT_TRUE(write_file(folder_.path() / "schemas" / "sample.schema.json", kSchema));
    ::setenv("RINGCRAFT_ASSETS", folder_.path().c_str(), 1);
  }
  ~DocumentTest() override { ::unsetenv("RINGCRAFT_ASSETS"); }

  static Result<Document> parsed(const std::string& text) {
    return parse_document(text, "sample.toml", "sample");
  }

  TemporaryFolder folder_;
};

TEST_F(DocumentTest, KeepsEveryValueWithItsTypeAndLine) {
  const auto document = parsed(
      "name = \"duel\"\nhorizon_s = 2\nrounds = 3\nlive = true\nliked = {jab = 1.5}\n"
      "colour = [0.1, 0.2, 0.3]\n\n[[fighter]]\nstyle = \"a\"\n\n[[fighter]]\nstyle = "
      "\"b\"\nhealth = 9.5\n");
  ASSERT_TRUE(document) << to_string(document.error());
  EXPECT_EQ(document->value["name"], "duel");
  EXPECT_EQ(document->value["horizon_s"].get<double>(), 2.0);
  EXPECT_TRUE(document->value["rounds"].is_number_integer());
  EXPECT_EQ(document->value["live"], true);
  EXPECT_EQ(document->value["liked"]["jab"], 1.5);
  EXPECT_EQ(document->value["colour"][2], 0.3);
  EXPECT_EQ(document->value["fighter"][1]["health"], 9.5);
  EXPECT_EQ(document->place("/name"), "line 1");
  EXPECT_EQ(document->place("/liked/jab"), "line 5");
  EXPECT_EQ(document->place("/fighter/0"), "line 8");
  EXPECT_EQ(document->place("/fighter/1/style"), "line 12");
  EXPECT_EQ(document->place("/fighter/1/health"), "line 13");
  EXPECT_EQ(document->place("/fighter/2"), "");
}

struct BadInput {
  const char* name;
  std::string text;
  const char* place;
  const char* what;
  const char* remedy;
};

void PrintTo(const BadInput& input, std::ostream* out) {
  *out << input.name;
}

class BadInputTest : public DocumentTest, public ::testing::WithParamInterface<BadInput> {};

TEST_P(BadInputTest, GivesOneLineWithPlaceAndRemedy) {
  const auto document = parsed(GetParam().text);
  ASSERT_FALSE(document);
  const Error& error = document.error();
  EXPECT_EQ(error.kind, ErrorKind::usage);
  EXPECT_EQ(error.file, "sample.toml");
  EXPECT_EQ(error.place, GetParam().place) << to_string(error);
  EXPECT_THAT(error.what, HasSubstr(GetParam().what));
  EXPECT_THAT(error.remedy, HasSubstr(GetParam().remedy));
  EXPECT_EQ(to_string(error).find('\n'), std::string::npos);
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

INSTANTIATE_TEST_SUITE_P(
    Documents, BadInputTest,
    ::testing::Values(
        BadInput{"UnknownKey", "name = \"a\"\nhorizont_s = 2\n", "line 2",
                 "unknown key 'horizont_s'", "did you mean 'horizon_s'?"},
        BadInput{"UnknownKeyUnlikeAny", "name = \"a\"\nzzzzzzzz = 2\n", "line 2",
                 "unknown key 'zzzzzzzz'", "known here: colour, fighter"},
        BadInput{"UnknownKeyInAList",
                 "name = \"a\"\n[[fighter]]\nstyle = \"a\"\n[[fighter]]\nstile = \"b\"\n", "line 5",
                 "unknown key 'stile'", "did you mean 'style'?"},
        BadInput{"UnknownTable", "name = \"a\"\n[figther]\nx = 1\n", "line 2",
                 "unknown key 'figther'", "did you mean 'fighter'?"},
        BadInput{"WrongType", "name = \"a\"\nhorizon_s = \"two\"\n", "line 2",
                 "'horizon_s' is a string", "a number above 0 and at most 5 (planning horizon"},
        BadInput{"FractionForInteger", "name = \"a\"\nrounds = 1.5\n", "line 2",
                 "'rounds' is a number", "an integer at least 1"},
        BadInput{"BelowRange", "horizon_s = -1\nname = \"a\"\n", "line 1",
                 "'horizon_s' is -1, out of range", "above 0 and at most 5"},
        BadInput{"AtExclusiveLimit", "name = \"a\"\nhorizon_s = 0.0\n", "line 2", "out of range",
                 "above 0"},
        BadInput{"AboveRange", "name = \"a\"\nhorizon_s = 5.01\n", "line 2", "out of range", "5"},
        BadInput{"NotAChoice", "name = \"a\"\nstance = \"sothpaw\"\n", "line 2",
                 "did you mean \"southpaw\"?", "one of \"orthodox\", \"southpaw\""},
        BadInput{"Missing", "rounds = 1\n", "line 1", "key 'name' is missing", "write a string"},
        BadInput{"MissingInAList",
                 "name = \"a\"\n[[fighter]]\nstyle = \"a\"\n[[fighter]]\nhealth = 1\n", "line 4",
                 "key 'style' is missing in 'fighter.1'", "add it"},
        BadInput{"TooFew", "name = \"a\"\n[[fighter]]\nstyle = \"a\"\n", "line 2",
                 "'fighter' has 1 entry, at least 2", "add entries"},
        BadInput{"TooMany", "name = \"a\"\ncolour = [1, 2, 3, 4]\n", "line 2",
                 "'colour' has 4 entries, at most 3", "remove entries"},
        BadInput{"TooManyFaulty", "name = \"a\"\n" + repeated("[[fighter]]\nstile = 1\n", 10),
                 "line 2", "'fighter' has 10 entries, at most 9", "remove entries"},
        BadInput{"WrongElement", "name = \"a\"\ncolour = [1,\n2,\n\"x\"]\n", "line 4",
                 "'colour.2' is a string", "write a number"},
        BadInput{"WrongPattern", "name = \"a\"\ncolour = \"red\"\n", "line 2",
                 "'colour' is \"red\"", "#[0-9a-f]"},
        BadInput{"TooLong", "name = \"a\"\ncolour = \"" + repeated("#", 600) + "\"\n", "line 2",
                 "'colour' is 600 bytes long", "shorten it"},
        BadInput{"TooLongAName", "name = \"" + repeated("\u00e4", 401) + "\"\n", "line 1",
                 "'name' has 401 characters, at most 400", "shorten it"},
        BadInput{"EmptyName", "name = \"\"\n", "line 1", "'name' is \"\"",
                 "write a string that is not empty"},
        BadInput{"WrongMapValue", "name = \"a\"\n[liked]\n\"1/2 ~\" = true\n", "line 3",
                 "'liked.1/2 ~' is a boolean", "write a number"},
        BadInput{"WrongMapKey", "name = \"a\"\n[named]\nfar = 1\nNear = 2\n", "line 4",
                 "a key of 'named' is \"Near\"", "write a string that matches ^[a-z]+$"},
        BadInput{"Syntax", "name = \"a\"\nrounds = = 1\n", "line 2, column 10", "not valid TOML",
                 "correct the syntax"},
        BadInput{"Json", "\n {\"name\": \"a\"}\n", "line 2, column 2", "JSON, and no TOML",
                 "name a TOML file"},
        BadInput{"OpenString", "name = \"a\n", "line 1, column 10", "not valid TOML", ""},
        BadInput{"KeyTwice", "name = \"a\"\nname = \"b\"\n", "line 2, column 8", "not valid TOML",
                 ""},
        BadInput{"ThreeBrackets", "name = \"a\"\n\n[[[fighter]]]\nx = 1\n", "line 3",
                 "not valid TOML", "correct the syntax"},
        BadInput{"BracketsAndNoName", "[[=\n", "line 1", "not valid TOML", ""},
        BadInput{"BareUmlaut", "name = \"\u00e4\" # \u00e4\n\u00e4 = 1\n", "line 2",
                 "a character beyond ASCII", "quotes"},
        BadInput{"BareHangul", "name = '''\n\u00e4'''''\n\n \ud7ff = 1\n", "line 4",
                 "a character beyond ASCII", "quotes"},
        BadInput{"NotFinite", "name = \"a\"\nhorizon_s = nan\n", "line 2, column 13", "not finite",
                 "finite"},
        BadInput{"Infinite", "name = \"a\"\ncolour = [1, 2, -inf]\n", "line 2, column 17",
                 "not finite", "finite"},
        BadInput{"Date", "name = 2024-01-01\n", "line 1, column 8", "dates", "quotes"},
        BadInput{"NotUtf8", "name = \"\xff\"\n", "line 1, column 8", "not valid TOML", ""},
        BadInput{"DeepArray", "name = " + repeated("[", 40) + repeated("]", 40) + "\n",
                 "line 1, column 40", "nested too deeply", "32"},
        BadInput{"VeryDeepArray", "name = " + repeated("[", 100'000), "line 1, column 264",
                 "not valid TOML", ""},
        BadInput{"DeepKey", repeated("a.", 1'000'000) + "b = 1\n", "line 1", "dotted key",
                 "within 32 levels"},
        BadInput{"DeepQuotedKey", repeated("\"=,\".", 100'000) + "b = 1\n", "line 1", "dotted key",
                 "32"},
        BadInput{"TooLarge", "name = \"" + repeated("0123456789abcdef", 300'000) + "\"\n", "",
                 "larger than 4 MiB", "split"}),
    [](const auto& test) { return test.param.name; });

TEST_F(DocumentTest, CharactersBeyondAsciiMayStandInTextAndComments) {
  const auto document = parsed(
      "\xef\xbb\xbf# \u00e4\nname = \"\"\"\u00e4\"\"\"\"\" # \ud7ff\n\"liked\" = {'\u00fc\"' = "
      "1}\n");
  ASSERT_TRUE(document) << to_string(document.error());
  EXPECT_EQ(document->value["name"], "\u00e4\"\"");
}

TEST_F(DocumentTest, DotsInTextAndNumbersAreNotDeepKeys) {
  const auto document = parsed("name = \"\"\"" + repeated("a.", 100) + "\"\"\"  # " +
                               repeated("b.", 100) + "\ncolour = [0.1, 0.2, 0.3]\n");
  EXPECT_TRUE(document) << to_string(document.error());
}

TEST_F(DocumentTest, AMissingFileIsAnInputError) {
  const auto document = read_document(folder_.path() / "none.toml", "sample");
  ASSERT_FALSE(document);
  EXPECT_EQ(document.error().kind, ErrorKind::input);
  EXPECT_THAT(document.error().file, HasSubstr("none.toml"));
}

TEST_F(DocumentTest, AMissingOrFaultySchemaIsAnError) {
  const auto none = parse_document("", "sample.toml", "../schemas/sample");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::usage);
  EXPECT_THAT(none.error().remedy, HasSubstr("known schemas: sample"));
  ASSERT_TRUE(write_file(folder_.path() / "schemas" / "broken.schema.json", "{"));
  EXPECT_FALSE(parse_document("", "sample.toml", "broken"));
  ASSERT_TRUE(write_file(
      folder_.path() / "schemas" / "loop.schema.json",
      R"({"$ref": "#/definitions/a", "definitions": {"a": {"$ref": "#/definitions/a"}}})"));
  EXPECT_FALSE(parse_document("", "sample.toml", "loop"));
}

// The walk does not know `multipleOf`; valijson, which has the last word, does.
TEST_F(DocumentTest, ASchemaWordThatTheWalkDoesNotKnowIsStillChecked) {
  ASSERT_TRUE(write_file(folder_.path() / "schemas" / "even.schema.json",
                         R"({"properties": {"n": {"type": "integer", "multipleOf": 2}}})"));
  EXPECT_TRUE(parse_document("n = 4\n", "even.toml", "even"));
  const auto odd = parse_document("n = 3\n", "even.toml", "even");
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().kind, ErrorKind::usage);
  EXPECT_THAT(to_string(odd.error()), HasSubstr("n"));
}

// A seeded storm of damaged inputs: whatever comes, the answer is a document or one line.
TEST_F(DocumentTest, DamagedInputGivesADocumentOrOneLine) {
  const std::string whole =
      "name = \"duel\"\nhorizon_s = 2.5e0\nrounds = 0x3\nlive = true\nliked = {jab = 1.5}\n"
      "colour = [0.1, 0.2, 0.3]\n[[fighter]]\nstyle = 'a'\n[[fighter]]\nstyle = \"\"\"b\"\"\"\n";
  const std::string pieces = "=[]{}.,\"'#\\\n\r\t 019-+_eEinfa\xff\xc3\x80";
  Random random(1);
  int refused = 0;
  for (int round = 0; round < 5000; ++round) {
    std::string text = whole;
    for (int change = random.below(4); change >= 0; --change) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
      const auto length = static_cast<std::size_t>(random.below(8));
      switch (random.below(3)) {
        case 0:
          text[at] =
              pieces[static_cast<std::size_t>(random.below(static_cast<int>(pieces.size())))];
          break;
        case 1:
          text.erase(at, length + 1);
          break;
        default:
          text.insert(at, text.substr(text.size() - at, length));
          break;
      }
      if (text.empty()) text = "=";
    }
    const auto document = parsed(text);
    if (document) continue;
    ++refused;
    EXPECT_EQ(document.error().kind, ErrorKind::usage);
    EXPECT_EQ(to_string(document.error()).find('\n'), std::string::npos);
  }
  EXPECT_GT(refused, 2500);
}

class SetValueTest : public DocumentTest {
 protected:
  SetValueTest()
      : document_(
            parsed("name = \"duel\"\n[[fighter]]\nstyle = \"a\"\n[[fighter]]\nstyle = \"b\"\n")
                .value()) {}
  Document document_;
};

TEST_F(SetValueTest, ReadsValuesAsTomlAndBareWordsAsText) {
  for (const char* assignment :
       {"horizon_s=2.5", "rounds=3", "live=false", "name=my duel", "fighter.0.style=fast",
        "fighter.1.style=\"quoted = 1\"", "liked.jab=2", "colour=[1, 0.5, 0]"}) {
    const auto set = set_value(document_, assignment);
    EXPECT_TRUE(set) << to_string(set.error());
  }
  EXPECT_EQ(document_.value["horizon_s"], 2.5);
  EXPECT_EQ(document_.value["rounds"], 3);
  EXPECT_EQ(document_.value["live"], false);
  EXPECT_EQ(document_.value["name"], "my duel");
  EXPECT_EQ(document_.value["fighter"][0]["style"], "fast");
  EXPECT_EQ(document_.value["fighter"][1]["style"], "quoted = 1");
  EXPECT_EQ(document_.value["liked"]["jab"], 2);
  EXPECT_EQ(document_.value["colour"].size(), 3u);
  EXPECT_TRUE(checked(document_, "sample"));
}

TEST_F(SetValueTest, AWordThatEndsLikeANumberThatIsNotFiniteIsAWord) {
  for (const std::string name : {"Ronan", "Finan", "spinf"}) {
    const auto set = set_value(document_, "name=" + name);
    EXPECT_TRUE(set) << to_string(set.error());
    EXPECT_EQ(document_.value["name"], name);
  }
}

TEST_F(SetValueTest, AppendsTheNextEntryOfAList) {
  ASSERT_TRUE(set_value(document_, "fighter.2.style=c"));
  EXPECT_EQ(document_.value["fighter"].size(), 3u);
  EXPECT_TRUE(checked(document_, "sample"));
}

TEST_F(SetValueTest, AFaultInASetValueNamesSet) {
  ASSERT_TRUE(set_value(document_, "horizon_s=-1"));
  const auto faulty = checked(document_, "sample");
  ASSERT_FALSE(faulty);
  EXPECT_EQ(faulty.error().place, "--set");
  EXPECT_THAT(faulty.error().what, HasSubstr("'horizon_s' is -1"));
}

TEST_F(SetValueTest, RefusesWhatIsNoAssignmentAndLeavesTheDocumentAlone) {
  const Document before = document_;
  for (const std::string assignment : {"",
                                       "=",
                                       "=1",
                                       "horizon_s",
                                       "horizon_s=",
                                       "horizon_s=nan",
                                       "horizon_s=-inf",
                                       "horizon_s=\"open",
                                       "horizon_s=[1",
                                       "horizon_s=1\nrounds=2",
                                       "fighter.5.style=a",
                                       "fighter.x.style=a",
                                       "fighter.-1.style=a",
                                       "fighter.99999999999.style=a",
                                       "name.first=a",
                                       "rounds=99999999999999999999",
                                       "rounds=010",
                                       "horizon_s=.5",
                                       "horizon_s=1e999",
                                       "name=\xff",
                                       "fighter..style=a",
                                       ".name=a",
                                       "name.=a"}) {
    const auto set = set_value(document_, assignment);
    ASSERT_FALSE(set) << assignment;
    EXPECT_EQ(set.error().kind, ErrorKind::usage);
    EXPECT_THAT(to_string(set.error()), HasSubstr("--set"));
    EXPECT_EQ(document_.value, before.value) << assignment;
    EXPECT_EQ(document_.lines, before.lines) << assignment;
  }
  EXPECT_FALSE(set_value(document_, repeated("a.", 1000) + "b=1"));
}

TEST(NearestWordTest, TakesTheWordThatWasMeantAndNoOther) {
  const std::vector<std::string> known{"horizon_s", "duration_s", "seed", "ring_m"};
  EXPECT_EQ(nearest_word("horizont_s", known), "horizon_s");
  EXPECT_EQ(nearest_word("sede", known), "seed");
  EXPECT_EQ(nearest_word("ring", known), "ring_m");
  EXPECT_EQ(nearest_word("colour", known), "");
  EXPECT_EQ(nearest_word("x", known), "");
  EXPECT_EQ(nearest_word(std::string(100'000, 'a'), known), "");
}

TEST(JsonPointerTest, EscapesAsRfc6901) {
  EXPECT_EQ(json_pointer("/a", "b/c~d"), "/a/b~1c~0d");
  EXPECT_EQ(json_pointer("", ""), "/");
}

TEST_F(DocumentTest, WithoutSchemasTheErrorNamesTheAssets) {
  std::filesystem::remove_all(folder_.path() / "schemas");
  const auto text = schema_text("sample");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().kind, ErrorKind::input);
  EXPECT_THAT(text.error().remedy, HasSubstr("RINGCRAFT_ASSETS"));
}

// Every schema that is published can be read, refuses unknown keys and is known to valijson.
TEST(PublishedSchemasTest, RefuseUnknownKeys) {
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "schemas")) {
    std::string name = entry.path().filename().string();
    name = name.substr(0, name.find(".schema.json"));
    const auto document = parse_document("no_such_key = 1\n", "x.toml", name);
    ASSERT_FALSE(document) << name;
    EXPECT_EQ(document.error().what, "unknown key 'no_such_key'") << name;
    ++seen;
  }
  EXPECT_GE(seen, 1);
}

}  // namespace
}  // namespace ringcraft
