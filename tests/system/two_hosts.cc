#include "tests/system/two_hosts.h"

#include <unistd.h>

#include <sstream>
#include <stdexcept>

#include "tests/system/process.h"

namespace collision::system_test {
namespace {

std::vector<std::string> Words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

void Ip(const std::string& arguments) {
  const Outcome outcome = RunToEnd(Words(COLLISION_IP_PROGRAM " " + arguments));
  if (outcome.status != 0) throw std::runtime_error("ip " + arguments + ": " + outcome.err);
}

void RemoveNamespace(const std::string& name) {
  RunToEnd(Words(COLLISION_IP_PROGRAM " netns del " + name));
}

std::vector<std::string> InNamespace(const std::string& name, std::vector<std::string> command) {
  const auto prefix = Words(COLLISION_IP_PROGRAM " netns exec " + name);
  command.insert(command.begin(), prefix.begin(), prefix.end());
  return command;
}

TwoHosts::TwoHosts() {
  for (int host : {0, 1})
    names_[host] = "collision-" + std::to_string(getpid()) + "-" + std::to_string(host);
  try {
    for (const std::string& name : names_) Ip("netns add " + name);
    Ip("-n " + names_[0] + " link add cable type veth peer name cable netns " + names_[1]);
    for (int host : {0, 1}) {
      const std::string on_host = "-n " + names_[host];
      Ip(on_host + " address add 10.99.0." + std::to_string(host + 1) + "/24 dev cable");
      Ip(on_host + " link set lo up");
      Ip(on_host + " link set cable up");
    }
  } catch (...) {
    for (const std::string& name : names_) RemoveNamespace(name);
    throw;
  }
}

TwoHosts::~TwoHosts() {
  for (const std::string& name : names_) RemoveNamespace(name);
}

void TwoHosts::LoseMulticast(int host) const {
  const std::string rules =
      "table netdev lost { chain in { type filter hook ingress device \"cable\" priority 0; "
      "ip daddr 224.0.0.0/4 drop; }; }";
  const Outcome outcome = RunToEnd(InNamespace(host == 0 ? names_[0] : names_[1], {"nft", rules}));
  if (outcome.status != 0) throw std::runtime_error("nft: " + outcome.err);
}

void TwoHosts::Plug(bool in) const {
  Ip("-n " + names_[0] + (in ? " link set cable up" : " link set cable down"));
}

}  // namespace collision::system_test
