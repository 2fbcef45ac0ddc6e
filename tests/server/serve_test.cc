#include "server/serve.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <future>

#include "server/config.h"
#include "server/logging.h"
#include "server/stop_signals.h"

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

// Goal:   SIGTERM ends the program with 0 and a line also from within a step that never ends; the
//         recording is whole, with the batch of that step.
TEST(Serve, EndsInTheMiddleOfAStep) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const std::string path = testing::TempDir() + "serve_test.recording";
  const auto serve = [&path] {
    StartLogging("info", "");
    PrepareSignals();
    const v1::Config config = CompleteConfig({});
    RecordingWriter recorder(path, config);
    BlockingBus bus;
    Serve(config, bus, &recorder);
  };
  EXPECT_EXIT(serve(), testing::ExitedWithCode(0), "ended in the middle of a step");
  RecordingReader reader(path);
  EXPECT_TRUE(reader.Next().has_value());
  EXPECT_FALSE(reader.Next().has_value());
  EXPECT_EQ(reader.error(), "");
  std::remove(path.c_str());
}

}  // namespace
}  // namespace collision::server
