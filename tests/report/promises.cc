#include "tests/report/promises.h"

#include "tests/report/rows.h"
#include "tests/report/text.h"

namespace collision::report {
namespace {

struct Promise {
  const char *words, *experiment, *figure;
  double at_most;
};

constexpr Promise kPromises[] = {
    {"no contact is missed", "precision", "ours_misses", 0},
    {"no contact is reported where there is none", "precision", "ours_false_alarms", 0},
    {"each bracket holds the exact distance", "precision", "ours_brackets_without_the_truth", 0},
    {"no time of contact is missed", "precision", "contact_ours_misses", 0},
    {"no time of contact is reported where there is none", "precision", "contact_ours_false_alarms",
     0},
    {"each bracket holds the exact time", "precision", "contact_ours_brackets_without_the_truth",
     0},
    {"whatever the budget, no contact comes unannounced", "budget", "unannounced_misses", 0},
    {"whatever the budget, every scene comes to its end", "budget", "runs_failed", 0},
    {"all methods find the same in every frame", "hubbard", "frames_that_differ", 0},
    {"the service tells of every contact of the flight", "hubbard", "service_missed", 0},
    {"no contact of a demo scene comes unannounced", "stepping", "ours_misses", 0},
    {"every demo scene comes to its end", "stepping", "runs_failed", 0},
    {"the profile costs at most a tenth more than the best choice by hand", "left-out",
     "chosen_over_best_units_worst", 1.1},
    {"a page of one file, with a hundred agents, has less than 5 MB", "gateway", "page_bytes", 5e6},
    {"the profile names each part that is left out", "left-out", "left_out_missed_count", 0},
    {"every method gives the same answers", "left-out", "answers_differ_count", 0},
};

}  // namespace

std::vector<PromiseLine> PromisesOf(const v1::Results& results) {
  std::vector<PromiseLine> lines;
  for (const Promise& promise : kPromises) {
    if (FindExperiment(results, promise.experiment) == nullptr) continue;
    const auto value = FigureOf(results, promise.experiment, promise.figure);
    lines.push_back({promise.words, promise.experiment, promise.figure, promise.at_most,
                     value ? Short(*value) : "not measured", value && *value <= promise.at_most});
  }
  return lines;
}

std::vector<std::string> BrokenIn(const v1::Results& results) {
  std::vector<std::string> broken;
  for (const v1::Experiment& experiment : results.experiments()) {
    if (!experiment.failure().empty()) {
      broken.push_back(experiment.name() + ": " + experiment.failure());
    }
  }
  for (const PromiseLine& line : PromisesOf(results)) {
    if (line.kept) continue;
    broken.push_back(line.experiment + ": " + line.words + ", but " + line.figure + " is " +
                     line.measured + ", at most " + Short(line.at_most));
  }
  return broken;
}

}  // namespace collision::report
