// The signals of a service as ordinary function calls.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace collision::server {

/// Blocks SIGTERM, SIGINT, SIGHUP and SIGUSR1 in the calling thread and in all threads that it
/// starts afterwards, so that they stay pending for a SignalWatcher. Ignores SIGPIPE and SIGXFSZ,
/// so that a failed write is an error with a cause and does not end the process. Call it before any
/// thread is made, DDS included.
void PrepareSignals();

/// What a service does on which signal. All are called on the watcher's thread.
struct SignalActions {
  std::function<void()> stop;         ///< SIGTERM, SIGINT: asks for the end. Once.
  std::chrono::nanoseconds patience;  ///< How long the watcher may still exist after that ...
  std::function<void()> give_up;      ///< ... before this is called. Once.
  /// SIGHUP: the configuration is to be read anew. `asker`: the process that waits for
  /// AnswerReload(); 0: none does.
  std::function<void(pid_t asker)> reload = {};
  std::function<void()> dump = {};  ///< SIGUSR1: what is known is to be told.
};

/// Calls functions, on a thread of its own, when the process gets signals.
///
/// A signal handler may call next to nothing (no mutex, no allocation, so no DDS) and may run on
/// any thread. These functions run on an ordinary thread and may do what a thread may.
class SignalWatcher {
 public:
  /// Requires that PrepareSignals() was called; a signal since then counts.
  explicit SignalWatcher(SignalActions actions);

  /// Afterwards no function is called any more.
  ~SignalWatcher();
  SignalWatcher(const SignalWatcher&) = delete;
  SignalWatcher& operator=(const SignalWatcher&) = delete;

  /// Whether SIGTERM or SIGINT has come. Any thread.
  bool stopped() const { return stopped_; }

 private:
  void Watch();
  bool EndsInTime() const;

  const SignalActions actions_;
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

/// How a request to reload has ended.
enum class ReloadAnswer {
  kDone,
  kDoneInPart,  ///< What differs else takes a new start of the service.
  kRefused,
  kNoProcess,  ///< It is not there, or belongs to another user.
  kNoService,  ///< It does not wait for signals as a SignalWatcher does; it was sent none.
  kNoAnswer
};

/// Sends SIGHUP to a service, another process, and waits for its answer; again each second.
/// Requires that nothing else in this process waits for SIGUSR1, which brings the answer.
ReloadAnswer AskToReload(pid_t service, std::chrono::nanoseconds patience);

/// Answers AskToReload(): done, in part or refused. Does nothing for an asker of 0, or one that has
/// gone.
void AnswerReload(pid_t asker, ReloadAnswer answer);

}  // namespace collision::server
