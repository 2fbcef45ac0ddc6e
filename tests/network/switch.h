// A network switch in user space, whose links lose, delay, reorder and double what they carry.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/random.h"

namespace collision::network {

/// What happens to each frame on its way from the switch to one host. What the host sends meets the
/// faults of those to whom it sends.
struct LinkFaults {
  double loss = 0;         ///< Probability that the frame is lost.
  double duplication = 0;  ///< Probability that it arrives twice.
  double delay_min_s = 0;  ///< Drawn for each frame: unless both are equal,
  double delay_max_s = 0;  ///< frames overtake one another.
};

/// What has become of the frames so far, over all links.
struct FrameCounts {
  std::uint64_t delivered = 0;
  std::uint64_t lost = 0;        ///< By LinkFaults::loss.
  std::uint64_t doubled = 0;     ///< By LinkFaults::duplication.
  std::uint64_t unplugged = 0;   ///< A cable was out, or the receiver's device was not up.
  std::uint64_t overflowed = 0;  ///< Too many were on their way.
};

/// Forwards Ethernet frames between TAP devices on a thread of its own: to the port where the
/// address was last seen, or else to all others. One port for each host; a device may be moved to
/// another network namespace, and stays attached. The other members may be called from any thread.
class Switch {
 public:
  /// Frames that may be on their way at once; further ones are lost, and counted.
  static constexpr std::size_t kFramesMax = 50'000;
  /// Addresses that are remembered; frames to others go to all ports.
  static constexpr std::size_t kAddressesMax = 1024;

  /// Makes a TAP device of each name, of at most 15 characters, in the network namespace of the
  /// caller. Throws std::system_error where that is not allowed: it takes root. The same seed
  /// gives the same losses and delays for the same frames.
  Switch(const std::vector<std::string>& devices, std::uint64_t seed);
  Switch(const Switch&) = delete;
  Switch& operator=(const Switch&) = delete;
  ~Switch();

  /// From here on for this port, by its place among the devices.
  void SetFaults(std::size_t port, const LinkFaults& faults);

  /// Pulls the cable of a port out, or puts it back. What is on its way to it then is lost.
  void Plug(std::size_t port, bool in);

  FrameCounts counts() const;

 private:
  using Clock = std::chrono::steady_clock;
  using Address = std::array<unsigned char, 6>;

  struct Port {
    int descriptor = -1;
    bool plugged = true;
    LinkFaults faults = {};
  };
  struct Waiting {
    std::size_t port;
    std::vector<unsigned char> frame;
  };

  void Run(const std::stop_token& stop);
  void TakeFrom(std::size_t port);
  void Forward(std::size_t from, const std::vector<unsigned char>& frame);
  void Send(std::size_t to, const std::vector<unsigned char>& frame);
  void DeliverDue();
  Clock::duration UntilNext() const;

  mutable std::mutex mutex_;  ///< Guards all below but the thread.
  std::vector<Port> ports_;
  Random random_;
  std::map<Address, std::size_t> port_of_;
  std::multimap<Clock::time_point, Waiting> waiting_;  ///< By the time of arrival.
  FrameCounts counts_;
  std::vector<unsigned char> buffer_;
  std::jthread thread_;
};

}  // namespace collision::network
