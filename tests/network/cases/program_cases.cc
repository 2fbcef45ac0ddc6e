// Programs that are killed, or stand still for a while.
#include <signal.h>

#include <chrono>
#include <string>

#include "tests/network/cases/cases.h"

namespace collision::network {
namespace {

// Longer than the lease of a clock and of a status.
constexpr std::chrono::seconds kStandstill{3};

constexpr TestbedOptions kAlone{.seconds = 4, .speed = 1};
constexpr TestbedOptions kWithStandby{.standby = true, .seconds = 4, .speed = 1};

void ExpectUndisturbed(Testbed* testbed, const Flown& undisturbed, Outcome* outcome) {
  const Flown flown = testbed->Finish();
  ExpectTruth("", flown, outcome);
  ExpectSameContacts("", flown, undisturbed, outcome);
  Report(testbed->lan().counts(), flown, outcome);
}

/// In the middle of a flight a program stands still, and goes on.
template <Party kParty>
void Stopped(const Setting& setting, Outcome* outcome) {
  const TestbedOptions& options = kParty == kStandby ? kWithStandby : kAlone;
  for (int i = 0; i < setting.times; ++i) {
    const Flown& undisturbed = Undisturbed(options);
    Testbed testbed(options);
    testbed.AwaitContacts(1);
    testbed.process(kParty).Signal(SIGSTOP);
    testbed.Pass(kStandstill);
    testbed.process(kParty).Signal(SIGCONT);
    ExpectUndisturbed(&testbed, undisturbed, outcome);
  }
}

void ActiveStopped(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.times; ++i) {
    const Flown& undisturbed = Undisturbed(kWithStandby);
    Testbed testbed(kWithStandby);
    testbed.AwaitContacts(1);
    testbed.process(kService).Signal(SIGSTOP);
    testbed.AwaitLog(kStandby, "in term 2");
    testbed.process(kService).Signal(SIGCONT);
    testbed.AwaitLog(kService, "stands by");
    ExpectUndisturbed(&testbed, undisturbed, outcome);
  }
}

void ActiveKilled(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.times; ++i) {
    const Flown& undisturbed = Undisturbed(kWithStandby);
    Testbed testbed(kWithStandby);
    testbed.AwaitContacts(1);
    testbed.Kill(kService);
    testbed.AwaitLog(kStandby, "in term 2");
    ExpectUndisturbed(&testbed, undisturbed, outcome);
  }
}

/// Killed, and started again while the flight goes on.
template <Party kParty>
void KilledAndBack(const Setting& setting, Outcome* outcome) {
  const TestbedOptions& options = kParty == kStandby ? kWithStandby : kAlone;
  for (int i = 0; i < setting.times; ++i) {
    const Flown& undisturbed = Undisturbed(options);
    Testbed testbed(options);
    testbed.AwaitContacts(1);
    testbed.Kill(kParty);
    testbed.Start(kParty);
    ExpectUndisturbed(&testbed, undisturbed, outcome);
  }
}

/// The next service knows of the simulators by its journal, and of contacts from then on.
void ServiceKilled(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.times; ++i) {
    Testbed testbed(kAlone);
    testbed.AwaitContacts(1);
    testbed.Kill(kService);
    testbed.Start(kService);
    const Flown flown = testbed.Finish();
    ExpectClearances("", flown, outcome);
    Report(testbed.lan().counts(), flown, outcome);
  }
}

/// The next process of its name takes over, with drones of its own.
void SimulatorKilled(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.times; ++i) {
    Testbed testbed(kAlone);
    testbed.AwaitContacts(1);
    testbed.Kill(kBeta);
    testbed.Start(kBeta);
    const Flown flown = testbed.Finish();
    ExpectTruth("", Only("alpha", flown), outcome);
    Report(testbed.lan().counts(), flown, outcome);
  }
}

}  // namespace

std::vector<Case> ProgramCases() {
  const std::string same = "the contacts of an undisturbed flight, each told once and in time";
  return {
      {"programs", "service-stopped", same, Stopped<kService>,
       "the only service stands still for 3 s"},
      {"programs", "service-killed", "no clearance is broken", ServiceKilled,
       "the only service is killed and started again"},
      {"programs", "active-stopped", same, ActiveStopped,
       "the service stands still until its standby serves, and goes on"},
      {"programs", "active-killed", same, ActiveKilled, "the service is killed beside its standby"},
      {"programs", "standby-stopped", same, Stopped<kStandby>, "the standby stands still for 3 s"},
      {"programs", "standby-killed", same, KilledAndBack<kStandby>,
       "the standby is killed and started again"},
      {"programs", "simulator-stopped", same, Stopped<kAlpha>, "a simulator stands still for 3 s"},
      {"programs", "simulator-killed",
       "time waits for its successor; the other one's contacts are told once and in time",
       SimulatorKilled, "a simulator is killed and started again"},
      {"programs", "monitor-stopped", same, Stopped<kMonitor>, "the monitor stands still for 3 s"},
      {"programs", "monitor-killed", same, KilledAndBack<kMonitor>,
       "the monitor is killed and started again"},
  };
}

}  // namespace collision::network
