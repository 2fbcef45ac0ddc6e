// ./run bench service: latency, throughput and messages of the whole service.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/json.h"
#include "tests/bench/service_parts.h"
#include "tests/bench/service_process.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the service beside a program that answers at once, on this machine only.",
               "service-bench");
  ServiceSettings settings;
  std::string json, contestant, world;
  app.add_flag("--quick", settings.quick, "fewer agents and repetitions: less than 20 s");
  app.add_option("--json", json, "write every measurement and the figures to this file");
  app.add_option("--only", settings.only, "only cells whose name PART/WHAT contains this");
  app.add_option("--domain", settings.domain, "DDS domain")->check(CLI::Range(0, 230));
  app.add_option("--serve", contestant, "")->group("");  // the child's side
  app.add_option("--world", world, "")->group("");
  CLI11_PARSE(app, count, arguments);
  if (!contestant.empty()) return Serve(contestant, world, settings.domain);
  ServiceReport report;
  MessagesPart(settings, &report);
  LatencyPart(settings, &report);
  std::fputs(report.Table().c_str(), stdout);
  return WriteJson(json, report.Json());
}
