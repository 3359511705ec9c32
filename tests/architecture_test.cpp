// The house rules that a compiler does not check: includes go down only, and third-party types stay
// in the files that are theirs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace ringcraft {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// What a layer may include, besides itself (ARCHITECTURE.md).
const std::map<std::string, std::vector<std::string>> kBelow{
    {"base", {}},
    {"motion", {"base"}},
    {"capture", {"base", "motion"}},
    {"fight", {"base", "motion"}},
    {"physics", {"base", "motion", "fight"}},
    {"planner", {"base", "motion", "fight", "physics"}},
    {"io", {"base", "motion", "fight", "physics"}},
    {"scene", {"base", "motion", "fight", "physics", "planner", "io"}},
    {"cli", {"base", "motion", "capture", "fight", "physics", "planner", "io", "scene"}},
};

// Where a library's headers may be included.
struct Home {
  const char* library;
  const char* headers;  // regular expression on what stands between the brackets or quotes
  const char* files;    // regular expression on the path under src
  std::size_t most;     // files that may do so
};
const std::vector<Home> kHomes{
    {"Bullet", "(bullet/)?(bt[A-Z]|LinearMath|Bullet(Dynamics|Collision)).*", "physics/[^/]+\\.cpp",
     99},
    {"tinygltf", "tiny_?gltf.*", "(io|capture)/[^/]+\\.cpp", 2},
    {"GLM", "glm/.*", "base/vec\\.h", 1},
    {"toml++", "toml(\\+\\+/|plusplus).*", "base/[^/]+\\.cpp", 1},
    {"valijson", "valijson/.*", "base/[^/]+\\.cpp", 1},
    {"CLI11", "CLI/.*", "cli/([^/]+\\.cpp|ranges\\.h)", 9},
    {"Boost.Beast", "boost/(asio|beast)[/.].*", "cli/[^/]+\\.cpp", 1},
};

struct Include {
  std::string file;  // under src: "motion/pose.h"
  int line = 0;
  std::string header;
};

// The includes of one file.
std::vector<Include> includes_of(const std::string& file, std::istream& text) {
  static const std::regex directive(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<Include> includes;
  std::string line;
  std::smatch match;
  for (int number = 1; std::getline(text, line); ++number) {
    if (std::regex_search(line, match, directive)) includes.push_back({file, number, match[1]});
  }
  return includes;
}

std::vector<std::string> faults(const std::vector<Include>& includes) {
  std::vector<std::string> found;
  std::map<std::string, std::vector<std::string>> users;
  for (const Include& include : includes) {
    const std::string where = include.file + ":" + std::to_string(include.line) + ": ";
    const std::string from = include.file.substr(0, include.file.find('/'));
    const std::string to = include.header.substr(0, include.header.find('/'));
    if (!kBelow.contains(from)) found.push_back(where + "'" + from + "' is no layer");
    if (kBelow.contains(from) && kBelow.contains(to) && to != from) {
      const auto& below = kBelow.at(from);
      if (std::find(below.begin(), below.end(), to) == below.end()) {
        found.push_back(where + from + " must not include " + include.header);
      }
    }
    if (include.header.starts_with("..") || include.header.starts_with("src/")) {
      found.push_back(where + "include from the layer's name on: " + include.header);
    }
    for (const Home& home : kHomes) {
      if (!std::regex_match(include.header, std::regex(home.headers))) continue;
      auto& files = users[home.library];
      if (files.empty() || files.back() != include.file) files.push_back(include.file);
      if (!std::regex_match(include.file, std::regex(home.files))) {
        found.push_back(where + home.library + " is not at home here: " + include.header);
      }
    }
  }
  for (const Home& home : kHomes) {
    if (users[home.library].size() <= home.most) continue;
    found.push_back(std::string(home.library) + " is included in more than " +
                    std::to_string(home.most) +
                    " files: " + ::testing::PrintToString(users[home.library]));
  }
  return found;
}

std::vector<std::string> faults_of(const std::string& file, const std::string& text) {
  std::istringstream stream(text);
  return faults(includes_of(file, stream));
}

TEST(ArchitectureTest, SourcesKeepTheLayersAndTheHomesOfLibraries) {
  const fs::path root = fs::path(RINGCRAFT_SOURCE_DIR) / "src";
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const auto ending = entry.path().extension();
    if (ending == ".h" || ending == ".cpp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Include> includes;
  for (const fs::path& file : files) {
    std::ifstream text(file);
    for (Include& include : includes_of(fs::relative(file, root).generic_string(), text)) {
      includes.push_back(std::move(include));
    }
  }
  EXPECT_GT(includes.size(), 100u);  // the tree was really read
  EXPECT_THAT(faults(includes), IsEmpty());
}

TEST(ArchitectureTest, AnIncludeThatRunsUpIsFound) {
  const auto found = faults_of("motion/pose.h", "#pragma once\n#include \"planner/plan.h\"\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "motion/pose.h:2: motion must not include planner/plan.h");
}

TEST(ArchitectureTest, AnIncludeThatRunsAcrossIsFound) {
  EXPECT_EQ(faults_of("fight/state.cpp", "#include \"capture/bvh.h\"\n").size(), 1u);
  EXPECT_EQ(faults_of("io/report.cpp", "  #  include <planner/plan.h>\n").size(), 1u);
  EXPECT_EQ(faults_of("scene/fight.cpp", "#include \"capture/bvh.h\"\n").size(), 1u);
  EXPECT_EQ(faults_of("base/file.cpp", "#include \"../motion/pose.h\"\n").size(), 1u);
}

TEST(ArchitectureTest, EveryPairOfLayersIsAllowedInOneDirectionAtMost) {
  for (const auto& [from, unused] : kBelow) {
    for (const auto& [to, also_unused] : kBelow) {
      if (from == to) continue;
      const bool down = faults_of(from + "/a.h", "#include \"" + to + "/b.h\"\n").empty();
      const bool back = faults_of(to + "/a.h", "#include \"" + from + "/b.h\"\n").empty();
      EXPECT_FALSE(down && back) << from << " and " << to;
    }
  }
}

TEST(ArchitectureTest, ALibraryAwayFromHomeIsFound) {
  EXPECT_EQ(faults_of("physics/impact.h", "#include <btBulletDynamicsCommon.h>\n").size(), 1u);
  EXPECT_EQ(faults_of("scene/fight.cpp", "#include <bullet/btBulletDynamicsCommon.h>\n").size(),
            1u);
  EXPECT_EQ(faults_of("planner/plan.cpp", "#include <LinearMath/btVector3.h>\n").size(), 1u);
  EXPECT_EQ(faults_of("scene/fight.cpp", "#include <tiny_gltf.h>\n").size(), 1u);
  EXPECT_EQ(faults_of("motion/pose.h", "#include <glm/glm.hpp>\n").size(), 1u);
  EXPECT_EQ(faults_of("base/document.h", "#include <toml++/toml.h>\n").size(), 1u);
  EXPECT_EQ(faults_of("scene/scene_file.cpp", "#include <CLI/CLI.hpp>\n").size(), 1u);
  EXPECT_THAT(faults_of("physics/impact.cpp", "#include <btBulletDynamicsCommon.h>\n"), IsEmpty());
  EXPECT_THAT(faults_of("base/vec.h", "#include <glm/glm.hpp>\n"), IsEmpty());
}

TEST(ArchitectureTest, ALibraryWithTooManyHomesIsFound) {
  std::vector<Include> includes;
  for (const char* file : {"io/glb.cpp", "io/glb.cpp", "io/more.cpp", "capture/gltf.cpp"}) {
    includes.push_back({file, 1, "tiny_gltf.h"});
  }
  const auto found = faults(includes);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0], HasSubstr("tinygltf is included in more than 2 files"));
}

TEST(ArchitectureTest, AFolderThatIsNoLayerIsFound) {
  EXPECT_EQ(faults_of("helpers/x.h", "#include <vector>\n").size(), 1u);
}

TEST(ArchitectureTest, WhatIsAllowedIsNotAFault) {
  EXPECT_THAT(faults_of("scene/fight.cpp",
                        "#include \"scene/fight.h\"\n#include <vector>\n#include \"base/vec.h\"\n"
                        "#include \"io/outputs.h\"\n// #include \"cli/x.h\"\n"),
              IsEmpty());
}

}  // namespace
}  // namespace ringcraft
