#include "tests/network/printed_events.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace collision::network {
namespace {

using google::protobuf::Struct;

v1::AgentId IdOf(const Struct& agent) {
  const auto number = [&](const char* key) {
    return static_cast<std::uint32_t>(agent.fields().at(key).number_value());
  };
  v1::AgentId id;
  id.set_simulator_id(std::stoull(agent.fields().at("simulator_id").string_value(), nullptr, 16));
  id.set_run(number("run"));
  id.set_slot(number("slot"));
  id.set_generation(number("generation"));
  return id;
}

/// "possible" is EVENT_POSSIBLE.
v1::EventStatus StatusOf(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  v1::EventStatus status{};
  if (!v1::EventStatus_Parse("EVENT_" + word, &status)) throw std::invalid_argument(word);
  return status;
}

std::int64_t InstantOf(const google::protobuf::Value& value) {
  return value.has_string_value() ? std::stoll(value.string_value())
                                  : std::numeric_limits<std::int64_t>::max();
}

v1::CollisionEvent EventOf(const Struct& document) {
  const auto& fields = document.fields();
  const auto& begin = fields.at("begin").struct_value().fields();
  v1::CollisionEvent event;
  *event.mutable_lower() = IdOf(fields.at("lower").struct_value());
  *event.mutable_higher() = IdOf(fields.at("higher").struct_value());
  event.set_contact(static_cast<std::uint32_t>(fields.at("contact").number_value()));
  // Null, of a forecast, reads as 0.
  event.set_contacts_sequence(
      static_cast<std::uint64_t>(fields.at("contacts_sequence").number_value()));
  event.set_status(StatusOf(fields.at("status").string_value()));
  event.mutable_begin()->set_earliest_ns(InstantOf(begin.at("earliest_ns")));
  event.mutable_begin()->set_latest_ns(InstantOf(begin.at("latest_ns")));
  return event;
}

}  // namespace

std::vector<v1::CollisionEvent> ParseEvents(const std::string& lines) {
  std::vector<v1::CollisionEvent> events;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    Struct document;
    if (!google::protobuf::util::JsonStringToMessage(line, &document).ok()) continue;
    const auto kind = document.fields().find("kind");
    if (kind == document.fields().end() || kind->second.string_value() != "event") continue;
    events.push_back(EventOf(document));
  }
  return events;
}

}  // namespace collision::network
