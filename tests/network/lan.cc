#include "tests/network/lan.h"

#include <unistd.h>

#include <cmath>
#include <exception>
#include <stdexcept>

#include "tests/system/process.h"
#include "tests/system/two_hosts.h"

namespace collision::network {
namespace {

using system_test::Ip;

constexpr char kDevice[] = "lan";  // its name on every host
constexpr int kLossUnit = 1000;    // nftables draws whole numbers

}  // namespace

Lan::Lan(std::size_t hosts, std::uint64_t seed) {
  const std::string process = std::to_string(getpid());
  std::vector<std::string> devices;
  for (std::size_t host = 0; host < hosts; ++host) {
    hosts_.push_back("collision-" + process + "-" + std::to_string(host));
    devices.push_back("tap" + process + "-" + std::to_string(host));
  }
  try {
    switch_ = std::make_unique<Switch>(devices, seed);
    for (std::size_t host = 0; host < hosts; ++host) {
      const std::string on_host = "-n " + hosts_[host];
      Ip("netns add " + hosts_[host]);
      Ip("link set " + devices[host] + " netns " + hosts_[host]);
      Ip(on_host + " link set " + devices[host] + " name " + kDevice);
      Ip(on_host + " address add 10.99.0." + std::to_string(host + 1) + "/24 dev " + kDevice);
      Ip(on_host + " link set lo up");
      Ip(on_host + " link set " + kDevice + " txqueuelen 10000 up");
    }
  } catch (...) {
    Remove();
    throw;
  }
}

Lan::~Lan() { Remove(); }

void Lan::Remove() {
  for (const std::string& host : hosts_) system_test::RemoveNamespace(host);
}

void Lan::SetFaults(const LinkFaults& faults) {
  for (std::size_t host = 0; host < hosts_.size(); ++host) switch_->SetFaults(host, faults);
}

void Lan::LoseAtHosts(double probability) const {
  const std::string of_unit = std::to_string(std::lround(probability * kLossUnit));
  const std::string rules =
      std::string("table netdev faults { chain arrivals { type filter hook ") +
      "ingress device \"" + kDevice + "\" priority 0; numgen random mod " +
      std::to_string(kLossUnit) + " < " + of_unit + " counter drop; }; }";
  for (const std::string& host : hosts_) {
    const system_test::Outcome outcome =
        system_test::RunToEnd(system_test::InNamespace(host, {COLLISION_NFT_PROGRAM, rules}));
    if (outcome.status != 0) throw std::runtime_error("nft: " + outcome.err);
  }
}

std::string WhyNoLan() {
  try {
    Lan(1, 0).LoseAtHosts(0.5);
    return "";
  } catch (const std::exception& error) {
    return std::string("no hosts can be made: ") + error.what() +
           " (that takes root, /dev/net/tun, iproute2 and nftables)";
  }
}

}  // namespace collision::network
