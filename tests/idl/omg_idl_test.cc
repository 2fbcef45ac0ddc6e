// Goal:   collision.idl is legal OMG IDL, so that compilers other than Cyclone's take it: those of
//         omniORB's kind refuse what idlc lets pass, such as a field `topic` of a type `Topic`.
// Method: omniidl (Debian's, of omniORB) reads the file without its annotations: it knows none.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace collision {
namespace {

/// What omniidl says of this text; empty: it is legal.
std::string ComplaintsAbout(const std::string& idl) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("omg_idl_test." + std::to_string(getpid()) + ".idl");
  std::ofstream(path) << idl;
  const std::string command = "omniidl -bdump " + path.string() + " 2>&1 >/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string said;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) said += buffer;
  const int status = pclose(pipe);
  std::filesystem::remove(path);
  return said.empty() && status != 0 ? "omniidl ended with " + std::to_string(status) : said;
}

std::string WithoutAnnotations(const std::string& idl) {
  return std::regex_replace(idl, std::regex("@(key|final)\\b"), "");
}

TEST(OmgIdl, OmniidlAcceptsEveryLine) {
  std::ifstream file(COLLISION_IDL_FILE);
  const std::string idl((std::istreambuf_iterator<char>(file)), {});
  ASSERT_NE(idl.find("@key"), std::string::npos);
  EXPECT_EQ(ComplaintsAbout(WithoutAnnotations(idl)), "")
      << "or omniidl is missing: docker/packages.txt";
}

// Were omniidl silent about everything, the test above would say nothing.
TEST(OmgIdl, OmniidlRefusesNamesThatDifferInCaseOnly) {
  EXPECT_NE(ComplaintsAbout("enum Topic { ONE }; struct Refusal { Topic topic; };"), "");
  EXPECT_NE(ComplaintsAbout("struct Sample { long sequence; };"), "");
}

}  // namespace
}  // namespace collision
