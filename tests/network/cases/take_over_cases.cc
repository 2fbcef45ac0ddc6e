// How long a world is without a service when a standby takes over.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/network/cases/cases.h"

namespace collision::network {
namespace {

using std::chrono::steady_clock;

constexpr double kToldWithin_s = 0.05;  // after the lease of the one that has failed

/// The quick part runs on machines that are busy, where a short lease gives false alarms.
double LeaseOf(const Setting& setting) { return setting.quick ? 0.5 : 0.1; }

enum class Fault { kKilled, kStopped, kUnplugged };

void Fail(Testbed* testbed, Party active, Fault fault) {
  switch (fault) {
    case Fault::kKilled:
      return testbed->process(active).Signal(SIGKILL);
    case Fault::kStopped:
      return testbed->process(active).Signal(SIGSTOP);
    case Fault::kUnplugged:
      return testbed->lan().Plug(active, false);
  }
}

/// Until what has failed can take over in its turn.
void Mend(Testbed* testbed, Party failed, Fault fault) {
  switch (fault) {
    case Fault::kKilled:
      testbed->Kill(failed);
      testbed->Start(failed);
      break;
    case Fault::kStopped:
      testbed->process(failed).Signal(SIGCONT);
      break;
    case Fault::kUnplugged:
      testbed->lan().Plug(failed, true);
  }
  testbed->AwaitLog(failed, "is ready to take over");
}

/// Which of the two serves: after a false alarm it is not the one that took over last.
Party Serving(Testbed* testbed, const HeardStatus& newest) {
  const std::string in_term = "in term " + std::to_string(newest.term);
  const bool first = testbed->process(kService).err().find(in_term) != std::string::npos;
  return first ? kService : kStandby;
}

/// The first status of the next service, as the listener heard it.
HeardStatus AwaitSuccessor(Testbed* testbed, std::uint64_t service) {
  HeardStatus successor;
  const bool heard = testbed->Await([&](const Heard& all) {
    const auto begin = all.statuses.rbegin();
    const auto former = std::find_if(begin, all.statuses.rend(),
                                     [&](const auto& one) { return one.service == service; });
    if (former == begin || former == all.statuses.rend()) return false;
    successor = *std::prev(former);
    return true;
  });
  if (!heard) throw std::runtime_error("no standby took over");
  return successor;
}

/// Until simulators follow it: then the one before it cannot come back.
void AwaitFollowers(Testbed* testbed, std::uint64_t service) {
  const bool followed = testbed->Await([&](const Heard& all) {
    return std::any_of(all.statuses.begin(), all.statuses.end(), [&](const auto& status) {
      return status.service == service && status.followed;
    });
  });
  if (!followed) throw std::runtime_error("nobody follows the standby that took over");
}

std::size_t Services(const Heard& heard) {
  std::size_t services = 0;
  for (std::size_t i = 0; i < heard.statuses.size(); ++i) {
    services += i == 0 || heard.statuses[i].service != heard.statuses[i - 1].service;
  }
  return services;
}

void Describe(std::vector<double> milliseconds, double promised_ms, Outcome* outcome) {
  std::sort(milliseconds.begin(), milliseconds.end());
  const auto last = static_cast<double>(milliseconds.size() - 1);
  const auto quantile = [&](double share) {
    return milliseconds[static_cast<std::size_t>(share * last + 0.5)];
  };
  outcome->Set("take_overs", last + 1);
  outcome->Set("min_ms", milliseconds.front());
  outcome->Set("p50_ms", quantile(0.5));
  outcome->Set("p90_ms", quantile(0.9));
  outcome->Set("max_ms", milliseconds.back());
  outcome->SetList("take_over_ms", milliseconds);
  outcome->Set("promised_ms", promised_ms);
  outcome->Set("within_lease_and_50_ms",
               static_cast<double>(std::count_if(milliseconds.begin(), milliseconds.end(),
                                                 [&](double ms) { return ms <= promised_ms; })));
}

/// After all these take-overs every contact has been told once and in time.
void Judge(const Flown& flown, std::size_t take_overs, Outcome* outcome) {
  const std::size_t services = Services(flown.heard);
  outcome->Expect(services > take_overs, "the listener heard of fewer take-overs");
  outcome->Set("false_alarms", static_cast<double>(services) - 1 - static_cast<double>(take_overs));
  ExpectTruth("", flown, outcome);
}

template <Fault kFault>
void TakeOver(const Setting& setting, Outcome* outcome) {
  Testbed testbed({.standby = true, .lease_s = LeaseOf(setting), .seconds = 3600, .speed = 1});
  testbed.AwaitContacts(1);
  std::vector<double> milliseconds;
  const int count = setting.Many(5, 50);
  for (int i = 0; i < count; ++i) {
    const HeardStatus before = testbed.listener().heard().statuses.back();
    const Party active = Serving(&testbed, before);
    const auto failed_at = steady_clock::now();
    Fail(&testbed, active, kFault);
    const HeardStatus successor = AwaitSuccessor(&testbed, before.service);
    milliseconds.push_back(
        std::chrono::duration<double, std::milli>(successor.at - failed_at).count());
    AwaitFollowers(&testbed, successor.service);
    Mend(&testbed, active, kFault);
  }
  const Flown flown = testbed.FinishNow();
  Judge(flown, static_cast<std::size_t>(count), outcome);
  Describe(milliseconds, 1e3 * (LeaseOf(setting) + kToldWithin_s), outcome);
  Report(testbed.lan().counts(), flown, outcome);
}

}  // namespace

std::vector<Case> TakeOverCases() {
  const std::string promise =
      "a standby takes over each time; on a machine that is not busy it is heard within the lease "
      "(0.1 s, quick 0.5 s) + 50 ms";
  return {
      {"take-over", "killed", promise, TakeOver<Fault::kKilled>,
       "the service that serves is killed, again and again"},
      {"take-over", "stopped", promise, TakeOver<Fault::kStopped>,
       "the service that serves stands still, again and again"},
      {"take-over", "unplugged", promise, TakeOver<Fault::kUnplugged>,
       "the cable of the service that serves is pulled, again and again"},
  };
}

}  // namespace collision::network
