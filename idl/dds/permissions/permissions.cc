#include "idl/dds/permissions/permissions.h"

#include <functional>
#include <stdexcept>
#include <vector>

#include "idl/credentials/validity.h"
#include "idl/dds/topics.h"

namespace collision::dds {
namespace {

constexpr char kHead[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n"
    "     xsi:noNamespaceSchemaLocation=\"http://www.omg.org/spec/DDS-Security/20170901/";

/// What stands in `name`, on a line of its own.
std::string Element(const std::string& indent, const std::string& name, const std::string& text) {
  return indent + "<" + name + ">" + text + "</" + name + ">\n";
}

std::string Domains(const std::string& indent, std::uint32_t domain) {
  return indent + "<domains>\n" + Element(indent + "  ", "id", std::to_string(domain)) + indent +
         "</domains>\n";
}

/// Topics that a program reads or writes in one partition.
struct Rule {
  bool writes = false;
  std::string partition;
  std::vector<std::string> topics;
};

std::vector<std::string> TopicsOf(const std::function<bool(const TopicRow&)>& wanted) {
  std::vector<std::string> names;
  for (const TopicRow& row : Topics()) {
    if (wanted(row)) names.emplace_back(row.name);
  }
  return names;
}

std::vector<std::string> TopicsOf(Source source) {
  return TopicsOf([source](const TopicRow& row) { return row.source == source; });
}

/// The earliest intersection is for monitors: it is computed for its readers.
std::vector<std::string> TopicsOfServiceForSimulators() {
  return TopicsOf([](const TopicRow& row) {
    return row.source == Source::kService && row.id != TopicId::kEarliestIntersection;
  });
}

std::vector<Rule> RulesOf(const Grantee& grantee) {
  const std::string& world = grantee.world;
  const std::string simulators = world + ".*", operators = world + kOperatorsPartition,
                    watchers = world + kWatchersPartition;
  const Rule reads_service{false, world, TopicsOf(Source::kService)};
  const Rule reads_simulators{false, simulators, TopicsOf(Source::kSimulators)};
  const Rule watches{true, watchers, TopicsOf(Source::kWatchers)};
  switch (grantee.role) {
    case DdsRole::kService:
      // A standby follows other services, and a health check has the credentials of its service.
      return {{true, world, TopicsOf(Source::kService)},
              reads_simulators,
              reads_service,
              {false, operators, TopicsOf(Source::kOperators)}};
    case DdsRole::kSimulator: {
      const Rule writes{true, world + "." + grantee.name, TopicsOf(Source::kSimulators)},
          is_watched{false, watchers, TopicsOf(Source::kWatchers)};
      if (grantee.monitors) return {writes, is_watched, reads_service, reads_simulators, watches};
      return {writes, is_watched, {false, world, TopicsOfServiceForSimulators()}};
    }
    case DdsRole::kMonitor:
      return {reads_service, reads_simulators, watches};
    case DdsRole::kOperator:
      return {{true, operators, TopicsOf(Source::kOperators)},
              reads_service,
              reads_simulators,
              watches};
    case DdsRole::kWatcher:
      break;
  }
  throw std::invalid_argument("permissions: this role has none of its own");
}

std::string RuleXml(const Rule& rule, std::uint32_t domain) {
  const std::string name = rule.writes ? "publish" : "subscribe";
  std::string xml = "      <allow_rule>\n" + Domains("        ", domain);
  xml += "        <" + name + ">\n          <topics>\n";
  for (const std::string& topic : rule.topics) xml += Element("            ", "topic", topic);
  xml += "          </topics>\n          <partitions>\n";
  xml += Element("            ", "partition", rule.partition);
  return xml + "          </partitions>\n        </" + name + ">\n      </allow_rule>\n";
}

const char* KindOf(Protection protection) {
  switch (protection) {
    case Protection::kSign:
      return "SIGN";
    case Protection::kSignForEachReader:
      return "SIGN_WITH_ORIGIN_AUTHENTICATION";
    case Protection::kEncrypt:
      return "ENCRYPT";
  }
  return "SIGN";
}

}  // namespace

std::string GovernanceXml(std::uint32_t domain, Protection protection) {
  std::string xml = std::string(kHead) + "omg_shared_ca_governance.xsd\">\n";
  xml += "  <domain_access_rules>\n    <domain_rule>\n" + Domains("      ", domain);
  const auto add = [&xml](const char* name, const char* value) {
    xml += Element("      ", name, value);
  };
  add("allow_unauthenticated_participants", "false");
  add("enable_join_access_control", "true");
  // Paid for each packet, in which many samples travel; what it protects includes discovery,
  // liveliness and every sample, so that these need nothing more.
  add("discovery_protection_kind", "NONE");
  add("liveliness_protection_kind", "NONE");
  add("rtps_protection_kind", KindOf(protection));
  xml += "      <topic_access_rules>\n        <topic_rule>\n";
  const auto add_to_topic = [&xml](const char* name, const char* value) {
    xml += Element("          ", name, value);
  };
  add_to_topic("topic_expression", "*");
  add_to_topic("enable_discovery_protection", "false");
  add_to_topic("enable_liveliness_protection", "false");
  add_to_topic("enable_read_access_control", "true");
  add_to_topic("enable_write_access_control", "true");
  add_to_topic("metadata_protection_kind", "NONE");
  add_to_topic("data_protection_kind", "NONE");
  xml += "        </topic_rule>\n      </topic_access_rules>\n";
  return xml + "    </domain_rule>\n  </domain_access_rules>\n</dds>\n";
}

std::string PermissionsXml(const Grantee& grantee) {
  std::string xml = std::string(kHead) + "omg_shared_ca_permissions.xsd\">\n";
  xml += "  <permissions>\n    <grant name=\"" + grantee.subject + "\">\n";
  xml += Element("      ", "subject_name", grantee.subject);
  xml += "      <validity>\n";
  xml += Element("        ", "not_before", credentials::XmlDateText(grantee.not_before));
  xml += Element("        ", "not_after", credentials::XmlDateText(grantee.not_after));
  xml += "      </validity>\n";
  for (const Rule& rule : RulesOf(grantee)) xml += RuleXml(rule, grantee.domain);
  xml += Element("      ", "default", "DENY");
  return xml + "    </grant>\n  </permissions>\n</dds>\n";
}

}  // namespace collision::dds
