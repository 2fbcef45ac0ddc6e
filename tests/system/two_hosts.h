// Two hosts on one machine: network namespaces joined by a cable.
#pragma once

#include <string>
#include <vector>

namespace collision::system_test {

/// Made at the start, removed at the end. Needs root. Addresses 10.99.0.1 and 10.99.0.2 exist
/// inside only.
class TwoHosts {
 public:
  /// Throws std::runtime_error, with what `ip` said, if it is not allowed.
  TwoHosts();
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;
  ~TwoHosts();

  /// The command, to be run on host 0 or 1.
  std::vector<std::string> On(int host, std::vector<std::string> command) const;

  /// Pulls the cable out, or puts it back.
  void Plug(bool in) const;

 private:
  std::string names_[2];
};

}  // namespace collision::system_test
