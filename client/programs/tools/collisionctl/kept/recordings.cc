#include "client/programs/tools/collisionctl/kept/recordings.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <system_error>
#include <tuple>

#include "client/library/network/conversion.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "client/programs/tools/collisionctl/kept/kept_contacts.h"
#include "idl/recording/entries.h"
#include "idl/recording/utc.h"
#include "idl/recording_format.h"

namespace collision::client {
namespace {

/// The simulator that a message of a batch speaks of; 0: none.
std::uint64_t SimulatorOf(const v1::Input& input) {
  if (input.has_agent_description()) return input.agent_description().simulator_id();
  return input.simulator_clock().simulator_id();
}

void Read(const std::string& path, SegmentFacts* facts) {
  wire::EntryReader reader(path);
  std::set<std::uint64_t> simulators;
  v1::RecordingEntry entry;
  while (reader.Next(&entry)) {
    if (entry.has_header()) {
      facts->number = entry.header().segment();
      facts->damage = wire::RefusalOfFormat(entry.header());
      if (!facts->damage.empty()) return;
    }
    for (const v1::Input& input : entry.batch().inputs()) simulators.insert(SimulatorOf(input));
    if (!entry.has_batch()) continue;
    facts->end_ns = std::max(facts->end_ns, entry.batch().wall_ns());
    facts->batches += !entry.batch().opening() && !entry.batch().continued();
  }
  simulators.erase(0);
  facts->simulators = simulators.size();
  // What a service writes at this moment ends anywhere.
  if (facts->is_written) return;
  facts->damage = reader.error();
  if (facts->damage.empty() && facts->number == 0 && facts->batches == 0)
    facts->damage = "byte 0: it holds nothing";
}

/// The journal of contacts of one world, read once: which contact was told when.
class ToldContacts {
 public:
  ToldContacts(const std::string& folder, const std::string& place) {
    const auto take = [this](const v1::ToldContact& told) {
      const v1::CollisionEvent& event = told.event();
      const v1::ServiceStamp& stamp = event.stamp();
      const Contact contact(stamp.service_id(), stamp.epoch(), FromMessage(event.lower()),
                            FromMessage(event.higher()), event.level(), event.contact());
      told_.emplace_back(told.wall_ns(),
                         numbers_.try_emplace(contact, numbers_.size()).first->second);
    };
    is_there_ = ReadContacts(folder, place, {}, take, [](const std::string&) {}) > 0;
    std::ranges::sort(told_);
  }

  /// How many were told of between two times; nothing where there is no journal.
  std::optional<std::size_t> Count(std::int64_t begin_ns, std::int64_t end_ns) const {
    if (!is_there_) return std::nullopt;
    std::set<std::size_t> contacts;
    const auto from = std::ranges::lower_bound(told_, begin_ns, {}, &Told::first);
    for (auto one = from; one != told_.end() && one->first <= end_ns; ++one)
      contacts.insert(one->second);
    return contacts.size();
  }

 private:
  using Contact =
      std::tuple<std::uint64_t, std::uint32_t, AgentId, AgentId, std::string, std::uint32_t>;
  using Told = std::pair<std::int64_t, std::size_t>;  ///< Wall time, number of the contact.
  bool is_there_ = false;
  std::map<Contact, std::size_t> numbers_;
  std::vector<Told> told_;
};

std::string NameOf(const SegmentFacts& facts) {
  return std::filesystem::path(facts.file.path).filename().string();
}

}  // namespace

std::vector<SegmentFacts> SegmentsIn(const std::string& folder) {
  std::string of_segments = folder, of_state = folder + "/..";
  std::error_code ignored;
  if (std::filesystem::is_directory(folder + "/" + wire::kRecordingsFolder, ignored)) {
    of_segments = folder + "/" + wire::kRecordingsFolder;
    of_state = folder;
  }
  std::vector<SegmentFacts> segments;
  std::map<std::string, ToldContacts> contacts;  // by world and domain
  for (const wire::KeptFile& file : wire::KeptFilesIn(of_segments, wire::kRecordingSuffix)) {
    SegmentFacts facts{.file = file, .end_ns = file.begin_ns};
    facts.is_written = wire::IsInUse(file.path);
    try {
      Read(file.path, &facts);
    } catch (const std::exception& failure) {
      facts.damage = failure.what();  // the oldest may have gone meanwhile
    }
    const std::string place = file.place();
    facts.contacts = contacts.try_emplace(place, of_state, place)
                         .first->second.Count(file.begin_ns, facts.end_ns);
    segments.push_back(std::move(facts));
  }
  return segments;
}

std::string RecordingsPage(const std::vector<SegmentFacts>& segments) {
  char line[400];
  std::snprintf(line, sizeof line, "%-16s %-24s %-24s %8s %8s %10s %8s  %s\n", "world",
                "from (UTC)", "to", "MB", "batches", "simulators", "contacts", "file");
  std::string page = line;
  for (const SegmentFacts& one : segments) {
    const std::string from = wire::UtcText(one.file.begin_ns), to = wire::UtcText(one.end_ns);
    std::snprintf(line, sizeof line, "%-16s %-23.23sZ %-23.23sZ %8.1f %8llu %10zu %8s  %s",
                  one.file.place().c_str(), from.c_str(), to.c_str(),
                  1e-6 * static_cast<double>(one.file.bytes),
                  static_cast<unsigned long long>(one.batches), one.simulators,
                  one.contacts ? std::to_string(*one.contacts).c_str() : "-", NameOf(one).c_str());
    page += line;
    if (one.number == 1) page += " (the service starts)";
    if (one.is_written) page += " (is being written)";
    page += "\n";
    if (!one.damage.empty()) page += "  damaged: " + one.damage + "\n";
  }
  return page;
}

std::string RecordingsJson(const std::string& folder, const std::vector<SegmentFacts>& segments) {
  std::vector<std::string> elements;
  for (const SegmentFacts& one : segments) {
    elements.push_back(JsonObject()
                           .Text("file", NameOf(one))
                           .Text("world", one.file.world)
                           .Count("domain", one.file.domain)
                           .Count("segment", one.number)
                           .Text("from", wire::UtcText(one.file.begin_ns))
                           .Text("to", wire::UtcText(one.end_ns))
                           .Count("bytes", one.file.bytes)
                           .Count("batches", one.batches)
                           .Count("simulators", one.simulators)
                           .Add("contacts", one.contacts ? std::to_string(*one.contacts) : "null")
                           .Flag("is_written", one.is_written)
                           .TextOrNull("damage", one.damage)
                           .Json());
  }
  return JsonDocument("recordings")
      .Text("folder", folder)
      .Add("segments", JsonArray(elements))
      .Json();
}

int PrintRecordings(const KeptOptions& options, const std::string& world, bool json) {
  const std::string folder = StateFolder(options, world);
  const std::vector<SegmentFacts> segments = SegmentsIn(folder);
  for (const std::string& listed : {folder, folder + "/" + wire::kRecordingsFolder}) {
    const std::string failure = wire::ListingFailure(listed);
    if (failure.empty() || !segments.empty()) continue;
    std::cerr << "collisionctl: " << listed << ": " << failure << '\n';
    return kExitRefused;
  }
  if (segments.empty()) {
    std::cerr << "collisionctl: " << folder << ": no recordings are in it (WORLD.DOMAIN.TIME"
              << wire::kRecordingSuffix << "); the service keeps them in its state_dir\n";
    return kExitRefused;
  }
  std::cout << (json ? RecordingsJson(folder, segments) + "\n" : RecordingsPage(segments));
  std::cout.flush();
  return std::cout ? kExitOk : kExitOutputFailed;
}

}  // namespace collision::client
