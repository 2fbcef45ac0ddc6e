// Goal:   a service that runs takes another configuration and another log file, keeps what it has
//         where the file is wrong, and tells what it knows when it is asked.
// Method: the real program, asked by its own --reload and by signals.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/system/test_world.h"

namespace collision::system_test {
namespace {

std::string TextOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class ReloadTest : public testing::Test {
 protected:
  ReloadTest() {
    Write("info");
    daemon_ = std::make_unique<Process>(
        std::vector<std::string>{Program("collisiond"), "--config", folder_.Path("settings")},
        std::vector<std::string>{"CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-loopback.xml")});
  }

  void Write(const std::string& level, const std::string& more = "") const {
    folder_.Write("settings", "world: \"" + world_ + "\"\ndomain: 94\nlog_level: \"" + level +
                                  "\"\nlog_file: \"" + folder_.Path("log") + "\"\n" + more);
  }

  std::string Log() const { return TextOf(folder_.Path("log")); }

  bool LogComesToSay(const std::string& text) const {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < deadline) {
      if (Contains(Log(), text)) return true;
    }
    return false;
  }

  Outcome Reload() const {
    return RunToEnd({Program("collisiond"), "--reload", std::to_string(daemon_->pid())});
  }

  const Folder folder_;
  const std::string world_ = "reload-" + std::to_string(getpid());
  std::unique_ptr<Process> daemon_;
};

TEST_F(ReloadTest, TakesWhatCanChangeAndOpensTheLogAnew) {
  ASSERT_TRUE(LogComesToSay("serves world"));
  std::filesystem::rename(folder_.Path("log"), folder_.Path("log.1"));
  Write("debug", "agents_max: 7\nrecorder_mb_max: 500\n");
  const Outcome done = Reload();
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(Contains(done.out, "fields that differ take a new start; its log names them"));
  EXPECT_TRUE(Contains(Log(), "reloaded: log_level: \"info\" -> \"debug\"")) << Log();
  EXPECT_TRUE(Contains(Log(), "recorder_mb_max: 1024 -> 500")) << Log();
  EXPECT_TRUE(Contains(Log(), "takes a new start to change: agents_max")) << Log();

  Write("info", "agents_max: many\n");
  const Outcome refused = Reload();
  EXPECT_EQ(refused.status, 78);
  EXPECT_TRUE(Contains(refused.err, "keeps its configuration")) << refused.err;
  EXPECT_TRUE(Contains(Log(), folder_.Path("settings") + ":5: agents_max")) << Log();
  EXPECT_TRUE(Contains(Log(), "the configuration stays as it was"));

  // What cannot be read again, or would block, is refused.
  std::filesystem::remove(folder_.Path("settings"));
  ASSERT_EQ(mkfifo(folder_.Path("settings").c_str(), 0600), 0);
  EXPECT_EQ(Reload().status, 78);
  EXPECT_TRUE(Contains(Log(), "not a regular file: it cannot be read again")) << Log();
  std::filesystem::remove(folder_.Path("settings"));
  EXPECT_EQ(Reload().status, 78);

  Write("debug");
  EXPECT_EQ(Reload().out, "") << "all that differs has been taken";

  // As logrotate does it.
  Write("info");
  daemon_->Signal(SIGHUP);
  EXPECT_TRUE(LogComesToSay("reloaded: log_level: \"debug\" -> \"info\"")) << Log();
  daemon_->Signal(SIGTERM);
  EXPECT_EQ(daemon_->WaitForExit(), 0);
  EXPECT_EQ(Reload().status, 69) << "it is not there any more";
}

TEST_F(ReloadTest, TellsWhatItKnows) {
  ASSERT_TRUE(LogComesToSay("serves world"));
  daemon_->Signal(SIGUSR1);
  EXPECT_TRUE(LogComesToSay("state: {\"version\":")) << Log();
  EXPECT_TRUE(Contains(Log(), "\"world\":\"" + world_ + "\"")) << Log();
}

}  // namespace
}  // namespace collision::system_test
