#include "server/service/requests/signal_requests.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <string>
#include <utility>

#include "server/process/logging.h"

namespace collision::server {
namespace {

std::string Listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

void SignalRequests::AskToReload(pid_t asker) {
  const std::lock_guard lock(mutex_);
  askers_.push_back(asker);
}

void SignalRequests::AskToDump() {
  const std::lock_guard lock(mutex_);
  dump_ = true;
}

void SignalRequests::Fulfil() {
  std::vector<pid_t> askers;
  bool dump = false;
  {
    const std::lock_guard lock(mutex_);
    askers.swap(askers_);
    dump = std::exchange(dump_, false);
  }
  if (!askers.empty()) {
    notifier_->Reloading();
    const ReloadAnswer answer = Reload();
    notifier_->Ready();
    for (const pid_t asker : askers) AnswerReload(asker, answer);
  }
  if (!dump) return;
  for (const std::string& line : state_lines_()) spdlog::info("state: {}", line);
}

ReloadAnswer SignalRequests::Reload() {
  const Reloaded reloaded = reloader_.Read();
  for (const std::string& error : reloaded.errors) spdlog::error("not reloaded: {}", error);
  if (!reloaded.accepted) {
    spdlog::error("the configuration stays as it was");
    return ReloadAnswer::kRefused;
  }
  try {
    StartLogging(LogOptionsOf(reloaded.config));
  } catch (const std::exception& error) {
    spdlog::error("not reloaded: log_file: {}; the log stays where it was", error.what());
    return ReloadAnswer::kRefused;
  }
  if (apply_) apply_(reloaded.config);
  reloader_.Commit(reloaded.config);
  const std::string changed = Listed(reloaded.changed);
  spdlog::info("reloaded: {}", changed.empty() ? "nothing has changed" : changed);
  if (reloaded.unchanged.empty()) return ReloadAnswer::kDone;
  spdlog::warn("takes a new start to change: {}", Listed(reloaded.unchanged));
  return ReloadAnswer::kDoneInPart;
}

}  // namespace collision::server
