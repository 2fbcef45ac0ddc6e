#include "tests/faults/simulator_program.h"

#include <algorithm>
#include <utility>

#include "collision/shape.h"
#include "idl/identity.h"

namespace collision::faults {
namespace {

/// From an arrival to what the program does about it, and from one step to the next.
constexpr std::int64_t kThinkingTime = 50'000;

/// A program also looks after its connection when nothing comes.
constexpr std::int64_t kLookingPeriod = 100 * kMillisecond;

client::Vector3 ToVector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

SimulatorProgram::SimulatorProgram(const SimulatorOptions& options, std::vector<Flight> flights,
                                   Network* network)
    : options_(options),
      network_(*network),
      step_ns_(options.start_ns),
      wall_offset_ns_(options.wall_offset_ns) {
  for (Flight& flight : flights) {
    stops_.insert({flight.from_ns, flight.until_ns});
    stops_.insert(flight.motion.jumps_ns.begin(), flight.motion.jumps_ns.end());
    for (const Declaration& change : flight.changes) stops_.insert(change.at_ns);
    Flown& flown = flown_.emplace_back();
    flown.flight = std::move(flight);
  }
}

SimulatorProgram::~SimulatorProgram() { Close(); }

void SimulatorProgram::Close() {
  world_.reset();
  agents_.clear();
}

void SimulatorProgram::Start() {
  auto end = std::make_unique<ClientEnd>(&network_, Role::kSimulator, SimulatorId(options_.name),
                                         [this] { Wake(network_.now_ns() + kThinkingTime); });
  end_ = end.get();
  const OnBehalfOf client(Owner::kClients);
  world_.emplace(
      client::World::Connect({.simulator = options_.name,
                              .lock_step = options_.lock_step,
                              .run = options_.run,
                              .incarnation = options_.incarnation,
                              .on_demand = options_.on_demand,
                              .chunk_size = options_.chunk_size,
                              .on_leave = client::OnLeave::kLeave,
                              .wall_clock = [this] { return StampOf(network_.now_ns()); }},
                             std::move(end)));
  world_->OnNotice([](const client::Notice&) {});  // Faults are what these runs are made of.
  world_->OnEvent([this](const client::Event& event) {
    const OnBehalfOf test(Owner::kTest);
    const std::int64_t clock_ns = world_->clock_ns();
    heard_.push_back(
        {network_.now_ns(), clock_ns == kAlways ? kAlways : clock_ns - StampOf(0), event});
  });
  world_->OnClearanceLowered([this](const auto&, const auto&) { ++lowered_; });
  world_->OnVoid([this](const auto&, const auto&) { ++voided_; });
  world_->OnServiceLost([this] { ++times_lost_; });
  Wake(network_.now_ns());
}

void SimulatorProgram::Kill() {
  killed_ = true;
  network_.Kill(id());
  Close();
}

void SimulatorProgram::Suspend() {
  suspended_ = true;
  network_.Isolate(id());
}

void SimulatorProgram::Resume() {
  suspended_ = false;
  network_.Rejoin(id());
  awaits_ = false;
  Wake(network_.now_ns());
}

void SimulatorProgram::Wake(std::int64_t at_ns) {
  if (!world_ || suspended_ || (awaits_ && awake_at_ns_ <= at_ns)) return;
  awaits_ = true;
  awake_at_ns_ = at_ns;
  const OnBehalfOf test(Owner::kTest);
  network_.At(at_ns, [this, at_ns] {
    if (!world_ || suspended_ || !awaits_ || awake_at_ns_ != at_ns) return;
    awaits_ = false;
    Continue();
  });
}

void SimulatorProgram::Continue() {
  const OnBehalfOf client(Owner::kClients);
  bool goes_on = false;
  if (finished_) {
    world_->Poll();
  } else if (options_.joins && !joined_) {
    goes_on = joined_ = Join();
  } else if (options_.lock_step) {
    goes_on = Advance();
  } else {
    Tick();
  }
  for (auto& [index, agent] : agents_) {
    NoteId(agent.id(), &flown_[index]);
  }
  waited_for_name_ |= !world_->waits_for_name().empty();
  refusals_ += world_->TakeRejections().size();
  contacts_missed_ = world_->contacts_missed();
  if (finished_ && !ended_) End();
  // Without lock-step the steps have their times.
  const std::int64_t next_ns =
      options_.lock_step || finished_ ? kLookingPeriod : step_ns_ - network_.now_ns();
  Wake(network_.now_ns() + (goes_on || next_ns <= 0 ? kThinkingTime : next_ns));
}

bool SimulatorProgram::Join() {
  const std::optional<std::int64_t> now_ns = world_->Join(std::chrono::nanoseconds(0));
  if (now_ns) step_ns_ = *now_ns;
  return now_ns.has_value();
}

/// One step, if it is granted.
bool SimulatorProgram::Advance() {
  if (!staged_) Set(step_ns_);
  staged_ = true;
  if (world_->AdvanceTo(step_ns_, std::chrono::nanoseconds(0)) == client::Advance::kTimeout) {
    return false;
  }
  staged_ = false;
  reached_ns_ = step_ns_;
  Note(step_ns_);
  if (step_ns_ >= options_.end_ns) {
    finished_ = true;
    world_->Finish();
  }
  step_ns_ = NextStep(step_ns_);
  return !finished_;
}

/// Without lock-step: takes in what has come and, when it is time, publishes.
void SimulatorProgram::Tick() {
  const std::int64_t now_ns = network_.now_ns();
  world_->Poll();
  if (now_ns < step_ns_) return Note(now_ns);
  Set(now_ns);
  world_->Publish(StampOf(now_ns));
  reached_ns_ = now_ns;
  Note(now_ns);
  finished_ = now_ns >= options_.end_ns;
  step_ns_ = NextStep(now_ns);
}

std::int64_t SimulatorProgram::NextStep(std::int64_t after_ns) const {
  const std::int64_t next = (after_ns / options_.period_ns + 1) * options_.period_ns;
  const auto stop = stops_.upper_bound(after_ns);
  const std::int64_t step = stop == stops_.end() ? next : std::min(next, *stop);
  return after_ns < options_.end_ns ? std::min(step, options_.end_ns) : step;
}

void SimulatorProgram::Set(std::int64_t world_ns) {
  for (std::size_t i = 0; i < flown_.size(); ++i) {
    Flown& flown = flown_[i];
    const Flight& flight = flown.flight;
    const bool lives = flight.from_ns <= world_ns && world_ns < flight.until_ns;
    const auto agent = agents_.find(i);
    if (lives && agent == agents_.end()) {
      flown.added_ns = world_ns;
      const auto added = agents_.emplace(
          i, world_->AddAgent(DescriptionOf(i, world_ns), StateOf(flight, world_ns)));
      NoteId(added.first->second.id(), &flown);
    } else if (lives) {
      Describe(i, world_ns, &agent->second);
      agent->second.SetState(StateOf(flight, world_ns));
    } else if (agent != agents_.end()) {
      // In lock-step that is told ahead of the step, and counts from the last one on.
      flown.removed_ns = options_.lock_step ? reached_ns_ : world_ns;
      agents_.erase(agent);
    }
  }
}

/// As declared from its last change on.
client::AgentDescription SimulatorProgram::DescriptionOf(std::size_t i,
                                                         std::int64_t world_ns) const {
  const Flight& flight = flown_[i].flight;
  client::AgentDescription description{
      .name = options_.name + "-" + std::to_string(i),
      .radius_m = flight.shape ? flight.shape->radius_m() : flight.radius,
      .acceleration_max_m_s2 = flight.acceleration_max,
      .shape = flight.shape};
  for (const Declaration& change : flight.changes) {
    if (change.at_ns <= world_ns) description.acceleration_max_m_s2 = change.acceleration_max;
  }
  return description;
}

/// Tells of the changes since the last step.
void SimulatorProgram::Describe(std::size_t i, std::int64_t world_ns, client::Agent* agent) {
  const auto is_new = [&](const Declaration& change) {
    return reached_ns_ < change.at_ns && change.at_ns <= world_ns;
  };
  const std::vector<Declaration>& changes = flown_[i].flight.changes;
  if (std::none_of(changes.begin(), changes.end(), is_new)) return;
  agent->SetDescription(DescriptionOf(i, world_ns));
  ++changes_told_;
}

client::State SimulatorProgram::StateOf(const Flight& flight, std::int64_t world_ns) const {
  const server::Piece now = flight.motion.At(world_ns).From(world_ns);
  const auto& jumps = flight.motion.jumps_ns;
  return {.stamp_ns = StampOf(world_ns),
          .position_m = ToVector(now.p),
          .velocity_m_s = ToVector(now.v),
          .discontinuity = std::binary_search(jumps.begin(), jumps.end(), world_ns)};
}

void SimulatorProgram::NoteId(const client::AgentId& id, Flown* flown) {
  const OnBehalfOf test(Owner::kTest);
  flown->id = id;
  runs_.insert(id.run);
}

void SimulatorProgram::Note(std::int64_t world_ns) {
  const OnBehalfOf test(Owner::kTest);
  for (auto& [index, agent] : agents_) {
    const client::Clearance clearance = agent.clearance();
    std::int64_t until =
        std::min({clearance.clear_until_ns, clearance.void_from_ns, clearance.expires_ns});
    if (clearance.not_clear) until = kAlways;
    if (until != kAlways && until != client::kNever) until -= StampOf(0);
    if (clearance.effective_from_ns != kAlways) {
      flown_[index].effective_ns.insert(clearance.effective_from_ns - StampOf(0));
    }
    std::vector<Reliance>& relied = flown_[index].relied;
    const bool same = !relied.empty() && relied.back().clear_until_ns == until;
    if (same) continue;
    relied.push_back({network_.now_ns(), world_ns, until, clearance.effective_from_ns});
  }
}

/// Leaves once its last clock has had its effect.
void SimulatorProgram::End() {
  ended_ = true;
  const OnBehalfOf test(Owner::kTest);
  network_.After(kSecond, [this] {
    if (killed_) return;
    const OnBehalfOf client(Owner::kClients);
    agents_.clear();
    world_->Poll();
    world_.reset();
    const OnBehalfOf leaving(Owner::kTest);
    network_.Leave(id());
  });
}

}  // namespace collision::faults
