// Networks that lose, delay, reorder and double, all the time.
#include <map>
#include <string>

#include "tests/network/cases/cases.h"

namespace collision::network {
namespace {

constexpr LinkFaults kLoss5{.loss = 0.05};
constexpr LinkFaults kLoss20{.loss = 0.2};
constexpr LinkFaults kDelay50{.delay_min_s = 0.05, .delay_max_s = 0.05};
constexpr LinkFaults kDelay200{.delay_min_s = 0.2, .delay_max_s = 0.2};
constexpr LinkFaults kReordered{.duplication = 0.05, .delay_min_s = 0.001, .delay_max_s = 0.03};
constexpr LinkFaults kAllAtOnce{
    .loss = 0.1, .duplication = 0.05, .delay_min_s = 0.02, .delay_max_s = 0.08};

void Fly(const Setting& setting, TestbedOptions options, Outcome* outcome) {
  options.seconds = setting.quick ? 4 : 20;
  options.claim_wait_s = 2;
  for (int i = 0; i < setting.times; ++i) {
    options.seed = static_cast<std::uint64_t>(i + 1);
    const std::string of = "seed " + std::to_string(options.seed) + ": ";
    const Flown* const undisturbed = options.wall_clock ? nullptr : &Undisturbed(options);
    Testbed testbed(options);
    const Flown flown = testbed.Finish();
    ExpectTruth(of, flown, outcome);
    if (undisturbed != nullptr) {
      ExpectSameContacts(of, flown, *undisturbed, outcome);
      ExpectSameEventLog(of, flown, *undisturbed, outcome);
    }
    Report(testbed.lan().counts(), flown, outcome);
  }
}

template <const LinkFaults& kFaults>
void LockStep(const Setting& setting, Outcome* outcome) {
  Fly(setting, {.faults = kFaults}, outcome);
}

template <const LinkFaults& kFaults>
void WallClock(const Setting& setting, Outcome* outcome) {
  Fly(setting, {.wall_clock = true, .faults = kFaults}, outcome);
}

void LockStepWithNftables(const Setting& setting, Outcome* outcome) {
  Fly(setting, {.loss_at_hosts = 0.2}, outcome);
}

void WallClockWithNftables(const Setting& setting, Outcome* outcome) {
  Fly(setting, {.wall_clock = true, .loss_at_hosts = 0.2}, outcome);
}

}  // namespace

const Flown& Undisturbed(const TestbedOptions& options) {
  static std::map<double, Flown> flights;
  const auto found = flights.find(options.seconds);
  if (found != flights.end()) return found->second;
  return flights[options.seconds] = Testbed({.seconds = options.seconds}).Finish();
}

std::vector<Case> ConditionCases() {
  const std::string lock_step =
      "the event log of a perfect network, each contact told once and in time";
  const std::string wall_clock = "every true contact told once, announced in time and bracketed";
  return {
      {"lock-step", "loss-5", lock_step, LockStep<kLoss5>, "5 % of all frames are lost"},
      {"lock-step", "loss-20", lock_step, LockStep<kLoss20>, "20 % of all frames are lost"},
      {"lock-step", "loss-20-nftables", lock_step, LockStepWithNftables,
       "the kernels of all hosts lose 20 % of what arrives"},
      {"lock-step", "delay-50", lock_step, LockStep<kDelay50>, "each way takes 50 ms"},
      {"lock-step", "delay-200", lock_step, LockStep<kDelay200>, "each way takes 200 ms"},
      {"lock-step", "reordered", lock_step, LockStep<kReordered>,
       "each frame takes 1 to 30 ms, 5 % arrive twice"},
      {"lock-step", "all-at-once", lock_step, LockStep<kAllAtOnce>,
       "10 % lost, 5 % twice, 20 to 80 ms"},
      {"wall-clock", "loss-5", wall_clock, WallClock<kLoss5>, "5 % of all frames are lost"},
      {"wall-clock", "loss-20", wall_clock, WallClock<kLoss20>, "20 % of all frames are lost"},
      {"wall-clock", "loss-20-nftables", wall_clock, WallClockWithNftables,
       "the kernels of all hosts lose 20 % of what arrives"},
      {"wall-clock", "delay-50", wall_clock, WallClock<kDelay50>, "each way takes 50 ms"},
      {"wall-clock", "delay-200", wall_clock, WallClock<kDelay200>, "each way takes 200 ms"},
      {"wall-clock", "reordered", wall_clock, WallClock<kReordered>,
       "each frame takes 1 to 30 ms, 5 % arrive twice"},
      {"wall-clock", "all-at-once", wall_clock, WallClock<kAllAtOnce>,
       "10 % lost, 5 % twice, 20 to 80 ms"},
  };
}

}  // namespace collision::network
