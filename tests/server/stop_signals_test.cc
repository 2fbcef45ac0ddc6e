#include "server/stop_signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <future>

namespace collision::server {
namespace {

// Goal:   SIGTERM and SIGINT call the function on another thread, even if they came before the
// watcher was made.
TEST(StopSignals, CallTheFunction) {
  PrepareSignals();
  for (const int signal : {SIGTERM, SIGINT}) {
    std::promise<std::thread::id> called;
    kill(getpid(), signal);
    StopSignalWatcher watcher([&called] { called.set_value(std::this_thread::get_id()); });
    EXPECT_NE(called.get_future().get(), std::this_thread::get_id());
    EXPECT_TRUE(watcher.stopped());
  }
}

// Goal:   without a signal the watcher ends quietly.
TEST(StopSignals, EndWithoutASignal) {
  PrepareSignals();
  int calls = 0;
  {
    const StopSignalWatcher watcher([&calls] { ++calls; });
    EXPECT_FALSE(watcher.stopped());
  }
  EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace collision::server
