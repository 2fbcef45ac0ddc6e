// What the service has of what a simulator wrote, and whose the simulator's name is.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "idl/messages.pb.h"

namespace collision::client {

/// What was written and is not in the service's report after this time is written again; after
/// twice the time once more, and so on up to the longest.
inline constexpr std::chrono::seconds kResendAfter(1);
inline constexpr std::chrono::seconds kResendAfterMax(8);

/// In lock-step, unless something was refused, so that it must come again. What is written again
/// while its first copy is lost on the way comes after what was written next, and a clock would
/// count before its states: so a service that only gets no processor is given more time. The
/// world's time stands meanwhile.
inline constexpr std::chrono::seconds kResendAfterInLockStep(120);

/// Compares the service's reports with what one program has written.
///
/// **Arrival.** A report counts the descriptions and states that have arrived. If it stays behind
/// what was written with some clock, everything is due to be sent again.
///
/// **The name.** A report of another program's run says who owns the name. While that program is
/// alive, this one waits; when it is gone, this one takes the next run, unless its own is higher
/// already, and everything is due. So the run is a number that the service knows best, and a host
/// whose clock is behind takes its turn like any other.
///
/// **Its end.** The service may have ended this program's run. If that was because it had not heard
/// of it, the program takes the next run; if an operator did it, nothing more counts.
///
/// Book-keeping only: neither clock nor network. One thread.
class Arrival {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `incarnation`: of this program, not 0.
  Arrival(std::uint32_t run, std::uint32_t incarnation, bool lock_step)
      : run_(run),
        incarnation_(incarnation),
        least_(lock_step ? kResendAfterInLockStep : kResendAfter) {}

  /// This program's run: the one it was made with, or the next one after another program's.
  std::uint32_t run() const { return run_; }
  std::uint32_t incarnation() const { return incarnation_; }

  /// A clock was written, after everything that it counts; `stated`: agents with a state sent.
  void Wrote(const v1::SimulatorClock& clock, std::uint32_t stated, Time now);

  /// A report on this simulator, by the service in force.
  void Hear(const v1::SimulatorReport& report, Time now);

  /// The service had no room for this simulator, and has taken nothing of what was written.
  void HearOfNoRoom() { refused_ = true; }

  /// Whether everything must be sent again. It then counts as sent.
  bool TakeDue(Time now);

  /// Whether that includes the shapes, which may be large: a service that is only late has them.
  bool with_shapes() const { return with_shapes_; }

  /// Whether another program of this name is alive and owns it.
  bool waits() const { return other_ && other_->alive(); }

  /// The report that names the other program; nullopt: the name is this one's, or nobody's.
  const std::optional<v1::SimulatorReport>& other() const { return other_; }

  /// An operator has ended this program's run; RUN_GOES_ON: none has.
  v1::RunEnd ended() const { return own_ ? own_->ended() : v1::RUN_GOES_ON; }

  /// What the service has of this program; nullopt: it has not said.
  const std::optional<v1::SimulatorReport>& own() const { return own_; }

 private:
  /// What had been written with a clock, and when.
  struct Written {
    std::uint64_t descriptions = 0;
    std::uint64_t states = 0;
    std::uint32_t stated = 0;
    Time at{};
  };

  bool IsBehind() const;
  /// A refusal says so.
  bool SomethingIsMissing() const;
  void Await(const Written& written, Time now);
  void HearOfOther(const v1::SimulatorReport& report);
  void TakeRunAfter(std::uint32_t run);

  std::uint32_t run_;
  std::uint32_t incarnation_;
  std::optional<v1::SimulatorReport> own_, other_;
  std::optional<Written> written_;  ///< With the newest clock.
  Written awaited_;                 ///< What the report must reach.
  bool reached_ = true;
  bool due_ = false;
  bool refused_ = false;  ///< As a whole, and not all has arrived since.
  bool with_shapes_ = false;
  std::chrono::seconds least_;  ///< Before something is written again for want of a report.
  std::chrono::seconds resend_after_ = kResendAfter;
};

/// A sentence for people: another program has the name, or had it in the last of all runs; empty if
/// it is free.
std::string OtherText(const std::string& simulator, const Arrival& arrival);

/// A sentence for people: an operator has ended this program's run; empty: none has.
std::string EndText(const std::string& simulator, const Arrival& arrival);

}  // namespace collision::client
