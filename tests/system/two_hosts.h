// Two hosts on one machine: network namespaces joined by a cable.
#pragma once

#include <string>
#include <vector>

namespace collision::system_test {

/// Runs `ip` (iproute2) with these words. Throws std::runtime_error, with what it said, if it
/// fails.
void Ip(const std::string& arguments);

/// Removes a network namespace, if there is one of that name.
void RemoveNamespace(const std::string& name);

/// The command, to be run in a network namespace.
std::vector<std::string> InNamespace(const std::string& name, std::vector<std::string> command);

/// Made at the start, removed at the end. Needs root. Addresses 10.99.0.1 and 10.99.0.2 exist
/// inside only.
class TwoHosts {
 public:
  /// Throws std::runtime_error, with what `ip` said, if it is not allowed.
  TwoHosts();
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;
  ~TwoHosts();

  /// The network namespace of host 0 or 1.
  const std::string& host(int index) const { return names_[index]; }

  /// From here on what others send to groups does not arrive at this host.
  void LoseMulticast(int host) const;

  /// Pulls the cable out, or puts it back.
  void Plug(bool in) const;

 private:
  std::string names_[2];
};

}  // namespace collision::system_test
