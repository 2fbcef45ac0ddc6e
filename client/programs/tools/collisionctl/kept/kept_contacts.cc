#include "client/programs/tools/collisionctl/kept/kept_contacts.h"

#include <chrono>
#include <exception>
#include <iostream>
#include <map>
#include <tuple>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/world_view.h"
#include "idl/recording/entries.h"
#include "idl/recording/kept_files.h"
#include "idl/recording/utc.h"
#include "idl/recording_format.h"

namespace collision::client {
namespace {

void ReadFile(const wire::KeptFile& file, const WallRange& range,
              const std::function<void(const v1::ToldContact&)>& take,
              const std::function<void(const std::string&)>& complain) {
  try {
    wire::EntryReader reader(file.path);
    v1::RecordingEntry entry;
    bool is_journal = false;
    while (reader.Next(&entry)) {
      is_journal |= entry.has_header() && entry.header().segment() == 0;
      const std::string refusal =
          entry.has_header() ? wire::RefusalOfFormat(entry.header()) : std::string();
      if (!refusal.empty()) return complain(file.path + ": " + refusal);
      const std::int64_t wall_ns = entry.contact().wall_ns();
      const bool is_in = range.since_ns <= wall_ns && wall_ns <= range.until_ns;
      if (entry.has_contact() && is_in) take(entry.contact());
    }
    // What a service writes at this moment ends anywhere.
    if (wire::IsInUse(file.path)) return;
    if (!reader.error().empty()) return complain(reader.error());
    if (!is_journal) complain(file.path + ": byte 0: it is no journal of contacts");
  } catch (const std::exception& failure) {
    complain(failure.what());
  }
}

/// Tells what a service has told again, since it took over from another one.
class TakeOvers {
 public:
  /// Whether another service has told this before: the same contact, certified to the same
  /// instants. A service that lost all counts a pair's contacts from one again, at others.
  bool Repeats(const v1::CollisionEvent& event) {
    const Key key(event.stamp().epoch(), FromMessage(event.lower()), FromMessage(event.higher()),
                  event.level(), event.contact(), event.status(), event.begin().SerializeAsString(),
                  event.end().SerializeAsString());
    const std::uint64_t service = event.stamp().service_id();
    return told_.try_emplace(key, service).first->second != service;
  }

 private:
  using Key = std::tuple<std::uint32_t, AgentId, AgentId, std::string, std::uint32_t, int,
                         std::string, std::string>;
  std::map<Key, std::uint64_t> told_;  ///< By which service first.
};

}  // namespace

std::size_t ReadContacts(const std::string& state_folder, const std::string& place,
                         const WallRange& range,
                         const std::function<void(const v1::ToldContact&)>& take,
                         const std::function<void(const std::string&)>& complain) {
  std::vector<wire::KeptFile> files;
  const std::string folder = state_folder + "/" + wire::kContactsFolder;
  for (wire::KeptFile& file : wire::KeptFilesIn(folder, wire::kContactsSuffix)) {
    if (file.place() == place) files.push_back(std::move(file));
  }
  for (const wire::KeptFile& file : files) ReadFile(file, range, take, complain);
  return files.size();
}

int PrintKeptContacts(const KeptOptions& options, const std::string& world, std::uint32_t domain,
                      const EventFormat& format, EventFilter filter) {
  filter.since_ns.reset();  // it is of the world's time
  const std::int64_t now_ns =
      std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  WallRange range;
  if (!options.since.empty()) range.since_ns = *WallTimeOf(options.since, now_ns);
  if (!options.until.empty()) range.until_ns = *WallTimeOf(options.until, now_ns);
  if (range.until_ns < range.since_ns) {
    std::cerr << "collisionctl: --until " << wire::UtcText(range.until_ns)
              << ": allowed: a time after --since, " << wire::UtcText(range.since_ns) << '\n';
    return kExitUsage;
  }
  WorldView view;
  const auto hear = view.Callbacks().event;
  EventPrinter printer(format, filter, &std::cout);
  TakeOvers take_overs;
  const std::string folder = StateFolder(options, world);
  bool is_whole = true;
  const auto complain = [&is_whole](const std::string& line) {
    std::cerr << "collisionctl: " << line << '\n';
    is_whole = false;
  };
  const std::size_t files = ReadContacts(
      folder, world + "." + std::to_string(domain), range,
      [&](const v1::ToldContact& contact) {
        if (take_overs.Repeats(contact.event())) return;
        hear(contact.event());
        printer.PrintNew(&view, wire::UtcText(contact.wall_ns()));
      },
      complain);
  if (files == 0) {
    const std::string of_contacts = folder + "/" + wire::kContactsFolder;
    const std::string failure = wire::ListingFailure(of_contacts);
    if (!failure.empty()) {
      complain(of_contacts + ": " + failure);
      return kExitRefused;
    }
    complain(of_contacts + ": no journal of contacts of world \"" + world + "\" on domain " +
             std::to_string(domain) + " is in it; --state-dir names the service's state_dir");
    return kExitRefused;
  }
  if (!std::cout) complain("the output cannot be written");
  return is_whole ? kExitOk : kExitOutputFailed;
}

}  // namespace collision::client
