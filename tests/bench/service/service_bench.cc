// ./run bench service: latency, throughput and messages of the whole service.
#include <CLI/CLI.hpp>

#include "tests/bench/service/parts.h"
#include "tests/bench/service/process.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the service beside a program that answers at once, on this machine only.",
               "service-bench");
  ServiceSettings settings;
  std::string contestant, world;
  settings.AddTo(&app, "fewer agents and repetitions: less than 20 s",
                 "only cells whose name PART/WHAT contains this");
  app.add_option("--domain", settings.domain, "DDS domain")->check(CLI::Range(0, 230));
  app.add_option("--serve", contestant, "")->group("");  // the child's side
  app.add_option("--world", world, "")->group("");
  CLI11_PARSE(app, count, arguments);
  if (!contestant.empty()) return Serve(contestant, world, settings.domain);
  ServiceReport report;
  MessagesPart(settings, &report);
  LatencyPart(settings, &report);
  return Finish(report, settings.json);
}
