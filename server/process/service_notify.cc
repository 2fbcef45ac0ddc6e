#include "server/process/service_notify.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "server/process/logging.h"
#include "server/process/write_all.h"

namespace collision::server {
namespace {

std::string Environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

ServiceNotifier::ServiceNotifier() : address_(Environment("NOTIFY_SOCKET")) {
  if (address_.empty() || address_.size() > sizeof(sockaddr_un::sun_path)) return;
  if (address_[0] == '@') address_[0] = '\0';
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const std::string process = Environment("WATCHDOG_PID");
  if (!process.empty() && process != std::to_string(getpid())) return;
  watchdog_period_ = std::chrono::microseconds(std::atoll(Environment("WATCHDOG_USEC").c_str()));
}

ServiceNotifier::~ServiceNotifier() {
  if (socket_ >= 0) close(socket_);
}

void ServiceNotifier::Alive(Time now) {
  if (watchdog_period_.count() <= 0 || now - fed_ < watchdog_period_ / 2) return;
  fed_ = now;
  Send("WATCHDOG=1");
}

void ServiceNotifier::Tell(std::string_view line, Time now) {
  told_ = now;
  Send("STATUS=" + std::string(line));
}

void ServiceNotifier::Send(std::string_view message) {
  if (socket_ < 0) return;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, address_.data(), address_.size());
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  // Never waits: a service manager that does not listen must not hold up the world.
  const ssize_t sent = sendto(socket_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                              reinterpret_cast<const sockaddr*>(&address), length);
  if (sent < 0) {
    Log(spdlog::level::warn, "service manager not notified",
        fmt::format("{}: {}", message, CauseOf(errno)));
  }
}

}  // namespace collision::server
