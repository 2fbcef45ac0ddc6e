#include "server/process/names_log.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <chrono>

#include "server/process/logging.h"

namespace collision::server {

void NamesLog::Write(std::int64_t monotonic_ns) {
  if (names_.empty() || monotonic_ns < next_ns_) return;
  const std::string names = fmt::format("\"{}\"", fmt::join(names_, "\", \""));
  spdlog::log(level_, fmt::runtime(line_), names);
  names_.clear();
  next_ns_ = monotonic_ns + std::chrono::nanoseconds(kMatterPeriod).count();
}

}  // namespace collision::server
