// The network interfaces of this machine, and the ports of DDS on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace collision::client {

/// One IPv4 address of an interface that is up.
struct Interface {
  std::string name;
  std::uint32_t address = 0, mask = 0;  ///< Host byte order.
  bool is_loopback = false;
  bool has_multicast = false;
};

/// Source: getifaddrs(3).
std::vector<Interface> InterfacesThatAreUp();

/// Of "192.0.2.7"; 0: the text is no address.
std::uint32_t AddressOf(const std::string& text);
std::string AddressText(std::uint32_t address);

/// The first UDP port of a DDS domain. Source: DDSI-RTPS 2.3, 9.6.1.
constexpr std::uint32_t FirstPortOf(std::uint32_t domain) { return 7400 + 250 * domain; }

}  // namespace collision::client
