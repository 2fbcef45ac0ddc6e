#include "idl/dds/inbox/senders.h"

#include <arpa/inet.h>

#include <algorithm>
#include <memory>

#include "idl/identity.h"

namespace collision::dds {
namespace {

constexpr std::uint32_t kParticipant = 0x1c1;  // ENTITYID_PARTICIPANT of RTPS

constexpr std::size_t kWritersMin = 4096;  // remembered before those that left are dropped
constexpr std::size_t kSimulatorsPerProgramMax =
    64;  // usually one; the end of more is not reported

using Endpoint =
    std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>;

/// Null if the writer is not there.
Endpoint Find(dds_entity_t reader, dds_instance_handle_t writer) {
  return {dds_get_matched_publication_data(reader, writer), &dds_builtintopic_free_endpoint};
}

}  // namespace

std::uint64_t SenderOf(const ddsi_guid& writer) {
  ddsi_guid participant = writer;
  participant.entityid.u = kParticipant;
  // The builtin topics have GUIDs in the order of the network.
  std::uint32_t words[] = {participant.prefix.u[0], participant.prefix.u[1],
                           participant.prefix.u[2], participant.entityid.u};
  for (std::uint32_t& word : words) word = htonl(word);
  return Fnv1a({reinterpret_cast<const char*>(words), sizeof words});
}

std::string PartitionOf(dds_entity_t reader, dds_instance_handle_t writer) {
  const Endpoint endpoint = Find(reader, writer);
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!endpoint || !dds_qget_partition(endpoint->qos, &count, &names)) return "";
  std::string first;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i == 0) first = names[i];
    dds_free(names[i]);
  }
  dds_free(names);
  return first;
}

void Senders::Add(dds_entity_t reader, dds_instance_handle_t writer, std::uint64_t sender) {
  if (writers_.size() >= std::max(writers_until_cleaning_, kWritersMin)) DropEnded();
  const auto [added, is_new] = writers_.try_emplace(writer, Writer{reader, sender});
  // Once, since it takes as long as some samples; it cannot change: DDS Security checks it when the
  // writer is found.
  if (is_new && looks_up_) added->second.partition = dds::PartitionOf(reader, writer);
  programs_.try_emplace(sender);
}

std::optional<std::uint64_t> Senders::Of(dds_entity_t reader, dds_instance_handle_t writer) {
  if (const auto known = writers_.find(writer); known != writers_.end())
    return known->second.sender;
  const Endpoint endpoint = Find(reader, writer);
  if (!endpoint) return std::nullopt;
  const auto* guid = reinterpret_cast<const char*>(endpoint->participant_key.v);
  const std::uint64_t sender = Fnv1a({guid, sizeof endpoint->participant_key.v});
  Add(reader, writer, sender);
  return sender;
}

bool Senders::AddSimulator(std::uint64_t sender, std::uint64_t simulator) {
  std::set<std::uint64_t>& simulators = programs_.at(sender).simulators;
  return simulators.size() < kSimulatorsPerProgramMax && simulators.insert(simulator).second;
}

bool Senders::SetAlive(std::uint64_t sender, bool alive) {
  Program& program = programs_.at(sender);
  if (program.alive == alive) return false;
  program.alive = alive;
  return true;
}

/// Drops only writers whose end was reported: it could not be reported for the others any more.
void Senders::DropEnded() {
  std::erase_if(writers_, [this](const auto& entry) {
    const auto& [writer, known] = entry;
    return !programs_.at(known.sender).alive && !Find(known.reader, writer);
  });
  std::set<std::uint64_t> left;
  for (const auto& [writer, known] : writers_) left.insert(known.sender);
  std::erase_if(programs_, [&left](const auto& entry) { return !left.contains(entry.first); });
  writers_until_cleaning_ = 2 * writers_.size();
}

}  // namespace collision::dds
