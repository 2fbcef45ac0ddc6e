#include "tests/bench/precision/cell.h"

#include <algorithm>
#include <cmath>

#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

struct TimedReplies {
  std::vector<Reply> replies;
  double seconds = 0;
};

PrecisionRow RowOf(Motion motion, const std::string& mesh, const PairMethod& method) {
  PrecisionRow row;
  row.part = "precision", row.motion = Name(motion), row.mesh = mesh;
  row.method = method.name, row.setting = method.setting;
  row.who = method.origin == Origin::kOurs       ? "ours"
            : method.origin == Origin::kBaseline ? "baseline"
                                                 : "peer";
  row.certified = method.certified;
  row.limited_by = method.limited_by;
  return row;
}

/// The least of the passes, shared among the poses.
TimedReplies RunTogether(const PairMethod& method, const std::vector<PlainPose>& poses,
                         const TimingPlan& plan) {
  TimedReplies timed;
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < plan.passes + 1; ++pass) {
    const Stopwatch watch;
    timed.replies = method.ask_all(poses);
    least = std::min(least, watch.seconds());
  }
  timed.seconds = least / static_cast<double>(poses.size());
  return timed;
}

TimedReplies RunAll(const PairMethod& method, const std::vector<PlainPose>& poses,
                    const TimingPlan& plan) {
  if (method.ask_all) return RunTogether(method, poses, plan);
  MethodTimes times = TimeMethods({method}, poses, plan)[0];
  return {std::move(times.replies), Median(times.warm)};
}

struct Accuracy {
  std::size_t misses = 0, false_alarms = 0, undecided = 0, without_truth = 0;
  std::vector<double> widths, errors;
  double wrong_at = 0;   ///< The widest gap or overlap of which the wrong is said [m].
  double right_at = -1;  ///< The smallest of which the right is said [m]; < 0: none.
};

void JudgeDecision(const JudgedPose& at, const Reply& reply, double diameter, Accuracy* accuracy) {
  const double by = at.share * diameter;
  if (reply.lower != reply.upper) {
    ++accuracy->undecided;
    return;
  }
  const bool yes = reply.lower > 0.5;
  accuracy->misses += at.overlap && !yes;
  accuracy->false_alarms += !at.overlap && yes;
  if (yes != at.overlap) {
    accuracy->wrong_at = std::max(accuracy->wrong_at, by);
  } else if (accuracy->right_at < 0 || by < accuracy->right_at) {
    accuracy->right_at = by;
  }
}

/// A distance above 0 says no, one of 0 or less yes; of brackets both ends must say it.
void JudgeDistance(const JudgedPose& at, const Reply& reply, bool certified, Accuracy* accuracy) {
  const double by = at.overlap ? 0 : at.distance;
  accuracy->misses += at.overlap && reply.lower > 0;
  accuracy->false_alarms += !at.overlap && reply.upper <= 0;
  accuracy->undecided += reply.lower <= 0 && reply.upper > 0;
  if (certified) {
    accuracy->without_truth += !(reply.lower <= by && by <= reply.upper);
    if (!at.overlap) accuracy->widths.push_back(reply.upper - reply.lower);
  }
  // Bodies that overlap have no distance to be off by. A library that answers below 0 says that
  // they overlap.
  if (!at.overlap) accuracy->errors.push_back(std::abs(std::max(0.0, reply.middle()) - by));
}

Accuracy AccuracyOf(const PairMethod& method, const PrecisionCell& cell,
                    const std::vector<Reply>& replies) {
  Accuracy accuracy;
  for (std::size_t i = 0; i < replies.size(); ++i) {
    if (method.task == Task::kDecision) {
      JudgeDecision(cell.poses[i], replies[i], cell.diameter, &accuracy);
    } else {
      JudgeDistance(cell.poses[i], replies[i], method.certified, &accuracy);
    }
  }
  return accuracy;
}

void Fill(const PairMethod& method, const PrecisionCell& cell, const TimedReplies& timed,
          PrecisionRow* row, PrecisionReport* report) {
  const Accuracy accuracy = AccuracyOf(method, cell, timed.replies);
  NumberHash hash;
  for (const Reply& reply : timed.replies) hash.Add(reply.lower), hash.Add(reply.upper);
  row->hash = hash.text();
  row->seconds = timed.seconds;
  row->queries = timed.replies.size();
  row->misses = accuracy.misses, row->false_alarms = accuracy.false_alarms;
  row->width = QuantileOf(accuracy.widths, 0.5);
  row->error = QuantileOf(accuracy.errors, 0.5);
  const bool wrong = accuracy.wrong_at > 0;
  row->more = {Number("width_p90", QuantileOf(accuracy.widths, 0.9)),
               Number("error_p90", QuantileOf(accuracy.errors, 0.9)),
               Number("error_max", QuantileOf(accuracy.errors, 1)),
               Number("undecided", static_cast<double>(accuracy.undecided)),
               Number("without_truth", static_cast<double>(accuracy.without_truth)),
               Number("wrong_at_m", wrong ? std::optional(accuracy.wrong_at) : std::nullopt),
               Number("diameter_m", cell.diameter)};
  if (accuracy.right_at >= 0) row->more.push_back(Number("right_at_m", accuracy.right_at));
  if (row->who == "ours") {
    report->FigureSum("ours_brackets_without_the_truth",
                      static_cast<double>(accuracy.without_truth));
  }
}

}  // namespace

void MeasureCell(const PrecisionSettings& settings, const PrecisionCell& cell,
                 const PairMethods& methods, PrecisionReport* report) {
  if (cell.poses.empty()) return;
  std::vector<PlainPose> poses;
  for (const JudgedPose& at : cell.poses) poses.push_back(at.pose);
  for (const PairMethod& method : methods) {
    PrecisionRow row = RowOf(cell.motion, cell.mesh, method);
    if (!settings.Wants(row.path())) continue;
    Fill(method, cell, RunAll(method, poses, settings.plan()), &row, report);
    report->Add(std::move(row));
  }
}

bool WantsAny(const PrecisionSettings& settings, Motion motion, const std::string& mesh,
              const PairMethods& methods) {
  return std::any_of(methods.begin(), methods.end(), [&](const PairMethod& method) {
    return settings.Wants(RowOf(motion, mesh, method).path());
  });
}

}  // namespace collision::bench
