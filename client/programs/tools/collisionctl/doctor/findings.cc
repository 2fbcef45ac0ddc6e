#include "client/programs/tools/collisionctl/doctor/findings.h"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/status/verdict.h"

namespace collision::client {
namespace {

constexpr std::string_view kStatusTopic = "collision/v1/service_status";

/// One that does not describe itself: of another vendor, or before a handshake of DDS Security.
constexpr char kNameless[] = "a program";

std::string NameOf(const DdsNeighbours& neighbours, std::uint64_t program) {
  const auto found = neighbours.programs.find(program);
  if (found == neighbours.programs.end() || found->second.pid.empty()) return kNameless;
  const DdsProgram& it = found->second;
  return it.process + " (pid " + it.pid + " on " + it.host + ")";
}

/// Whether a partition is the world's, or that of one of its simulators.
bool IsOf(const std::string& world, const std::string& partition) {
  return partition == world || partition.starts_with(world + ".");
}

bool WritesStatusIn(const DdsPeer& peer, const std::string& world) {
  return peer.writes && peer.topic == kStatusTopic &&
         std::ranges::count(peer.partitions, world) > 0;
}

std::string Joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

/// The addresses of a program, as it tells them: parts between commas, each perhaps with a port.
std::vector<std::uint32_t> AddressesIn(const std::string& list) {
  std::vector<std::uint32_t> addresses;
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t begin = part.find_first_of("0123456789");
    if (begin == std::string::npos) continue;
    const std::size_t end = part.find_first_not_of("0123456789.", begin);
    if (const std::uint32_t address = AddressOf(part.substr(begin, end - begin)); address != 0)
      addresses.push_back(address);
  }
  return addresses;
}

class Doctor {
 public:
  Doctor(const DoctorSeen& seen, const WorldView& view) : seen_(seen), view_(view) {
    for (const DdsPeer& peer : seen.neighbours.peers) {
      if (WritesStatusIn(peer, seen.world)) services_.insert(peer.program);
    }
  }

  std::vector<Finding> Examine() {
    if (!seen_.failure.empty()) {
      ExamineFailure();
      return std::move(findings_);
    }
    if (!seen_.unreadable.empty()) {
      Add("other-revision", seen_.unreadable,
          "install programs of one version on all hosts: collisiond --version, "
          "collisionctl --version");
    }
    if (services_.empty()) {
      FindService();
    } else if (!view_.status() && seen_.unreadable.empty()) {
      FindWhyUnheard();
    }
    ExamineInterfaces();
    ExaminePeers();
    if (view_.status()) ExamineWorld(*view_.status());
    NoteOpenNetwork();
    return std::move(findings_);
  }

 private:
  void Add(std::string matter, std::string what, std::string advice) {
    findings_.push_back(
        {.matter = std::move(matter), .what = std::move(what), .advice = std::move(advice)});
  }

  std::string Place() const {
    return "world \"" + seen_.world + "\" on domain " + std::to_string(seen_.domain);
  }

  /// DDS could not be started.
  void ExamineFailure() {
    const std::string profile = seen_.profile.empty() ? "" : ", network profile " + seen_.profile;
    const std::string what = seen_.failure_lines.empty() ? seen_.failure : seen_.failure_lines;
    const auto says = [&](const char* words) { return what.find(words) != std::string::npos; };
    const std::string cannot = "DDS does not start on domain " + std::to_string(seen_.domain);
    if (says("open configuration file")) {
      Add("profile", cannot + profile + ": " + what,
          "let CYCLONEDDS_URI name a file that is there (file:///ABSOLUTE/PATH), or unset it");
    } else if (says("match an available interface")) {
      Add("profile", cannot + profile + ": " + what,
          "name an interface of this machine in <NetworkInterface name=\"...\"/>: " + OwnText());
    } else if (says("can be had here")) {
      Add("dds", "DDS is not started: " + what,
          "raise that limit, and that of the service if it has the same: systemctl show, "
          "docker inspect, ulimit -a");
    } else if (says("config:")) {
      Add("profile", cannot + profile + ": " + what,
          "correct that place of the profile; config/cyclonedds-lan.xml shows one");
    } else if (seen_.has_credentials || says("credentials")) {
      Add("credentials", cannot + " with these credentials: " + what,
          "take a folder that is whole, of one authority, for this world and domain, and of a "
          "monitor, an operator, or a simulator made with --monitoring: collisionctl "
          "make-certificates");
    } else {
      Add("dds", cannot + profile + ": " + what,
          "see whether another program has the ports from " +
              std::to_string(FirstPortOf(seen_.domain)) +
              " on, and whether an interface is up: " + OwnText());
    }
  }

  void FindService() {
    const std::string none = "no service is heard in " + Place();
    const std::string start = "start one: collisiond --world " + seen_.world + " --domain " +
                              std::to_string(seen_.domain);
    if (FindByCredentials(none)) return;
    if (seen_.host_answers) {
      return Add("multicast",
                 none + ", but " + seen_.host +
                     " answers when it is asked by unicast: multicast does not come through",
                 "in the network profile of every host set AllowMulticast to false and name the "
                 "hosts as <Peer Address=\"" +
                     seen_.host + "\"/> (config/cyclonedds-lan.xml)");
    }
    if (const auto worlds = WorldsServed(seen_.neighbours); !worlds.empty()) {
      return Add("other-world", none + "; served here: " + Joined(worlds),
                 "collisionctl --world " + worlds.front() + " doctor, or " + start +
                     "; one that runs already hangs: start it again");
    }
    if (!seen_.elsewhere.empty()) {
      const std::string domain = std::to_string(seen_.elsewhere.front());
      return Add(
          "other-domain", none + "; domain " + domain + " serves a world of this name",
          "collisionctl --domain " + domain + " --world " + seen_.world + " doctor, or " + start);
    }
    const bool is_alone = std::ranges::all_of(
        seen_.neighbours.programs, [](const auto& entry) { return entry.second.is_own; });
    const std::string hidden = seen_.has_credentials ? "" : Hidden(seen_.neighbours);
    if (!hidden.empty()) {
      return Add("secured",
                 none + "; these programs show nothing of themselves to this one: " + hidden +
                     ": a secured world keeps it out",
                 "collisionctl --credentials FOLDER doctor (docker/SECURITY.md)");
    }
    if (!is_alone) return Add("no-service", none, start);
    if (seen_.has_credentials) {
      return Add("nobody",
                 none +
                     ", nor any other program: nothing runs or it hangs, or it is on another "
                     "interface, or multicast does not come through",
                 start + "; its log tells of those that it refuses");
    }
    Add("nobody",
        none +
            ", nor any other program: nothing runs or it hangs, or it is on another interface, or "
            "multicast does not come through",
        start + "; if one runs on another host: collisionctl doctor --host ITS-ADDRESS");
  }

  /// Whether the credentials of this program are the cause.
  bool FindByCredentials(const std::string& none) {
    const DdsNeighbours& others = seen_.without_credentials;
    const std::vector<std::string> worlds = WorldsServed(others);
    if (std::ranges::count(worlds, seen_.world) > 0) {
      Add("open-world", none + " by a program with credentials; it is served without",
          "leave --credentials out and unset COLLISION_CREDENTIALS, or secure the service: "
          "collisiond --credentials FOLDER (docker/SECURITY.md)");
      return true;
    }
    const std::string hidden = Hidden(others);
    if (hidden.empty()) return false;
    AddAuthority(none + "; these programs show nothing of themselves to this one: " + hidden);
    return true;
  }

  void AddAuthority(const std::string& what) {
    Add("authority", what + ": a secured world of another authority, or of another name",
        "take credentials made by the authority of that service: collisionctl make-certificates; "
        "its log says whom it refuses");
  }

  /// Programs that show no reader or writer, and are services or do not say what they are, as those
  /// of a secured world do not.
  static std::string Hidden(const DdsNeighbours& neighbours) {
    std::vector<std::string> names;
    for (const auto& [key, program] : neighbours.programs) {
      const bool is_shown = std::ranges::any_of(
          neighbours.peers, [key = key](const auto& peer) { return peer.program == key; });
      const bool may_serve = program.process.empty() || program.process.starts_with("collisiond");
      if (may_serve && !program.is_own && !is_shown) names.push_back(NameOf(neighbours, key));
    }
    return Joined(names);
  }

  /// It has been found, and what it writes does not arrive.
  void FindWhyUnheard() {
    const bool is_misfit = std::ranges::any_of(seen_.neighbours.peers, [this](const auto& peer) {
      return WritesStatusIn(peer, seen_.world) && !peer.misfit.empty();
    });
    if (is_misfit) return;  // told with the others
    const std::string name = NameOf(seen_.neighbours, *services_.begin());
    if (seen_.has_credentials && name == kNameless) {
      return AddAuthority("a service is in " + Place() + ", and does not let these credentials in");
    }
    if (const std::string theirs = OtherNetwork(); !theirs.empty()) {
      return Add("other-network",
                 name + " is found at " + theirs + ", which is in no network of this machine: " +
                     OwnText() + ", and nothing comes from there",
                 "name one interface in the network profile of each host: "
                 "<NetworkInterface name=\"...\"/>");
    }
    Add("unheard", name + " is found, but nothing that it writes comes here",
        "let UDP through the firewalls of both hosts, ports " +
            std::to_string(FirstPortOf(seen_.domain)) +
            " and above; with DDS Security: its log "
            "says why it refuses this program");
  }

  /// Whoever reaches the network can take part.
  void NoteOpenNetwork() {
    constexpr std::uint32_t kLoopback = 127;
    const std::uint32_t address = AddressOf(seen_.own_address);
    if (seen_.has_credentials || !view_.status() || address == 0 || address >> 24 == kLoopback)
      return;
    findings_.push_back({.matter = "open",
                         .what = "the world is on the network of " + seen_.own_address +
                                 " without credentials: whoever reaches that network can take part",
                         .advice = "collisionctl make-certificates --help, and docker/SECURITY.md",
                         .is_note = true});
  }

  /// The addresses of the services if none is in a network of this machine; else empty.
  std::string OtherNetwork() const {
    std::vector<std::string> theirs;
    for (const std::uint64_t service : services_) {
      const auto program = seen_.neighbours.programs.find(service);
      if (program == seen_.neighbours.programs.end()) continue;
      for (const std::uint32_t address : AddressesIn(program->second.addresses)) {
        theirs.push_back(AddressText(address));
        for (const Interface& own : seen_.interfaces) {
          if ((own.address & own.mask) == (address & own.mask)) return "";
        }
      }
    }
    return Joined(theirs);
  }

  std::string OwnText() const {
    std::vector<std::string> texts;
    for (const Interface& own : seen_.interfaces)
      texts.push_back(own.name + " " + AddressText(own.address));
    return Joined(texts);
  }

  /// Several could be meant, and Cyclone DDS takes one.
  void ExamineInterfaces() {
    if (!services_.empty()) return;
    const std::uint32_t spoken = AddressOf(seen_.own_address);
    std::vector<std::string> others;
    std::string used;
    for (const Interface& own : seen_.interfaces) {
      if (own.address == spoken) {
        used = own.name + " " + AddressText(own.address);
        if (own.is_loopback) {
          Add("loopback", "this program speaks on " + used + " alone: other hosts are not heard",
              "if the service is on another host: CYCLONEDDS_URI=file://.../cyclonedds-lan.xml");
          return;
        }
      } else if (!own.is_loopback) {
        others.push_back(own.name + " " + AddressText(own.address));
      }
    }
    if (others.empty() || used.empty()) return;
    Add("interface",
        "this program speaks on " + used + " alone, and there is also " + Joined(others),
        "if the service is there, name that interface in the network profile: "
        "<NetworkInterface name=\"...\"/>");
  }

  void ExaminePeers() {
    std::set<std::string> told;
    for (const DdsPeer& peer : seen_.neighbours.peers) {
      const bool is_ours = std::ranges::any_of(
          peer.partitions, [this](const std::string& one) { return IsOf(seen_.world, one); });
      if (peer.misfit.empty() || (!is_ours && !peer.partitions.empty())) continue;
      const std::string what = std::string(peer.writes ? "writer" : "reader") + " of " +
                               peer.topic + " by " + NameOf(seen_.neighbours, peer.program) +
                               " meets nobody: " + peer.misfit;
      if (!told.insert(what).second) continue;
      Add("misfit", what,
          "build it from this version's idl/collision.idl, with the quality of service of "
          "idl/PROTOCOL.md");
    }
  }

  void ExamineWorld(const v1::ServiceStatus& status) {
    const std::size_t others = services_.size() - std::min<std::size_t>(services_.size(), 1);
    const std::size_t standbys = view_.Standbys().size();
    if (others > standbys) {
      std::vector<std::string> names;
      for (const std::uint64_t service : services_)
        names.push_back(NameOf(seen_.neighbours, service));
      Add("two-services",
          "several services are in " + Place() + ", and not all but one stand by: " + Joined(names),
          "end all but one, or configure on_occupied: STAND_BY");
    }
    const std::vector<std::string> verdict = Verdict(view_);
    for (const std::string& line : verdict) {
      if (line.starts_with("WELL")) continue;
      if (line.starts_with("  ") && !findings_.empty()) {
        findings_.back().what += "\n  " + line;
      } else {
        Add("service", line, "collisionctl status --all");
      }
    }
    ExamineSimulators(status);
    ExamineAgents(status);
  }

  void ExamineSimulators(const v1::ServiceStatus& status) {
    for (const v1::SimulatorStatus& simulator : status.simulators()) {
      if (!simulator.alive()) {
        Add("silent",
            "simulator " + simulator.name() + " is not heard; the service keeps its " +
                std::to_string(simulator.agents()) + " agents, whose bounds grow",
            "start it again, or remove it: collisionctl evict " + simulator.name());
      }
      ExamineOffset(simulator);
    }
  }

  /// A clock that is within what is allowed, but only just.
  void ExamineOffset(const v1::SimulatorStatus& simulator) {
    const std::int64_t skew_max = view_.skew_max_ns();
    if (skew_max == 0 || !simulator.has_clock_offset()) return;
    const auto& [low, high] =
        std::pair{simulator.clock_offset().earliest_ns(), simulator.clock_offset().latest_ns()};
    const bool is_far = (low > skew_max / 2) || (high < -(skew_max / 2) &&
                                                 high != std::numeric_limits<std::int64_t>::min());
    if (!is_far) return;
    const std::int64_t off = low > 0 ? low : high;
    Add("skew",
        "the clock of " + simulator.name() + " is off by " +
            NumberText(1e-6 * static_cast<double>(off), "%+.3f") +
            " ms or more; clock.skew_max_s allows " +
            NumberText(1e-6 * static_cast<double>(skew_max), "%.3f ms"),
        "synchronise the clocks of both hosts (chrony, PTP), or raise clock.skew_max_s");
  }

  /// Agents whose next state has been wanted for a while.
  void ExamineAgents(const v1::ServiceStatus& status) {
    if (status.simulated_clock()) return;
    constexpr std::int64_t kPatience = 1'000'000'000;
    std::size_t stale = 0;
    std::string first;
    for (const AgentView& agent : view_.Agents()) {
      if (agent.presence != AgentPresence::kHeld || !agent.clearance) continue;
      if (agent.clearance->state_wanted_ns() >= status.now_ns() - kPatience) continue;
      if (stale++ == 0) first = view_.FullName(IdOf(agent));
    }
    if (stale == 0) return;
    Add("stale",
        "of " + std::to_string(stale) + " agents a state has been wanted for more than 1 s: " +
            first + (stale > 1 ? " and others" : ""),
        "see whether their simulators still step: collisionctl agents --watch");
  }

  const DoctorSeen& seen_;
  const WorldView& view_;
  std::set<std::uint64_t> services_;  ///< Programs that write a status in this world.
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<std::string> WorldsServed(const DdsNeighbours& neighbours) {
  std::set<std::string> worlds;
  for (const DdsPeer& peer : neighbours.peers) {
    if (!peer.writes || peer.topic != kStatusTopic) continue;
    worlds.insert(peer.partitions.begin(), peer.partitions.end());
  }
  return {worlds.begin(), worlds.end()};
}

std::vector<Finding> Findings(const DoctorSeen& seen, const WorldView& view) {
  return Doctor(seen, view).Examine();
}

std::string DoctorPage(const DoctorSeen& seen, const WorldView& view,
                       const std::vector<Finding>& findings) {
  std::string page;
  if (IsWell(findings)) {
    const v1::ServiceStatus& status = *view.status();
    const auto others = std::ranges::count_if(
        seen.neighbours.programs, [](const auto& entry) { return !entry.second.is_own; });
    page = "WELL: the service is heard, " + std::to_string(status.simulators_size()) +
           " simulators and " + std::to_string(status.agents()) + " agents; " +
           std::to_string(others) + " programs on the network, all readers and writers fit\n";
  }
  std::size_t number = 0;
  for (const Finding& finding : findings) {
    page += (finding.is_note ? "note: " : std::to_string(++number) + ". ") + finding.what +
            "\n   -> " + finding.advice + "\n";
  }
  return page;
}

bool IsWell(const std::vector<Finding>& findings) {
  return std::ranges::all_of(findings, &Finding::is_note);
}

std::string DoctorJson(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const Finding& finding : findings) {
    all.push_back(JsonObject()
                      .Text("matter", finding.matter)
                      .Text("what", finding.what)
                      .Text("advice", finding.advice)
                      .Flag("is_note", finding.is_note)
                      .Json());
  }
  return JsonDocument("doctor").Add("findings", JsonArray(all)).Json();
}

}  // namespace collision::client
