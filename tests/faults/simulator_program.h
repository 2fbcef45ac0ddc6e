// A simulator on the faulty network: the real client library, flying known motions.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "collision/world.h"
#include "tests/faults/service_program.h"
#include "tests/simulation/motion.h"

namespace collision::faults {

using server::Motion;

inline constexpr std::int64_t kAlways = std::numeric_limits<std::int64_t>::min();

/// What an agent declares from an instant on.
struct Declaration {
  std::int64_t at_ns;
  double acceleration_max;
};

/// What one agent does in truth. Instants are those of the world, less its base.
struct Flight {
  Motion motion;
  double radius = 1;
  double acceleration_max = 0;
  std::int64_t from_ns = 0;                ///< Added at the first step from then on ...
  std::int64_t until_ns = client::kNever;  ///< ... and removed at the first from then on.
  std::vector<Declaration> changes = {};   ///< Of `acceleration_max`, in their order.
  std::shared_ptr<const client::Shape> shape = nullptr;  ///< Of the same points as the ball.
};

struct SimulatorOptions {
  std::string name = "alpha";
  bool lock_step = true;
  std::uint32_t run = 1;
  std::uint32_t incarnation = 1;
  std::int64_t period_ns = 100 * kMillisecond;
  std::int64_t start_ns = 0;  ///< First step.
  std::int64_t end_ns = 10 * kSecond;
  bool on_demand = true;
  std::uint32_t chunk_size = 0;  ///< As in client::ConnectOptions.
  bool joins = false;            ///< Lock-step: comes later, asks what time it is, and begins then.
  std::int64_t wall_offset_ns = 0;  ///< Of its clock, without lock-step.
};

/// An event as this program was told of it.
struct HeardEvent {
  std::int64_t at_ns;     ///< Virtual time.
  std::int64_t world_ns;  ///< Its own clock then, less the base: what it had done.
  client::Event event;
};

/// What an agent was clear of, as its program believed at one of its steps.
struct Reliance {
  std::int64_t at_ns;
  std::int64_t world_ns;
  std::int64_t clear_until_ns;  ///< What a careful program relies on: not void, not expired.
  std::int64_t effective_from_ns;
};

/// One agent's part in the run.
struct Flown {
  Flight flight;
  std::optional<std::int64_t> added_ns;  ///< In the world, less the base.
  std::int64_t removed_ns = client::kNever;
  client::AgentId id;
  std::vector<Reliance> relied;
  /// From when on, as its program was told, others count its changes: in the world, less the base.
  std::set<std::int64_t> effective_ns;
};

class SimulatorProgram {
 public:
  SimulatorProgram(const SimulatorOptions& options, std::vector<Flight> flights, Network* network);
  ~SimulatorProgram();

  void Start();
  /// Ends without a word.
  void Kill();
  /// Stands still, and nobody hears of it.
  void Suspend();
  void Resume();
  /// Its clock is set.
  void StepWall(std::int64_t by_ns) { wall_offset_ns_ += by_ns; }

  bool finished() const { return finished_; }
  bool killed() const { return killed_; }
  /// It has started, and has not ended.
  bool connected() const { return world_.has_value(); }
  Network::Id id() const { return end_->id(); }
  const SimulatorOptions& options() const { return options_; }
  const std::vector<Flown>& flown() const { return flown_; }
  const std::vector<HeardEvent>& heard() const { return heard_; }
  const std::set<std::uint32_t>& runs() const { return runs_; }
  std::uint64_t contacts_missed() const { return contacts_missed_; }
  std::uint64_t refusals() const { return refusals_; }
  std::uint64_t lowered() const { return lowered_; }
  std::uint64_t voided() const { return voided_; }
  std::uint64_t times_lost() const { return times_lost_; }
  std::uint64_t changes_told() const { return changes_told_; }
  /// How often it was told that another program has its name.
  bool waited_for_name() const { return waited_for_name_; }
  /// Its last step, less the base.
  std::int64_t reached_ns() const { return reached_ns_; }
  std::int64_t base_ns() const { return options_.lock_step ? 0 : kWallAtStart; }

 private:
  void Wake(std::int64_t at_ns);
  void Continue();
  bool Join();
  bool Advance();
  void Tick();
  void Set(std::int64_t world_ns);
  client::AgentDescription DescriptionOf(std::size_t i, std::int64_t world_ns) const;
  void Describe(std::size_t i, std::int64_t world_ns, client::Agent* agent);
  client::State StateOf(const Flight& flight, std::int64_t world_ns) const;
  void NoteId(const client::AgentId& id, Flown* flown);
  void Note(std::int64_t world_ns);
  std::int64_t NextStep(std::int64_t after_ns) const;
  std::int64_t StampOf(std::int64_t world_ns) const {
    return base_ns() + world_ns + (options_.lock_step ? 0 : wall_offset_ns_);
  }
  void End();
  void Close();

  const SimulatorOptions options_;
  Network& network_;
  ClientEnd* end_ = nullptr;
  std::optional<client::World> world_;
  std::map<std::size_t, client::Agent> agents_;
  std::vector<Flown> flown_;
  std::vector<HeardEvent> heard_;
  std::set<std::uint32_t> runs_;
  std::set<std::int64_t> stops_;
  std::int64_t step_ns_ = 0;
  std::int64_t reached_ns_ = kAlways;
  std::int64_t wall_offset_ns_;
  std::int64_t awake_at_ns_ = 0;
  bool awaits_ = false, staged_ = false, finished_ = false, killed_ = false, suspended_ = false;
  bool ended_ = false, waited_for_name_ = false, joined_ = false;
  std::uint64_t contacts_missed_ = 0, refusals_ = 0, lowered_ = 0, voided_ = 0, times_lost_ = 0;
  std::uint64_t changes_told_ = 0;
};

}  // namespace collision::faults
