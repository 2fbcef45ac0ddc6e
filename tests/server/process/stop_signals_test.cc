#include "server/process/stop_signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <future>

namespace collision::server {
namespace {

constexpr std::chrono::hours kEver{1000};

// Goal:   SIGTERM and SIGINT call the function on another thread, even if they came before the
// watcher was made.
TEST(StopSignals, CallTheFunction) {
  PrepareSignals();
  for (const int signal : {SIGTERM, SIGINT}) {
    std::promise<std::thread::id> called;
    kill(getpid(), signal);
    StopSignalWatcher watcher([&called] { called.set_value(std::this_thread::get_id()); }, kEver,
                              [] { FAIL(); });
    EXPECT_NE(called.get_future().get(), std::this_thread::get_id());
    EXPECT_TRUE(watcher.stopped());
  }
}

// Goal:   without a signal the watcher ends quietly.
TEST(StopSignals, EndWithoutASignal) {
  PrepareSignals();
  int calls = 0;
  {
    const StopSignalWatcher watcher([&calls] { ++calls; }, kEver, [&calls] { ++calls; });
    EXPECT_FALSE(watcher.stopped());
  }
  EXPECT_EQ(calls, 0);
}

// Goal:   what does not end after the first function gets the second.
TEST(StopSignals, GiveUpOnWhatDoesNotEnd) {
  PrepareSignals();
  std::promise<void> asked, given_up;
  StopSignalWatcher watcher([&asked] { asked.set_value(); }, std::chrono::milliseconds(20),
                            [&given_up] { given_up.set_value(); });
  kill(getpid(), SIGTERM);
  asked.get_future().wait();
  given_up.get_future().wait();
}

}  // namespace
}  // namespace collision::server
