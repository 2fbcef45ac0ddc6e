// A well-behaved simulator in lock-step, on the simulated network.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "collision_core/detection/events/agent_id.h"
#include "tests/simulation/motion.h"
#include "tests/simulation/simulated_network.h"

namespace collision::server {

struct SimulatedAgent {
  double radius = 1;
  double margin = 0;
  double acceleration_max = 0;
  Motion motion;
  double position_error = 0;
  std::int64_t from_ns = 0;                                          ///< Admitted then.
  std::int64_t until_ns = std::numeric_limits<std::int64_t>::max();  ///< Removed then.
  std::string shape_bytes = {};  ///< As it travels; of one part. Empty: a ball. Shapes do not turn.
  std::function<void(v1::AgentDescription*)> declare =
      {};                                          ///< What else it declares; may be empty.
  std::function<void(v1::AgentState*)> tell = {};  ///< Likewise of each state.
};

struct SimulatorOptions {
  std::string name = "alpha";
  std::uint32_t run = 1;
  std::uint64_t sender = 1;
  std::int64_t start_ns = 0;             ///< Of its clock, in this run.
  std::int64_t period_ns = 100'000'000;  ///< States are sent at its multiples.
  std::int64_t end_ns = 10'000'000'000;
  std::uint32_t chunk_size = 64;
  bool removes_at_end = true;  ///< Else its agents stay and its clock stops there.
};

/// Agent i sits in slot i. Admissions, removals and jumps happen exactly at their times; after each
/// it waits until the service has seen them, since a later state would overwrite them.
class SimulatedSimulator {
 public:
  SimulatedSimulator(const SimulatorOptions& options, std::vector<SimulatedAgent> agents,
                     SimulatedNetwork* network);

  /// Writes the first samples after `delay_ns`.
  void Start(std::int64_t delay_ns = 0);

  /// Ends without a word.
  void Kill();

  std::uint64_t id() const { return id_; }
  detection::AgentId AgentAt(std::uint32_t slot) const { return {id_, slot, options_.run, 1}; }
  std::int64_t clock_ns() const { return clock_ns_; }
  bool finished() const { return finished_; }
  const std::vector<SimulatedAgent>& agents() const { return agents_; }
  const std::vector<v1::Rejection>& rejections() const { return rejections_; }
  /// A grant came that was less than one before.
  bool grant_withdrawn() const { return grant_withdrawn_; }

 private:
  void Hear(const v1::Output& output);
  void HearReport(const v1::SimulatorReport& report);
  void Continue();
  std::int64_t NextStop() const;
  std::uint32_t Incarnation() const { return static_cast<std::uint32_t>(options_.sender) << 16; }
  void PublishAt(std::int64_t clock_ns);
  void Describe(std::uint32_t slot);
  void Remove(std::uint32_t slot);
  void WriteShape(const std::string& bytes);
  void WriteChunks();
  void WriteClock();
  v1::AgentState StateOf(std::uint32_t slot);

  const SimulatorOptions options_;
  const std::uint64_t id_;
  std::vector<SimulatedAgent> agents_;
  SimulatedNetwork& network_;
  std::set<std::int64_t> stops_;
  std::set<std::uint32_t> present_;
  std::set<std::string> written_;                   ///< Hashes of shapes.
  std::map<std::uint32_t, std::uint64_t> awaited_;  ///< Slot -> sequence that must be acknowledged.
  std::int64_t clock_ns_ = 0;
  std::int64_t granted_ns_ = std::numeric_limits<std::int64_t>::min();
  std::uint64_t states_sequence_ = 0;
  std::uint64_t descriptions_sequence_ = 0;
  bool started_ = false;
  bool killed_ = false;
  bool finished_ = false;
  bool continuing_ = false;
  bool grant_withdrawn_ = false;
  std::vector<v1::Rejection> rejections_;
};

/// A description of an agent as the simulator would write it.
v1::AgentDescription DescriptionOf(const std::string& simulator, std::uint32_t run,
                                   std::uint32_t slot, const SimulatedAgent& agent);

}  // namespace collision::server
