// Worlds that go by wall clocks, which are off, set and suspended.
#include "server/config/config.h"
#include "tests/faults/cases/cases.h"
#include "tests/faults/cases/fleet.h"

namespace collision::faults {
namespace {

std::string Seed(std::uint64_t seed) { return "seed " + std::to_string(seed) + ": "; }

void Offsets(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Fleet fleet = WallFleet(seed);
    const auto scene = MakeScene(fleet);
    Fly(fleet, scene.get(), {}, outcome);
    Report(scene->Judged(WallJudge()), seed, outcome);
    ExpectAllHeard(scene->monitor(), seed, outcome);
    outcome->Expect(scene->service().counter("rejected_clock_skew") == 0,
                    Seed(seed) + "a clock within the bound is refused");
  }
}

/// The service is suspended, or parted from a simulator: promises run out meanwhile.
void Outage(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet = WallFleet(seed);
    fleet.end_ns = 40 * kSecond;
    fleet.agents = 4;
    Random random(seed * 77);
    const auto at = static_cast<std::int64_t>(random.Uniform(2, 5) * 1e9);
    const auto lasts = static_cast<std::int64_t>(random.LogUniform(0.1, 28) * 1e9);
    const auto scene = MakeScene(fleet);
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(at, [&] {
            scene->service().Suspend();
            scene->network().After(lasts, [&] { scene->service().Resume(); });
          });
        },
        outcome);
    JudgeOptions options = WallJudge();
    options.unserved.push_back({at, at + lasts + kSecond});
    Report(scene->Judged(options), seed, outcome);
    ExpectAllHeard(scene->monitor(), seed, outcome);
  }
}

/// The clock of the service's machine is set within the bound.
void StepWithin(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet = WallFleet(seed);
    fleet.wall_offsets_ns = {0, 0, 0};
    const auto scene = MakeScene(fleet);
    const std::int64_t by = (i % 2 == 0 ? 1 : -1) * kSkewNs * 9 / 10;
    Fly(
        fleet, scene.get(),
        [&] { scene->When(3 * kSecond, [&, by] { scene->service().StepWall(by); }); }, outcome);
    Report(scene->Judged(WallJudge()), seed, outcome);
    outcome->Expect(scene->service().status().stamp().epoch() == 1,
                    Seed(seed) + "a step within the bound ends the epoch");
  }
}

/// All clocks are set by more, at once; what was told before is of another time.
void StepBeyond(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet = WallFleet(seed);
    const auto scene = MakeScene(fleet);
    const std::int64_t by = (i % 2 == 0 ? 1 : -1) * (i % 3 + 1) * 5 * kSecond;
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(3 * kSecond, [&, by] {
            scene->service().StepWall(by);
            for (std::size_t one = 0; one < 3; ++one) scene->simulator(one).StepWall(by);
          });
        },
        outcome);
    outcome->Expect(scene->service().status().stamp().epoch() == 2,
                    Seed(seed) + "a step beyond the bound begins no epoch");
    std::uint64_t voided = 0, confirmed = 0;
    for (const SimulatorProgram* one : scene->simulators()) voided += one->voided();
    for (const MonitoredEvent& heard : scene->monitor().heard()) {
      confirmed += heard.event.stamp().epoch() == 2 && heard.event.status() == v1::EVENT_CONFIRMED;
    }
    outcome->Expect(voided >= 3 * static_cast<std::uint64_t>(fleet.agents),
                    Seed(seed) + "told void were " + std::to_string(voided));
    outcome->Add("voided", static_cast<double>(voided));
    outcome->Add("confirmed_after", static_cast<double>(confirmed));
  }
  outcome->Expect(outcome->Get("confirmed_after") > 0, "no contact was confirmed after a step");
}

/// Beta's clock is wrong by more than the bound: it is refused, the others are served.
void BeyondBound(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet = WallFleet(seed);
    fleet.wall_offsets_ns[1] = (i % 2 == 0 ? 1 : -1) * kSkewNs * (3 + 10 * (i % 3));
    const auto scene = MakeScene(fleet);
    Fly(fleet, scene.get(), {}, outcome);
    const SimulatorProgram* const right[] = {&scene->simulator(0), &scene->simulator(2)};
    Report(Judge({right[0], right[1]}, scene->monitor(), WallJudge()), seed, outcome);
    outcome->Expect(scene->service().counter("rejected_clock_skew") > 0 ||
                        scene->service().counter("rejected_future_stamp") > 0,
                    Seed(seed) + "a clock that is off is not refused");
    outcome->Expect(scene->simulator(1).refusals() > 0,
                    Seed(seed) + "the simulator with the wrong clock was not told");
  }
}

}  // namespace

std::vector<Case> ClockCases() {
  const std::string promise =
      "no contact late or unheard, no promise covers one, brackets hold, within the bound on "
      "clocks";
  return {{"clocks", "offsets", promise, Offsets,
           "wall clocks that are off by up to 0.9 of the bound of 20 ms, a tenth lost, up to 5 ms "
           "of delay"},
          {"clocks", "outage", promise + "; promises run out in the outage", Outage,
           "the same, and the service stands still for 0.1 to 28 s"},
          {"clocks", "step-within", promise + "; the epoch goes on", StepWithin,
           "the service's clock is set by 0.9 of the bound, forward or back"},
          {"clocks", "step-beyond",
           "all that was promised is told to be void, and a new epoch serves all", StepBeyond,
           "all clocks are set by 5 to 15 s, forward or back"},
          {"clocks", "beyond-bound", promise + " for the others; the wrong one is told",
           BeyondBound, "the clock of one simulator is off by 3 to 23 times the bound"}};
}

}  // namespace collision::faults
