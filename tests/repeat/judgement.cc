#include "tests/repeat/judgement.h"

#include <algorithm>
#include <map>
#include <set>

#include "tests/bench/harness/json.h"

namespace collision::repeat {
namespace {

using bench::Format;
using bench::Padded;

std::set<std::string> EventLogs(const Row& row) {
  std::set<std::string> logs;
  for (const Flight& flight : row.flights) logs.insert(flight.event_log);
  return logs;
}

double Count(const Row& row, bool Flight::*what) {
  return static_cast<double>(std::count_if(row.flights.begin(), row.flights.end(),
                                           [&](const Flight& flight) { return flight.*what; }));
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

double Flights(const Row& row) { return static_cast<double>(row.flights.size()); }

std::string Measurement(const Row& row) {
  return bench::Object(
      {bench::Text("part", "repeat"), bench::Text("scene", row.series.scene),
       bench::Text("condition", row.series.condition.name),
       bench::Number("seconds", row.series.seconds), bench::Number("speed", row.series.speed),
       bench::Number("flights", Flights(row)), bench::Number("ended", Count(row, &Flight::ended)),
       bench::Number("satisfied", Count(row, &Flight::satisfied)),
       bench::Number("event_logs", static_cast<double>(EventLogs(row).size())),
       bench::Text("event_log", LogsText(EventLogs(row))), bench::Number("stops", CountStops(row)),
       bench::Number("wall_s", MedianWall(row))});
}

}  // namespace

std::string TableHead() {
  return Padded("scene", 16) + Padded("condition", 20) + Padded("seconds", 8) + Padded("speed", 7) +
         Padded("flights", 8) + Padded("ended", 6) + Padded("satisfied", 10) + Padded("logs", 5) +
         Padded("stops", 7) + Padded("wall s", 7) + "event log\n";
}

std::string TableLine(const Row& row) {
  const std::set<std::string> logs = EventLogs(row);
  const auto number = [](double value, std::size_t width) {
    return Padded(Format("%g", value), width);
  };
  const double speed = row.series.speed;
  return Padded(row.series.scene, 16) + Padded(row.series.condition.name, 20) +
         number(row.series.seconds, 8) + Padded(speed > 0 ? Format("%.3g", speed) : "-", 7) +
         number(Flights(row), 8) + number(Count(row, &Flight::ended), 6) +
         number(Count(row, &Flight::satisfied), 10) + number(static_cast<double>(logs.size()), 5) +
         number(CountStops(row), 7) + Padded(Format("%.1f", MedianWall(row)), 7) + LogsText(logs) +
         "\n";
}

std::vector<std::string> Faults(const std::vector<Row>& rows) {
  struct Found {
    std::set<std::string> logs;
    double broken_off = 0;
  };
  std::map<std::string, Found> scenes;
  for (const Row& row : rows) {
    Found& scene = scenes[row.series.scene];
    scene.logs.merge(EventLogs(row));
    scene.broken_off += Flights(row) - Count(row, &Flight::ended);
  }
  std::vector<std::string> faults;
  for (const Row& row : rows) {
    if (row.series.condition.starves() && CountStops(row) == 0)
      faults.push_back(row.series.name() + ": nothing was stopped");
  }
  for (const auto& [name, scene] : scenes) {
    const std::size_t logs = scene.logs.size();
    if (logs > 1) faults.push_back(name + ": " + std::to_string(logs) + " different event logs");
    if (scene.broken_off > 0)
      faults.push_back(name + Format(": %g flights did not run to their end", scene.broken_off));
    if (scene.logs.contains("")) faults.push_back(name + ": a flight without an event log");
    if (std::none_of(scene.logs.begin(), scene.logs.end(), HasEvents))
      faults.push_back(name + ": no events");
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
