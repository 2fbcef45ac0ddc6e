// A monitor: prints every event of a world, with the names of its agents.
#include <chrono>
#include <cstdio>
#include <map>

#include "collision/event_text.h"
#include "collision/monitor.h"
#include "collision/pending_names.h"

using namespace collision::client;
using namespace std::chrono_literals;

int main() {
  std::map<AgentId, std::string> names;
  PendingNames pending;
  Monitor monitor(
      {.simulators = true},
      {.event = [&](const Event& event) { pending.Add(event, std::chrono::steady_clock::now()); },
       .description =
           [&](const DescribedAgent& agent) { names[agent.id] = agent.description.name; }});
  const auto is_named = [&](const AgentId& id) { return names.contains(id); };
  const auto name = [&](const AgentId& id) { return is_named(id) ? names[id] : "?"; };
  for (;;) {
    monitor.Poll(100ms);
    for (const Event& event : pending.Take(is_named, std::chrono::steady_clock::now())) {
      std::puts(EventLine(event, name, 0).c_str());
    }
  }
}
