// What the service is asked by signals, and does between two steps.
#pragma once

#include <sys/types.h>

#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/process/service_notify.h"
#include "server/process/signals.h"
#include "server/service/requests/reload.h"

namespace collision::server {

/// SIGHUP: the configuration is read anew, and the log file opened anew. SIGUSR1: what the service
/// knows is written to the log.
class SignalRequests {
 public:
  /// `apply` puts what can change in force, but for the log; may be null. `state_lines`: what the
  /// service knows. `notifier` outlives it.
  SignalRequests(Reloader reloader, std::function<void(const v1::Config&)> apply,
                 std::function<std::vector<std::string>()> state_lines, ServiceNotifier* notifier)
      : reloader_(std::move(reloader)),
        apply_(std::move(apply)),
        state_lines_(std::move(state_lines)),
        notifier_(notifier) {}

  /// These are called by the thread of the signals.
  void AskToReload(pid_t asker);
  void AskToDump();

  /// Does what was asked for, on the thread of the steps.
  void Fulfil();

 private:
  ReloadAnswer Reload();

  Reloader reloader_;
  const std::function<void(const v1::Config&)> apply_;
  const std::function<std::vector<std::string>()> state_lines_;
  ServiceNotifier* const notifier_;
  std::mutex mutex_;
  std::vector<pid_t> askers_;  ///< Of a reload.
  bool dump_ = false;
};

}  // namespace collision::server
