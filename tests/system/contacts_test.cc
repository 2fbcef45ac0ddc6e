// Goal:   a monitor that keeps reading hears every contact and little else; one that has stood
//         still likewise.
// Method: two columns of balls that pass through each other; one monitor is stopped meanwhile, the
//         output of the other is not read. Their lines are compared with what the service counted.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

constexpr int kColumn = 16;  // balls; each of the 256 pairs touches once
constexpr int kSeconds = 40;
constexpr std::size_t kRevisionsOfAnEvent = 3;

/// The columns move along x, 2 m from ball to ball.
std::string Columns() {
  std::ostringstream table;
  table << "time_s,agent_id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n";
  for (int row = 0; row <= 16 * kSeconds; ++row) {
    const double time = row / 16.0;
    for (int ball = 0; ball < kColumn; ++ball) {
      const double x = 5 + 2 * ball - time;
      table << time << "," << ball << "," << x << ",0,0,-1,0,0\n";
      table << time << "," << kColumn + ball << "," << -x << ",0,0,1,0,0\n";
    }
  }
  return table.str();
}

/// The text of a field in a line of JSON; empty: it has none.
std::string Field(const std::string& line, const std::string& name) {
  const auto at = line.find("\"" + name + "\":");
  if (at == std::string::npos) return "";
  const auto begin = at + name.size() + 3;
  return line.substr(begin, line.find_first_of(",}", begin) - begin);
}

struct Heard {
  std::vector<std::uint64_t> contacts;           ///< Their numbers, in order.
  std::map<std::string, std::size_t> revisions;  ///< Of each event.
};

Heard HeardIn(const std::string& output) {
  Heard heard;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const std::string number = Field(line, "contacts_sequence");
    if (number.empty()) continue;
    if (number != "null") heard.contacts.push_back(std::stoull(number));
    const auto pair = line.find("\"lower\"");
    ++heard.revisions[line.substr(pair, line.find("\"revision\"") - pair)];
  }
  return heard;
}

std::uint64_t ContactsPublished(const TestWorld& world) {
  const std::string status = world.Monitor({"status", "--json"}).out;
  return std::stoull(Field(status, "contacts_published"));
}

TEST(Contacts, EachIsHeardByAMonitorThatStandsStillAndByOneThatIsNotRead) {
  const TestWorld world(76, "simulators_awaited: 2");
  const auto daemon = world.StartDaemon();
  const auto unread = world.StartMonitor({"events", "--follow", "--json"});
  const auto stopped = world.StartMonitor({"events", "--follow", "--json"});
  // A first contact shows that both are there.
  for (const auto& process : {world.StartSimulator(kLeft), world.StartSimulator(kRight)}) {
    ASSERT_EQ(process->WaitForExit(), 0) << process->err();
  }
  ASSERT_TRUE(unread->WaitForOutput("\"status\":\"ended\"")) << unread->err();
  ASSERT_TRUE(stopped->WaitForOutput("\"status\":\"ended\"")) << stopped->err();

  stopped->Signal(SIGSTOP);
  const auto columns =
      world.StartPlayer({world.folder().Write("columns.csv", Columns()), "--simulator", "columns",
                         "--radius", "0.5", "--acceleration-max", "0.5"});
  const auto other = world.StartSimulator({"still", 0, 0, kSeconds});
  ASSERT_EQ(columns->WaitForExit(), 0) << columns->err();
  ASSERT_EQ(other->WaitForExit(), 0) << other->err();
  stopped->Signal(SIGCONT);

  const std::uint64_t published = ContactsPublished(world);
  EXPECT_GE(published, 2u * kColumn * kColumn);
  std::vector<std::uint64_t> all;
  for (std::uint64_t number = 1; number <= published; ++number) all.push_back(number);
  const std::string last = "\"contacts_sequence\":" + std::to_string(published) + ",";
  for (const auto& monitor : {unread.get(), stopped.get()}) {
    ASSERT_TRUE(monitor->WaitForOutput(last)) << monitor->err();
    const Heard heard = HeardIn(monitor->out());
    EXPECT_EQ(heard.contacts, all);
    std::vector<std::size_t> revisions;
    for (const auto& [event, count] : heard.revisions) revisions.push_back(count);
    std::sort(revisions.begin(), revisions.end());
    EXPECT_LE(revisions[revisions.size() / 2], kRevisionsOfAnEvent);
    monitor->Signal(SIGTERM);
    EXPECT_EQ(monitor->WaitForExit(), 0);
    EXPECT_TRUE(Contains(monitor->err(), "missed: 0")) << monitor->err();
  }
}

}  // namespace
}  // namespace collision::system_test
