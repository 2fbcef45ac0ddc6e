// Goal:   the container image is built from what is there, and the compose files start what the
//         image holds, without an engine at hand to try it.
// Method: read docker/Dockerfile, .dockerignore, compose.yaml and compose.lan.yaml against the
//         files they speak of.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

const std::filesystem::path kRoot = COLLISION_SOURCE_DIR;
constexpr const char* kDockerfile = "docker/Dockerfile";
constexpr const char* kCompose = "docker/compose.yaml";
constexpr const char* kComposeLan = "docker/compose.lan.yaml";

/// What the first group of `pattern` matches, everywhere in `text`.
std::vector<std::string> All(const std::string& text, const std::string& pattern) {
  const std::regex compiled(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), compiled), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

std::vector<std::string> Words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool Contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// What .dockerignore lets through, of the project's root.
std::vector<std::string> Context() {
  return All(ReadFile(".dockerignore"), "(?:^|\n)!([^/\n]+)/?(?=\n|$)");
}

/// The lines of each service of a compose file; the keys "x-..." are what services share.
std::map<std::string, std::string> ComposeBlocks(const char* file) {
  std::map<std::string, std::string> blocks;
  std::istringstream lines(ReadFile(file));
  std::string section, block;
  const std::regex key("( *)([a-z-]+):.*");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, key) && match[1].length() <= 2) {
      if (match[1].length() == 0) section = block = match[2];
      if (match[1].length() == 2 && section == "services") block = match[2];
    }
    blocks[block] += line + "\n";
  }
  return blocks;
}

// The package list has one rule, and two readers of it.
TEST(Image, InstallsByTheRuleOfRun) {
  const std::string rule = "awk -v command=\\S+ '([^']+)'[\\s\\\\]+\"?\\S*docker/packages.txt";
  const auto of_run = All(ReadFile("run"), rule);
  const auto of_image = All(ReadFile(kDockerfile), rule);
  ASSERT_EQ(of_run.size(), 1u);
  EXPECT_EQ(of_image, of_run);
}

TEST(Image, CopiesWhatIsThereAndNotIgnored) {
  const auto context = Context();
  const auto copies = All(ReadFile(kDockerfile), "\nCOPY ([^\n]+)");
  ASSERT_GT(copies.size(), 4u);
  for (const std::string& copy : copies) {
    auto words = Words(copy);
    if (words.front().rfind("--from=", 0) == 0) continue;
    words.pop_back();  // the target
    for (const std::string& source : words) {
      EXPECT_TRUE(std::filesystem::exists(kRoot / source)) << source;
      const std::string room = source.substr(0, source.find('/'));
      EXPECT_TRUE(source == "." || Contains(context, room)) << source << " is ignored";
    }
  }
}

TEST(Image, IsBuiltFromAllThatBuildingTakes) {
  const auto context = Context();
  for (const std::string& name : context)
    EXPECT_TRUE(std::filesystem::exists(kRoot / name)) << name;
  const auto rooms = All(ReadFile("CMakeLists.txt"), "\n *add_subdirectory\\((\\w+)\\)");
  ASSERT_TRUE(Contains(rooms, "server"));
  for (const std::string& room : rooms) EXPECT_EQ(Contains(context, room), room != "tests") << room;
  EXPECT_NE(ReadFile(kDockerfile).find("-DCOLLISION_TESTS=OFF"), std::string::npos);
  EXPECT_NE(ReadFile("CMakeLists.txt").find("if(COLLISION_TESTS)"), std::string::npos);
}

TEST(Image, HasTheVersionOfTheProject) {
  const auto version = All(ReadFile("CMakeLists.txt"), "project\\(collisiond VERSION (\\S+)");
  ASSERT_EQ(version.size(), 1u);
  EXPECT_EQ(All(ReadFile(kDockerfile), "image\\.version=\"([^\"]+)\""), version);
}

TEST(Image, RunsAsANumberedUserThatIsNotRoot) {
  const auto users = All(ReadFile(kDockerfile), "\nUSER ([^\n]+)");
  ASSERT_FALSE(users.empty());
  EXPECT_TRUE(std::regex_match(users.back(), std::regex("[1-9][0-9]{3,}:[1-9][0-9]{3,}")))
      << users.back();
}

TEST(Image, NamesOnlyConfigurationThatIsThere) {
  const std::string text = ReadFile(kDockerfile) + ReadFile(kCompose) + ReadFile(kComposeLan);
  const auto files = All(text, "/usr/share/collisiond/([A-Za-z0-9_./-]+)");
  ASSERT_GT(files.size(), 2u);
  for (const std::string& file : files) {
    EXPECT_TRUE(std::filesystem::exists(kRoot / "config" / file)) << file;
  }
}

// Containers do not share a loopback interface, so its profile would find no other process, without
// an error.
TEST(Image, HasAProfileForSeveralHosts) {
  const auto profile =
      All(ReadFile(kDockerfile), "CYCLONEDDS_URI=file:///usr/share/collisiond/(\\S+)");
  ASSERT_EQ(profile.size(), 1u);
  const std::string text = ReadFile("config/" + profile[0]);
  EXPECT_NE(text.find("<AllowMulticast>true<"), std::string::npos);
}

TEST(Compose, StartsProgramsOfTheImage) {
  std::string rules;
  for (const char* room : {"server", "client/programs/tools", "client/programs/simulators"}) {
    rules += ReadFile(std::string(room) + "/CMakeLists.txt");
  }
  const auto programs = All(rules, "(?:client_program|add_executable)\\(([a-z-]+) ");
  const auto started = All(ReadFile(kCompose) + ReadFile(kComposeLan), "entrypoint: \\[([a-z-]+)");
  ASSERT_GE(started.size(), 5u);
  for (const std::string& program : started) EXPECT_TRUE(Contains(programs, program)) << program;
}

TEST(Compose, GivesNoServiceMorePrivilegeThanAnother) {
  const auto blocks = ComposeBlocks(kCompose);
  const std::string& shared = blocks.at("x-service");
  for (const char* line : {"read_only: true", "cap_drop: [ALL]", "no-new-privileges:true",
                           "mem_limit:", "pids_limit:", "networks: [world]"}) {
    EXPECT_NE(shared.find(line), std::string::npos) << line;
  }
  EXPECT_NE(blocks.at("x-simulator").find("<<: *service"), std::string::npos);
  EXPECT_NE(blocks.at("x-simulator").find("condition: service_healthy"), std::string::npos);
  for (const char* service : {"collisiond", "spaceship", "drones", "pilot", "monitor"}) {
    const std::string& block = blocks.at(service);
    EXPECT_TRUE(std::regex_search(block, std::regex("<<: \\*(service|simulator)"))) << service;
    for (const char* more :
         {"privileged", "cap_add", "read_only", "user:", "network_mode", "ports"}) {
      EXPECT_EQ(block.find(more), std::string::npos) << service << ": " << more;
    }
  }
}

// All containers look for the service where it is.
TEST(Compose, AllServicesShareOneWorldAndDomain) {
  const auto blocks = ComposeBlocks(kCompose);
  for (const char* service : {"collisiond", "spaceship", "drones", "pilot", "monitor"}) {
    for (const char* variable : {"${COLLISION_WORLD:-default}", "${COLLISION_DOMAIN:-0}"}) {
      EXPECT_NE(blocks.at(service).find(variable), std::string::npos)
          << service << ": " << variable;
    }
  }
}

TEST(ComposeLan, RunsInTheNetworkOfItsHostWithoutPrivileges) {
  const auto blocks = ComposeBlocks(kComposeLan);
  for (const char* line : {"network_mode: host", "read_only: true", "cap_drop: [ALL]",
                           "no-new-privileges:true", "pids_limit:"}) {
    EXPECT_NE(blocks.at("x-program").find(line), std::string::npos) << line;
  }
  for (const char* variable : {"${COLLISION_WORLD:-default}", "${COLLISION_DOMAIN:-0}",
                               "/usr/share/collisiond/cyclonedds-lan.xml}"}) {
    EXPECT_NE(blocks.at("x-world").find(variable), std::string::npos) << variable;
  }
  for (const char* service : {"collisiond", "monitor"}) {
    const std::string& block = blocks.at(service);
    for (const char* line : {"<<: *program", "<<: *world", "COLLISION_CREDENTIALS: ${", ":/host:ro",
                             "mem_limit:", "restart:"}) {
      EXPECT_NE(block.find(line), std::string::npos) << service << ": " << line;
    }
    for (const char* more : {"privileged", "cap_add", "read_only", "user:", "network_mode"}) {
      EXPECT_EQ(block.find(more), std::string::npos) << service << ": " << more;
    }
  }
}

// A new volume takes the owner of the image's folder, which is the user that writes to it.
TEST(ComposeLan, KeepsStateInAFolderOfTheImagesUser) {
  const std::string dockerfile = ReadFile(kDockerfile);
  const auto mounts = All(ReadFile(kComposeLan), "\n *- state:(\\S+)");
  const auto folders =
      All(ReadFile(kComposeLan), "\n *STATE_DIRECTORY: (\\S+)/\\$\\{COLLISION_WORLD");
  ASSERT_EQ(mounts.size(), 1u);
  EXPECT_EQ(folders, mounts);
  const auto users = All(dockerfile, "\nUSER (\\d+):");
  ASSERT_EQ(users.size(), 1u);
  EXPECT_EQ(All(dockerfile, "install -d -o " + users[0] + " \\S.* (\\S+)\n"), mounts);
  const auto settings = All(ReadFile(kComposeLan), "COLLISION_CONFIG:-([^}]+)");
  EXPECT_EQ(settings, All(dockerfile, "COLLISION_CONFIG=(\\S+)"));
}

}  // namespace
}  // namespace collision::source
