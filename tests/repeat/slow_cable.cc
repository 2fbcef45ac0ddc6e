#include "tests/repeat/slow_cable.h"

#include <arpa/inet.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <map>
#include <system_error>
#include <vector>

#include "client/programs/shared/stop_signal.h"
#include "tests/support/random.h"

namespace collision::repeat {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kFrameMax = 65536 + 128;  // an unsegmented datagram and its headers
constexpr std::chrono::milliseconds kStopCheck{50};

[[noreturn]] void Throw(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// One end of the cable: a packet socket on a device.
class End {
 public:
  explicit End(const std::string& device)
      : socket_(socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, htons(ETH_P_ALL))) {
    if (socket_ < 0) Throw("packet socket");
    // Each frame has in front of it what the kernel still has to do: between namespaces it leaves
    // checksums out, and fills them in only where it is told so again.
    const int on = 1;
    if (setsockopt(socket_, SOL_PACKET, PACKET_VNET_HDR, &on, sizeof on) != 0) Throw(device);
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_ALL);
    address.sll_ifindex = static_cast<int>(if_nametoindex(device.c_str()));
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) Throw(device);
  }
  End(const End&) = delete;
  End& operator=(const End&) = delete;
  ~End() { close(socket_); }

  int descriptor() const { return socket_; }

  /// The next frame that came from outside; empty: none waits.
  std::vector<char> Receive() {
    for (;;) {
      sockaddr_ll from{};
      socklen_t length = sizeof from;
      const ssize_t size = recvfrom(socket_, buffer_.data(), buffer_.size(), 0,
                                    reinterpret_cast<sockaddr*>(&from), &length);
      if (size < 0 && errno == EINTR) continue;
      if (size < 0) return {};
      if (from.sll_pkttype == PACKET_OUTGOING) continue;
      return {buffer_.begin(), buffer_.begin() + size};
    }
  }

  /// A frame that the device does not take is lost, as on any cable.
  void Send(const std::vector<char>& frame) {
    if (send(socket_, frame.data(), frame.size(), 0) < 0) ++refused_;
  }

  std::uint64_t refused() const { return refused_; }

 private:
  int socket_;
  std::vector<char> buffer_ = std::vector<char>(kFrameMax);
  std::uint64_t refused_ = 0;
};

struct Waiting {
  End* to;
  std::vector<char> frame;
};

}  // namespace

void CarryFrames(const std::string& device_a, const std::string& device_b,
                 const CableFaults& faults) {
  End a(device_a), b(device_b);
  std::printf("carries\n");
  std::fflush(stdout);
  Random random(faults.seed);
  std::multimap<Clock::time_point, Waiting> waiting;
  unsigned long long carried = 0, lost = 0;
  const auto take_from = [&](End* from, End* to) {
    for (auto frame = from->Receive(); !frame.empty(); frame = from->Receive()) {
      if (random.Chance(faults.loss)) {
        ++lost;
        continue;
      }
      const double delay_s = random.Uniform(faults.delay_min_s, faults.delay_max_s);
      const auto delay =
          std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(delay_s));
      waiting.emplace(Clock::now() + delay, Waiting{to, std::move(frame)});
    }
  };
  while (!client::StopRequested()) {
    const auto now = Clock::now();
    for (; !waiting.empty() && waiting.begin()->first <= now; waiting.erase(waiting.begin())) {
      waiting.begin()->second.to->Send(waiting.begin()->second.frame);
      ++carried;
    }
    Clock::duration patience = kStopCheck;
    if (!waiting.empty()) patience = std::min(patience, waiting.begin()->first - now);
    const auto seconds = std::chrono::floor<std::chrono::seconds>(patience);
    const timespec timeout{seconds.count(), std::chrono::nanoseconds(patience - seconds).count()};
    pollfd ends[] = {{a.descriptor(), POLLIN, 0}, {b.descriptor(), POLLIN, 0}};
    ppoll(ends, 2, &timeout, nullptr);
    take_from(&a, &b);
    take_from(&b, &a);
  }
  std::printf("frames: %llu carried, %llu lost, %llu refused\n", carried, lost,
              static_cast<unsigned long long>(a.refused() + b.refused()));
}

}  // namespace collision::repeat
