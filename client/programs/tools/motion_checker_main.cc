// motion-checker: compares the events of a run with the true contacts of the simulators' motion
// logs.

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "client/checker/check.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"

namespace collision::checker {
namespace {

std::ifstream Open(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    std::fprintf(stderr, "motion-checker: %s: cannot be read\n", path.c_str());
    std::exit(client::kExitNoInput);
  }
  return file;
}

std::string TextOf(const std::string& path) {
  std::ifstream file = Open(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

v1::Config ConfigOf(const std::string& path) {
  v1::Config config;
  if (!google::protobuf::TextFormat::ParseFromString(TextOf(path), &config))
    throw std::runtime_error(path + ": not the text of a configuration");
  return config;
}

int Run(const std::string& report_path, const std::vector<std::string>& logs,
        const RunFacts& facts) {
  std::vector<AgentMotion> motions;
  for (const std::string& path : logs) {
    std::ifstream file = Open(path);
    auto more = ReadMotionLog(file, std::filesystem::path(path).stem().string());
    std::move(more.begin(), more.end(), std::back_inserter(motions));
  }
  Observations observations;
  if (!report_path.empty()) {
    v1::RunReport report;
    const auto status = google::protobuf::util::JsonStringToMessage(TextOf(report_path), &report);
    if (!status.ok()) throw std::runtime_error(report_path + ": " + status.ToString());
    observations.events = {report.events().begin(), report.events().end()};
    observations.names = {report.names().begin(), report.names().end()};
  }
  const Evidence evidence(std::move(motions), observations, facts);
  const std::size_t certain = evidence.contacts_certain();
  std::printf("%zu agents, %zu true contacts", evidence.motions().size(), certain);
  const std::size_t grazes = evidence.contacts().size() - certain;
  if (grazes > 0) std::printf(", %zu grazes", grazes);
  std::printf("\n");
  if (report_path.empty()) {
    for (const TrueContact& contact : evidence.contacts()) {
      std::printf("%s  %s to %s%s\n", evidence.PairName(contact.a, contact.b).c_str(),
                  evidence.Time(contact.begin_ns).c_str(), evidence.Time(contact.end_ns).c_str(),
                  contact.certain ? "" : "  (a graze)");
    }
    return 0;
  }
  Violations violations = CheckEvents(evidence);
  for (const Violations& more : {CheckGeometry(evidence), CheckLevels(evidence)}) {
    violations.insert(violations.end(), more.begin(), more.end());
  }
  for (const std::string& violation : violations) std::printf("violation: %s\n", violation.c_str());
  std::size_t events = evidence.histories().size();
  for (const Evidence& level : evidence.levels()) events += level.histories().size();
  std::printf("%zu events checked: %s\n", events,
              violations.empty() ? "satisfied" : "NOT satisfied");
  return violations.empty() ? 0 : 1;
}

}  // namespace
}  // namespace collision::checker

int main(int argc, char** argv) {
  using namespace collision::checker;
  std::string report, config;
  std::vector<std::string> logs;
  double leaving = 0;
  RunFacts facts;
  CLI::App app("Computes all true contacts of motion logs and compares a run's events with them.",
               "motion-checker");
  app.add_option("logs", logs, "Motion logs, each named after its simulator")->required();
  app.add_option("--report", report,
                 "Report of scene-runner --json; without it the true contacts are listed");
  app.add_option("--config", config,
                 "Configuration of the service in that run: its levels are judged, too");
  app.add_option("--leaving", leaving,
                 "An agent may have left this many seconds before its motion ends")
      ->check(collision::client::Finite(1e9, true));
  if (const auto code = collision::client::ParseCommandLine(&app, argc, argv)) return *code;
  facts.leaving_ns = std::llround(leaving * 1e9);
  try {
    if (!config.empty()) facts.config = ConfigOf(config);
    return Run(report, logs, facts);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "motion-checker: %s\n", error.what());
    return collision::client::kExitBadData;
  }
}
