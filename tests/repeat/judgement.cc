#include "tests/repeat/judgement.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tests/bench/harness/json.h"

namespace collision::repeat {
namespace {

using bench::Format;
using bench::Padded;

/// Flights that must agree: of one scene and length, in the order of the table.
using Key = std::pair<std::string, double>;

std::set<std::string> EventLogs(const Row& row) {
  std::set<std::string> logs;
  for (const Flight& flight : row.flights) logs.insert(flight.event_log);
  return logs;
}

std::size_t CountFailed(const Row& row) {
  return static_cast<std::size_t>(std::count_if(row.flights.begin(), row.flights.end(),
                                                [](const Flight& f) { return !f.satisfied; }));
}

double MedianWall(const Row& row) {
  std::vector<double> times;
  for (const Flight& flight : row.flights) times.push_back(flight.wall_s);
  std::sort(times.begin(), times.end());
  return times.empty() ? 0 : times[times.size() / 2];
}

int CountStops(const Row& row) {
  int stops = 0;
  for (const Flight& flight : row.flights) stops += flight.stops;
  return stops;
}

/// "29396 events, hash 558b0aeee412cafe" of "event log: ..."; several are joined.
std::string LogsText(const std::set<std::string>& logs) {
  std::string text;
  for (const std::string& log : logs) {
    const std::size_t begin = log.find(": ");
    text += text.empty() ? "" : " | ";
    text += begin == std::string::npos ? "none" : log.substr(begin + 2);
  }
  return text;
}

bool HasEvents(const std::string& log) { return log.find(": 0 events") == std::string::npos; }

std::string Measurement(const Row& row) {
  return bench::Object({bench::Text("part", "repeat"), bench::Text("scene", row.series.scene),
                        bench::Text("condition", row.series.condition.name),
                        bench::Number("seconds", row.series.seconds),
                        bench::Number("flights", static_cast<double>(row.flights.size())),
                        bench::Number("failed", static_cast<double>(CountFailed(row))),
                        bench::Number("event_logs", static_cast<double>(EventLogs(row).size())),
                        bench::Text("event_log", LogsText(EventLogs(row))),
                        bench::Number("stops", CountStops(row)),
                        bench::Number("wall_s", MedianWall(row))});
}

}  // namespace

std::string TableHead() {
  return Padded("scene", 17) + Padded("condition", 20) + Padded("seconds", 9) +
         Padded("flights", 9) + Padded("failed", 8) + Padded("logs", 6) + Padded("stops", 7) +
         Padded("wall s", 8) + "event log\n";
}

std::string TableLine(const Row& row) {
  const std::set<std::string> logs = EventLogs(row);
  const auto number = [](double value, std::size_t width) {
    return Padded(Format("%g", value), width);
  };
  return Padded(row.series.scene, 17) + Padded(row.series.condition.name, 20) +
         number(row.series.seconds, 9) + number(static_cast<double>(row.flights.size()), 9) +
         number(static_cast<double>(CountFailed(row)), 8) +
         number(static_cast<double>(logs.size()), 6) + number(CountStops(row), 7) +
         Padded(Format("%.1f", MedianWall(row)), 8) + LogsText(logs) + "\n";
}

std::vector<std::string> Faults(const std::vector<Row>& rows) {
  struct Found {
    std::set<std::string> logs;
    std::size_t failed = 0;
  };
  std::map<Key, Found> groups;
  for (const Row& row : rows) {
    Found& group = groups[{row.series.scene, row.series.seconds}];
    group.logs.merge(EventLogs(row));
    group.failed += CountFailed(row);
  }
  std::vector<std::string> faults;
  for (const auto& [key, group] : groups) {
    const std::string name = key.first + " of " + Format("%g", key.second) + " s: ";
    const std::size_t logs = group.logs.size();
    if (logs > 1) faults.push_back(name + std::to_string(logs) + " different event logs");
    if (group.failed > 0) faults.push_back(name + std::to_string(group.failed) + " flights failed");
    if (group.logs.contains("")) faults.push_back(name + "a flight without an event log");
    if (std::none_of(group.logs.begin(), group.logs.end(), HasEvents))
      faults.push_back(name + "no events");
  }
  return faults;
}

std::string Json(const std::vector<Row>& rows) {
  bench::Figures figures({"repeat_flights", "repeat_scenes", "repeat_faults"});
  std::set<std::string> scenes;
  double flights = 0;
  std::vector<std::string> measurements;
  for (const Row& row : rows) {
    scenes.insert(row.series.scene);
    flights += static_cast<double>(row.flights.size());
    measurements.push_back(Measurement(row));
  }
  figures.Set("repeat_flights", flights);
  figures.Set("repeat_scenes", static_cast<double>(scenes.size()));
  figures.Set("repeat_faults", static_cast<double>(Faults(rows).size()));
  return figures.Json(measurements);
}

}  // namespace collision::repeat
