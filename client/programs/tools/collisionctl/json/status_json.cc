#include "client/programs/tools/collisionctl/json/status_json.h"

#include <limits>
#include <vector>

#include "client/programs/tools/collisionctl/json/agent_reference.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "client/programs/tools/collisionctl/status/verdict.h"
#include "idl/histogram.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

constexpr std::int64_t kNotGiven = std::numeric_limits<std::int64_t>::min();

std::string SimulatorJson(const v1::SimulatorStatus& simulator) {
  JsonObject object;
  object.Text("name", simulator.name())
      .Id("simulator_id", simulator.simulator_id())
      .Count("run", simulator.run())
      .Flag("alive", simulator.alive())
      .Instant("clock", simulator.clock_ns())
      .Flag("granted", simulator.granted_until_ns() != kNotGiven)
      .Instant("granted_until", simulator.granted_until_ns())
      .Count("agents", simulator.agents())
      .Count("states", simulator.states())
      .Count("rejected", simulator.rejected());
  if (simulator.has_clock_offset()) {
    object.Add("clock_offset", JsonObject()
                                   .Instant("earliest", simulator.clock_offset().earliest_ns())
                                   .Instant("latest", simulator.clock_offset().latest_ns())
                                   .Json());
  } else {
    object.Null("clock_offset");
  }
  JsonObject quotas;
  for (const v1::QuotaUse& use : simulator.quotas()) {
    quotas.Add(use.resource(),
               JsonObject().Count("used", use.used()).Count("most", use.most()).Json());
  }
  object.Add("quotas", quotas.Json())
      .Count("refused_now", simulator.refused_now())
      .TextOrNull("refused_why", simulator.refused_why());
  return object.Json();
}

/// Of one service, in force or not.
void AddService(const v1::ServiceStatus& status, JsonObject* object) {
  object->Id("service_id", status.service_id())
      .Text("phase", Word(v1::ServicePhase_Name(status.phase()), "PHASE_"))
      .Text("version", status.version())
      .TextOrNull("process", ExtensionOf(status, std::string(wire::kProcessExtension)))
      .Count("term", status.stamp().term())
      .Count("epoch", status.stamp().epoch())
      .Count("sequence", status.stamp().sequence())
      .Instant("now", status.now_ns())
      .Count("agents", status.agents());
  if (status.configuration() == 0) {
    object->Null("configuration");
  } else {
    object->Id("configuration", status.configuration());
  }
  JsonObject extensions;
  for (const v1::KeyValue& extension : status.extensions()) {
    extensions.Text(extension.key(), extension.value());
  }
  object->Add("extensions", extensions.Json());
}

/// What the service measures of itself. An end of null: the class holds all that is greater.
void AddMeasurements(const v1::ServiceStatus& status, JsonObject* object) {
  object->TextOrNull("build", status.build())
      .Instant("started", status.started_ns())
      .Number("uptime_s", 1e-9 * static_cast<double>(status.uptime_ns()))
      .Number("cpu_s", 1e-6 * static_cast<double>(status.cpu_us()))
      .Count("memory_bytes", status.memory_bytes());
  JsonObject histograms;
  for (const v1::Histogram& histogram : status.histograms()) {
    std::vector<std::string> classes;
    for (int i = 0; i < histogram.counts_size(); ++i) {
      JsonObject one;
      if (i + 1 < wire::kHistogramCountsMax) {
        one.Count("up_to", wire::ClassEnd(static_cast<std::size_t>(i)));
      } else {
        one.Null("up_to");
      }
      classes.push_back(one.Count("count", histogram.counts(i)).Json());
    }
    histograms.Add(histogram.name(), JsonArray(classes));
  }
  object->Add("histograms", histograms.Json());
}

std::string StandbysJson(const WorldView& view) {
  std::vector<std::string> standbys;
  for (const v1::ServiceStatus& standby : view.Standbys()) {
    JsonObject object;
    AddService(standby, &object);
    object.Flag("same_configuration", standby.configuration() == view.status()->configuration());
    standbys.push_back(object.Json());
  }
  return JsonArray(standbys);
}

void AddWorld(const v1::ServiceStatus& status, JsonObject* object) {
  object->Text("world", status.world())
      .Text("clock", status.simulated_clock() ? "lock-step" : "real-time")
      .TextOrNull("frame", status.frame())
      .TextOrNull("epoch_utc", status.epoch_utc())
      .Instant("granted_until", status.granted_until_ns())
      .Number("lease_s", 1e-9 * static_cast<double>(status.lease_ns()))
      .Count("pairs_tracked", status.pairs_tracked())
      .Count("followers", status.followers())
      .Text("broad_phase", status.broad_phase())
      .Text("broad_phase_why", status.broad_phase_why())
      .Add("left_out", JsonTexts({status.left_out().begin(), status.left_out().end()}));
}

}  // namespace

std::string StatusJson(const WorldView& view) {
  const v1::ServiceStatus& status = *view.status();
  const std::vector<std::string> verdict = Verdict(view);
  std::vector<std::string> simulators;
  for (const v1::SimulatorStatus& simulator : status.simulators()) {
    simulators.push_back(SimulatorJson(simulator));
  }
  JsonObject counters;
  for (const v1::Counter& counter : status.counters()) {
    counters.Count(counter.name(), counter.value());
  }
  JsonObject document = JsonDocument("status");
  document.Flag("well", verdict.front().starts_with("WELL")).Add("verdict", JsonTexts(verdict));
  AddService(status, &document);
  AddWorld(status, &document);
  AddMeasurements(status, &document);
  return document.Add("simulators", JsonArray(simulators))
      .Add("counters", counters.Json())
      .Add("standbys", StandbysJson(view))
      .Json();
}

}  // namespace collision::client
