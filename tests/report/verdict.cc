#include "tests/report/verdict.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "tests/report/rivals.h"
#include "tests/report/rows.h"
#include "tests/report/text.h"

namespace collision::report {
namespace {

constexpr char kRight[] = "Are the answers right?";
constexpr char kPhases[] =
    "How fast are the two phases? How many times as long as ours the best other program takes, "
    "where "
    "ours looks worst";
constexpr char kService[] = "Does the service hold?";
/// Where nobody else does the same.
constexpr char kNoPeer[] = "-";
/// Factors nearer to 1 are told in percent.
constexpr double kFactorLeast = 1.1;
/// A frame of 60 Hz [s].
constexpr double kFrame = 1.0 / 60;

struct Answer {
  double value = 0;
  std::string shown;
};

enum class Kind { kAtLeast, kAtMost };

struct Question {
  const char *group, *asked;
  Kind kind;
  double bound;
  const char* bound_shown;
  std::function<std::optional<Answer>(const v1::Results&)> measure;
  std::function<std::string(const v1::Results&)> beaten_by;
};

/// Nullopt where one of the figures is missing.
std::optional<double> SumOf(const v1::Results& results, const std::string& experiment,
                            const std::vector<std::string>& figures) {
  double sum = 0;
  for (const std::string& figure : figures) {
    const auto value = FigureOf(results, experiment, figure);
    if (!value) return std::nullopt;
    sum += *value;
  }
  return sum;
}

/// Of those that were measured.
std::optional<double> LeastOf(const v1::Results& results, const std::string& experiment,
                              const std::vector<std::string>& figures) {
  std::optional<double> least;
  for (const std::string& figure : figures) {
    const auto value = FigureOf(results, experiment, figure);
    if (value) least = std::min(least.value_or(*value), *value);
  }
  return least;
}

std::optional<Answer> Count(const v1::Results& results, const std::string& experiment,
                            const std::vector<std::string>& figures) {
  const auto sum = SumOf(results, experiment, figures);
  if (!sum) return std::nullopt;
  return Answer{*sum, Grouped(*sum)};
}

std::optional<Answer> Times(std::optional<double> ratio) {
  if (!ratio) return std::nullopt;
  return Answer{*ratio, Rounded(*ratio, 2) + " ×"};
}

/// "nobody; the next, FCL, takes 1.7 × our time", or "FCL, 0.5 × our time".
std::string BeatenBy(const std::optional<Rival>& rival) {
  if (!rival) return kNoPeer;
  const std::string time = Rounded(rival->over_ours, 2) + " × our time";
  return rival->over_ours < 1 ? rival->who + ": " + time
                              : "nobody; next " + rival->who + ": " + time;
}

/// Others' count of wrong answers against ours.
std::string BeatenByCount(const std::string& who, std::optional<double> theirs,
                          std::optional<double> ours) {
  if (!theirs || !ours) return kNoPeer;
  return (*theirs < *ours ? "" : "nobody; ") + who + ": " + Grouped(*theirs);
}

/// How many cases are not kept.
std::optional<Answer> Broken(const std::vector<const Row*>& rows) {
  if (rows.empty()) return std::nullopt;
  const auto kept = std::count_if(rows.begin(), rows.end(),
                                  [](const Row* row) { return TextOf(*row, "kept") == "yes"; });
  const auto all = static_cast<double>(rows.size());
  return Answer{all - static_cast<double>(kept),
                Grouped(static_cast<double>(kept)) + " of " + Grouped(all) + " cases kept"};
}

std::optional<Answer> LateOrUnheard(const v1::Results& results) {
  std::optional<double> wrong, contacts;
  for (const Row* row : Select(results, "faults", {})) {
    for (const char* field : {"late", "unheard"}) {
      const auto count = NumberOf(*row, field);
      if (count) wrong = wrong.value_or(0) + *count;
    }
    contacts = contacts.value_or(0) + NumberOf(*row, "contacts").value_or(0);
  }
  if (!wrong) return std::nullopt;
  return Answer{*wrong, Grouped(*wrong) + " of " + Grouped(*contacts)};
}

std::optional<Answer> LateTakeOvers(const v1::Results& results) {
  double all = 0, in_time = 0;
  for (const Row* row : Select(results, "network", {{"group", "take-over"}})) {
    const auto count = NumberOf(*row, "take_overs");
    const auto within = NumberOf(*row, "within_lease_and_50_ms");
    if (!count || !within) return std::nullopt;
    all += *count, in_time += *within;
  }
  if (all == 0) return std::nullopt;
  return Answer{all - in_time, Grouped(in_time) + " of " + Grouped(all) + " in time"};
}

/// With the greatest budget of a pair's turn that is not above the service's default.
std::optional<Answer> BeginBracket(const v1::Results& results) {
  constexpr double kDefaultBudget = 2000;  // [µs]
  std::optional<double> budget, width;
  for (const Row* row : Select(results, "budget", {{"kind", "a pair's turn"}})) {
    const auto of_row = NumberOf(*row, "budget_us"), measured = NumberOf(*row, "begin_width_p50_s");
    if (!of_row || !measured || *of_row > kDefaultBudget || *of_row < budget.value_or(0)) continue;
    budget = of_row, width = measured;
  }
  if (!width) return std::nullopt;
  return Answer{*width, Duration(*width)};
}

/// Of the gateway with most agents and viewers.
std::optional<Answer> GatewayCores(const v1::Results& results) {
  const std::vector<Condition> most = {{"part", "cost"}, {"agents", "10000"}, {"viewers", "100"}};
  for (const Row* row : Select(results, "gateway", most)) {
    const auto cores = NumberOf(*row, "cores");
    if (cores) return Answer{*cores, Rounded(*cores, 2) + " cores"};
  }
  return std::nullopt;
}

std::string Rate(const v1::Results& results, const std::string& figure) {
  const auto value = FigureOf(results, "service", figure);
  return value ? Rounded(*value) + " a second" : "";
}

std::string Latency(const v1::Results& results, const std::string& figure) {
  const auto value = FigureOf(results, "service", figure);
  return value ? Duration(*value) : "";
}

/// A ratio, and what it is of ours.
std::optional<Answer> Beside(const v1::Results& results, const std::string& figure,
                             const std::string& ours) {
  auto answer = Times(FigureOf(results, "service", figure));
  if (answer && !ours.empty()) answer->shown += ": " + ours;
  return answer;
}

std::string NoOp(const std::string& value) {
  return value.empty() ? kNoPeer : "no-op program: " + value;
}

/// The last one asks Bullet's tree by way of our own queue.
const std::vector<std::string> kOtherMethods = {"all-pairs", "face-sweep", "spatial-index",
                                                "Bullet, asked lazily"};

Contest Agents(const std::string& experiment, const std::string& part,
               std::vector<Condition> conditions) {
  conditions.emplace_back("part", part);
  return {experiment, conditions, {"scene", "agents"}, "seconds", "chosen", kOtherMethods};
}

Contest Narrow(const std::string& part, const std::string& time) {
  return {"narrow-phase", {{"part", part}}, {"mesh", "triangles", "gap"},
          time,           "ours",           {"ours, octree"}};
}

const std::vector<std::string> kOurWrong = {
    "ours_misses",         "ours_false_alarms",         "ours_brackets_without_the_truth",
    "contact_ours_misses", "contact_ours_false_alarms", "contact_ours_brackets_without_the_truth"};
const std::vector<std::string> kTheirWrong = {"peers_misses_at_best", "peers_false_alarms_at_best",
                                              "contact_peers_misses_at_best",
                                              "contact_peers_false_alarms_at_best"};

using R = const v1::Results&;

std::vector<Question> AboutAnswers() {
  const auto none = [](R) { return kNoPeer; };
  return {
      {kRight,
       "Contacts that are told late or not at all, over faulty networks and beside programs "
       "that fail",
       Kind::kAtMost, 0, "none", LateOrUnheard, none},
      {kRight, "Contacts of the demo scenes that come unannounced", Kind::kAtMost, 0, "none",
       [](R r) { return Count(r, "stepping", {"ours_misses"}); },
       [](R r) {
         return BeatenByCount("a loop at 60 Hz", FigureOf(r, "stepping", "stepping_60hz_misses"),
                              FigureOf(r, "stepping", "ours_misses"));
       }},
      {kRight, "Contact or not, how far, and when: wrong answers, and brackets without the truth",
       Kind::kAtMost, 0, "none", [](R r) { return Count(r, "precision", kOurWrong); },
       [](R r) {
         return BeatenByCount("the libraries, each at its best setting",
                              SumOf(r, "precision", kTheirWrong), SumOf(r, "precision", kOurWrong));
       }},
      {kRight, "When did it begin? Median width of the bracket, 101 ships, default budget",
       Kind::kAtMost, kFrame, "≤ 16.7 ms, a frame at 60 Hz", BeginBracket, none},
  };
}

/// Ours is to be as fast as the best other: `figures` are its times over ours.
Question AsFast(const char* asked, const std::string& experiment,
                const std::vector<std::string>& figures,
                const std::function<std::optional<Rival>(R)>& rival) {
  return {kPhases,
          asked,
          Kind::kAtLeast,
          1,
          "≥ 1 ×",
          [=](R r) { return Times(LeastOf(r, experiment, figures)); },
          [=](R r) { return BeatenBy(rival(r)); }};
}

std::vector<Question> AboutPhases() {
  const auto of = [](const Contest& contest) {
    return [contest](R r) { return RivalOf(r, contest); };
  };
  const std::vector<Condition> many = {{"agents", "100000"}};
  return {
      AsFast("Narrow phase: do two meshes touch?", "narrow-phase",
             {"decision_worst", "decision_gap_0_1pct_worst", "decision_gap_50pct_worst"},
             of(Narrow("decision", "warm_s"))),
      AsFast("Narrow phase: their distance, to 1e-6", "narrow-phase", {"distance_worst"},
             of(Narrow("distance", "warm_s"))),
      AsFast("Narrow phase: do two boxes or hulls touch, with nothing in the cache?",
             "narrow-phase",
             {"convex_decision_cold_worst", "convex_decision_gap_0_1pct_cold_worst",
              "convex_decision_gap_50pct_cold_worst"},
             of(Narrow("convex decision", "cold_s"))),
      AsFast("Narrow phase: time of contact, to an error that the other reaches", "precision",
             {"contact_peer_over_ours_at_equal_error"}, ContactRivalOf),
      AsFast("Preparing a mesh: building its tree", "narrow-phase", {"build_vs_fcl_bvh_worst"},
             of(Narrow("build", "warm_s"))),
      AsFast("Broad phase: the earliest meeting of 100,000 agents, from scratch", "broad-phase",
             {"scratch_100k_at_once", "scratch_100k_half", "scratch_100k_never"},
             of(Agents("broad-phase", "scratch", many))),
      AsFast("The same in crowds and other scenes that are hard to divide", "special-scenes",
             {"worst_scene_ratio"}, of(Agents("special-scenes", "scenes", {}))),
      AsFast("Broad phase: one of 100,000 agents has news", "streaming", {"incremental_100k"},
             of(Agents("streaming", "incremental", many))),
  };
}

std::vector<Question> AboutTheService() {
  const auto none = [](R) { return kNoPeer; };
  return {
      {kService, "Updates a second with 10,000 agents, of those of a program that does nothing",
       Kind::kAtLeast, 0.7, "≥ 0.7 ×",
       [](R r) {
         return Beside(r, "service_updates_ratio_10000", Rate(r, "service_updates_per_s_10000"));
       },
       [](R r) { return NoOp(Rate(r, "network_updates_per_s_10000")); }},
      {kService, "From an update to its event with 10,000 agents, over that of the same program",
       Kind::kAtMost, 2, "≤ 2 ×",
       [](R r) {
         return Beside(r, "service_event_p50_ratio_10000", Latency(r, "service_event_p50_s_10000"));
       },
       [](R r) { return NoOp(Latency(r, "network_event_p50_s_10000")); }},
      {kService, "10,000 agents that change ten times a second, to 100 browsers: the gateway takes",
       Kind::kAtMost, 0.5, "≤ 0.5 cores", GatewayCores, none},
      {kService, "A service fails: its successor is heard within the lease and 50 ms",
       Kind::kAtMost, 0, "always", LateTakeOvers, none},
      {kService, "A bad client floods, lies or crowds: an honest one is served as before",
       Kind::kAtMost, 0, "always",
       [](R r) {
         return Broken(Select(r, "soak", {{"group", "beside"}}));
       },
       none},
      {kService,
       "Real programs on networks that lose, delay, reorder and part: every promise holds",
       Kind::kAtMost, 0, "always",
       [](R r) {
         return Broken(Select(r, "network", {{"group", "!take-over"}}));
       },
       none},
  };
}

std::vector<Question> Questions() {
  std::vector<Question> questions;
  for (const auto& part : {AboutAnswers(), AboutPhases(), AboutTheService()}) {
    questions.insert(questions.end(), part.begin(), part.end());
  }
  return questions;
}

bool IsKept(const Question& question, double value) {
  return question.kind == Kind::kAtLeast ? value >= question.bound : value <= question.bound;
}

/// "missed by 3.9 ×"; of counts, "missed by 3".
std::string MissedBy(const Question& question, double value) {
  if (question.bound == 0) return "missed by " + Grouped(value);
  const double factor =
      question.kind == Kind::kAtLeast ? question.bound / value : value / question.bound;
  if (factor < kFactorLeast) return "missed by " + Rounded(100 * (factor - 1), 2) + " %";
  return "missed by " + Rounded(factor, 2) + " ×";
}

}  // namespace

std::vector<VerdictLine> VerdictsOf(const v1::Results& results) {
  std::vector<VerdictLine> lines;
  for (const Question& question : Questions()) {
    VerdictLine line{
        question.group, question.asked, question.bound_shown, "–", Verdict::kNotMeasured,
        "not measured", kNoPeer};
    if (const auto answer = question.measure(results)) {
      const bool kept = IsKept(question, answer->value);
      line.measured = answer->shown;
      line.verdict = kept ? Verdict::kKept : Verdict::kMissed;
      line.words = kept ? "kept" : MissedBy(question, answer->value);
      line.beaten_by = question.beaten_by(results);
    }
    lines.push_back(line);
  }
  return lines;
}

std::string SummaryOf(const std::vector<VerdictLine>& lines) {
  const auto count = [&](Verdict verdict) {
    const auto of_it = std::count_if(lines.begin(), lines.end(), [&](const VerdictLine& line) {
      return line.verdict == verdict;
    });
    return std::to_string(of_it);
  };
  return count(Verdict::kKept) + " of " + std::to_string(lines.size()) + " kept, " +
         count(Verdict::kMissed) + " missed, " + count(Verdict::kNotMeasured) + " not measured.";
}

}  // namespace collision::report
