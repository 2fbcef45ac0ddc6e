// Runs of simulators that the service has ended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace collision::server {

/// Why a run was ended by the service.
enum class EndCause {
  kSilent,     ///< Its simulator was silent for `remove_silent_after_s`.
  kEvicted,    ///< An operator removed its simulator.
  kRestarted,  ///< An operator let the world's time begin anew.
  kRefused     ///< Its hello does not fit the service.
};

/// As in the extension `because` of an event: "silent", "evicted", "restarted", "refused".
const char* NameOf(EndCause cause);

/// A run of a simulator that has been ended.
struct EndedRun {
  std::uint64_t simulator = 0;
  std::uint32_t run = 0;
  EndCause cause = EndCause::kSilent;

  friend bool operator==(const EndedRun&, const EndedRun&) = default;
};

/// The runs in a text of EndedRuns::TakeTurn(); what is none is left out.
std::vector<EndedRun> EndedRunsIn(const std::string& text);

/// Of each simulator the highest run that the service has ended. What still comes of that run, or a
/// lower one, is refused; a higher run is welcome. It remembers kEndedRunsMax simulators; beyond,
/// the one that was ended first is forgotten: what it goes on writing is then taken as that of a
/// newcomer, whose states nobody has described. One thread.
class EndedRuns {
 public:
  void Add(std::uint64_t simulator, std::uint32_t run, EndCause cause);

  /// Why exactly this run was ended; nullopt: it was not.
  std::optional<EndCause> Find(std::uint64_t simulator, std::uint32_t run) const;

  /// Why a message of this run is refused, with the allowed range; nullopt: it is not.
  std::optional<std::string> Refusal(std::uint64_t simulator, std::uint32_t run) const;

  /// For a standby, which may have come later: "SIMULATOR:RUN:CAUSE, ...", at most so many bytes.
  /// Each call goes on after the last one, so that in turn all are told.
  std::string TakeTurn(std::size_t bytes);

  std::size_t size() const { return ended_.size(); }
  std::uint64_t count(EndCause cause) const;  ///< Of all runs ended so far for this cause.

 private:
  struct Ended {
    std::uint32_t run = 0;
    EndCause cause = EndCause::kSilent;
    std::uint64_t number = 0;  ///< In the order in which they were ended.
  };

  std::map<std::uint64_t, Ended> ended_;          ///< By simulator.
  std::map<std::uint64_t, std::uint64_t> order_;  ///< Simulators by number.
  std::uint64_t told_ = 0;                        ///< The number told last.
  std::uint64_t count_ = 0;
  std::map<EndCause, std::uint64_t> counts_;
};

/// Simulators whose ended runs are remembered.
inline constexpr std::size_t kEndedRunsMax = 4096;

}  // namespace collision::server
