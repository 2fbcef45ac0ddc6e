// Goal:   programs on another vendor's DDS, written from the IDL alone, take part like ours.
// Method: the example is configured and built as its README says; its simulator flies two balls
//         that overlap from 4.75 s to 5.25 s, its monitor must hear the same contacts as ours.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

constexpr int kDomain = 95;
constexpr std::int64_t kBegin = 4'750'000'000;  // [ns]
constexpr std::int64_t kEnd = 5'250'000'000;
constexpr std::int64_t kOpen = std::numeric_limits<std::int64_t>::max();

const std::string kExample = std::string(COLLISION_SOURCE_DIR) + "/client/examples/fast_dds";
const std::vector<std::string> kProfile = {"FASTRTPS_DEFAULT_PROFILES_FILE=" + kExample +
                                           "/loopback.xml"};

/// A revision of a contact, in the words of either monitor.
struct Contact {
  std::string pair;
  int number = 0;
  int revision = 0;
  std::string status;
  std::int64_t begin_earliest = 0, begin_latest = 0, end_earliest = 0, end_latest = 0;

  auto operator<=>(const Contact&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Contact& contact) {
  return out << contact.pair << " #" << contact.number << " r" << contact.revision << " "
             << contact.status << " [" << contact.begin_earliest << ", " << contact.begin_latest
             << "] [" << contact.end_earliest << ", " << contact.end_latest << "]";
}

/// "4.750000000" or "open" of the example, "4750000000" or null of ours.
std::int64_t Instant(std::string text) {
  if (text == "open" || text == "null") return kOpen;
  std::erase_if(text, [](char c) { return c == '.' || c == '"'; });
  return std::stoll(text);
}

/// The contacts among the lines of `output` that fit `pattern`, whose captures are the parts of a
/// Contact, sorted.
std::vector<Contact> ContactsIn(const std::string& output, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<Contact> contacts;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::smatch part;
    if (!std::regex_search(line, part, regex)) continue;
    contacts.push_back({part[1].str() + " × " + part[2].str(), std::stoi(part[3]),
                        std::stoi(part[4]), part[5], Instant(part[6]), Instant(part[7]),
                        Instant(part[8]), Instant(part[9])});
  }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

/// The lines about a simulator's agents.
std::string LinesAbout(const std::string& simulator, const std::string& output) {
  std::string about;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (Contains(line, simulator)) about += line + "\n";
  }
  return about;
}

/// What the example's simulator or monitor printed.
std::vector<Contact> ContactsOfExample(const std::string& output) {
  const std::string bracket = R"(\[(\S+), (\S+)\])";
  return ContactsIn(output, R"(/(\S+) × \S+/(\S+)  #(\d+) r(\d+)  (confirmed|undecided|ended)  )"
                            "begin " +
                                bracket + "  end " + bracket);
}

/// What collisionctl events --json printed, whose fields have an order of their own.
std::vector<Contact> ContactsOfJson(const std::string& output) {
  static const std::regex fields(
      R"re(.*"status":"(\w+)","lower":\{"name":"(\w+)".*"higher":\{"name":"(\w+)".*)re"
      R"re("contact":(\d+),"revision":(\d+),"contacts_sequence":"?\d.*)re"
      R"re("begin":\{"earliest_ns":([^,]+),.*"latest_ns":([^,]+),.*\},)re"
      R"re("end":\{"earliest_ns":([^,]+),.*"latest_ns":([^,]+),.*\},"continuous".*)re");
  return ContactsIn(std::regex_replace(output, fields, "$2 $3 $4 $5 $1 $6 $7 $8 $9"),
                    R"(^(\w+) (\w+) (\d+) (\d+) (\w+) (\S+) (\S+) (\S+) (\S+)$)");
}

/// The folder with the example's programs, which are built there.
std::string Build(const Folder& folder) {
  const std::string build = folder.Path("fast_dds");
  const Outcome configured =
      RunToEnd({COLLISION_CMAKE, "-S", kExample, "-B", build, "-DCMAKE_BUILD_TYPE=Debug",
                std::string("-DCMAKE_CXX_COMPILER=") + COLLISION_CXX});
  if (configured.status != 0) throw std::runtime_error(configured.out + configured.err);
  const Outcome built = RunToEnd({COLLISION_CMAKE, "--build", build});
  if (built.status != 0) throw std::runtime_error(built.out + built.err);
  return build;
}

/// One of the programs in `build`, run as the simulator or, without a name, as the monitor.
std::vector<std::string> Command(const std::string& build, const TestWorld& world,
                                 const std::string& simulator = "") {
  std::vector<std::string> words = {
      build + (simulator.empty() ? "/fast-dds-monitor" : "/fast-dds-simulator"), "--world",
      world.name(), "--domain", std::to_string(world.domain())};
  if (!simulator.empty()) words.insert(words.end(), {"--simulator", simulator});
  return words;
}

/// What has ended was confirmed before, and the brackets of both hold the truth.
void ExpectTheTruth(const std::vector<Contact>& contacts) {
  ASSERT_GE(contacts.size(), 2u);
  EXPECT_EQ(contacts.front().status, "confirmed");
  EXPECT_EQ(contacts.back().status, "ended");
  for (const Contact& contact : contacts) {
    EXPECT_LE(contact.begin_earliest, kBegin) << contact;
    EXPECT_GE(contact.begin_latest, kBegin) << contact;
    EXPECT_LE(contact.end_earliest, kEnd) << contact;
    EXPECT_GE(contact.end_latest, kEnd) << contact;
  }
}

TEST(FastDds, SimulatorAndMonitorOfTheExampleAgreeWithTheService) {
  const TestWorld world(kDomain, "simulators_awaited: 1");
  const std::string build = Build(world.folder());
  Process monitor(Command(build, world), kProfile);
  const auto daemon = world.StartDaemon();
  const auto ours = world.StartMonitor({"events", "--follow", "--json"});

  // A first contact shows that both monitors are there. Its simulator removes its agents.
  const Outcome first = RunToEnd(Command(build, world, "first"), kProfile);
  ASSERT_EQ(first.status, 0) << first.err;
  ASSERT_TRUE(monitor.WaitForOutput("  ended  ")) << monitor.out() << monitor.err();
  ASSERT_TRUE(ours->WaitForOutput("\"status\":\"ended\"")) << ours->err();
  EXPECT_TRUE(world.MonitorComesToSay({"status", "--json"}, "\"agents_removed\":2"));

  const Outcome second = RunToEnd(Command(build, world, "second"), kProfile);
  EXPECT_EQ(second.status, 0);
  EXPECT_EQ(second.err, "");
  const auto heard_end = [](const std::string& output, const std::string& ended) {
    return Contains(LinesAbout("second", output), ended);
  };
  ASSERT_TRUE(monitor.WaitUntil([&] { return heard_end(monitor.out(), "  ended  "); }));
  ASSERT_TRUE(ours->WaitUntil([&] { return heard_end(ours->out(), "\"status\":\"ended\""); }));
  const auto told = ContactsOfJson(LinesAbout("second", ours->out()));
  ExpectTheTruth(told);
  EXPECT_EQ(ContactsOfExample(LinesAbout("second", monitor.out())), told);
  EXPECT_EQ(ContactsOfExample(second.out), told);

  // A service that is killed closes nothing: only its lease tells.
  daemon->Signal(SIGKILL);
  EXPECT_TRUE(monitor.WaitForOutput("status: no service is heard")) << monitor.out();
  monitor.Signal(SIGINT);
  EXPECT_EQ(monitor.WaitForExit(), 0) << monitor.err();
  EXPECT_EQ(RunToEnd(Command(build, world, "alone"), kProfile).status, 1);
}

}  // namespace
}  // namespace collision::system_test
