// The time of contact where its answer is closed: error against time.
#include <algorithm>
#include <cmath>

#include "tests/bench/harness/measure.h"
#include "tests/bench/pairs/contact_ours.h"
#include "tests/bench/pairs/peers.h"
#include "tests/bench/precision/cell.h"

namespace collision::bench {
namespace {

/// Shorter than this the clock's own time would count [s].
constexpr double kMeasuredMin = 4e-6;

struct TimedReply {
  bool ended = false;
  double seconds = 0;
  ContactReply reply;
};

/// The least of a few times.
TimedReply RunHere(const ContactQuery& ask, int passes) {
  TimedReply timed;
  timed.ended = true;
  timed.seconds = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < passes; ++pass) {
    const Stopwatch watch;
    int times = 0;
    do {
      timed.reply = ask();
      ++times;
    } while (watch.seconds() < kMeasuredMin);
    timed.seconds = std::min(timed.seconds, watch.seconds() / times);
  }
  return timed;
}

TimedReply RunInChild(const ContactQuery& ask, int passes, double cut_off) {
  const ApartResult result = RunApart(cut_off, [&] {
    // The first one of a process pays for its memory.
    const TimedReply timed = RunHere(ask, passes + 1);
    return std::vector<double>{timed.seconds, static_cast<double>(timed.reply.verdict),
                               timed.reply.lower, timed.reply.upper};
  });
  if (result.status != ApartStatus::kDone) return {};
  const auto& v = result.values;
  return {true, v[0], {static_cast<ContactReply::Verdict>(static_cast<int>(v[1])), v[2], v[3]}};
}

struct Sums {
  std::size_t queries = 0, endless = 0, misses = 0, false_alarms = 0, undecided = 0,
              without_truth = 0;
  std::vector<double> seconds, widths, errors;
  NumberHash hash;

  void Count(const ContactCase& of, const TimedReply& timed, double slack, bool certified) {
    using Verdict = ContactReply::Verdict;
    ++queries;
    endless += !timed.ended;
    if (!timed.ended) return;
    const ContactReply& reply = timed.reply;
    hash.Add(static_cast<double>(reply.verdict)), hash.Add(reply.lower), hash.Add(reply.upper);
    seconds.push_back(timed.seconds);
    undecided += reply.verdict == Verdict::kUndecided;
    misses += of.begin && reply.verdict == Verdict::kFree;
    false_alarms += !of.begin && reply.verdict == Verdict::kContact;
    if (!of.begin || reply.verdict == Verdict::kFree) return;
    errors.push_back(std::abs(0.5 * (reply.lower + reply.upper) - *of.begin));
    if (!certified) return;
    widths.push_back(reply.upper - reply.lower);
    without_truth += reply.lower > *of.begin + slack || reply.upper < *of.begin - slack;
  }
};

PrecisionRow RowOf(const ContactFamily& family, const ContactMethod& method) {
  PrecisionRow row;
  row.part = "contact", row.motion = Name(family.motion), row.mesh = family.name;
  row.method = method.name, row.setting = method.setting;
  row.who = method.origin == Origin::kOurs ? "ours" : method.naive ? "naive" : "peer";
  row.certified = method.certified;
  row.limited_by = method.limited_by;
  return row;
}

void Fill(const Sums& sums, double cut_off, PrecisionRow* row, PrecisionReport* report) {
  row->seconds = QuantileOf(sums.seconds, 0.5);
  row->width = QuantileOf(sums.widths, 0.5);
  row->error = QuantileOf(sums.errors, 0.5);
  row->queries = sums.queries;
  row->misses = sums.misses, row->false_alarms = sums.false_alarms;
  row->hash = sums.hash.text();
  row->more = {Number("width_p90", QuantileOf(sums.widths, 0.9)),
               Number("error_p90", QuantileOf(sums.errors, 0.9)),
               Number("error_max", QuantileOf(sums.errors, 1)),
               Number("undecided", static_cast<double>(sums.undecided)),
               Number("without_truth", static_cast<double>(sums.without_truth)),
               Number("endless", static_cast<double>(sums.endless)),
               Number("cut_off_s", cut_off)};
  if (row->who == "ours") {
    report->FigureSum("contact_ours_brackets_without_the_truth",
                      static_cast<double>(sums.without_truth));
  }
}

ContactMethods AllMethods() {
  ContactMethods all = OurContactCurves();
  Append(SteppingMethods(), &all);
  Append(ContactPeerCurves(), &all);
  return all;
}

}  // namespace

void ContactTimesPart(const PrecisionSettings& settings, PrecisionReport* report) {
  const std::vector<ContactFamily> families = ContactFamilies(settings.contacts());
  const double cut_off = settings.contact_cut_off();
  for (const ContactFamily& family : families) {
    for (const ContactMethod& method : AllMethods()) {
      PrecisionRow row = RowOf(family, method);
      if (!settings.Wants(row.path())) continue;
      Sums sums;
      for (std::size_t i = 0; i < family.cases.size(); ++i) {
        const auto ask = method.make(family.cases[i]);
        if (!ask) break;
        const TimedReply timed = method.may_not_end ? RunInChild(ask, settings.passes(), cut_off)
                                                    : RunHere(ask, settings.passes());
        sums.Count(family.cases[i], timed, family.slack[i], method.certified);
        // One of its kind is enough to know: it would take the others' time.
        if (sums.endless > settings.endless_max()) break;
      }
      if (sums.queries == 0) continue;
      Fill(sums, cut_off, &row, report);
      report->Add(std::move(row));
    }
  }
}

}  // namespace collision::bench
