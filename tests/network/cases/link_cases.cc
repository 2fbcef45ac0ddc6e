// Cables that are pulled out in the middle of a flight, and put back.
#include <chrono>
#include <string>
#include <vector>

#include "tests/network/cases/cases.h"

namespace collision::network {
namespace {

using std::chrono::seconds;

/// The lease of a participant in the profile is 20 s: after the last of these, programs that could
/// not hear each other meet as if they had just joined.
std::vector<seconds> OutFor(const Setting& setting) {
  if (setting.quick) return {seconds(5)};
  return {seconds(5), seconds(15), seconds(25)};
}

std::string Of(seconds out) { return "out for " + std::to_string(out.count()) + " s: "; }

/// The flight begins, the cable is out, the flight goes on to its end.
Flown FlyUnplugged(const TestbedOptions& options, Party party, seconds out, Outcome* outcome) {
  Testbed testbed(options);
  testbed.AwaitContacts(1);
  testbed.lan().Plug(party, false);
  testbed.Pass(out);
  testbed.lan().Plug(party, true);
  Flown flown = testbed.Finish();
  Report(testbed.lan().counts(), flown, outcome);
  return flown;
}

void FlyInLockStep(const Setting& setting, const TestbedOptions& options, Party party,
                   Outcome* outcome) {
  const Flown& undisturbed = Undisturbed(options);
  for (const seconds out : OutFor(setting)) {
    const Flown flown = FlyUnplugged(options, party, out, outcome);
    ExpectTruth(Of(out), flown, outcome);
    ExpectSameContacts(Of(out), flown, undisturbed, outcome);
    ExpectSameEventLog(Of(out), flown, undisturbed, outcome);
  }
}

template <Party kParty>
void LockStep(const Setting& setting, Outcome* outcome) {
  FlyInLockStep(setting, {.seconds = 4, .speed = 1}, kParty, outcome);
}

/// Cut off from everybody, the standby takes over. Nobody follows it, so it leaves the world alone.
void StandbyInLockStep(const Setting& setting, Outcome* outcome) {
  FlyInLockStep(setting, {.standby = true, .seconds = 4, .speed = 1}, kStandby, outcome);
}

/// The standby takes over; the first one finds itself replaced when it is back.
void ActiveInLockStep(const Setting& setting, Outcome* outcome) {
  const TestbedOptions options{.standby = true, .seconds = 4, .speed = 1};
  const Flown& undisturbed = Undisturbed(options);
  for (const seconds out : OutFor(setting)) {
    const Flown flown = FlyUnplugged(options, kService, out, outcome);
    ExpectTruth(Of(out), flown, outcome);
    ExpectSameContacts(Of(out), flown, undisturbed, outcome);
    outcome->Expect(flown.heard.statuses.back().term >= 2, Of(out) + "the standby does not serve");
  }
}

template <Party kParty>
void WallClock(const Setting& setting, Outcome* outcome) {
  for (const seconds out : OutFor(setting)) {
    const TestbedOptions options{.wall_clock = true,
                                 .seconds = 4.0 + static_cast<double>(out.count())};
    const Flown flown = FlyUnplugged(options, kParty, out, outcome);
    if (kParty == kMonitor) {
      ExpectTruth(Of(out), flown, outcome);
    } else {
      ExpectClearances(Of(out), flown, outcome);
    }
  }
}

}  // namespace

std::vector<Case> LinkCases() {
  const std::string same = "time waits; the event log of an undisturbed flight, each contact once";
  const std::string out = "is out for 5 s, 15 s and 25 s";
  return {
      {"links", "service", same, LockStep<kService>, "the cable of the only service " + out},
      {"links", "active", "the standby serves; the contacts of an undisturbed flight, each once",
       ActiveInLockStep, "the cable of the service that has a standby " + out},
      {"links", "standby", same, StandbyInLockStep, "the cable of the standby " + out},
      {"links", "simulator", same, LockStep<kAlpha>, "the cable of a simulator " + out},
      {"links", "monitor", "the event log of an undisturbed flight, each contact once",
       LockStep<kMonitor>, "the cable of the monitor " + out},
      {"links", "service-wall-clock", "no clearance is broken", WallClock<kService>,
       "the cable of the only service " + out},
      {"links", "simulator-wall-clock", "no clearance is broken", WallClock<kAlpha>,
       "the cable of a simulator " + out},
      {"links", "monitor-wall-clock", "each true contact is told once and in time",
       WallClock<kMonitor>, "the cable of the monitor " + out},
  };
}

}  // namespace collision::network
