// How long a simulator waits for a grant.
#pragma once

#include <chrono>
#include <cstdint>

namespace collision::client {

/// So long without a grant or a reason, and a simulator gives up.
inline constexpr std::chrono::seconds kGrantTimeout{120};

/// While the service says whom or what time waits for, it is the service's policy how long: a
/// large shape may take minutes, a debugger hours. Only a wait without a reason comes to an end.
class GrantPatience {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  GrantPatience(std::int64_t granted_ns, Wall now)
      : granted_ns_(granted_ns), until_(now + kGrantTimeout) {}

  /// Whether to wait on; `has_reason`: the service is there and names one.
  bool Lasts(std::int64_t granted_ns, bool has_reason, Wall now) {
    if (granted_ns != granted_ns_ || has_reason) until_ = now + kGrantTimeout;
    granted_ns_ = granted_ns;
    return now <= until_;
  }

 private:
  std::int64_t granted_ns_;
  Wall until_;
};

}  // namespace collision::client
