// What most cases fly: three simulators of wandering balls, and what holds after each run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "tests/faults/scene.h"
#include "tests/support/suite/case.h"

namespace collision::faults {

/// Three simulators, alpha, beta and gamma, with different steps; gamma streams every state.
struct Fleet {
  v1::Config config = LockStepConfig(3);
  NetworkOptions network;
  std::uint64_t seed = 1;
  int agents = 6;  ///< Of each.
  std::function<std::vector<Flight>(int count, std::int64_t end_ns, Random*)> flights = Wanderers;
  std::int64_t end_ns = 10 * kSecond;
  bool lock_step = true;
  bool streams = false;          ///< All of them stream every state, ...
  std::int64_t pace = 1;         ///< ... at steps so many times as short ...
  std::uint32_t chunk_size = 0;  ///< ... in samples of so many agents; 0: the library decides.
  std::vector<std::int64_t> wall_offsets_ns = {0, 0, 0};
  bool keeps_journal = false;
  std::size_t strangers = 0;              ///< Agents that other programs may bring.
  std::int64_t limit_ns = 600 * kSecond;  ///< Virtual time in which the run must come to its end.
};

/// The bound on clocks of a wall fleet [ns].
inline constexpr std::int64_t kSkewNs = 20 * kMillisecond;
/// By wall clocks that are off by up to 0.9 of the bound, over a faulty network.
Fleet WallFleet(std::uint64_t seed);
/// What holds of it: within the bound, and once all have arrived.
JudgeOptions WallJudge();

/// All of them on one network with a service and a monitor, not yet started.
std::unique_ptr<Scene> MakeScene(const Fleet& fleet);

/// Starts them, lets `faults` arrange what is to happen, and runs to the end, which is expected.
void Fly(const Fleet& fleet, Scene* scene, const std::function<void()>& faults,
         suite::Outcome* outcome);

/// What the events of a lock-step run are known by.
struct Fingerprint {
  std::uint64_t hash = 0, count = 0;
  bool operator==(const Fingerprint&) const = default;
};
/// Of the same fleet on a perfect network, without any fault.
Fingerprint PerfectEvents(const Fleet& fleet);

/// Puts a judgement into the outcome: what must hold is checked, what was seen is counted.
void Report(const Judgement& judgement, std::uint64_t seed, suite::Outcome* outcome);

/// What the network did, and that no program took more memory than it may.
void ReportProgress(const Scene& scene, std::uint64_t seed, suite::Outcome* outcome,
                    std::size_t strangers = 0);

/// Every contact that the services published was heard, once and in order, and none counts as
/// missed.
void ExpectAllHeard(const MonitorProgram& monitor, std::uint64_t seed, suite::Outcome* outcome);

/// A run in lock-step that must have the events of a perfect network.
void FlyAsPerfect(const Fleet& fleet, const std::function<void(Scene*)>& faults,
                  suite::Outcome* outcome);

/// A scene in which nothing happens proves nothing.
void ExpectContacts(double in_each_run, suite::Outcome* outcome);

}  // namespace collision::faults
