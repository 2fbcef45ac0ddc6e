// Reading the configuration anew while the service runs.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "idl/config.pb.h"
#include "server/config/config.h"
#include "server/process/logging.h"

namespace collision::server {

/// Whether a field can change while the service runs: how it logs, and how much of what happens it
/// keeps (but whether it keeps any, which changes from or to 0, takes a new start). Answers depend
/// on most others: a recording, which holds the configuration of its start, is to give the same
/// events.
bool CanChange(std::string_view path, std::string_view before, std::string_view after);

/// How a complete configuration wants the log.
LogOptions LogOptionsOf(const v1::Config& config);

/// What came of it.
struct Reloaded {
  bool accepted = false;                  ///< False: the file is wrong, and nothing has changed.
  std::vector<std::string> changed = {};  ///< "log_level: info -> debug"
  /// Fields that differ from those in force and take a new start.
  std::vector<std::string> unchanged = {};
  std::vector<std::string> errors = {};  ///< Unless accepted: as of LoadConfig().
  v1::Config config = {};                ///< If accepted: what is to be in force, for Commit().
};

/// Holds the configuration in force. One thread.
class Reloader {
 public:
  /// `load`: reads it as the start did, command line and environment included; null: there is no
  /// file, and nothing changes.
  Reloader(v1::Config in_force, std::function<ConfigResult()> load)
      : in_force_(std::move(in_force)), load_(std::move(load)) {}

  /// Reads it and compares; nothing changes before Commit().
  Reloaded Read() const;

  /// Once all that has changed is in force.
  void Commit(v1::Config config) { in_force_ = std::move(config); }

  const v1::Config& in_force() const { return in_force_; }

 private:
  v1::Config in_force_;
  std::function<ConfigResult()> load_;
};

}  // namespace collision::server
