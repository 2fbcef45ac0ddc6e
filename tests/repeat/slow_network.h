// Two hosts on one machine, joined by a slow cable.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/repeat/slow_cable.h"
#include "tests/system/process.h"

namespace collision::repeat {

/// Three network namespaces: the two hosts, and between them one in which a process carries the
/// frames. Made at the start, removed at the end. Needs root.
class SlowNetwork {
 public:
  /// `cable` is the program slow-cable. Throws std::runtime_error if it is not allowed.
  SlowNetwork(const std::string& cable, const CableFaults& faults);
  SlowNetwork(const SlowNetwork&) = delete;
  SlowNetwork& operator=(const SlowNetwork&) = delete;
  ~SlowNetwork();

  /// The command, to be run on host 0 or 1.
  std::vector<std::string> On(int host, std::vector<std::string> command) const;

 private:
  void Remove();

  std::string middle_;
  std::string hosts_[2];
  std::unique_ptr<system_test::Process> carrier_;
};

}  // namespace collision::repeat
