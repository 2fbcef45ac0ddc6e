#include "server/recording/recorded_claim.h"

#include "idl/recording_format.h"
#include "server/process/version.h"

namespace collision::server {

v1::ServiceClaim ToMessage(const ClaimOptions& claim) {
  v1::ServiceClaim message;
  message.set_instance(claim.instance);
  message.set_term_before(claim.term_before);
  message.set_wait_ns(claim.wait_ns);
  message.set_heard_for_ns(claim.heard_for_ns);
  message.set_stands_by(claim.stands_by);
  message.set_waking_ns(claim.waking_ns);
  message.set_epoch(claim.epoch);
  message.set_ended_runs(claim.ended_runs);
  for (const JournalledSimulator& simulator : claim.roster) {
    v1::RosterEntry& entry = *message.add_roster();
    entry.set_id(simulator.id);
    entry.set_run(simulator.run);
    entry.set_name(simulator.name);
    if (simulator.granted) entry.set_granted_ns(simulator.granted->nanoseconds());
  }
  return message;
}

ClaimOptions FromMessage(const v1::ServiceClaim& message) {
  ClaimOptions claim{.instance = message.instance(),
                     .term_before = message.term_before(),
                     .wait_ns = message.wait_ns(),
                     .heard_for_ns = message.heard_for_ns(),
                     .stands_by = message.stands_by(),
                     .waking_ns = message.waking_ns(),
                     .roster = {},
                     .epoch = message.epoch(),
                     .ended_runs = message.ended_runs()};
  for (const v1::RosterEntry& entry : message.roster()) {
    JournalledSimulator& simulator = claim.roster.emplace_back();
    simulator.id = entry.id();
    simulator.run = entry.run();
    simulator.name = entry.name();
    if (entry.has_granted_ns()) simulator.granted = Instant::FromNanoseconds(entry.granted_ns());
  }
  return claim;
}

v1::RecordingEntry HeaderOf(const v1::Config& config, const ClaimOptions& claim,
                            std::uint32_t segment) {
  v1::RecordingEntry entry;
  v1::RecordingHeader& header = *entry.mutable_header();
  header.set_format(wire::kRecordingFormat);
  header.set_version(Version());
  *header.mutable_config() = config;
  *header.mutable_claim() = ToMessage(claim);
  header.set_segment(segment);
  return entry;
}

}  // namespace collision::server
