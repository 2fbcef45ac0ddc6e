// Goal:   collisiond's command line and configuration do what they say, with the exit codes they
// say. Method: run the program; the bad configurations each hold one planted mistake whose line is
// known.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "tests/support/sanitized.h"
#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

Outcome Collisiond(std::vector<std::string> options) {
  options.insert(options.begin(), Program("collisiond"));
  return RunToEnd(options);
}

/// As systemd is for a service: its end of NOTIFY_SOCKET, for programs started while it exists.
class ServiceManager {
 public:
  explicit ServiceManager(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0) << path;
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~ServiceManager() {
    unsetenv("NOTIFY_SOCKET");
    close(socket_);
  }
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  /// The next message, which has arrived already; empty: none.
  std::string Next() {
    char message[64];
    const ssize_t size = recv(socket_, message, sizeof message, MSG_DONTWAIT);
    return size < 0 ? "" : std::string(message, static_cast<std::size_t>(size));
  }

 private:
  int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

std::string ReadFile(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A network that is not there.
const std::vector<std::string> kNoNetwork = {
    "CYCLONEDDS_URI=<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface "
    "name=\"no-such-one\"/></Interfaces></General></Domain></CycloneDDS>"};

TEST(CommandLine, TellsItsVersion) {
  const Outcome outcome = Collisiond({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out.rfind("collisiond ", 0), 0u) << outcome.out;
}

TEST(CommandLine, UnknownOptionIsAUsageError) {
  for (const char* option : {"--no-such-option", "stray"}) {
    const Outcome outcome = Collisiond({option});
    EXPECT_EQ(outcome.status, 2) << option;
    EXPECT_TRUE(Contains(outcome.err, option)) << outcome.err;
  }
}

TEST(CommandLine, GoodConfigurationIsFine) {
  const Outcome shipped =
      Collisiond({"--config", ConfigFile("collisiond.textproto"), "--check-config"});
  EXPECT_EQ(shipped.status, 0) << shipped.err;
}

TEST(CommandLine, PrintedConfigurationCanBeReadAgain) {
  const Folder folder;
  const Outcome printed =
      RunToEnd({Program("collisiond"), "--print-config", "--domain", "7"}, kNoNetwork);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_TRUE(Contains(printed.out, "\ndomain: 7\n")) << printed.out;
  const std::string file = folder.Write("printed.textproto", printed.out);
  const Outcome checked = Collisiond({"--config", file, "--check-config"});
  EXPECT_EQ(checked.status, 0);
  EXPECT_EQ(checked.out, file + ": ok\n");
  EXPECT_EQ(Collisiond({"--config", file, "--print-config"}).out, printed.out);
}

TEST(CommandLine, BadConfigurationNamesFileLineFieldAndRange) {
  struct Mistake {
    std::string text;
    std::vector<std::string> expected;
  };
  const Mistake mistakes[] = {
      {"world: \"a\"\n\nagents_max: 0\n", {":3: agents_max:", "1 to "}},
      {"clock {\n  kind: REAL_TIME\n  skew_max_s: -1\n}\n", {":3: clock.skew_max_s:", "0 to 60"}},
      {"temporal_resolution_s: nan\n", {":1: temporal_resolution_s:", " to "}},
      {"# nothing\nno_such_field: 1\n", {":2:", "no_such_field"}},
      {"world: 7\n", {":1:"}},
      {"domain: 231\nworld: \"\"\n",
       {":1: domain: 231 is not allowed; allowed: 0 to 230\n", ":2: world:"}},
  };
  for (const Mistake& mistake : mistakes) {
    const Folder folder;
    const std::string file = folder.Write("bad.textproto", mistake.text);
    const Outcome outcome = Collisiond({"--config", file, "--check-config"});
    EXPECT_EQ(outcome.status, 78) << mistake.text;
    for (const std::string& expected : mistake.expected)
      EXPECT_TRUE(Contains(outcome.err, expected)) << outcome.err;
    EXPECT_TRUE(Contains(outcome.err, file)) << outcome.err;
    EXPECT_EQ(Collisiond({"--config", file}).status, 78) << "served with " << mistake.text;
    EXPECT_EQ(Collisiond({"--config", file, "--print-config"}).status, 78) << mistake.text;
  }
}

TEST(CommandLine, MissingConfigurationIsOneClearLine) {
  const Folder folder;
  const Outcome outcome = Collisiond({"--config", folder.Path("none.textproto")});
  EXPECT_EQ(outcome.status, 78);
  EXPECT_TRUE(Contains(outcome.err, "none.textproto")) << outcome.err;
}

TEST(CommandLine, WithoutDdsItSaysSo) {
  const Outcome outcome = RunToEnd({Program("collisiond")}, kNoNetwork);
  EXPECT_EQ(outcome.status, 69);
  EXPECT_TRUE(Contains(outcome.err, "collisiond: ")) << outcome.err;
}

// Goal:   where the system gives it too little, it says so, in place of a crash within DDS.
// Method: limits of the shell; threads are few where each has a stack of a gigabyte, and a
//         sanitizer has no room with such a limit.
TEST(CommandLine, WithTooFewFilesOrThreadsItSaysSo) {
  const auto within = [](const std::string& limits) {
    return RunToEnd({"/bin/sh", "-c", limits + "; exec " + Program("collisiond")},
                    {"CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-loopback.xml")});
  };
  const Outcome files = within("ulimit -n 20");
  EXPECT_EQ(files.status, 69);
  EXPECT_TRUE(Contains(files.err, "more files can be had here, and 48 are needed")) << files.err;
  if (kSanitized) return;
  const Outcome threads = within("ulimit -s 1048576; ulimit -v 6291456");
  EXPECT_EQ(threads.status, 69);
  EXPECT_TRUE(Contains(threads.err, "more threads can be had here, and 16")) << threads.err;
}

TEST(CommandLine, AFileThatCannotBeWrittenIsOneClearLine) {
  const Outcome recording = Collisiond({"--record", "/dev/full"});
  EXPECT_EQ(recording.status, 74);
  EXPECT_EQ(recording.err,
            "collisiond: /dev/full: byte 0: cannot be written: No space left on device\n");
  const Folder folder;
  const Outcome log =
      Collisiond({"--config", folder.Write("log.textproto", "log_file: \"/dev/null/log\"")});
  EXPECT_EQ(log.status, 74);
  EXPECT_EQ(log.err.rfind("collisiond: log_file: ", 0), 0u) << log.err;
  const Outcome cache =
      Collisiond({"--config", folder.Write("c.textproto", "tree_cache_dir: \"/dev/null/trees\"")});
  EXPECT_EQ(cache.status, 74);
  EXPECT_EQ(cache.err, "collisiond: tree_cache_dir: /dev/null/trees: Not a directory\n");
}

// Goal:   with on_state_failure END a journal that cannot be kept, or is damaged, ends the service,
//         with a line that names the file and what to do; nothing of the file is changed.
TEST(CommandLine, WithEndAJournalThatFailsEndsTheService) {
  const Folder folder;
  const auto serve = [&folder](const std::string& state_dir) {
    const std::string text = "state_dir: \"" + state_dir + "\"\non_state_failure: END";
    return RunToEnd({Program("collisiond"), "--config", folder.Write("end.textproto", text)},
                    kNoNetwork);
  };
  const std::string file = folder.Write("file", "not a folder");
  const Outcome no_folder = serve(file);
  EXPECT_EQ(no_folder.status, 74);
  EXPECT_TRUE(Contains(no_folder.err, "collisiond: state_dir: " + file + ": cannot be made: "))
      << no_folder.err;
  const Outcome nowhere = serve("");
  EXPECT_EQ(nowhere.status, 78);
  EXPECT_TRUE(Contains(nowhere.err, "collisiond: on_state_failure: END needs a folder"));
  const std::string journal = folder.Path("default.0.journal");
  EXPECT_EQ(serve(folder.Path("")).status, 69) << "a new journal is fine";
  const std::string whole = ReadFile(journal);
  ASSERT_EQ(whole.size(), 128u);
  std::string spoilt = whole;
  spoilt[8] ^= 1;
  for (const std::string& damaged : {spoilt, whole.substr(0, 100), std::string()}) {
    folder.Write("default.0.journal", damaged);
    const Outcome outcome = serve(folder.Path("."));
    EXPECT_EQ(outcome.status, 74) << outcome.err;
    EXPECT_TRUE(Contains(outcome.err, "default.0.journal: byte 0: ")) << outcome.err;
    EXPECT_TRUE(Contains(outcome.err, "move the file away")) << outcome.err;
    EXPECT_EQ(ReadFile(journal), damaged);
  }
  const Outcome gone_on =
      RunToEnd({Program("collisiond"), "--config",
                folder.Write("go_on.textproto", "state_dir: \"" + folder.Path("") + "\"")},
               kNoNetwork);
  EXPECT_EQ(gone_on.status, 69) << "only the network is missing";
  EXPECT_TRUE(Contains(gone_on.err, "the file is empty")) << gone_on.err;
}

TEST(CommandLine, EndsCleanlyOnAStopSignal) {
  const TestWorld world(60);
  for (const int signal : {SIGTERM, SIGINT}) {
    ServiceManager manager(world.folder().Path("manager-" + std::to_string(signal)));
    const auto daemon = world.StartDaemon();
    daemon->Signal(signal);
    EXPECT_EQ(daemon->WaitForExit(), 0) << daemon->err();
    EXPECT_EQ(EventLogLine(daemon->err()), "event log: 0 events, hash cbf29ce484222325");
    EXPECT_TRUE(daemon->err().ends_with("hash cbf29ce484222325\n")) << daemon->err();
    const auto next = [&manager] {
      std::string message = manager.Next();
      while (message.starts_with("STATUS=")) message = manager.Next();
      return message;
    };
    EXPECT_EQ(next(), "READY=1");
    EXPECT_EQ(next(), "STOPPING=1");
  }
}

}  // namespace
}  // namespace collision::system_test
