#include "tests/support/suite/suite.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/bench/harness/json.h"
#include "tests/bench/harness/measure.h"

namespace collision::suite {
namespace {

constexpr int kBroken = 1, kNothingToRun = 2, kSkipped = 77;
constexpr int kTimesMax = 100;

struct Options {
  Setting setting{.quick = false};
  bool list = false;
  std::string json, only;
  std::vector<std::string> registered;
};

struct Row {
  Case what;
  Outcome outcome;
  double seconds = 0;
};

/// A whole name chooses that case alone, although others begin with it.
std::vector<Case> Chosen(const Suite& suite, const std::string& only) {
  std::vector<Case> chosen;
  for (const Case& one : suite.cases) {
    if (one.full_name() == only) return {one};
    if (one.full_name().find(only) != std::string::npos) chosen.push_back(one);
  }
  return chosen;
}

Row Run(const Case& what, const Setting& setting) {
  Row row{what, {}, 0};
  const bench::CpuStopwatch watch;
  try {
    what.run(setting, &row.outcome);
  } catch (const std::exception& error) {
    row.outcome.Expect(false, error.what());
  }
  row.seconds = watch.seconds();
  return row;
}

void Print(const Row& row) {
  const std::string fault = row.what.fault.empty() ? "" : "    fault     " + row.what.fault + "\n";
  std::printf("%s %s %s  %s\n%s    promised  %s\n    measured  %s\n",
              row.outcome.passed() ? "kept  " : "BROKEN",
              bench::Padded(row.what.full_name(), 30).c_str(),
              bench::SecondsText(row.seconds).c_str(),
              (Show(static_cast<double>(row.outcome.checks())) + " checks").c_str(), fault.c_str(),
              row.what.promise.c_str(), row.outcome.Measured().c_str());
  std::fflush(stdout);
}

std::size_t FieldsOf(const Row& row) {
  return (row.what.fault.empty() ? 8 : 9) + row.outcome.numbers().size() +
         row.outcome.lists().size();
}

std::string Measurement(const std::string& part, const Row& row) {
  std::vector<bench::Field> fields = {
      bench::Text("part", part),
      bench::Text("group", row.what.group),
      bench::Text("name", row.what.name),
      bench::Text("promised", row.what.promise),
      bench::Text("measured", row.outcome.Measured()),
      bench::Text("kept", row.outcome.passed() ? "yes" : "NO"),
      bench::Number("checks", static_cast<double>(row.outcome.checks())),
      bench::Number("cpu_s", row.seconds)};
  if (!row.what.fault.empty()) fields.push_back(bench::Text("fault", row.what.fault));
  for (const auto& [name, value] : row.outcome.numbers()) {
    fields.push_back(bench::Number(name, value));
  }
  for (const auto& [name, values] : row.outcome.lists()) {
    fields.push_back(bench::List(name, values));
  }
  return bench::Object(fields);
}

std::string Json(const std::string& part, const std::vector<Row>& rows) {
  bench::Figures figures({part + "_cases", part + "_broken", part + "_checks", part + "_cpu_s"});
  double broken = 0, checks = 0, seconds = 0;
  std::vector<std::string> measurements;
  for (const Row& row : rows) {
    broken += row.outcome.passed() ? 0 : 1;
    checks += static_cast<double>(row.outcome.checks());
    seconds += row.seconds;
    measurements.push_back(Measurement(part, row));
  }
  figures.Set(part + "_cases", static_cast<double>(rows.size()));
  figures.Set(part + "_broken", broken);
  figures.Set(part + "_checks", checks);
  figures.Set(part + "_cpu_s", seconds);
  return figures.Json(measurements);
}

/// Whether a reader takes the file, and finds every case in it with all its fields, each once.
bool IsReadBack(const std::string& path, const std::vector<Row>& rows) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  google::protobuf::Struct file;
  const auto status = google::protobuf::util::JsonStringToMessage(text.str(), &file);
  if (!status.ok()) {
    std::fprintf(stderr, "%s: %s\n", path.c_str(), status.ToString().c_str());
    return false;
  }
  const auto& measurements = file.fields().at("measurements").list_value().values();
  bool same = measurements.size() == static_cast<int>(rows.size());
  for (int i = 0; same && i < measurements.size(); ++i) {
    const auto& fields = measurements[i].struct_value().fields();
    const Row& row = rows[static_cast<std::size_t>(i)];
    same =
        fields.size() == FieldsOf(row) && fields.at("promised").string_value() == row.what.promise;
    for (const auto& [name, value] : row.outcome.numbers()) {
      same = same && fields.contains(name) &&
             std::abs(fields.at(name).number_value() - value) <= 1e-8 * std::abs(value);
    }
    for (const auto& [name, values] : row.outcome.lists()) {
      same = same && fields.contains(name) &&
             fields.at(name).list_value().values_size() == static_cast<int>(values.size());
    }
  }
  if (!same) std::fprintf(stderr, "%s is not what was measured\n", path.c_str());
  return same;
}

/// Every case must be registered as a test, and every test be a case.
int CompareWith(const Suite& suite, const std::vector<std::string>& registered) {
  std::set<std::string> missing(registered.begin(), registered.end());
  int status = 0;
  for (const Case& one : suite.cases) {
    if (missing.erase(one.full_name()) == 1) continue;
    std::fprintf(stderr, "not registered as a test: %s\n", one.full_name().c_str());
    status = kBroken;
  }
  for (const std::string& name : missing) {
    std::fprintf(stderr, "registered, but no case: %s\n", name.c_str());
    status = kBroken;
  }
  return status;
}

int RunAll(const Suite& suite, const Options& options) {
  const std::vector<Case> chosen = Chosen(suite, options.only);
  if (chosen.empty()) {
    std::fprintf(stderr, "--only: no case's name contains \"%s\"; see --list\n",
                 options.only.c_str());
    return kNothingToRun;
  }
  const std::string obstacle = suite.obstacle == nullptr ? "" : suite.obstacle();
  if (!obstacle.empty()) {
    std::fprintf(stderr, "skipped: %s\n", obstacle.c_str());
    return kSkipped;
  }
  std::vector<Row> rows;
  for (const Case& one : chosen) {
    std::fprintf(stderr, "[%zu/%zu] %s\n", rows.size() + 1, chosen.size(), one.full_name().c_str());
    rows.push_back(Run(one, options.setting));
    Print(rows.back());
  }
  const auto broken =
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.outcome.passed(); });
  std::printf("%zu cases, %td broken\n", rows.size(), broken);
  if (const int status = bench::WriteJson(options.json, Json(suite.part, rows)); status != 0)
    return status;
  if (!options.json.empty() && !IsReadBack(options.json, rows)) return kBroken;
  return broken == 0 ? 0 : kBroken;
}

}  // namespace

int RunSuite(const Suite& suite, int argc, char** argv) {
  Options options;
  CLI::App app(suite.about);
  app.add_flag("--quick", options.setting.quick, "fewer and shorter");
  app.add_option("--times", options.setting.times,
                 "so many times as many seeds, pairs or laps of each case")
      ->check(CLI::Range(1, kTimesMax))
      ->capture_default_str();
  app.add_flag("--list", options.list, "only name the cases");
  app.add_option("--json", options.json, "write every case, and the figures, to this file");
  app.add_option("--only", options.only,
                 "only cases whose GROUP/NAME contains this; a whole name: that case alone");
  app.add_option("--registered", options.registered, "compare these names with the cases");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? 0 : kNothingToRun;
  }
  if (!options.registered.empty()) return CompareWith(suite, options.registered);
  if (!options.list) return RunAll(suite, options);
  for (const Case& one : suite.cases) std::printf("%s\n", one.full_name().c_str());
  return 0;
}

}  // namespace collision::suite
