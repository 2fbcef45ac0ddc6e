// Log lines that name simulators.
#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace collision::server {

/// Writes at most one warning per second, as Log() does, but loses no name: the names that are
/// added in between stand in the next line. One thread.
class NamesLog {
 public:
  /// `line`: a format with one {} where the names go.
  explicit NamesLog(std::string line) : line_(std::move(line)) {}

  void Add(const std::string& name) { names_.insert(name); }

  /// Writes the names added since the last line, if a second has passed since then.
  void Write(std::int64_t monotonic_ns);

 private:
  const std::string line_;
  std::set<std::string> names_;
  std::int64_t next_ns_ = INT64_MIN;
};

}  // namespace collision::server
