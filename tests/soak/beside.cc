// Bad clients beside an honest one: what it is served, against what another honest one is served at
// the same time by a service of its own. Whatever else the machine does concerns both alike.
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "collision/monitor.h"
#include "tests/bench/harness/measure.h"
#include "tests/soak/cases.h"
#include "tests/soak/honest.h"
#include "tests/soak/process_use.h"
#include "tests/support/sanitized.h"
#include "tests/system/test_world.h"

namespace collision::soak {
namespace {

using system_test::Process;
using system_test::TestWorld;

constexpr int kDomain = 86, kDomainAlone = 87;
/// Of the median: times what it is alone. The tests share their machine with others.
constexpr double kTimesMax = 2, kTimesMaxInTests = 4;
/// And once more what all pairs together may take in a step.
constexpr double kStepBudgetMs = 1;
constexpr int kLapsMin = 20;
constexpr int kWallUnended = 4;  ///< One in so many laps may stay without its end.
/// At least so many more of what a kind counts, and how long that is waited for: on a busy machine
/// a program of the lowest priority hardly runs.
constexpr double kDone = 100;
constexpr double kDoneWithin_s = 180;
constexpr int kFilesMax = 16384;

// What the service may take [MB].
constexpr double kWaiting = 16;      // waiting_mb_max
constexpr double kUnproven = 64;     // before a name is proved
constexpr double kContact = 4.5e-3;  // kept for readers, up to 32768
constexpr double kAgent = 20e-3;
constexpr double kPair = 2e-3;
constexpr double kOther = 24;  // what malloc() keeps, and buffers of DDS

constexpr char kLimits[] =
    "agents_max: 2000\npairs_max: 4096\nshapes_max: 512\nwaiting_mb_max: 16\ntree_cache_mb: 64\n"
    "sender_bytes_per_second_max: 10000000\nstep_budget_us: 1000\n";

/// Each step of the honest one waits for an answer.
constexpr char kLockStep[] = "simulators_awaited: 1 grant_ahead_max_s: 0.016666667";
constexpr char kWallClock[] = "kind: REAL_TIME";

/// Of a bad client.
struct Kind {
  const char* name;
  const char* does;
  const char* counter;  ///< Of the status: grows as it does that.
  bool lock_step = true;
  bool records = false;  ///< The service.
};

constexpr Kind kKeys = {"keys", "writes states under ever-new keys", "unproven_inputs"};
constexpr Kind kDisposals = {"disposals", "gives up shapes that never were, under ever-new keys",
                             "inputs"};
constexpr Kind kGhosts = {"ghosts", "writes one state each under ever-new ids that nobody proves",
                          "unproven_inputs"};
constexpr Kind kGarbage = {"garbage", "writes descriptions that are refused",
                           "rejections_suppressed"};
constexpr Kind kShapes = {"shapes", "writes ever-new small shapes, more than there are places",
                          "rejected_bad_shape"};
constexpr Kind kAgents = {"agents", "brings more agents than the world may have",
                          "rejected_too_many_agents"};
constexpr Kind kPairs = {"pairs", "brings 150 agents at one place: more pairs than are tracked",
                         "saturations"};
constexpr Kind kCrowd = {"crowd", "flies 363 meshes of 3,160 triangles at one place, wall clock",
                         "work_units", false};
constexpr Kind kStream = {"stream",
                          "writes states of 1,024 agents to a service that records, wall clock",
                          "states_accepted", false, true};

class Beside {
 public:
  Beside(const Kind& kind, const Setting& setting, Outcome* outcome)
      : kind_(kind),
        setting_(setting),
        outcome_(*outcome),
        world_(kDomain, kind.lock_step ? kLockStep : kWallClock, kLimits),
        alone_(kDomainAlone, kind.lock_step ? kLockStep : kWallClock, kLimits) {
    world_.Configure("tree_cache_dir: \"" + world_.folder().Path("trees") + "\"\n");
  }

  void Run() {
    const std::string recording = world_.folder().Path("recording");
    daemon_ = world_.StartDaemon(kind_.records ? std::vector<std::string>{"--record", recording}
                                               : std::vector<std::string>());
    client::Monitor monitor({.world = world_.name(), .domain = world_.domain()},
                            {.status = [this](const auto& status) { Note(status); }});
    Honest honest(world_.name(), world_.domain(), kind_.lock_step, &outcome_);
    const auto daemon_alone = alone_.StartDaemon();
    Honest other(alone_.name(), alone_.domain(), kind_.lock_step, &outcome_);
    Served before, alone, beside;
    while (before.laps < 2 * kLapsMin) {
      if (!other.Lap(&before) || !honest.Lap(&before)) return;
    }
    monitor.Poll(std::chrono::nanoseconds(0));
    before_mb_ = UseOf(daemon_->pid()).resident_mb;
    counted_before_ = Counter(kind_.counter);
    bad_ = world_.StartHelper("bad_client", {kind_.name});
    if (!outcome_.Expect(bad_->WaitForOutput("begun"), "the bad one did not begin")) return;
    const bench::Stopwatch watch;
    while (watch.seconds() < setting_.Many(6, 20) || beside.laps < kLapsMin ||
           (Done() < kDone && watch.seconds() < kDoneWithin_s)) {
      if (!other.Lap(&alone) || !honest.Lap(&beside)) return;
      monitor.Poll(std::chrono::nanoseconds(0));
      // Its log is taken: a full pipe would stop it.
      daemon_->WaitForExit(std::chrono::milliseconds(1));
    }
    // Until a last status has come.
    for (int i = 0; i < 100; ++i) monitor.Poll(std::chrono::milliseconds(20));
    outcome_.Expect(!bad_->WaitForExit(std::chrono::milliseconds(1)), "the bad one has ended");
    Tell(alone, beside);
    const int unended = honest.unended() + other.unended();
    outcome_.Set("unended", unended);
    // By the wall clock the agents may be gone before the service knows their shape, or their
    // states, where the machine has other things to do.
    const int laps = before.laps + alone.laps + beside.laps;
    outcome_.Expect(unended <= (kind_.lock_step ? 0 : laps / kWallUnended),
                    "contacts were not heard as ended");
    bad_->Signal(SIGKILL);
    daemon_->Signal(SIGTERM);
    outcome_.Expect(daemon_->WaitForExit() == 0, "the service did not end well: " + daemon_->err());
    JudgeTreeCache();
    if (kind_.records) JudgeRecording(recording);
  }

 private:
  /// Of the newest status.
  double Counter(const char* name) const {
    const auto found = status_.counters.find(name);
    return found == status_.counters.end() ? 0 : static_cast<double>(found->second);
  }

  /// How much harm the bad one has done, as its kind counts it.
  double Done() const { return Counter(kind_.counter) - counted_before_; }

  void Note(const client::ServiceStatus& status) {
    status_ = status;
    if (!bad_) return;
    const double contacts = std::min(32768.0, Counter("contacts_published"));
    const double allowed = kWaiting + kUnproven + kOther + kContact * contacts +
                           kAgent * status.agents + kPair * status.pairs_tracked +
                           1e-6 * (Counter("shape_bytes") + Counter("tree_bytes"));
    const double grown = UseOf(daemon_->pid()).resident_mb - before_mb_;
    outcome_.Greatest("grown_mb", grown);
    outcome_.Greatest("grown_of_allowed", grown / allowed);
    if (!kSanitized) outcome_.Expect(grown <= allowed, "more memory than its accounts");
  }

  /// It is whole: it can be replayed to its end.
  void JudgeRecording(const std::string& path) {
    outcome_.Set("recorded_mb", 1e-6 * static_cast<double>(std::filesystem::file_size(path)));
    const system_test::Outcome replay =
        system_test::RunToEnd({system_test::Program("collisiond"), "--replay", path});
    outcome_.Expect(replay.status == 0, "the recording is damaged: " + replay.err);
  }

  /// Once the service has ended: a folder that changes may list a file under both its names.
  void JudgeTreeCache() {
    std::error_code ignored;
    const std::filesystem::directory_iterator trees(world_.folder().Path("trees"), ignored);
    const auto files = static_cast<double>(std::distance(begin(trees), end(trees)));
    outcome_.Set("cached_files", files);
    outcome_.Expect(files <= kFilesMax, "too many files in the tree cache");
  }

  void Tell(const Served& alone, const Served& beside) {
    outcome_.Set("laps_alone", alone.laps);
    outcome_.Set("laps_beside", beside.laps);
    if (kind_.lock_step) Compare("answer", alone.answers_ms, beside.answers_ms);
    Compare("event", alone.events_ms, beside.events_ms);
    outcome_.Set(kind_.counter, Done());
    outcome_.Expect(Done() >= kDone, std::string("hardly anything bad was done: ") + kind_.counter);
  }

  void Compare(const std::string& what, const std::vector<double>& alone,
               const std::vector<double>& beside) {
    for (const double part : {0.5, 0.99}) {
      const std::string name = what + (part == 0.5 ? "_p50" : "_p99");
      const double before = QuantileOf(alone, part), after = QuantileOf(beside, part);
      outcome_.Set(name + "_alone_ms", before);
      outcome_.Set(name + "_beside_ms", after);
      outcome_.Set(name + "_times", before > 0 ? after / before : 0);
    }
    const double times_max = setting_.quick ? kTimesMaxInTests : kTimesMax;
    const double median_ms = outcome_.Get(what + "_p50_beside_ms");
    const double allowed_ms = times_max * outcome_.Get(what + "_p50_alone_ms") + kStepBudgetMs;
    outcome_.Expect(
        !beside.empty() && median_ms <= allowed_ms,
        what + " takes " + suite::Show(median_ms) + " ms, allowed are " + suite::Show(allowed_ms));
  }

  const Kind& kind_;
  const Setting setting_;
  Outcome& outcome_;
  TestWorld world_, alone_;  ///< The second one is without the bad client.
  std::unique_ptr<Process> daemon_, bad_;
  client::ServiceStatus status_;
  double before_mb_ = 0, counted_before_ = 0;
};

template <const Kind& kind>
Case CaseOf() {
  return {"beside", kind.name,
          "an honest simulator hears the same contact in each lap; grants and events take at most "
          "twice as long and a step's budget of pairs (median) as those of another one, which a "
          "second service serves alone at the same time; memory grows by no more than its accounts",
          [](const Setting& setting, Outcome* outcome) { Beside(kind, setting, outcome).Run(); },
          std::string("another one ") + kind.does};
}

}  // namespace

std::vector<Case> BesideCases() {
  return {CaseOf<kKeys>(),    CaseOf<kDisposals>(), CaseOf<kGhosts>(),
          CaseOf<kGarbage>(), CaseOf<kShapes>(),    CaseOf<kAgents>(),
          CaseOf<kPairs>(),   CaseOf<kCrowd>(),     CaseOf<kStream>()};
}

}  // namespace collision::soak
