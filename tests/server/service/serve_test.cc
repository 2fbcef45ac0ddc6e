// Goal:   however the service ends, its exit code and its log say why, and its recording is whole.
#include "server/service/serve.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <future>
#include <mutex>
#include <new>
#include <sstream>
#include <utility>

#include "collision_core/base/check.h"
#include "server/config/config.h"
#include "server/process/logging.h"
#include "server/process/signals.h"
#include "tests/server/messages.h"
#include "tests/server/shapes/failing_tree_store.h"
#include "tests/server/shapes/shapes.h"
#include "tests/support/temporary_path.h"

namespace collision::server {
namespace {

/// The process is asked to end while a step runs, and the step does not.
class BlockingBus final : public Bus {
 public:
  bool Receive(std::chrono::nanoseconds, std::size_t, std::vector<v1::Input>*) override {
    return true;
  }
  void Publish(const v1::Output&) override {
    kill(getpid(), SIGTERM);
    never_.get_future().wait();
  }
  void Flush() override {}
  void Wake() override {}

 private:
  std::promise<void> never_;
};

/// Hands out one batch, then waits until it is woken; fails a check at the first clearance of an
/// agent.
class FailingBus final : public Bus {
 public:
  explicit FailingBus(std::vector<v1::Input> inputs) : inputs_(std::move(inputs)) {}

  bool Receive(std::chrono::nanoseconds, std::size_t, std::vector<v1::Input>* inputs) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return woken_ || !inputs_.empty(); });
    *inputs = std::exchange(inputs_, {});
    return true;
  }
  void Publish(const v1::Output& output) override {
    CORE_CHECK(output.clearance().agents().empty(), "planted in the bus", 42);
  }
  void Flush() override {}
  void Wake() override {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<v1::Input> inputs_;
  bool woken_ = false;
};

std::string TakeFile(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::remove(path.c_str());
  return text.str();
}

struct Served {
  int exit_code = 0;
  std::string log;
  std::vector<v1::RecordedBatch> batches;
  std::string recording_error;
};

/// Serves on this bus, with a log and a recording.
Served ServeOn(Bus& bus, std::shared_ptr<TreeStore> trees = nullptr) {
  const std::string recording = TemporaryPath("serve_test_failed.recording");
  const std::string log = TemporaryPath("serve_test.log");
  const v1::Config config = CompleteConfig({});
  Served served;
  StartLogging({.level = "critical", .file = log});
  PrepareSignals();
  {
    RecordingWriter recorder(recording, config);
    served.exit_code =
        Serve(config, bus, {.recorder = &recorder, .trees = std::move(trees)}).value();
    EXPECT_EQ(recorder.error(), "");
  }
  StartLogging({.level = "info"});
  served.log = TakeFile(log);
  RecordingReader reader(recording);
  while (auto batch = reader.Next()) served.batches.push_back(std::move(*batch));
  served.recording_error = reader.error();
  std::remove(recording.c_str());
  return served;
}

// Goal:   SIGTERM ends the program with 0 and a line also from within a step that never ends; the
//         recording is whole, with the batch of that step.
TEST(Serve, EndsInTheMiddleOfAStep) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  // The process that is to end runs this test anew, up to there, and writes where this one reads.
  constexpr char kVariable[] = "COLLISION_SERVE_TEST_RECORDING";
  const char* told = std::getenv(kVariable);
  const std::string path = told != nullptr ? told : TemporaryPath("serve_test.recording");
  setenv(kVariable, path.c_str(), 1);
  const auto serve = [&path] {
    StartLogging({.level = "info"});
    PrepareSignals();
    const v1::Config config = CompleteConfig({});
    RecordingWriter recorder(path, config);
    BlockingBus bus;
    Serve(config, bus, {.recorder = &recorder});
  };
  EXPECT_EXIT(serve(), testing::ExitedWithCode(0), "exits without waiting for it");
  RecordingReader reader(path);
  EXPECT_TRUE(reader.Next().has_value());
  EXPECT_FALSE(reader.Next().has_value());
  EXPECT_EQ(reader.error(), "");
}

// Goal:   a check that fails within a step ends the service with 70 and a critical line that names
//         what must hold, where and the value; the recording is whole, with the batch of that step.
TEST(Serve, EndsAtAFailedCheckWithItsRecordingWhole) {
  FailingBus bus(AlphaJoins(10));
  const Served served = ServeOn(bus);
  EXPECT_EQ(served.exit_code, 70);
  for (const char* part : {"critical", "planted in the bus", "serve_test.cc", "42"}) {
    EXPECT_NE(served.log.find(part), std::string::npos) << served.log;
  }
  ASSERT_EQ(served.batches.size(), 1u);
  EXPECT_EQ(served.batches[0].inputs_size(), 4);
  EXPECT_EQ(served.recording_error, "");
}

// Goal:   a check that fails on a thread that builds shapes does the same: it is carried to the
//         daemon's thread, which it wakes.
TEST(Serve, EndsAtACheckThatFailsOnAnotherThread) {
  const std::string bytes = EncodeShape(Cube(1));
  std::vector<v1::Input> inputs = From(10, PartsOf("alpha", bytes));
  inputs.push_back(From(10, ClockOf("alpha", 0)));
  FailingBus bus(inputs);
  const Served served = ServeOn(bus, std::make_shared<FailingTreeStore>());
  EXPECT_EQ(served.exit_code, 70);
  EXPECT_NE(served.log.find("planted in the store of trees"), std::string::npos) << served.log;
  ASSERT_EQ(served.batches.size(), 1u);
  EXPECT_EQ(served.batches[0].inputs_size(), 2);
  EXPECT_EQ(served.recording_error, "");
}

// Goal:   only a bug ends with 70: what `run` returns stands, and other exceptions end with 71.
TEST(EndOnFailure, TellsBugsFromWantOfMemory) {
  EXPECT_EQ(EndOnFailure([] { return 3; }), 3);
  EXPECT_EQ(EndOnFailure([]() -> int { throw CheckFailure("planted"); }), 70);
  EXPECT_EQ(EndOnFailure([]() -> int { throw std::length_error("planted"); }), 70);
  EXPECT_EQ(EndOnFailure([]() -> int { throw std::bad_alloc(); }), 71);
}

}  // namespace
}  // namespace collision::server
