// What was seen of the motion of agents: states of a run, or rows of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "collision/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// The part of a state that bounds are derived from.
struct MotionSample {
  std::int64_t stamp_ns = 0;
  Vector3 position_m{};
  Vector3 velocity_m_s{};
  Quaternion orientation{1, 0, 0, 0};
  Vector3 angular_velocity_rad_s{};
  bool discontinuity = false;
};

/// What its owner declares about the motion.
struct DeclaredBounds {
  double acceleration_max_m_s2 = 0;
  double jerk_max_m_s3 = 0;
};

struct SampledAgent {
  std::string simulator = {};  ///< Empty for a file of rows.
  std::string name = {};
  std::optional<DeclaredBounds> declared = {};  ///< As described last.
  bool has_velocities = true;
  std::vector<MotionSample> samples = {};  ///< Stamps strictly increase.
};

/// Collects the samples of agents from the messages that simulators send.
class MotionSamples {
 public:
  /// In all; further ones are dropped, and `full()` says so.
  static constexpr std::size_t kSamplesMax = 5'000'000;

  void Take(const v1::AgentDescription& description);

  /// States that no sender may send are counted and left out. So are those that are not newer than
  /// the agent's last: a sample carries what it carried before, too.
  void Take(const v1::AgentStates& states);

  bool full() const { return samples_ >= kSamplesMax; }
  std::size_t samples() const { return samples_; }

  /// How many states were left out because a value is out of range, and what the first of them
  /// was: "agent arm-1: position_m.x: nan, allowed: ...".
  std::size_t refused() const { return refused_; }
  const std::string& first_refusal() const { return first_refusal_; }

  /// Of agents with a sample at least, by simulator and slot.
  std::vector<SampledAgent> Agents() const;

 private:
  /// Simulator, run, slot and generation.
  using Key = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t, std::uint32_t>;

  std::map<Key, SampledAgent> agents_;
  std::size_t samples_ = 0;
  std::size_t refused_ = 0;
  std::string first_refusal_;
};

}  // namespace collision::client
