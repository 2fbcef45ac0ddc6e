// Goal:   a journal that cannot be written is told in the status, and the policy decides whether
//         the service goes on; what is granted was on file before.
// Method: a daemon whose journal meets a full disk in the middle of a run.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "server/claim/journal.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr rlim_t kRecordBytes = 128;  ///< Of the journal.

/// No file of this process can grow beyond a size while this lives: as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

class StateFailureTest : public testing::Test {
 protected:
  StateFailureTest() {
    std::string folder = testing::TempDir() + "stateXXXXXX";
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    journal_.emplace(folder_, "lab", 0, 64);
  }
  ~StateFailureTest() override { std::filesystem::remove_all(folder_); }

  /// A daemon that has its term, but no room for a simulator.
  ScriptedDaemon* Start(v1::Config::OnFailure on_failure) {
    v1::Config config = Simulated();
    config.set_on_state_failure(on_failure);
    daemon_.emplace(config, DaemonParts{.journal = {.journal = &*journal_}});
    daemon_->Step({}, 0.01);
    disk_.emplace(kRecordBytes + 7);
    return &*daemon_;
  }

  bool has_granted() const {
    for (const v1::Output& output : daemon_->bus().outputs) {
      if (output.has_clearance()) return true;
    }
    return false;
  }

  std::string folder_;
  std::optional<Journal> journal_;
  mutable std::optional<ScriptedDaemon> daemon_;
  std::optional<SmallDisk> disk_;
};

TEST_F(StateFailureTest, GoOnServesAndTells) {
  ScriptedDaemon* daemon = Start(v1::Config::GO_ON);
  EXPECT_EQ(Extension(daemon->status(), "state_failure"), "");
  daemon->Step(AlphaJoins(1), 0.01);
  EXPECT_TRUE(has_granted());
  EXPECT_EQ(Extension(daemon->status(), "state_failure"),
            journal_->path() + ": byte 128: cannot be written: No space left on device");
}

TEST_F(StateFailureTest, EndEndsBeforeAnythingIsGranted) {
  ScriptedDaemon* daemon = Start(v1::Config::END);
  daemon->bus().next = AlphaJoins(1);
  EXPECT_FALSE(daemon->daemon().Step());
  EXPECT_FALSE(has_granted());
  EXPECT_NE(journal_->error(), "");
}

TEST_F(StateFailureTest, AServiceThatFoundNoJournalSaysWhy) {
  daemon_.emplace(Simulated(), DaemonParts{.journal = {.failure = "/state: cannot be made"}});
  EXPECT_EQ(Extension(daemon_->status(), "state_failure"), "/state: cannot be made");
}

}  // namespace
}  // namespace collision::server
