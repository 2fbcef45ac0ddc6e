#include "tests/repeat/slow_network.h"

#include <unistd.h>

#include <stdexcept>
#include <utility>

#include "tests/system/two_hosts.h"

namespace collision::repeat {

using system_test::InNamespace;
using system_test::Ip;

SlowNetwork::SlowNetwork(const std::string& cable, const CableFaults& faults) {
  const std::string name = "collision-" + std::to_string(getpid()) + "-";
  middle_ = name + "middle";
  for (int host : {0, 1}) hosts_[host] = name + std::to_string(host);
  try {
    for (const std::string& made : {middle_, hosts_[0], hosts_[1]}) Ip("netns add " + made);
    for (int host : {0, 1}) {
      const std::string end = "end-" + std::to_string(host), on_host = "-n " + hosts_[host];
      Ip("-n " + middle_ + " link add " + end + " type veth peer name cable netns " + hosts_[host]);
      Ip("-n " + middle_ + " link set " + end + " up");
      Ip(on_host + " address add 10.99.0." + std::to_string(host + 1) + "/24 dev cable");
      Ip(on_host + " link set lo up");
      Ip(on_host + " link set cable up");
    }
    carrier_ = std::make_unique<system_test::Process>(InNamespace(
        middle_, {cable, "end-0", "end-1", "--delay-min-s", std::to_string(faults.delay_min_s),
                  "--delay-max-s", std::to_string(faults.delay_max_s), "--loss",
                  std::to_string(faults.loss), "--seed", std::to_string(faults.seed)}));
    if (!carrier_->WaitForOutput("carries")) throw std::runtime_error(carrier_->err());
  } catch (...) {
    Remove();
    throw;
  }
}

SlowNetwork::~SlowNetwork() { Remove(); }

void SlowNetwork::Remove() {
  carrier_.reset();
  for (const std::string& made : {middle_, hosts_[0], hosts_[1]})
    system_test::RemoveNamespace(made);
}

std::vector<std::string> SlowNetwork::On(int host, std::vector<std::string> command) const {
  return InNamespace(hosts_[host], std::move(command));
}

}  // namespace collision::repeat
