// Goal:   collisionctl doctor names every trouble for which a world is silent or does not do what
//         it should, and what to type next; of a world that is well it says so.
// Method: each trouble is made with real programs; `stranger` and `troubles` are those that have
//         or make it.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/system/test_world.h"
#include "tests/system/two_hosts.h"

namespace collision::system_test {
namespace {

constexpr char kRealTime[] = "kind: REAL_TIME skew_max_s: 0.2";

class DoctorTest : public testing::Test {
 protected:
  /// Asks it until it says so: what has just begun takes its time to be noticed.
  void ComesToSay(const TestWorld& world, const std::vector<std::string>& texts) const {
    for (const std::string& text : texts)
      EXPECT_TRUE(world.MonitorComesToSay({"doctor"}, text)) << text << "\n"
                                                             << world.Monitor({"doctor"}).out;
  }

  static std::unique_ptr<Process> StartHere(const TestWorld& world, const std::string& program,
                                            const std::string& trouble) {
    auto process = world.StartHelper(program, {trouble});
    EXPECT_TRUE(process->WaitForOutput("here")) << process->err();
    return process;
  }
};

TEST_F(DoctorTest, OfAWorldThatIsWellItSaysSo) {
  const TestWorld world(120, kRealTime);
  const auto daemon = world.StartDaemon();
  const auto simulator = StartHere(world, "troubles", "real-time");
  ComesToSay(world, {"WELL: the service is heard, 1 simulators and 2 agents"});
  EXPECT_EQ(world.Monitor({"doctor"}).status, 0);
  EXPECT_EQ(world.Monitor({"--json", "doctor"}).out,
            "{\"schema\":\"collision/1\",\"kind\":\"doctor\",\"findings\":[]}\n");
}

TEST_F(DoctorTest, NamesWhereAServiceIsToBeFound) {
  const TestWorld world(121, kRealTime);
  const Outcome nobody = world.Monitor({"doctor"});
  EXPECT_EQ(nobody.status, 1);
  EXPECT_TRUE(Contains(nobody.out, "nor any other program")) << nobody.out;
  EXPECT_TRUE(
      Contains(nobody.out, "-> start one: collisiond --world " + world.name() + " --domain 121"))
      << nobody.out;
  {
    const auto elsewhere = world.StartDaemon({"--domain", "122"});
    const Outcome domain = world.Monitor({"doctor"});
    EXPECT_TRUE(Contains(domain.out, "domain 122 serves a world of this name")) << domain.out;
    EXPECT_TRUE(Contains(domain.out, "-> collisionctl --domain 122 --world " + world.name()));
  }
  const auto other = world.StartDaemon({"--world", "another"});
  const Outcome named = world.Monitor({"doctor"});
  EXPECT_TRUE(Contains(named.out, "served here: another")) << named.out;
  EXPECT_TRUE(Contains(named.out, "-> collisionctl --world another doctor")) << named.out;
}

// Goal:   a network profile with which DDS does not start is named, with what is wrong in it.
TEST_F(DoctorTest, NamesANetworkProfileThatIsWrong) {
  const TestWorld world(132);
  const auto with = [&](const std::string& profile) {
    return RunToEnd({Program("collisionctl"), "--domain", "132", "doctor"},
                    {"CYCLONEDDS_URI=" + profile});
  };
  const Outcome missing = with("file:///nowhere.xml");
  EXPECT_EQ(missing.status, 69) << missing.err;
  EXPECT_TRUE(Contains(missing.out,
                       "1. DDS does not start on domain 132, network profile "
                       "file:///nowhere.xml: can't open configuration file"))
      << missing.out;
  EXPECT_TRUE(Contains(missing.out, "   -> let CYCLONEDDS_URI name a file that is there"));
  const Outcome card = with(
      "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"none0\"/></Interfaces>"
      "</General></Domain></CycloneDDS>");
  EXPECT_TRUE(Contains(card.out, "none0: does not match an available interface")) << card.out;
  EXPECT_TRUE(Contains(card.out, "-> name an interface of this machine")) << card.out;
  EXPECT_TRUE(Contains(card.out, "lo 127.0.0.1")) << card.out;
  const Outcome word = with("<CycloneDDS><Domain><Foo>1</Foo></Domain></CycloneDDS>");
  EXPECT_TRUE(Contains(word.out, "Foo: unknown element")) << word.out;
}

TEST_F(DoctorTest, NamesServicesThatDoNotBelongThere) {
  const TestWorld world(123, kRealTime);
  {
    const auto alone = StartHere(world, "troubles", "other-revision");
    ComesToSay(world, {"-> install programs of one version on all hosts"});
  }
  const auto daemon = world.StartDaemon();
  const auto second = StartHere(world, "troubles", "second-service");
  ComesToSay(world, {"several services are in world", "-> end all but one"});
}

// Goal:   whoever can never be met is named, with what differs.
TEST_F(DoctorTest, NamesReadersAndWritersThatDoNotFit) {
  const TestWorld world(124, kRealTime);
  const auto daemon = world.StartDaemon();
  const std::pair<const char*, const char*> cases[] = {
      {"best-effort", "agent_states by stranger (pid "},
      {"best-effort", "meets nobody: it offers best effort, and readers request reliable"},
      {"volatile", "it offers volatile, and readers request transient-local"},
      {"exclusive", "ownership: it is exclusive"},
      {"long-lease", "its lease is longer than the 2 s that readers request"},
      {"no-key", "its type has no key"},
      {"other-name", "its type is \"lab::States\", not \"collision::v1::AgentStates\""},
      {"other-members", "its type has other members"},
      {"other-version", "collision/v2/agent_states by stranger"},
      {"persistent-reader", "reader of collision/v1/contact by stranger"}};
  for (const auto& [trouble, text] : cases) {
    const auto stranger = StartHere(world, "stranger", trouble);
    ComesToSay(world, {text});
  }
  // The service has noticed, too, though not whose they are.
  for (const char* line : {"a writer of collision/v1/agent_states does not fit: reliability; ",
                           "a writer of collision/v1/agent_states does not fit: type; ",
                           "a reader of collision/v1/contact does not fit: durability; "}) {
    EXPECT_TRUE(daemon->WaitForOutput(line)) << line << daemon->err();
  }
}

TEST_F(DoctorTest, NamesTroubleWithClocks) {
  const TestWorld world(125, kRealTime);
  const auto daemon = world.StartDaemon();
  {
    const auto ahead = StartHere(world, "troubles", "ahead");
    ComesToSay(world, {"the clock of troubled is off by +1", "-> synchronise the clocks"});
  }
  const auto lock_step = StartHere(world, "troubles", "two-agents");
  ComesToSay(world, {"REFUSES troubled: "});
}

TEST_F(DoctorTest, NamesSimulatorsThatStandOrAreSilent) {
  const TestWorld world(126, kRealTime);
  const auto daemon = world.StartDaemon();
  const auto stuck = StartHere(world, "troubles", "stuck");
  ComesToSay(world, {"of 2 agents a state has been wanted for more than 1 s"});
  stuck->Signal(SIGKILL);
  ComesToSay(world, {"simulator troubled is not heard; the service keeps its 2 agents",
                     "remove it: collisionctl evict troubled"});
}

TEST_F(DoctorTest, NamesLimitsThatAreReached) {
  const TestWorld world(127, "simulators_awaited: 1", "agents_max: 1\n");
  const auto daemon = world.StartDaemon();
  const auto two = StartHere(world, "troubles", "two-agents");
  ComesToSay(world, {"REFUSES troubled: ", "raise the limit in the configuration"});
}

// Goal:   a recording that has ended is told, with what to do.
// Method: files may not grow beyond a few thousand bytes in the service's process.
TEST_F(DoctorTest, NamesARecordingThatHasEnded) {
  const TestWorld world(128, kRealTime);
  const std::string file = world.folder().Path("run.rec");
  const Process daemon({"prlimit", "--fsize=6000", Program("collisiond"), "--config",
                        world.folder().Path("collisiond.textproto"), "--record", file},
                       {"CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-loopback.xml")});
  const auto simulator = StartHere(world, "troubles", "real-time");
  ComesToSay(world, {"to record: " + file});
}

class TwoHostsDoctor : public DoctorTest {};

// Goal:   on the host of the simulators the doctor names the interface that is missing, and the
//         multicast that does not come through.
// Method: two network namespaces; one loses what is sent to groups.
TEST_F(TwoHostsDoctor, NamesTheWrongInterfaceAndLostMulticast) {
  const TwoHosts hosts;
  TestWorld world(129, kRealTime);
  world.MoveTo(hosts.host(0));
  const auto daemon = world.StartDaemon();
  world.MoveTo(hosts.host(1));
  ComesToSay(world, {"WELL: the service is heard"});

  const auto doctor = [&](const std::vector<std::string>& words, const char* profile) {
    std::vector<std::string> command = {
        Program("collisionctl"), "--world", world.name(), "--domain", "129", "doctor"};
    command.insert(command.end(), words.begin(), words.end());
    return RunToEnd(InNamespace(hosts.host(1), command),
                    {"CYCLONEDDS_URI=file://" + ConfigFile(profile)});
  };
  const Outcome loopback = doctor({}, "cyclonedds-loopback.xml");
  EXPECT_TRUE(Contains(loopback.out, "speaks on lo 127.0.0.1 alone")) << loopback.out;
  EXPECT_TRUE(Contains(loopback.out, "cyclonedds-lan.xml")) << loopback.out;

  for (int host : {0, 1}) hosts.LoseMulticast(host);
  const Outcome lost = doctor({}, "cyclonedds-lan.xml");
  EXPECT_TRUE(Contains(lost.out, "collisionctl doctor --host ITS-ADDRESS")) << lost.out;
  const Outcome found = doctor({"--host", "10.99.0.1"}, "cyclonedds-lan.xml");
  EXPECT_TRUE(Contains(found.out, "multicast does not come through")) << found.out;
  EXPECT_TRUE(Contains(found.out, "<Peer Address=\"10.99.0.1\"/>")) << found.out;

  Ip("-n " + hosts.host(1) + " link add second type veth peer name its-end");
  Ip("-n " + hosts.host(1) + " address add 10.98.0.1/24 dev second");
  Ip("-n " + hosts.host(1) + " link set second up");
  const Outcome several = doctor({}, "cyclonedds-lan.xml");
  EXPECT_TRUE(Contains(several.out, "and there is also")) << several.out;
  EXPECT_TRUE(Contains(several.out, "<NetworkInterface name=")) << several.out;
}

}  // namespace
}  // namespace collision::system_test
