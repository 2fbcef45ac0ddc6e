#include "tests/network/switch.h"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace collision::network {
namespace {

constexpr std::size_t kHeader = 14;            // of an Ethernet frame
constexpr std::size_t kFrameMax = 65536;       // more than any device sends
constexpr std::chrono::milliseconds kIdle{2};  // also the longest time to see the end

[[noreturn]] void Throw(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

int MakeTap(const std::string& name) {
  const int descriptor = open("/dev/net/tun", O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) Throw("/dev/net/tun");
  ifreq request{};
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  name.copy(request.ifr_name, IFNAMSIZ - 1);
  if (ioctl(descriptor, TUNSETIFF, &request) == 0) return descriptor;
  const int error = errno;
  close(descriptor);
  errno = error;
  Throw(name);
}

}  // namespace

Switch::Switch(const std::vector<std::string>& devices, std::uint64_t seed)
    : random_(seed), buffer_(kFrameMax) {
  try {
    for (const std::string& device : devices) ports_.push_back({.descriptor = MakeTap(device)});
  } catch (...) {
    for (const Port& port : ports_) close(port.descriptor);
    throw;
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

Switch::~Switch() {
  thread_.request_stop();
  thread_.join();
  for (const Port& port : ports_) close(port.descriptor);
}

void Switch::SetFaults(std::size_t port, const LinkFaults& faults) {
  const std::scoped_lock lock(mutex_);
  ports_.at(port).faults = faults;
}

void Switch::Plug(std::size_t port, bool in) {
  const std::scoped_lock lock(mutex_);
  ports_.at(port).plugged = in;
  std::erase_if(waiting_, [&](const auto& entry) {
    const bool to_port = entry.second.port == port;
    counts_.unplugged += to_port;
    return to_port;
  });
  int carrier = in;
  if (ioctl(ports_[port].descriptor, TUNSETCARRIER, &carrier) != 0) Throw("TUNSETCARRIER");
}

FrameCounts Switch::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

void Switch::Run(const std::stop_token& stop) {
  std::vector<pollfd> ready;
  for (const Port& port : ports_) ready.push_back({port.descriptor, POLLIN, 0});
  while (!stop.stop_requested()) {
    Clock::duration patience{};
    {
      const std::scoped_lock lock(mutex_);
      DeliverDue();
      patience = UntilNext();
    }
    const timespec timeout{0, std::chrono::nanoseconds(patience).count()};
    if (ppoll(ready.data(), ready.size(), &timeout, nullptr) <= 0) continue;
    const std::scoped_lock lock(mutex_);
    for (std::size_t port = 0; port < ports_.size(); ++port) {
      if (ready[port].revents != 0) TakeFrom(port);
    }
  }
}

void Switch::TakeFrom(std::size_t port) {
  for (;;) {
    const ssize_t size = read(ports_[port].descriptor, buffer_.data(), buffer_.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < static_cast<ssize_t>(kHeader)) return;
    Forward(port, {buffer_.begin(), buffer_.begin() + size});
  }
}

void Switch::Forward(std::size_t from, const std::vector<unsigned char>& frame) {
  if (!ports_[from].plugged) {
    ++counts_.unplugged;
    return;
  }
  Address to{}, sender{};
  std::copy_n(frame.begin(), to.size(), to.begin());
  std::copy_n(frame.begin() + to.size(), sender.size(), sender.begin());
  if (port_of_.size() < kAddressesMax || port_of_.contains(sender)) port_of_[sender] = from;
  if (const auto known = port_of_.find(to); known != port_of_.end()) {
    if (known->second != from) Send(known->second, frame);
    return;
  }
  for (std::size_t port = 0; port < ports_.size(); ++port) {
    if (port != from) Send(port, frame);
  }
}

void Switch::Send(std::size_t to, const std::vector<unsigned char>& frame) {
  const auto& [descriptor, plugged, faults] = ports_[to];
  if (!plugged) {
    ++counts_.unplugged;
    return;
  }
  if (random_.Chance(faults.loss)) {
    ++counts_.lost;
    return;
  }
  const bool twice = random_.Chance(faults.duplication);
  counts_.doubled += twice;
  for (int copy = 0; copy < (twice ? 2 : 1); ++copy) {
    if (waiting_.size() >= kFramesMax) {
      ++counts_.overflowed;
      return;
    }
    const std::chrono::duration<double> delay(
        random_.Uniform(faults.delay_min_s, faults.delay_max_s));
    waiting_.emplace(Clock::now() + std::chrono::duration_cast<Clock::duration>(delay),
                     Waiting{to, frame});
  }
}

void Switch::DeliverDue() {
  const auto now = Clock::now();
  for (; !waiting_.empty() && waiting_.begin()->first <= now; waiting_.erase(waiting_.begin())) {
    const auto& [port, frame] = waiting_.begin()->second;
    const bool taken = write(ports_[port].descriptor, frame.data(), frame.size()) > 0;
    ++(taken ? counts_.delivered : counts_.unplugged);
  }
}

Switch::Clock::duration Switch::UntilNext() const {
  if (waiting_.empty()) return kIdle;
  return std::clamp<Clock::duration>(waiting_.begin()->first - Clock::now(), Clock::duration(0),
                                     kIdle);
}

}  // namespace collision::network
