#include "idl/dds/senders.h"

#include <algorithm>
#include <memory>

#include "idl/identity.h"

namespace collision::dds {
namespace {

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

std::optional<std::uint64_t> Senders::Of(dds_entity_t reader, dds_instance_handle_t writer) {
  if (const auto known = writers_.find(writer); known != writers_.end())
    return known->second.sender;
  const Endpoint endpoint = Find(reader, writer);
  if (!endpoint) return std::nullopt;
  const auto* guid = reinterpret_cast<const char*>(endpoint->participant_key.v);
  const std::uint64_t sender = Fnv1a({guid, sizeof endpoint->participant_key.v});
  if (writers_.size() >= std::max(writers_until_cleaning_, kWritersMin)) DropEnded();
  writers_.emplace(writer, Writer{reader, sender});
  programs_.try_emplace(sender);
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
