#include "tests/bench/service/parts.h"

namespace collision::bench {
namespace {

std::vector<std::string> FigureNames() {
  std::vector<std::string> names = {"messages_saved_ratio", "crowd_event_p50_ratio",
                                    "crowd_event_p99_ratio"};
  for (const char* agents : {"_100", "_1000", "_10000"}) {
    for (const char* name :
         {"service_event_p50_s", "service_event_p99_s", "network_event_p50_s",
          "network_event_p99_s", "service_event_p50_ratio", "service_updates_per_s",
          "network_updates_per_s", "service_updates_ratio"}) {
      names.push_back(std::string(name) + agents);
    }
  }
  for (const std::string protection : kProtections) {
    names.push_back("secured_event_p50_ratio_" + protection);
    names.push_back("secured_updates_ratio_" + protection);
  }
  names.insert(names.end(), {"recorder_event_p50_ratio", "recorder_updates_ratio"});
  for (const char* agents : {"1000", "10000"}) {
    names.push_back(std::string("lattice_step_ratio_") + agents);
  }
  return names;
}

}  // namespace

ServiceReport::ServiceReport() : RowReport(FigureNames(), "", "") {}

}  // namespace collision::bench
