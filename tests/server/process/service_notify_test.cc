#include "server/process/service_notify.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace collision::server {
namespace {

using Time = ServiceNotifier::Time;

/// A service manager's end of the socket. `address` with '@' first is in the abstract space.
class Manager {
 public:
  explicit Manager(std::string address) : address_(std::move(address)) {
    setenv("NOTIFY_SOCKET", address_.c_str(), 1);
    unsetenv("WATCHDOG_USEC");
    unsetenv("WATCHDOG_PID");
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    std::memcpy(name.sun_path, address_.data(), address_.size());
    if (address_[0] == '@') name.sun_path[0] = '\0';
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&name), length), 0);
  }
  ~Manager() {
    close(socket_);
    unlink(address_.c_str());
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    unsetenv("WATCHDOG_PID");
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  /// The next message, which has arrived already; empty: none.
  std::string Next() {
    char message[256];
    const ssize_t size = recv(socket_, message, sizeof message, MSG_DONTWAIT);
    return size < 0 ? "" : std::string(message, static_cast<std::size_t>(size));
  }

 private:
  std::string address_;
  int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

std::string SomePath() { return testing::TempDir() + "notify." + std::to_string(getpid()); }

// Goal:   the messages are those of sd_notify, on a path and in the abstract space.
TEST(ServiceNotifier, TellsTheManager) {
  for (const std::string& address : {SomePath(), "@collision." + std::to_string(getpid())}) {
    Manager manager(address);
    ServiceNotifier notifier;
    const Time now = Time{} + std::chrono::hours(1);
    EXPECT_TRUE(notifier.WantsStatus(now));
    notifier.Tell("3 simulators", now);
    EXPECT_EQ(manager.Next(), "STATUS=3 simulators");
    EXPECT_FALSE(notifier.WantsStatus(now + std::chrono::seconds(1)));
    EXPECT_TRUE(notifier.WantsStatus(now + std::chrono::seconds(2)));
    notifier.Reloading();
    EXPECT_EQ(manager.Next(), "RELOADING=1");
    notifier.Ready();
    EXPECT_EQ(manager.Next(), "READY=1");
    notifier.Stopping();
    EXPECT_EQ(manager.Next(), "STOPPING=1");
    notifier.Alive(Time(std::chrono::hours(1)));
    EXPECT_EQ(manager.Next(), "") << "no watchdog was asked for";
  }
}

// Goal:   the watchdog is fed at the first step and then twice per period, not at every step.
TEST(ServiceNotifier, FeedsTheWatchdog) {
  Manager manager(SomePath());
  setenv("WATCHDOG_USEC", "2000000", 1);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  ServiceNotifier notifier;
  const Time start(std::chrono::hours(1));
  notifier.Alive(start);
  EXPECT_EQ(manager.Next(), "WATCHDOG=1");
  notifier.Alive(start + std::chrono::milliseconds(999));
  EXPECT_EQ(manager.Next(), "");
  notifier.Alive(start + std::chrono::milliseconds(1000));
  EXPECT_EQ(manager.Next(), "WATCHDOG=1");
  EXPECT_EQ(manager.Next(), "");
}

// Goal:   a watchdog meant for another process is not fed, and without a manager nothing happens.
TEST(ServiceNotifier, IsQuietWhenNotAddressed) {
  {
    Manager manager(SomePath());
    setenv("WATCHDOG_USEC", "2000000", 1);
    setenv("WATCHDOG_PID", "1", 1);
    ServiceNotifier notifier;
    notifier.Alive(Time(std::chrono::hours(1)));
    EXPECT_EQ(manager.Next(), "");
  }
  ServiceNotifier notifier;
  notifier.Ready();
  notifier.Alive(Time(std::chrono::hours(1)));
}

}  // namespace
}  // namespace collision::server
