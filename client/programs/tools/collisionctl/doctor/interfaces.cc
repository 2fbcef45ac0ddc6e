#include "client/programs/tools/collisionctl/doctor/interfaces.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>

#include <array>
#include <memory>

namespace collision::client {
namespace {

std::uint32_t AddressIn(const sockaddr* address) {
  return ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr);
}

}  // namespace

std::vector<Interface> InterfacesThatAreUp() {
  ifaddrs* first = nullptr;
  std::vector<Interface> interfaces;
  if (getifaddrs(&first) != 0) return interfaces;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  for (const ifaddrs* next = first; next != nullptr; next = next->ifa_next) {
    if (next->ifa_addr == nullptr || next->ifa_netmask == nullptr) continue;
    if (next->ifa_addr->sa_family != AF_INET || (next->ifa_flags & IFF_UP) == 0) continue;
    interfaces.push_back({.name = next->ifa_name,
                          .address = AddressIn(next->ifa_addr),
                          .mask = AddressIn(next->ifa_netmask),
                          .is_loopback = (next->ifa_flags & IFF_LOOPBACK) != 0,
                          .has_multicast = (next->ifa_flags & IFF_MULTICAST) != 0});
  }
  return interfaces;
}

std::uint32_t AddressOf(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1 ? ntohl(address.s_addr) : 0;
}

std::string AddressText(std::uint32_t address) {
  const in_addr in{htonl(address)};
  std::array<char, INET_ADDRSTRLEN> text{};
  return inet_ntop(AF_INET, &in, text.data(), text.size()) == nullptr ? "" : text.data();
}

}  // namespace collision::client
