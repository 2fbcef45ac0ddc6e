// A week in lock-step, as fast as it goes: one service with its journal, crews that come and go,
// and a monitor that hears all.
#include <signal.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "collision/monitor.h"
#include "tests/soak/cases.h"
#include "tests/soak/contact_judge.h"
#include "tests/soak/process_use.h"
#include "tests/support/sanitized.h"
#include "tests/system/test_world.h"

namespace collision::soak {
namespace {

using system_test::Process;
using system_test::TestWorld;

constexpr int kDomain = 85;
/// About a minute and ten minutes on two processors.
constexpr int kQuickWatches = 500, kFullWatches = 12'000;
/// A program of crews that is started later could not fly any more.
constexpr int kLastStarts = 200;
constexpr double kMaxGrownMb = 4;  ///< In the second half of the week.
/// Contacts that wait for readers: so much more than at its begin the service has once, and keeps.
constexpr double kContactsMb = 32768 * 5e-3;
/// So much more the client that flies the whole week may take [MB]: it remembers 131,072 pairs, and
/// Cyclone DDS 0.10.2 keeps the key of each shape that it has given up.
constexpr double kRememberedMb = 12, kKeyMb = 0.45e-3;
constexpr double kMoreDescriptors = 8;
/// Counters of the status that tell how much there is of something, and how much there may be.
constexpr double kAgentsMax = 2 * kCrews * kSites;  // those of two watches
constexpr double kPairsMax = kAgentsMax * (2 * kCrews - 1) / 2;
constexpr std::array<std::pair<const char*, double>, 6> kQueues = {
    {{"queued", kAgentsMax + kPairsMax},
     {"pairs_waiting", kPairsMax},
     {"shapes", kAgentsMax},
     {"shapes_gathering", kAgentsMax},
     {"trees_building", kAgentsMax},
     {"unproven_inputs", kAgentsMax}}};

constexpr char kConfig[] = "agents_max: 4096\nshapes_max: 4096\nsimulators_max: 16\n";

/// Pairs are looked at once in a step, which is longer than any step of a simulator in real time.
std::string ResolutionText(const Plan& plan) {
  const double step_s = 1e-9 * static_cast<double>(plan.step_ns());
  return "temporal_resolution_s: " + std::to_string(std::min(10.0, step_s)) +
         "\nannounce_within_s: " + std::to_string(std::max(10.0, step_s)) + "\n";
}

/// No program runs ahead of the others by more than a step.
std::string ClockText(const Plan& plan) {
  return "simulators_awaited: " + std::to_string(kCrews) +
         " grant_ahead_max_s: " + std::to_string(1e-9 * static_cast<double>(plan.step_ns()));
}

class Week {
 public:
  Week(const Setting& setting, Outcome* outcome)
      : plan_(setting.Many(kQuickWatches, kFullWatches)),
        outcome_(*outcome),
        judge_(plan_, outcome),
        world_(kDomain, ClockText(plan_), kConfig) {
    world_.Configure(ResolutionText(plan_));
  }

  void Fly() {
    daemon_ = world_.StartDaemon();
    client::Monitor monitor({.world = world_.name(), .domain = world_.domain()},
                            {.event = [this](const auto& event) { Hear(event); },
                             .status = [this](const auto& status) { Note(status); }});
    for (int crew = 0; crew < kCrews; ++crew) Start(crew, 0);
    while (crews_[0].process) {
      monitor.Poll(std::chrono::milliseconds(5));
      // A program says what it flies before anybody can hear of it.
      for (int crew = 0; crew < kCrews; ++crew) Attend(crew);
      for (const client::Event& event : std::exchange(heard_, {})) judge_.Hear(event);
      // Its log is taken: a full pipe would stop it.
      const auto ended = daemon_->WaitForExit(std::chrono::milliseconds(1));
      if (!outcome_.Expect(!ended, "the service has ended: " + daemon_->err())) return;
    }
    // Until the last status has come.
    for (int i = 0; i < 100; ++i) monitor.Poll(std::chrono::milliseconds(20));
    for (const client::Event& event : heard_) judge_.Hear(event);
    judge_.End();
    outcome_.Expect(monitor.contacts_missed() == 0, "the monitor has missed contacts");
    Tell();
    for (Program& crew : crews_) crew.process.reset();
    daemon_->Signal(SIGTERM);
    outcome_.Expect(daemon_->WaitForExit() == 0, "the service did not end well: " + daemon_->err());
  }

 private:
  struct Program {
    int life = 0;
    bool flies = false;  ///< It has said from when on.
    std::unique_ptr<Process> process;
  };

  void Start(int crew, int life) {
    Program& program = crews_[static_cast<std::size_t>(crew)];
    program.life = life;
    program.flies = false;
    program.process = world_.StartHelper(
        "soak_crew", {std::to_string(crew), std::to_string(life), std::to_string(plan_.watches())});
    ++programs_;
  }

  std::int64_t end_ns() const { return plan_.BeginOf(plan_.watches()); }

  /// Takes what it has said; starts the next one where it has ended.
  void Attend(int crew) {
    Program& program = crews_[static_cast<std::size_t>(crew)];
    if (!program.process) return;
    const auto status = program.process->WaitForExit(std::chrono::milliseconds(1));
    const std::string& said = program.process->out();
    if (!program.flies && said.ends_with('\n')) {
      program.flies = true;
      judge_.Flies(crew, program.life, std::stoi(said.substr(said.find(' '))));
    }
    if (!status) return;
    const bool killed = *status == 128 + SIGKILL && LifeOf(plan_, crew, program.life).killed;
    killed_ += killed ? 1 : 0;
    outcome_.Expect(killed || *status == 0, "crew " + std::to_string(crew) + " ended with " +
                                                std::to_string(*status) + ": " +
                                                program.process->err());
    program.process.reset();
    if (crew == 0 && *status == 0) reached_ns_ = end_ns();
    // One that was killed is waited for.
    if (crew != 0 && (killed || reached_ns_ / plan_.watch_ns() < plan_.watches() - kLastStarts)) {
      Start(crew, program.life + 1);
    }
  }

  void Hear(const client::Event& event) {
    ++events_;
    heard_.push_back(event);
  }

  void Note(const client::ServiceStatus& status) {
    reached_ns_ = std::max(reached_ns_, status.now_ns);
    const double part = static_cast<double>(status.now_ns) / static_cast<double>(kWeekNs);
    service_.push_back({part, UseOf(daemon_->pid())});
    if (crews_[0].process) client_.push_back({part, UseOf(crews_[0].process->pid())});
    last_ = status.counters;
    outcome_.Greatest("agents_max", status.agents);
    outcome_.Greatest("pairs_max", status.pairs_tracked);
    for (const auto& [name, allowed] : kQueues) {
      const auto value = static_cast<double>(last_[name]);
      outcome_.Greatest(std::string(name) + "_max", value);
      outcome_.Expect(value <= allowed, std::string(name) + " " + suite::Show(value));
    }
    outcome_.Expect(status.agents <= kAgentsMax, "too many agents");
    outcome_.Expect(status.pairs_tracked <= kPairsMax, "too many pairs");
  }

  void Tell() {
    outcome_.Set("simulated_s", 1e-9 * static_cast<double>(reached_ns_));
    outcome_.Set("programs", programs_);
    outcome_.Set("programs_killed", killed_);
    for (const char* name : {"agents_admitted", "agents_removed", "shape_parts_received"}) {
      outcome_.Set(name, static_cast<double>(last_[name]));
    }
    outcome_.Set("pairs", static_cast<double>(judge_.pairs()));
    outcome_.Set("contacts", static_cast<double>(judge_.contacts()));
    outcome_.Set("events_heard", static_cast<double>(events_));
    double refused = 0;
    for (const auto& [name, value] : last_) {
      if (name.starts_with("rejected_")) refused += static_cast<double>(value);
    }
    outcome_.Set("refusals", refused);
    outcome_.Expect(reached_ns_ >= end_ns(), "no week has passed");
    outcome_.Expect(judge_.contacts() > judge_.pairs() / 20, "hardly a contact");
    const double shapes_mb = kKeyMb * kSites / 2 * plan_.watches() / 2;
    TellMemory("service", service_, kContactsMb, kMaxGrownMb);
    TellMemory("client", client_, 0, kMaxGrownMb + kRememberedMb + shapes_mb);
  }

  /// From the middle of the week on nothing grows by more than `grown_mb`, but for what it has not
  /// yet taken of `filled_mb`.
  void TellMemory(const std::string& whose, const std::vector<UseAt>& readings, double filled_mb,
                  double grown_mb) {
    if (!outcome_.Expect(!readings.empty(), "nothing is known of the " + whose)) return;
    const auto at = [&](double part) {
      return MedianOf(readings, &ProcessUse::resident_mb, part - 0.1, part);
    };
    outcome_.Set(whose + "_mb_at_0.1", at(0.1));
    outcome_.Set(whose + "_mb_at_0.5", at(0.5));
    outcome_.Set(whose + "_mb_at_1", at(1));
    const double full_mb = std::max(at(0.5), readings.front().use.resident_mb + filled_mb);
    // A sanitizer keeps what was freed.
    outcome_.Expect(kSanitized || at(1) <= full_mb + grown_mb,
                    "the memory of the " + whose + " grows");
    for (const auto& [name, what] : {std::pair("descriptors", &ProcessUse::descriptors),
                                     std::pair("threads", &ProcessUse::threads)}) {
      const double before = MedianOf(readings, what, 0, 0.1);
      const double at_end = MedianOf(readings, what, 0.9, 1);
      outcome_.Set(whose + "_" + name + "_at_0.1", before);
      outcome_.Set(whose + "_" + name + "_at_1", at_end);
      outcome_.Expect(at_end <= before + kMoreDescriptors, whose + " has ever more " + name);
    }
  }

  const Plan plan_;
  Outcome& outcome_;
  ContactJudge judge_;
  TestWorld world_;
  std::unique_ptr<Process> daemon_;
  std::array<Program, kCrews> crews_;
  std::vector<UseAt> service_, client_;
  std::map<std::string, std::uint64_t> last_;  ///< Counters of the last status.
  /// As far as is known: the first crew flies to the end, and ends well if it has come there.
  std::int64_t reached_ns_ = 0;
  int programs_ = 0, killed_ = 0;
  std::vector<client::Event> heard_;  ///< Not judged yet.
  std::uint64_t events_ = 0;
};

void FlyWeek(const Setting& setting, Outcome* outcome) { Week(setting, outcome).Fly(); }

}  // namespace

std::vector<Case> WeekCases() {
  return {{"soak", "week",
           "each contact is heard once, as confirmed and as ended, in brackets that hold; memory, "
           "descriptors, threads and queues are at the end as in the middle of the week",
           FlyWeek,
           "a week of lock-step: four programs that come, go and are killed, of the same names and "
           "of ever-new ones; all their agents are new ones, half of them with a new shape, "
           "every few minutes"}};
}

}  // namespace collision::soak
