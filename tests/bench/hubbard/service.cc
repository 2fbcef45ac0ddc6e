// The core as the service runs it over the same flights: between frames as well, by budget.
#include <algorithm>
#include <map>

#include "collision_core/detection/detector.h"
#include "collision_core/numeric/seconds.h"
#include "tests/bench/harness/frame_times.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/harness/number_hash.h"
#include "tests/bench/hubbard/parts.h"

namespace collision::bench {
namespace {

/// Units of work a frame; 0: no limit but each turn's.
constexpr std::uint64_t kBudgets[] = {10, 30, 100, 300, 1000, 3000, 10'000, 0};
/// What the owners declare of their errors: beyond what their motion rounds [m, m/s, rad].
constexpr double kError = 1e-9;
constexpr double kAnnounceWithin = 0.1;

detection::AgentId IdOf(std::uint32_t ship) { return {1, ship, 1, 1}; }

motion::MotionState StateOf(const Flight& flight, std::int64_t frame, std::uint32_t ship) {
  motion::MotionState state = flight.BoundOf(frame, ship).state;
  state.position_error = state.velocity_error = state.rotation_error = kError;
  return state;
}

/// One contact, as of its last revision.
using ContactKey = std::pair<ShipPair, std::uint32_t>;
struct Run {
  std::vector<double> frames;  ///< The processor's time [s].
  std::map<ContactKey, detection::CollisionEvent> contacts;
  std::size_t undecided_at_work = 0;  ///< Pairs that waited for a verdict, summed over frames.
  NumberHash hash;
};

bool IsOver(detection::EventStatus status) {
  return status == detection::EventStatus::kDismissed ||
         status == detection::EventStatus::kWithdrawn || status == detection::EventStatus::kEnded;
}

void Keep(const std::vector<detection::CollisionEvent>& events, Run* run) {
  for (const detection::CollisionEvent& event : events) {
    run->contacts[{{event.lower.slot, event.higher.slot}, event.contact}] = event;
    run->hash.Add(event.lower.slot), run->hash.Add(event.higher.slot);
    run->hash.Add(static_cast<double>(event.status));
    run->hash.Add(static_cast<double>(event.begin.earliest.nanoseconds()));
    run->hash.Add(static_cast<double>(event.begin.latest.nanoseconds()));
  }
}

Run Fly(const Flight& flight, std::uint64_t units) {
  detection::DetectorOptions options;
  options.announce_within = kAnnounceWithin;
  options.work_units_per_step = units;
  detection::Detector detector(options);
  for (std::uint32_t ship = 0; ship < flight.ships(); ++ship) {
    detector.Admit(IdOf(ship),
                   {.limits = flight.BoundOf(0, ship).limits, .shape = flight.kind(ship).shape},
                   StateOf(flight, 0, ship), Flight::InstantOf(0));
  }
  Run run;
  for (std::int64_t frame = 0; frame < flight.frames(); ++frame) {
    const Instant now = Flight::InstantOf(frame);
    const CpuStopwatch watch;
    for (std::uint32_t ship = 0; ship < flight.ships(); ++ship) {
      if (frame > 0) detector.Update(IdOf(ship), StateOf(flight, frame, ship), now);
      detector.SetHeardUntil(OwnerOf(IdOf(ship)), now);
    }
    detector.Advance(now);
    run.frames.push_back(watch.seconds());
    Keep(detector.events(), &run);
    for (const auto& [key, event] : run.contacts) {
      run.undecided_at_work += event.status == detection::EventStatus::kPossible &&
                               event.limited_by == narrow_phase::BracketLimit::kBudget;
    }
  }
  return run;
}

/// What the last revisions say, beside the contacts that the frames show.
struct Verdicts {
  std::size_t confirmed = 0, undecided = 0, possible = 0, by_budget = 0, between_frames = 0,
              missed = 0;
  std::vector<double> widths;  ///< Of the begins of confirmed contacts [s].
};

bool Covers(const detection::CollisionEvent& event, Instant at) {
  if (event.status == detection::EventStatus::kDismissed) return false;
  return event.begin.earliest <= at && at <= event.end.latest;
}

Verdicts VerdictsOf(const Flight& flight, const Run& run) {
  Verdicts verdicts;
  std::map<ContactKey, bool> shown;
  for (std::int64_t frame = 0; frame < flight.frames(); ++frame) {
    for (const ShipPair& pair : flight.contacts(frame)) {
      bool found = false;
      for (auto at = run.contacts.lower_bound({pair, 0});
           at != run.contacts.end() && at->first.first == pair; ++at) {
        if (!Covers(at->second, Flight::InstantOf(frame))) continue;
        found = shown[at->first] = true;
      }
      verdicts.missed += !found;
    }
  }
  for (const auto& [key, event] : run.contacts) {
    const bool confirmed = event.status == detection::EventStatus::kConfirmed ||
                           event.status == detection::EventStatus::kEnded;
    verdicts.confirmed += confirmed;
    verdicts.undecided += event.status == detection::EventStatus::kUndecided;
    verdicts.possible += event.status == detection::EventStatus::kPossible;
    verdicts.by_budget +=
        !IsOver(event.status) && event.limited_by == narrow_phase::BracketLimit::kBudget;
    verdicts.between_frames += confirmed && !shown.contains(key);
    if (confirmed && event.begin.latest != Instant::Never()) {
      verdicts.widths.push_back(
          numeric::SecondsBetween(event.begin.earliest, event.begin.latest).upper);
    }
  }
  return verdicts;
}

}  // namespace

void ServiceRows(const HubbardSettings& settings, const HubbardScene& scene,
                 HubbardReport* report) {
  for (const std::uint64_t units : kBudgets) {
    HubbardRow row = RowOf(
        "service", scene,
        units > 0 ? std::to_string(units) + " units a frame" : std::string("no limit a frame"));
    if (!settings.Wants(row.path())) continue;
    const Run run = Fly(scene.flight, units);
    const Verdicts verdicts = VerdictsOf(scene.flight, run);
    double total = 0;
    for (const double seconds : run.frames) total += seconds;
    row.seconds = total / static_cast<double>(run.frames.size());
    row.hash = run.hash.text();
    const auto count = [](std::size_t number) { return static_cast<double>(number); };
    const auto width = [&](double fraction) -> std::optional<double> {
      if (verdicts.widths.empty()) return std::nullopt;
      return Quantile(verdicts.widths, fraction);
    };
    row.remark = std::to_string(verdicts.confirmed) + " contacts, of them " +
                 std::to_string(verdicts.between_frames) + " between frames; begin within " +
                 (width(0.5) ? SecondsText(*width(0.5)) : std::string("-")) + "; " +
                 std::to_string(verdicts.undecided) + " undecided";
    if (verdicts.missed > 0) row.remark += "; MISSED " + std::to_string(verdicts.missed);
    row.more.insert(
        row.more.end(),
        {Number("units_a_frame", count(units)), Number("width", width(0.5)),
         Number("width_p90", width(0.9)), Number("contacts", count(verdicts.confirmed)),
         Number("between_frames", count(verdicts.between_frames)),
         Number("undecided", count(verdicts.undecided)),
         Number("possible_at_end", count(verdicts.possible)),
         Number("limited_by_budget", count(verdicts.by_budget)),
         Number("waiting_a_frame", count(run.undecided_at_work) / count(run.frames.size())),
         Number("missed", count(verdicts.missed)),
         Text("limited_by", units > 0 ? "the budget of a frame; at last the motion between states"
                                      : "the motion between states")});
    for (Field& field : FrameFields(run.frames)) row.more.push_back(std::move(field));
    report->Add(std::move(row));
    report->FigureSum("service_missed", count(verdicts.missed));
  }
}

}  // namespace collision::bench
