#include "client/programs/tools/collisionctl/agents_watcher.h"

#include <exception>
#include <random>
#include <utility>

namespace collision::client {

AgentsWatcher::AgentsWatcher(std::unique_ptr<Transport> transport, std::chrono::nanoseconds period)
    : transport_(std::move(transport)) {
  std::random_device source;
  const std::uint64_t high = source();
  watch_.set_watcher_id(high << 32 | source());
  watch_.set_period_ns(period.count());
  watch_.set_all(true);
}

AgentsWatcher::~AgentsWatcher() {
  try {
    Write(std::chrono::nanoseconds(0));
  } catch (const std::exception&) {
    // A destructor cannot report it. Without a network the lease ends it.
  }
}

void AgentsWatcher::Repeat(Time now) {
  if (written_ && now - *written_ < kRepeatPeriod) return;
  written_ = now;
  Write(kLease);
}

void AgentsWatcher::Write(std::chrono::nanoseconds lease) {
  v1::Input message;
  watch_.set_lease_ns(lease.count());
  *message.mutable_watch() = watch_;
  transport_->Write(message);
  transport_->Flush();
}

}  // namespace collision::client
