#include "client/library/network/current_service.h"

#include <algorithm>
#include <iterator>

namespace collision::client {

bool CurrentService::GoesFirst(const v1::ServiceStamp& stamp, bool followed) const {
  if (ended_.contains(stamp.service_id())) return false;
  const bool own = followed_ && !ended_.contains(id_);
  if (own != followed) return followed;
  return stamp.term() != term_ ? stamp.term() > term_ : stamp.service_id() < id_;
}

bool CurrentService::Hear(const v1::ServiceHeard& heard) {
  if (!heard.ended()) {
    ended_.erase(heard.service_id());
    return false;
  }
  if (ended_.size() == kEndedMax) ended_.erase(ended_.begin());
  ended_.insert(heard.service_id());
  return heard.service_id() == id_;
}

bool CurrentService::Accept(const v1::ServiceStamp& stamp, Time now, bool followed) {
  if (stamp.service_id() != id_) {
    const bool silent = now - heard_ >= (followed ? kServiceSilence : kServiceLoss);
    if (id_ != 0 && !GoesFirst(stamp, followed) && !silent) return false;
    id_ = stamp.service_id();
    followed_ = false;
  } else if (IsPast(stamp)) {
    return false;
  }
  term_ = stamp.term();
  epoch_ = stamp.epoch();
  followed_ = followed_ || followed;
  heard_ = now;
  return true;
}

const v1::ServiceStamp& StampOf(const v1::Output& output) {
  switch (output.message_case()) {
    case v1::Output::kClearance:
      return output.clearance().stamp();
    case v1::Output::kEarliestIntersection:
      return output.earliest_intersection().stamp();
    case v1::Output::kCollisionEvent:
      return output.collision_event().stamp();
    case v1::Output::kRejection:
      return output.rejection().stamp();
    case v1::Output::kSimulatorReport:
      return output.simulator_report().stamp();
    case v1::Output::kAgentBreach:
      return output.agent_breach().stamp();
    case v1::Output::kScreeningEvent:
      return output.screening_event().event().stamp();
    default:
      return output.service_status().stamp();
  }
}

OtherServices::Instance OtherServices::InstanceOf(const v1::Output& output) {
  const auto kind = output.message_case();
  const auto in = [](std::uint32_t region, std::uint32_t number) {
    return std::uint64_t{region} << 32 | number;
  };
  switch (kind) {
    case v1::Output::kClearance:
      return {kind,
              {output.clearance().simulator_id(),
               in(output.clearance().region(), output.clearance().chunk())}};
    case v1::Output::kCollisionEvent:
      return {kind,
              {output.collision_event().pair_slot(), in(output.collision_event().region(), 0)}};
    case v1::Output::kSimulatorReport:
      return {
          kind,
          {output.simulator_report().simulator_id(), in(output.simulator_report().region(), 0)}};
    case v1::Output::kAgentBreach:
      return {kind,
              {output.agent_breach().simulator_id(),
               in(output.agent_breach().region(), output.agent_breach().slot())}};
    case v1::Output::kScreeningEvent:
      return {kind,
              {output.screening_event().simulator_id(),
               in(output.screening_event().region(), output.screening_event().pair_slot())}};
    default:
      return {kind, {0, 0}};
  }
}

void OtherServices::Keep(const v1::Output& output, Time now) {
  // A rejection answers what was just sent; who does not serve is not in force.
  if (output.has_rejection()) return;
  if (output.has_service_status() && output.service_status().phase() != v1::PHASE_SERVING) return;
  const std::uint64_t id = StampOf(output).service_id();
  if (!services_.contains(id) && services_.size() == kServicesMax) {
    services_.erase(std::min_element(
        services_.begin(), services_.end(),
        [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; }));
  }
  Said& said = services_[id];
  if (now - said.heard >= kForgottenAfter) said = {};
  said.heard = now;
  if (output.has_collision_event() && output.collision_event().contacts_sequence() > 0) {
    said.contacts.push_back(output);
    if (said.contacts.size() > kContactsMax) said.contacts.pop_front();
    return;
  }
  const Instance instance = InstanceOf(output);
  if (said.newest.size() < kInstancesMax || said.newest.contains(instance)) {
    said.newest.insert_or_assign(instance, output);
  }
}

std::vector<v1::Output> OtherServices::Take(std::uint64_t service_id, Time now) {
  std::vector<v1::Output> outputs;
  const auto found = services_.find(service_id);
  if (found == services_.end()) return outputs;
  Said said = std::move(found->second);
  services_.erase(found);
  if (now - said.heard >= kForgottenAfter) return outputs;
  outputs.assign(std::make_move_iterator(said.contacts.begin()),
                 std::make_move_iterator(said.contacts.end()));
  for (auto& [instance, output] : said.newest) outputs.push_back(std::move(output));
  std::sort(outputs.begin(), outputs.end(), [](const v1::Output& a, const v1::Output& b) {
    return StampOf(a).sequence() < StampOf(b).sequence();
  });
  return outputs;
}

std::vector<v1::Output> OtherServices::Statuses(Time now) const {
  std::vector<v1::Output> statuses;
  for (const auto& [id, said] : services_) {
    if (now - said.heard >= kForgottenAfter) continue;
    const auto status = said.newest.find({v1::Output::kServiceStatus, {0, 0}});
    if (status != said.newest.end()) statuses.push_back(status->second);
  }
  return statuses;
}

bool OtherServices::IsHeard(Time now) const {
  return std::any_of(services_.begin(), services_.end(), [now](const auto& service) {
    return now - service.second.heard < kServiceSilence;
  });
}

}  // namespace collision::client
