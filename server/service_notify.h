// What systemd wants to know of a service of Type=notify.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace collision::server {

/// Speaks sd_notify's protocol over the datagram socket that NOTIFY_SOCKET names; without one it
/// does nothing. Twenty lines of our own instead of libsystemd. Used by one thread. Source:
/// sd_notify(3), systemd 252.
class ServiceNotifier {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID.
  ServiceNotifier();
  ~ServiceNotifier();
  ServiceNotifier(const ServiceNotifier&) = delete;
  ServiceNotifier& operator=(const ServiceNotifier&) = delete;

  void Ready() { Send("READY=1"); }
  void Stopping() { Send("STOPPING=1"); }

  /// To be called at every step; feeds the watchdog, if there is one, twice per period.
  void Alive(Time now);

 private:
  void Send(std::string_view message);

  int socket_ = -1;
  std::string address_;  // a path, or a name in the abstract space after a NUL
  std::chrono::microseconds watchdog_period_{0};
  Time fed_{};
};

}  // namespace collision::server
