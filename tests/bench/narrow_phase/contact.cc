// The time of contact where its answer is closed: ours and the libraries'.
#include <cmath>

#include "tests/bench/harness/measure.h"
#include "tests/bench/narrow_phase/parts.h"
#include "tests/bench/pairs/contact_ours.h"
#include "tests/bench/pairs/peers.h"

namespace collision::bench {
namespace {

/// As narrow as can be.
constexpr narrow_phase::ContactTolerance kTolerance{0, 1e-12};

std::string TextOf(const narrow_phase::TimeOfContactResult& found) {
  if (found.status == narrow_phase::ContactStatus::kFree) return "apart throughout";
  const bool contact = found.status == narrow_phase::ContactStatus::kContact;
  return std::string(contact ? "begins" : "undecided, if at all") +
         Format(" in [%.13g,", found.begin.lower) + Format(" %.13g],", found.begin.upper) +
         Format(" %.2g wide", found.begin.upper - found.begin.lower) +
         (contact ? "" : Format(", within %.2g m", found.within));
}

/// Bodies that touch by nothing may be touching or undecided, but neither free nor late.
bool Holds(const narrow_phase::TimeOfContactResult& found, const ContactCase& of) {
  if (!of.begin) return found.status == narrow_phase::ContactStatus::kFree;
  // What rounding the states to doubles may have moved the answer by.
  const double slack = 1e-14 * *of.begin;
  if (found.status == narrow_phase::ContactStatus::kFree) return false;
  if (found.begin.lower > *of.begin + slack) return false;
  return of.touches_by_nothing || (found.status == narrow_phase::ContactStatus::kContact &&
                                   found.begin.upper >= *of.begin - slack);
}

std::string TextOf(const std::optional<double>& found, const ContactCase& of) {
  if (!found) return of.begin ? "MISSES IT" : "apart throughout";
  if (!of.begin) return Format("FALSE ALARM at %.9g", *found);
  const double off = *found - *of.begin;
  return Format("%.9g,", *found) + Format(" off by %+.2g", off) +
         (IsRight(found, of.begin, of.duration) ? "" : ": WRONG");
}

NarrowRow RowOf(const ContactCase& of, const std::string& contestant) {
  NarrowRow row;
  row.part = "cases";
  row.mesh = of.name;
  row.contestant = contestant;
  return row;
}

}  // namespace

void ContactCasesPart(const NarrowSettings& settings, NarrowReport* report) {
  for (const ContactCase& of : ClosedContactCases()) {
    NarrowRow row = RowOf(of, "ours");
    const std::string truth =
        of.begin ? Format("truth %.13g: ", *of.begin) : std::string("truth: never: ");
    if (settings.Wants(row.path())) {
      const ContactShapes shapes{ShapeOf(of.a), ShapeOf(of.b)};
      narrow_phase::TimeOfContactResult found;
      row.warm = LeastSeconds(5, [&] { found = OurContact(of, shapes, kTolerance); });
      row.remark = truth + TextOf(found) + (Holds(found, of) ? "" : ": WRONG");
      row.more = {Number("begin_lower_s", found.begin.lower),
                  Number("begin_upper_s", found.begin.upper),
                  Number("work", static_cast<double>(found.work))};
      report->Add(std::move(row));
    }
    for (const ContactMethod& library : ContactPeers()) {
      row = RowOf(of, library.name);
      if (!settings.Wants(row.path())) continue;
      const ContactQuery ask = library.make(of);
      if (!ask) continue;
      std::optional<double> told;
      row.warm = LeastSeconds(5, [&] { told = ask().begin(); });
      row.remark = truth + TextOf(told, of);
      if (told) row.more = {Number("begin_s", *told)};
      report->Add(std::move(row));
    }
  }
}

}  // namespace collision::bench
