// The truth that the programs flew against what they and the monitor were told. Shares no code with
// the service.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/faults/monitor_program.h"
#include "tests/faults/simulator_program.h"

namespace collision::faults {

struct JudgeOptions {
  std::int64_t base_ns = 0;  ///< The world's time when virtual time, or the run, is 0.
  /// The truth is worked out in doubles, and stamps are rounded.
  std::int64_t tolerance_ns = 200;
  /// What the service says of an agent that is added or jumps may take so long to be heard.
  std::int64_t hearing_ns = 0;
  double grazing = 1e-7;  ///< Overlaps below may go either way [m].
  /// In the world, less its base: contacts that begin then need no announcement, since the case
  /// keeps the service from it; what was promised of them must have been void or over.
  std::vector<std::pair<std::int64_t, std::int64_t>> unserved;
  /// Whether promises may be lowered: then only the last one before a contact counts.
  bool lowered = false;
};

struct Judgement {
  std::uint64_t contacts = 0;  ///< True ones.
  /// Of them, those that the case keeps from being announced, or that begin after a change of an
  /// agent and before that counts (Clearance::effective_from_ns), if it ever does: an agent may
  /// come and go within what others were granted.
  std::uint64_t unserved = 0;
  /// Of the latter, those that nobody was told of, not even afterwards.
  std::uint64_t untold = 0;
  std::uint64_t confirmed = 0;  ///< Of them, those that the monitor was told of as confirmed.
  std::uint64_t late = 0;       ///< Not announced before they began.
  std::uint64_t unheard = 0;    ///< Not heard in time by a program whose agent was in them.
  std::uint64_t relied = 0;     ///< Promises to their agents that covered their begin.
  std::uint64_t promises = 0;   ///< Held against a contact.
  std::uint64_t wrong_brackets = 0;
  std::uint64_t untrue = 0;       ///< Confirmed, and no contact.
  double notice_least_s = 1e300;  ///< From the announcement, published, to the begin.
  double begin_width_s = 0;       ///< The widest begin bracket of a confirmed contact, at the end.
  std::vector<std::string> failures;

  bool holds() const { return failures.empty(); }
};

Judgement Judge(const std::vector<const SimulatorProgram*>& programs, const MonitorProgram& monitor,
                const JudgeOptions& options);

}  // namespace collision::faults
