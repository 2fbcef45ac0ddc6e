#include "client/programs/tools/recordings/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/programs/shared/forecast_slots.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"
#include "idl/recording/utc.h"

namespace collision::client {
namespace {

using chart::Chart;
using chart::Point;
using chart::Series;

constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kOpen = std::numeric_limits<std::int64_t>::max();

double SecondsOf(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

/// The value below which a share of them lies; they are reordered. Requires some.
double Quantile(std::vector<double>* values, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values->size() - 1));
  const auto place = values->begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values->begin(), place, values->end());
  return *place;
}

void Add(double x, double y, Series* series) {
  Point point;
  point.x = x;
  if (std::isfinite(y)) point.y = y;
  series->points.push_back(std::move(point));
}

Series Named(const char* name, bool thick = false) {
  Series series;
  series.name = name;
  series.thick = thick;
  return series;
}

constexpr char kWorldTime[] = "the world's time [s]";

/// Times since 1970 are told from the first one on: of the whole numbers nobody reads the last
/// digits.
void BeginAtFirst(Chart* chart, std::vector<Series>* all) {
  constexpr double kLong = 1e8;  // [s]
  double first = std::numeric_limits<double>::infinity();
  for (const Series& series : *all) {
    for (const Point& point : series.points) first = std::min(first, point.x);
  }
  if (!std::isfinite(first) || first < kLong || chart->x_label != kWorldTime) return;
  first = std::floor(first);
  for (Series& series : *all) {
    for (Point& point : series.points) point.x -= first;
  }
  chart->x_label = "seconds after " + wire::UtcText(static_cast<std::int64_t>(first) * kSecondNs);
}

/// Without the curves that have no point.
Chart WithCurves(Chart chart, std::vector<Series> all) {
  BeginAtFirst(&chart, &all);
  chart.draws_title = true;
  for (Series& series : all) {
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  return chart;
}

/// For how long agents are clear, over time.
class ClearanceCurves final : public Curves {
 public:
  void Sample(std::int64_t now_ns, const WorldView& view) override {
    std::vector<double> clear;
    for (const AgentView& agent : view.Agents()) {
      if (!agent.clearance || agent.clearance->clear_until_ns() == kNone) continue;
      const std::int64_t until = agent.clearance->clear_until_ns();
      clear.push_back(until == kOpen ? std::numeric_limits<double>::infinity()
                                     : std::max(0.0, SecondsOf(until - now_ns)));
    }
    if (clear.empty()) return;
    const double t = SecondsOf(now_ns);
    Add(t, Quantile(&clear, 0), &least_);
    Add(t, Quantile(&clear, 0.1), &tenth_);
    Add(t, Quantile(&clear, 0.5), &median_);
  }

  Chart Draw() const override {
    return WithCurves({.id = "clearance",
                       .title = "How long agents are clear",
                       .x_label = kWorldTime,
                       .y_label = "certainly touches nothing for [s]",
                       .log_x = false,
                       .log_y = false,
                       .caption = "The least is of the agent that may touch another first."},
                      {least_, tenth_, median_});
  }

 private:
  Series least_ = Named("the least", true), tenth_ = Named("nine of ten are longer"),
         median_ = Named("median");
};

/// What was not yet known of the begin of each contact, over the time that was left.
class BracketCurves final : public Curves {
 public:
  void Take(const v1::CollisionEvent& event) override {
    if (event.level().empty()) told_[KeyOf(event)].push_back(event);
  }
  void Sample(std::int64_t, const WorldView&) override {}

  Chart Draw() const override {
    std::vector<std::pair<std::int64_t, const std::vector<v1::CollisionEvent>*>> contacts;
    for (const auto& [key, revisions] : told_) {
      const v1::CollisionEvent& last = revisions.back();
      const bool is_contact =
          last.status() == v1::EVENT_CONFIRMED || last.status() == v1::EVENT_ENDED;
      if (is_contact && last.begin().latest_ns() != kOpen) {
        contacts.emplace_back(last.begin().latest_ns(), &revisions);
      }
    }
    std::ranges::sort(contacts);
    std::vector<Series> all;
    for (const auto& [begin_ns, revisions] : contacts) {
      if (all.size() == kContactsShown) break;
      all.push_back(CurveOf(begin_ns, *revisions));
    }
    const std::size_t shown = all.size();
    return WithCurves(
        {.id = "brackets",
         .title = "What was not yet known of the begin of contacts",
         .x_label = "before it began [s]",
         .y_label = "width of what was possible [s]",
         .caption = "Each curve is a contact, from right to left; the first " +
                    std::to_string(shown) + " of " + std::to_string(contacts.size()) + "."},
        std::move(all));
  }

 private:
  static constexpr std::size_t kContactsShown = 8;
  static constexpr double kLeastLead = 1e-4;  ///< [s]; what came later stands there.

  static Series CurveOf(std::int64_t begin_ns, const std::vector<v1::CollisionEvent>& revisions) {
    const v1::CollisionEvent& last = revisions.back();
    Series series;
    series.name = last.lower_label().agent_name() + " - " + last.higher_label().agent_name();
    for (const v1::CollisionEvent& one : revisions) {
      const std::int64_t latest = std::min(one.begin().latest_ns(), begin_ns);
      const std::int64_t earliest =
          std::max(one.begin().earliest_ns(), one.now_ns() < latest ? one.now_ns() : kNone);
      Add(std::max(kLeastLead, SecondsOf(begin_ns - one.now_ns())),
          std::max(1e-9, SecondsOf(latest - earliest)), &series);
    }
    return series;
  }

  std::map<EventKey, std::vector<v1::CollisionEvent>> told_;
};

/// How old states are when the service takes them; where time is that of simulators, how long a
/// second of it takes.
class LatencyCurves final : public Curves {
 public:
  explicit LatencyCurves(std::function<std::int64_t()> wall_ns) : wall_ns_(std::move(wall_ns)) {}

  void Take(const v1::ServiceStatus& status) override { is_simulated_ = status.simulated_clock(); }

  void Take(const v1::AgentStates& states) override {
    if (is_simulated_.value_or(true)) return;
    for (const v1::AgentState& state : states.states()) {
      seconds_.push_back(SecondsOf(wall_ns_() - state.stamp_ns()));
    }
  }

  void Sample(std::int64_t now_ns, const WorldView&) override {
    const std::int64_t wall_ns = wall_ns_();
    if (is_simulated_.value_or(false) && before_ns_ != kNone && now_ns > world_before_ns_) {
      seconds_.push_back(SecondsOf(wall_ns - before_ns_) / SecondsOf(now_ns - world_before_ns_));
    }
    before_ns_ = wall_ns;
    world_before_ns_ = now_ns;
    if (seconds_.empty() || now_ns < due_ns_) return;
    due_ns_ = now_ns + kBucketNs;
    const double t = SecondsOf(now_ns);
    Add(t, Quantile(&seconds_, 0.5), &median_);
    Add(t, Quantile(&seconds_, 0.99), &high_);
    Add(t, Quantile(&seconds_, 1), &greatest_);
    seconds_.clear();
  }

  Chart Draw() const override {
    const bool is_simulated = is_simulated_.value_or(true);
    return WithCurves({.id = "latency",
                       .title = is_simulated ? "How long a second of the world takes"
                                             : "How old states are when the service takes them",
                       .x_label = kWorldTime,
                       .y_label = is_simulated ? "wall time [s]" : "age of states [s]",
                       .log_x = false,
                       .caption = "Of half a second each; by the clock of the service's machine."},
                      {median_, high_, greatest_});
  }

 private:
  static constexpr std::int64_t kBucketNs = 500'000'000;

  const std::function<std::int64_t()> wall_ns_;
  std::optional<bool> is_simulated_;
  std::int64_t before_ns_ = kNone, world_before_ns_ = kNone, due_ns_ = kNone;
  std::vector<double> seconds_;
  Series median_ = Named("median", true), high_ = Named("99 of 100 are less"),
         greatest_ = Named("the greatest");
};

/// How many pairs the service has to do with.
class PairCurves final : public Curves {
 public:
  void Take(const v1::CollisionEvent& event) override {
    if (!event.level().empty()) return;
    if (const auto ended = slots_.Take(event)) open_.erase(*ended);
    const bool is_open =
        event.status() == v1::EVENT_POSSIBLE || event.status() == v1::EVENT_CONFIRMED;
    is_open ? static_cast<void>(open_[KeyOf(event)] = event)
            : static_cast<void>(open_.erase(KeyOf(event)));
  }
  void Take(const v1::ServiceStatus& status) override { tracked_ = status.pairs_tracked(); }

  void Sample(std::int64_t now_ns, const WorldView&) override {
    double contacts = 0, expected = 0;
    for (const auto& [key, event] : open_) {
      contacts += event.status() == v1::EVENT_CONFIRMED;
      expected += event.status() == v1::EVENT_POSSIBLE && IsExpected(event);
    }
    const double t = SecondsOf(now_ns);
    if (tracked_) Add(t, *tracked_, &tracked_curve_);
    Add(t, static_cast<double>(open_.size()) - contacts, &possible_);
    Add(t, expected, &expected_);
    Add(t, contacts, &contacts_);
  }

  Chart Draw() const override {
    return WithCurves({.id = "pairs",
                       .title = "Pairs that the service has to do with",
                       .x_label = kWorldTime,
                       .y_label = "pairs",
                       .log_x = false,
                       .caption = "Tracked: near enough to be looked at one by one."},
                      {tracked_curve_, possible_, expected_, contacts_});
  }

 private:
  std::optional<double> tracked_;
  ForecastSlots slots_;
  std::map<EventKey, v1::CollisionEvent> open_;
  Series tracked_curve_ = Named("tracked"), possible_ = Named("may touch"),
         expected_ = Named("touch if they go on so"), contacts_ = Named("touch", true);
};

}  // namespace

std::unique_ptr<Curves> MakeCurves(const std::string& what, std::function<std::int64_t()> wall_ns) {
  if (what == "clearance") return std::make_unique<ClearanceCurves>();
  if (what == "brackets") return std::make_unique<BracketCurves>();
  if (what == "latency") return std::make_unique<LatencyCurves>(std::move(wall_ns));
  return std::make_unique<PairCurves>();
}

}  // namespace collision::client
