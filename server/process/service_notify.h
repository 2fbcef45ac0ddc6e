// Notifies systemd of the state of a service of Type=notify.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace collision::server {

/// Speaks sd_notify's protocol over the datagram socket that NOTIFY_SOCKET names; without one it
/// does nothing. It needs no libsystemd. A message that cannot be sent at once is dropped and
/// logged: a service manager that does not listen must not hold up the world. One thread.
/// Source: sd_notify(3), systemd 252.
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
  void Reloading() { Send("RELOADING=1"); }

  /// Whether a line for people is due: somebody listens, and the last one is 2 s old.
  bool WantsStatus(Time now) const {
    return socket_ >= 0 && now - told_ >= std::chrono::seconds(2);
  }

  /// One line for people, without a newline: what `systemctl status` shows.
  void Tell(std::string_view line, Time now);

  /// Feeds the watchdog, if there is one, twice per period. Call it at every step.
  void Alive(Time now);

 private:
  void Send(std::string_view message);

  int socket_ = -1;
  std::string address_;  ///< A path, or a NUL and a name in the abstract namespace.
  std::chrono::microseconds watchdog_period_{0};
  Time fed_{};
  Time told_{};
};

}  // namespace collision::server
