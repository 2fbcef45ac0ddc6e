#include "server/process/signals.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <future>
#include <vector>

namespace collision::server {
namespace {

constexpr std::chrono::hours kEver{1000};

SignalActions Unless(std::function<void()> stop) {
  return {.stop = std::move(stop), .patience = kEver, .give_up = [] { FAIL(); }};
}

// Goal:   SIGTERM and SIGINT call the function on another thread, even if they came before the
// watcher was made.
TEST(Signals, CallTheFunction) {
  PrepareSignals();
  for (const int signal : {SIGTERM, SIGINT}) {
    std::promise<std::thread::id> called;
    kill(getpid(), signal);
    SignalWatcher watcher(Unless([&called] { called.set_value(std::this_thread::get_id()); }));
    EXPECT_NE(called.get_future().get(), std::this_thread::get_id());
    EXPECT_TRUE(watcher.stopped());
  }
}

// Goal:   without a signal the watcher ends quietly.
TEST(Signals, EndWithoutASignal) {
  PrepareSignals();
  int calls = 0;
  {
    const SignalWatcher watcher(Unless([&calls] { ++calls; }));
    EXPECT_FALSE(watcher.stopped());
  }
  EXPECT_EQ(calls, 0);
}

// Goal:   what does not end after the first function gets the second.
TEST(Signals, GiveUpOnWhatDoesNotEnd) {
  PrepareSignals();
  std::promise<void> asked, given_up;
  SignalWatcher watcher({.stop = [&asked] { asked.set_value(); },
                         .patience = std::chrono::milliseconds(20),
                         .give_up = [&given_up] { given_up.set_value(); }});
  kill(getpid(), SIGTERM);
  asked.get_future().wait();
  given_up.get_future().wait();
}

// Goal:   SIGHUP and SIGUSR1 call theirs each time, and end nothing.
TEST(Signals, OthersAreRequests) {
  PrepareSignals();
  int reloads = 0;
  std::promise<void> dumped, stopped;
  SignalWatcher watcher({.stop = [&stopped] { stopped.set_value(); },
                         .patience = kEver,
                         .give_up = [] { FAIL(); },
                         .reload =
                             [&reloads](pid_t asker) {
                               EXPECT_EQ(asker, 0) << "nobody waits";
                               ++reloads;
                               // The next one only now: of equal signals one is kept.
                               kill(getpid(), reloads == 1 ? SIGHUP : SIGUSR1);
                             },
                         .dump = [&dumped] { dumped.set_value(); }});
  kill(getpid(), SIGHUP);
  dumped.get_future().wait();
  EXPECT_EQ(reloads, 2);
  EXPECT_FALSE(watcher.stopped());
  kill(getpid(), SIGTERM);
  stopped.get_future().wait();
}

// Goal:   who asks for a reload hears whether it was done.
// Method: a child process asks, and ends with the answer; one asks a process that is not there.
TEST(Signals, AReloadIsAnswered) {
  PrepareSignals();
  for (const ReloadAnswer answer :
       {ReloadAnswer::kDone, ReloadAnswer::kDoneInPart, ReloadAnswer::kRefused}) {
    SignalWatcher watcher({.stop = [] {},
                           .patience = kEver,
                           .give_up = [] { FAIL(); },
                           .reload = [answer](pid_t asker) { AnswerReload(asker, answer); }});
    const pid_t service = getpid();
    const pid_t child = fork();
    if (child == 0) _exit(static_cast<int>(AskToReload(service, std::chrono::minutes(4))));
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(answer));
    EXPECT_EQ(AskToReload(child, kEver), ReloadAnswer::kNoProcess);
  }
}

// Goal:   of several that ask at once each is answered, though equal signals are one.
TEST(Signals, EachOfSeveralAskersIsAnswered) {
  PrepareSignals();
  SignalWatcher watcher({.stop = [] {},
                         .patience = kEver,
                         .give_up = [] { FAIL(); },
                         .reload = [](pid_t asker) { AnswerReload(asker, ReloadAnswer::kDone); }});
  const pid_t service = getpid();
  std::vector<pid_t> children;
  for (int i = 0; i < 8; ++i) {
    children.push_back(fork());
    if (children.back() == 0) {
      _exit(static_cast<int>(AskToReload(service, std::chrono::minutes(4))));
    }
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(ReloadAnswer::kDone));
  }
}

// Goal:   a process that SIGHUP would end is sent none.
TEST(Signals, WhoIsNoServiceIsLeftAlone) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_UNBLOCK, &all, nullptr);
    close(ready[1]);
    for (;;) pause();
  }
  close(ready[1]);
  char none = 0;
  ASSERT_EQ(read(ready[0], &none, 1), 0) << "the end, once the child has unblocked its signals";
  close(ready[0]);
  EXPECT_EQ(AskToReload(child, kEver), ReloadAnswer::kNoService);
  EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "it lives";
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace collision::server
