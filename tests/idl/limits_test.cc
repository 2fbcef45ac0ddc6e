// Goal:   limits.h and collision.idl agree: what the code calls the longest text or list is the
//         bound that the wire has.
// Method: each constant against the bound of a field that it limits, read from the IDL file.
#include "idl/limits.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/idl/idl_file.h"

namespace collision {
namespace {

/// The bound of a string or sequence; 0 if there is no such field.
std::size_t BoundOf(const std::string& type, const std::string& name) {
  const auto found = Idl().structs.find(type);
  if (found == Idl().structs.end()) return 0;
  const auto field = std::find_if(found->second.begin(), found->second.end(),
                                  [&name](const IdlField& one) { return one.name == name; });
  return field == found->second.end() ? 0 : field->bound;
}

TEST(Limits, LengthsAreTheBoundsOfTheIdl) {
  EXPECT_EQ(BoundOf("AgentDescription", "simulator_name"), wire::kNameMax);
  EXPECT_EQ(BoundOf("AgentDescription", "agent_name"), wire::kNameMax);
  EXPECT_EQ(BoundOf("AgentDescription", "class_name"), wire::kClassNameMax);
  EXPECT_EQ(BoundOf("CollisionEvent", "level"), wire::kLevelNameMax);
  EXPECT_EQ(BoundOf("AgentDescription", "assembly"), wire::kNameMax);
  EXPECT_EQ(BoundOf("SimulatorClock", "simulator_name"), wire::kNameMax);
  EXPECT_EQ(BoundOf("SimulatorStatus", "name"), wire::kNameMax);
  EXPECT_EQ(BoundOf("ServiceStatus", "world"), wire::kNameMax);
  EXPECT_EQ(BoundOf("SimulatorReport", "name"), wire::kNameMax);
  EXPECT_EQ(BoundOf("Rejection", "field"), wire::kRefusedFieldMax);
  EXPECT_EQ(BoundOf("AgentBreach", "field"), wire::kBreachFieldMax);
  EXPECT_EQ(BoundOf("StandingRefusal", "field"), wire::kRefusedFieldMax);
  EXPECT_EQ(BoundOf("StandingRefusal", "detail"), wire::kRefusalDetailMax);
  EXPECT_EQ(BoundOf("Rejection", "detail"), wire::kRefusalDetailMax);
  EXPECT_EQ(BoundOf("AgentDescription", "assembly"), wire::kNameMax);
  EXPECT_EQ(BoundOf("Tag", "key"), wire::kTagKeyMax);
  EXPECT_EQ(BoundOf("Tag", "value"), wire::kTagValueMax);
  for (const char* hello : {"ServiceHello", "SimulatorHello"}) {
    EXPECT_EQ(BoundOf(hello, "frame"), wire::kLabelMax);
    EXPECT_EQ(BoundOf(hello, "version"), wire::kLabelMax);
  }
  EXPECT_EQ(BoundOf("ServiceHello", "world"), wire::kNameMax);
  EXPECT_EQ(BoundOf("ServiceHello", "epoch_utc"), wire::kLabelMax);
  EXPECT_EQ(BoundOf("SimulatorHello", "simulator_name"), wire::kNameMax);
  EXPECT_EQ(BoundOf("ServiceStatus", "frame"), wire::kLabelMax);
  EXPECT_EQ(BoundOf("ServiceStatus", "epoch_utc"), wire::kLabelMax);
  for (const char* name : {"simulator_name", "agent_name", "assembly"}) {
    EXPECT_EQ(BoundOf("AgentLabel", name), wire::kNameMax);
  }
  EXPECT_EQ(BoundOf("KeyValue", "value"), wire::kExtensionValueMax);
  EXPECT_EQ(BoundOf("ServiceStatus", "broad_phase"), wire::kStatusBroadPhaseMax);
  EXPECT_EQ(BoundOf("ServiceStatus", "broad_phase_why"), wire::kStatusBroadPhaseWhyMax);
  EXPECT_EQ(BoundOf("ServiceStatus", "build"), wire::kStatusBuildMax);
  EXPECT_EQ(BoundOf("SimulatorStatus", "refused_why"), wire::kStatusRefusedWhyMax);
}

TEST(Limits, CountsAreTheBoundsOfTheIdl) {
  const auto count = [](int limit) { return static_cast<std::size_t>(limit); };
  EXPECT_EQ(BoundOf("AgentStates", "states"), count(wire::kStatesPerSampleMax));
  EXPECT_EQ(BoundOf("Clearance", "agents"), count(wire::kStatesPerChunkMax));
  EXPECT_EQ(BoundOf("ServiceStatus", "simulators"), count(wire::kStatusSimulatorsMax));
  EXPECT_EQ(BoundOf("ServiceStatus", "counters"), count(wire::kStatusCountersMax));
  EXPECT_EQ(BoundOf("ServiceStatus", "left_out"), count(wire::kStatusLeftOutMax));
  EXPECT_EQ(BoundOf("ServiceStatus", "histograms"), count(wire::kStatusHistogramsMax));
  EXPECT_EQ(BoundOf("Histogram", "counts"), count(wire::kHistogramCountsMax));
  EXPECT_EQ(BoundOf("SimulatorStatus", "quotas"), count(wire::kSimulatorQuotasMax));
  EXPECT_EQ(BoundOf("AgentDescription", "tags"), count(wire::kTagsMax));
  EXPECT_EQ(BoundOf("AgentLabel", "tags"), count(wire::kTagsMax));
  EXPECT_EQ(BoundOf("ServiceHello", "regions"), count(wire::kRegionsMax));
  EXPECT_EQ(BoundOf("ServiceHello", "extensions"), count(wire::kHelloExtensionsMax));
  EXPECT_EQ(BoundOf("SimulatorHello", "extensions"), count(wire::kHelloExtensionsMax));
  EXPECT_EQ(BoundOf("Watch", "agents"), count(wire::kWatchAgentsMax));
  EXPECT_EQ(BoundOf("AgentDescription", "meets_in_assembly"), count(wire::kPartnersListedMax));
  EXPECT_EQ(BoundOf("AgentDescription", "never_meets"), count(wire::kPartnersListedMax));
  EXPECT_EQ(BoundOf("CollisionEvent", "extensions"), count(wire::kEventExtensionsMax));
  EXPECT_EQ(BoundOf("ServiceStatus", "extensions"), count(wire::kStatusExtensionsMax));
  EXPECT_EQ(BoundOf("SimulatorReport", "refusals"), count(wire::kReportRefusalsMax));
  EXPECT_EQ(BoundOf("ShapePart", "bytes"), wire::kShapePartBytes);
}

TEST(Limits, TheRevisionIsThatOfTheIdl) {
  EXPECT_EQ(Idl().constants.at("WIRE_REVISION"), wire::kWireRevision);
}

// Goal:   a name that would be another partition, or several, is refused.
TEST(Limits, NamesAreShortAndWithoutWildcards) {
  for (const char* name : {"a", "Z_9-", "default", "-"}) EXPECT_TRUE(wire::IsName(name)) << name;
  EXPECT_TRUE(wire::IsName(std::string(wire::kNameMax, 'x')));
  EXPECT_FALSE(wire::IsName(std::string(wire::kNameMax + 1, 'x')));
  for (const char* name : {"", "a.b", "a*", "?", "a b", "\xc3\xa4", "/"}) {
    EXPECT_FALSE(wire::IsName(name)) << name;
  }
}

}  // namespace
}  // namespace collision
