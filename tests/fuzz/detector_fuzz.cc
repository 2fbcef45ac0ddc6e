#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "collision_core/detection/detector.h"
#include "collision_core/numeric/seconds.h"
#include "idl/limits.h"
#include "server/codec/codec.h"
#include "server/codec/encode.h"
#include "tests/fuzz/answers.h"
#include "tests/fuzz/fuzzed_messages.h"
#include "tests/fuzz/fuzzed_shapes.h"
#include "tests/fuzz/targets.h"
#include "tests/support/truth/exact_balls.h"

namespace collision::fuzz {
namespace {

constexpr std::uint32_t kAgents = 5;
constexpr int kCallsMax = 120;
constexpr int kStepsMax = 24;
constexpr broad_phase::BroadPhaseMethod kMethods[] = {broad_phase::BroadPhaseMethod::kAllPairs,
                                                      broad_phase::BroadPhaseMethod::kExhaustive,
                                                      broad_phase::BroadPhaseMethod::kSpatialIndex};

detection::DetectorOptions FuzzedOptions(FuzzedData* data) {
  constexpr double kResolutions[] = {1.0 / 60, 0.001, 1, 1e-6};
  constexpr double kSkews[] = {0, 0.002, 1e-9, 60};
  detection::DetectorOptions options;
  options.temporal_resolution = data->OneOf(kResolutions);
  options.announce_within = options.temporal_resolution * static_cast<double>(1 + data->Byte());
  options.skew = data->OneOf(kSkews);
  options.agents_max = kAgents - 1;
  options.pairs_max = static_cast<std::uint32_t>(1 + data->Below(12));
  options.pairs_per_agent_max = static_cast<std::uint32_t>(1 + data->Below(4));
  options.history_max = static_cast<std::uint32_t>(2 + data->Below(8));
  options.work_units_per_evaluation = data->Bits(2) % 4000;
  options.work_units_per_step = data->Flag() ? data->Bits(2) % 8000 : 0;
  return options;
}

bool Same(const detection::AgentClearance& a, const detection::AgentClearance& b) {
  return a.agent == b.agent && a.clear_until == b.clear_until && a.not_clear == b.not_clear &&
         a.in_contact == b.in_contact && a.saturated == b.saturated &&
         a.effective_from == b.effective_from && a.cause == b.cause && a.void_from == b.void_from &&
         a.unannounced_until == b.unannounced_until;
}

/// What the fuzzer knows of an agent, independently of the detector.
struct KnownAgent {
  Ballistic ball;
  detection::AgentDeclaration declaration;
  bool contradicts = false;  ///< Faster than its own cap: no motion is allowed at all.
};

/// One detector for each method; every call goes to all, and their answers must be equal.
class Detectors {
 public:
  explicit Detectors(detection::DetectorOptions options) {
    for (const broad_phase::BroadPhaseMethod method : kMethods) {
      options.broad_phase = method;
      detectors_.push_back(std::make_unique<detection::Detector>(options));
    }
  }

  template <typename Call>
  auto All(const char* what, Call call) {
    const auto first = call(*detectors_.front());
    for (std::size_t i = 1; i < detectors_.size(); ++i) {
      Require(call(*detectors_[i]) == first, what, ": another answer of ", Name(kMethods[i]));
    }
    return first;
  }

  void Advance(Instant now) {
    for (const auto& detector : detectors_) {
      detector->Advance(now);
      detector->Validate();
    }
    const std::vector<std::string> first = EventsOf(*detectors_.front());
    for (std::size_t i = 1; i < detectors_.size(); ++i) {
      if (EventsOf(*detectors_[i]) == first) continue;
      Require(false, "events of ", Name(kMethods[i]), ":\n", Shown(*detectors_[i]), "not\n",
              Shown(*detectors_.front()));
    }
  }

  void CompareClearances() {
    const auto first = detectors_.front()->TakeChangedClearances();
    for (std::size_t i = 1; i < detectors_.size(); ++i) {
      const auto others = detectors_[i]->TakeChangedClearances();
      Require(std::equal(first.begin(), first.end(), others.begin(), others.end(), Same),
              "clearances of ", Name(kMethods[i]));
    }
    for (const auto& detector : detectors_) detector->Validate();
  }

  void CompareEarliest() {
    const detection::EarliestAnswer first = detectors_.front()->Earliest();
    for (std::size_t i = 1; i < detectors_.size(); ++i) {
      const detection::EarliestAnswer other = detectors_[i]->Earliest();
      Require(other.found == first.found && other.earliest == first.earliest &&
                  (!first.found || (other.lower == first.lower && other.higher == first.higher)),
              "earliest of ", Name(kMethods[i]), ": ", Shown(other), ", not ", Shown(first));
    }
  }

  const detection::Detector& first() const { return *detectors_.front(); }

 private:
  static std::vector<std::string> EventsOf(const detection::Detector& detector) {
    std::vector<std::string> events;
    for (const detection::CollisionEvent& event : detector.events()) {
      events.push_back(server::Encode(event).SerializeAsString());
    }
    return events;
  }

  static std::string Shown(const detection::EarliestAnswer& answer) {
    return server::Encode(answer).ShortDebugString();
  }

  static std::string Shown(const detection::Detector& detector) {
    std::string text;
    for (const detection::CollisionEvent& event : detector.events()) {
      text += server::Encode(event).ShortDebugString() + "\n";
    }
    return text;
  }

  std::vector<std::unique_ptr<detection::Detector>> detectors_;
};

class Session {
 public:
  explicit Session(const detection::DetectorOptions& options) : detectors_(options) {}

  /// False: no more steps.
  bool Call(FuzzedData* data) {
    const auto slot = static_cast<std::uint32_t>(data->Below(kAgents));
    switch (data->Below(10)) {
      case 0:
      case 1:
        Redeclare(slot, data);
        return true;
      case 2:
        detectors_.All("Remove", [&](detection::Detector& d) { return d.Remove(IdOf(slot)); });
        if (known_.erase(slot) != 0) ++generations_[slot];
        return true;
      case 3:
      case 4:
      case 5:
      case 6:
        SendState(slot, data);
        return true;
      case 7:
        detectors_.All("SetHeardUntil", [&](detection::Detector& d) {
          d.SetHeardUntil(OwnerOf(IdOf(slot)), now_);
          return true;
        });
        return true;
      default:
        Step(data);
        return ++steps_ < kStepsMax;
    }
  }

 private:
  /// Each agent has an owner of its own, so that what is heard of them differs.
  detection::AgentId IdOf(std::uint32_t slot) const {
    return {.simulator = 1 + slot, .slot = slot, .run = 1, .generation = generations_[slot]};
  }

  std::optional<detection::AgentDeclaration> Declaration(FuzzedData* data) {
    v1::AgentDescription wire = FuzzedDeclaration("alpha", data);
    wire.clear_shape_hash();
    wire.set_slot(0);
    wire.set_agent_name("");
    auto decoded = server::DecodeDescription(wire);
    if (!std::holds_alternative<detection::AgentDeclaration>(decoded)) return std::nullopt;
    auto declaration = std::get<detection::AgentDeclaration>(decoded);
    const std::uint8_t kind = data->Byte();
    if (kind >= 250) declaration.shape_awaited = true;
    if (kind >= 192 && kind < 250) declaration.shape = FuzzedBody(data);
    // The server refuses a shape that reaches beyond the ball.
    if (declaration.shape) {
      declaration.limits.radius =
          std::max(declaration.limits.radius, declaration.shape->facts().radius);
    }
    return declaration;
  }

  /// As the codec lets it through: from the past, or as far ahead as time may have been granted.
  std::optional<motion::MotionState> State(FuzzedData* data) {
    const v1::AgentState wire = FuzzedState(now_.nanoseconds(), data);
    const server::StampRules rules{.latest = numeric::AddRoundedDown(now_, 10)};
    auto decoded = server::DecodeState({}, wire, rules);
    if (!std::holds_alternative<motion::MotionState>(decoded)) return std::nullopt;
    return std::get<motion::MotionState>(decoded);
  }

  void Record(std::uint32_t slot, const motion::MotionState& state,
              const detection::AgentDeclaration& declaration) {
    KnownAgent& known_agent = known_[slot];
    known_agent = {.ball = {.state = state, .radius = declaration.limits.radius},
                   .declaration = declaration};
    known_agent.contradicts = !(state.v_WA.norm() <= declaration.limits.speed_max);
  }

  void SendState(std::uint32_t slot, FuzzedData* data) {
    const std::optional<motion::MotionState> state = State(data);
    if (!state) return;
    const Instant from = std::max(now_, state->stamp);
    const auto known = known_.find(slot);
    if (known == known_.end()) {
      const auto declaration = Declaration(data);
      if (!declaration) return;
      if (detectors_.All("Admit", [&](detection::Detector& d) {
            return d.Admit(IdOf(slot), *declaration, *state, from);
          })) {
        Record(slot, *state, *declaration);
      }
      return;
    }
    const detection::UpdateOutcome outcome = detectors_.All(
        "Update", [&](detection::Detector& d) { return d.Update(IdOf(slot), *state, from); });
    if (outcome == detection::UpdateOutcome::kOlder) return;
    Require(outcome != detection::UpdateOutcome::kUnknown, "an agent that was admitted is unknown");
    Record(slot, *state, known->second.declaration);
  }

  void Redeclare(std::uint32_t slot, FuzzedData* data) {
    const auto declaration = Declaration(data);
    if (!declaration) return;
    const bool known = detectors_.All("Redeclare", [&](detection::Detector& d) {
      return d.Redeclare(IdOf(slot), *declaration, now_);
    });
    Require(known == known_.contains(slot), "Redeclare() of ", slot);
    if (known) Record(slot, known_[slot].ball.state, *declaration);
  }

  void Step(FuzzedData* data) {
    const std::uint8_t kind = data->Byte();
    const double seconds = kind < 240 ? kind / 64.0 : data->UpTo(1e9);
    now_ = std::min(numeric::AddRoundedDown(now_, seconds),
                    Instant::FromNanoseconds(wire::kInstantMax - 20'000'000'000));
    detectors_.Advance(now_);
    for (const detection::CollisionEvent& event : detectors_.first().events()) {
      CheckEvent(server::Encode(event));
      Require(event.now <= now_, "an event lies later than now");
      status_[{event.lower, event.higher}] = event.status;
    }
    if (data->Flag()) detectors_.CompareEarliest();
    detectors_.CompareClearances();
    CheckPromises();
  }

  /// Two agents that keep their last velocities do not touch before the clearance of both has
  /// ended, unless their contact was announced.
  void CheckPromises() const {
    for (auto a = known_.begin(); a != known_.end(); ++a) {
      for (auto b = std::next(a); b != known_.end(); ++b)
        CheckPair(a->first, a->second, b->first, b->second);
    }
  }

  void CheckPair(std::uint32_t slot_a, const KnownAgent& a, std::uint32_t slot_b,
                 const KnownAgent& b) const {
    if (a.contradicts || b.contradicts || !CanMeet(a.declaration.filter, b.declaration.filter))
      return;
    for (const KnownAgent* agent : {&a, &b}) {
      if (agent->declaration.shape || agent->declaration.shape_awaited) return;
    }
    const auto status =
        status_.find({std::min(IdOf(slot_a), IdOf(slot_b)), std::max(IdOf(slot_a), IdOf(slot_b))});
    if (status != status_.end() && (status->second == detection::EventStatus::kPossible ||
                                    status->second == detection::EventStatus::kConfirmed)) {
      return;
    }
    const auto of_a = detectors_.first().ClearanceOf(IdOf(slot_a));
    const auto of_b = detectors_.first().ClearanceOf(IdOf(slot_b));
    Require(of_a && of_b, "an agent without a clearance");
    const Instant from = std::max(
        {now_, a.ball.state.stamp, b.ball.state.stamp, of_a->effective_from, of_b->effective_from});
    const Instant until =
        std::min({std::max(of_a->clear_until, of_b->clear_until), a.ball.state.expiry,
                  b.ball.state.expiry, Instant::FromNanoseconds(wire::kInstantMax)});
    if (from >= until || !GapOf(a.ball, b.ball, from).ApartAt(0.0)) return;
    const Instant last = Instant::FromNanoseconds(until.nanoseconds() - 1);
    const Instant nearest = NearestWithin(a.ball, b.ball, from, last);
    const ExactGap gap = GapOf(a.ball, b.ball, nearest);
    Require(ValueAt(gap.Excess(), 0.0).Sign() >= 0, slot_a, " and ", slot_b, " touch at ",
            nearest.nanoseconds(), " or before; clear until ", until.nanoseconds(), ", now ",
            now_.nanoseconds());
  }

  Detectors detectors_;
  Instant now_;
  int steps_ = 0;
  std::map<std::uint32_t, KnownAgent> known_;
  std::uint32_t generations_[kAgents] = {};
  std::map<std::pair<detection::AgentId, detection::AgentId>, detection::EventStatus> status_;
};

}  // namespace

void FuzzDetector(Bytes bytes) {
  FuzzedData data(bytes);
  const detection::DetectorOptions options = FuzzedOptions(&data);
  Session session(options);
  for (int call = 0; call < kCallsMax && !data.empty(); ++call) {
    if (!session.Call(&data)) return;
  }
}

}  // namespace collision::fuzz
