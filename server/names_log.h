// Log lines that name simulators.
#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace collision::server {

/// Writes one warning per second at most, as Log() does, but loses no name: those that come in
/// between stand in the next line. One thread.
class NamesLog {
 public:
  /// `line`: where the names stand in it is {}.
  explicit NamesLog(std::string line) : line_(std::move(line)) {}

  void Add(const std::string& name) { names_.insert(name); }

  /// Writes the names added since the last line, if it is time for one.
  void Tell(std::int64_t monotonic_ns);

 private:
  const std::string line_;
  std::set<std::string> names_;
  std::int64_t next_ns_ = INT64_MIN;
};

}  // namespace collision::server
