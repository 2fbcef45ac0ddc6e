// Log lines that name simulators.
#pragma once

#include <spdlog/common.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>

namespace collision::server {

/// Writes at most one line per second, as Log() does, but loses no name: the names that are
/// added in between stand in the next line. One thread.
class NamesLog {
 public:
  /// `line`: a format with one {} where the names go.
  explicit NamesLog(std::string line, spdlog::level::level_enum level = spdlog::level::warn)
      : line_(std::move(line)), level_(level) {}

  void Add(const std::string& name) { names_.insert(name); }

  /// Writes the names added since the last line, if a second has passed since then.
  void Write(std::int64_t monotonic_ns);

 private:
  const std::string line_;
  const spdlog::level::level_enum level_;
  std::set<std::string> names_;
  std::int64_t next_ns_ = INT64_MIN;
};

}  // namespace collision::server
