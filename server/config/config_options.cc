#include "server/config/config_options.h"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "idl/limits.h"

namespace collision::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// A limit as the text of the table, with a zero behind it.
template <std::uint64_t limit>
struct Digits {
  static constexpr std::size_t kCount = [] {
    std::size_t count = 1;
    for (std::uint64_t rest = limit; rest >= 10; rest /= 10) ++count;
    return count;
  }();
  static constexpr std::array<char, kCount + 1> kText = [] {
    std::array<char, kCount + 1> text{};
    std::uint64_t rest = limit;
    for (std::size_t at = kCount; at > 0; rest /= 10) {
      text[--at] = static_cast<char>('0' + rest % 10);
    }
    return text;
  }();
};
template <std::uint64_t limit>
constexpr std::string_view kDigits{Digits<limit>::kText.data()};

constexpr ConfigOption kOptions[] = {
    {"world", "none", "", "", wire::kNameText, "\"default\"",
     "Which world this service serves. Worlds do not see each other."},
    {"domain", "none", "0", kDigits<wire::kDomainMax>, "", "0",
     "DDS domain. Simulators and monitors must use the same."},
    {"clock.kind", "none", "", "", "LOCK_STEP or REAL_TIME", "LOCK_STEP",
     "LOCK_STEP: all simulators of the world advance together, and now is the least of their "
     "clocks. REAL_TIME: now is the time since 1970 by the clock of this machine, which should be "
     "synchronised (NTP, PTP). The simulators must run in the same way (WorldOptions::lock_step, "
     "--lock-step or --real-time)."},
    {"clock.skew_max_s", "s", "0", "60", "", "0",
     "Bound on the difference between any sender's clock and ours. Bounds are widened by it, and a "
     "stamp further in the future is refused, as is a sender whose clock is certainly off by more. "
     "If our own clock is set by more, all promises are void and given anew. With REAL_TIME it "
     "must be "
     "greater than 0.",
     "0.002"},
    {"clock.simulators_awaited", "simulators", "1", "1024", "", "1",
     "With LOCK_STEP, time stands still until so many simulators have published a clock."},
    {"clock.grant_ahead_max_s", "s", "0.000001", "86400", "", "10",
     "With LOCK_STEP, no simulator is allowed to run further ahead than this, however empty the "
     "scene."},
    {"clock.on_silent_simulator", "none", "", "", "WAIT or RELEASE", "WAIT",
     "With LOCK_STEP, when the process of a simulator has died, or it does not move although it "
     "was granted time: WAIT stops the world's time until it is back, RELEASE goes on without it "
     "after release_after_s. Its agents stay either way, and their bounds grow. A service that is "
     "started again waits likewise for those that the one before it served.",
     "", "LOCK_STEP"},
    {"clock.release_after_s", "s", "0.1", "86400", "", "5",
     "How long RELEASE waits; longer than any simulator takes for one step. With WAIT it must keep "
     "its default."},
    {"clock.first_clock_max_s", "s", "0", "4000000000", "", "31536000",
     "With LOCK_STEP, the latest time at which an epoch of the world may begin: a first clock "
     "beyond "
     "it, such as a time since 1970, is refused.",
     "", "LOCK_STEP"},
    {"clock.shape_wait_max_s", "s", "0", "86400", "", "60",
     "With LOCK_STEP, how long time stands still for the shape of an agent: until it has arrived "
     "and its tree is built. After that the agent counts as its ball, or with its coarse tree, and "
     "from when on the tree counts is chance: two runs need not have the same events.",
     "", "LOCK_STEP"},
    {"clock.waiting_after_s", "s", "0.1", "86400", "", "5",
     "With LOCK_STEP, a simulator that was granted time, is the last one and tells nothing new for "
     "so long is named: in the log, in the status, and to the other simulators.",
     "", "LOCK_STEP"},
    {"clock.remove_silent_after_s", "s", "0", "604800", "", "60",
     "A simulator that has been silent for so long is removed with its agents: with REAL_TIME "
     "since its "
     "process died, with LOCK_STEP since it was released (on_silent_simulator RELEASE). 0: never."},
    {"clock.wait_for_synchronisation_s", "s", "0", "86400", "", "0",
     "With REAL_TIME, wait so long at the start until the system counts its clock as synchronised, "
     "then "
     "go on without. 0: do not wait.",
     "", "REAL_TIME"},
    {"frame", "none", "", "", "a text of at most 64 printable ASCII characters, or empty", "\"\"",
     "Label of the world frame, such as \"ENU 47.3977 8.5456 488\". A simulator that states "
     "another "
     "one is refused. Empty: not stated, and any fits."},
    {"epoch_utc", "none", "", "", "a text of at most 64 printable ASCII characters, or empty",
     "\"\"",
     "With LOCK_STEP, what instant 0 is, such as \"2026-01-01T00:00:00Z\", for those who read. "
     "Empty: not stated."},
    {"log_level", "none", "", "", "trace, debug, info, warn, error, critical or off", "\"info\"",
     "The least severe lines that are logged."},
    {"log_file", "none", "", "", "a path of at most 4096 printable ASCII characters, or empty",
     "\"\"", "Where the log goes, appended. Empty: standard error."},
    {"log_format", "none", "", "", "TEXT or JSON", "TEXT",
     "JSON: each line of the log is an object with time (UTC), level and message."},
    {"temporal_resolution_s", "s", "0.000001", "10", "", "0.016666666666666666",
     "A pair whose earliest possible intersection is nearer than this goes to the narrow phase, at "
     "most once per this time. Contacts shorter than it are found all the same."},
    {"announce_within_s", "s", "0.000001", "86400", "", "2",
     "A possible intersection this near gets an event. At least temporal_resolution_s."},
    {"agents_max", "agents", "1", "1000000", "", "1000",
     "Agents in the world; another one is refused."},
    {"simulators_max", "simulators", "1", "1024", "", "64",
     "Simulators in the world; what another one writes is refused. At least "
     "clock.simulators_awaited."},
    {"pairs_max", "pairs", "1", "16777216", "", "65536",
     "Pairs tracked at once; beyond it agents are published as saturated, with a clearance of "
     "now."},
    {"pairs_per_agent_max", "pairs", "1", "1000000", "", "256",
     "Pairs of one agent tracked at once; beyond it the agent is saturated."},
    {"history_max", "states", "2", "4096", "", "64",
     "States kept per agent for evaluating contacts; beyond, the oldest are dropped and brackets "
     "widen."},
    {"inputs_per_batch_max", "messages", "1", "1048576", "", "65536",
     "Messages taken from the network in one step; the rest waits for the next."},
    {"sender_messages_per_second_max", "messages", "100", "100000000", "", "300000",
     "Messages taken from one program per second, half a second's at once. The rest waits; of a "
     "program that is far behind, only the newest message of each kind, agent or chunk."},
    {"sender_bytes_per_second_max", "bytes", "100000", "100000000000", "", "268435456",
     "Likewise bytes, as on the network."},
    {"waiting_mb_max", "MB", "1", "65536", "", "128",
     "Memory for messages that have arrived and wait. Where it is full, the program of which most "
     "waits loses its oldest, so that each may fill an equal share. More is refused; a program "
     "that "
     "goes on is ignored for 10 s, the next time for twice as long, up to an hour."},
    {"undescribed_after_s", "s", "0.1", "3600", "", "5",
     "How long states without a description, and agents whose shape has not arrived, wait until "
     "their sender gets a rejection."},
    {"status_period_s", "s", "0.05", "10", "", "0.5",
     "Time between two samples of the service's status, by the monotonic clock."},
    {"earliest_period_s", "s", "0", "3600", "", "0.1",
     "Least time between two samples of the earliest possible intersection, of the world's time or "
     "of the monotonic clock, whichever is over first. Computed only while somebody reads it."},
    {"rejections_per_second_max", "messages", "1", "100000", "", "100",
     "Rejections published per second; further ones are only counted in the status."},
    {"forecasts_per_second_max", "messages", "1", "1000000", "", "1000",
     "New and moved forecasts published per second, of the world's time with LOCK_STEP; the "
     "soonest "
     "goes first, the others wait. A forecast that may begin within temporal_resolution_s does not "
     "wait, nor does its end. Contacts are no forecasts and never wait."},
    {"time_budget_us", "us", "0", "1000000", "", "2000",
     "Budget of the narrow phase for one pair in one evaluation, where at least one agent has a "
     "shape. A pair that runs out of it gets wider brackets; its events say limited by budget. 0: "
     "sphere trees are not refined. It is counted in work units, so that a replay stops where the "
     "recorded run did, on any machine."},
    {"step_budget_us", "us", "0", "1000000", "", "100000",
     "Budget for all pairs together in one step, balls as well. It is shared first among "
     "simulators, then among the pairs of each: pairs that are announced and undecided get more. "
     "Pairs beyond it wait for the next step, in turn, and are clear as far as was certified "
     "before. "
     "0: no limit but time_budget_us for each pair.",
     "2000"},
    {"work_units_per_us", "work units", "1", "1000000", "", "20",
     "Turns time_budget_us and step_budget_us into work units. collisiond --calibrate measures it "
     "on this machine."},
    {"shape_triangles_max", "triangles", "1", kDigits<wire::kShapeTrianglesMax>, "", "2000000",
     "Triangles of one shape; a shape of more is refused."},
    {"shapes_max", "shapes", "1", "65536", "", "1024",
     "Different shapes in the world, including those that are still arriving; another one is "
     "refused."},
    {"shape_bytes_max", "bytes", "1048576", "1099511627776", "", "268435456",
     "Maximum memory for the arrived parts and the meshes of all shapes together. A part that does "
     "not fit is refused. Trees have their own limit, tree_bytes_max."},
    {"broad_phase", "none", "", "", "AUTO, ALL_PAIRS or SPATIAL_INDEX", "AUTO",
     "How candidate pairs are found. All methods give the same answers and differ in cost. AUTO "
     "takes ALL_PAIRS for few agents, SPATIAL_INDEX for many, and in between the one that does "
     "less work."},
    {"tree_builder", "none", "", "", "OCTREE, FITTED or MEDIAN_SPLIT", "FITTED",
     "Which builder makes the sphere trees of shapes. FITTED: balls that fit the surface far more "
     "tightly, so that brackets of the same cost are narrower. OCTREE: the reference. collisionctl "
     "sphere-tree shows the difference. A surface of more than 4096 triangles has a coarse tree "
     "until this one is built. MEDIAN_SPLIT: the coarse tree is all there is, built in a tenth of "
     "the time: for landscapes in LOCK_STEP, which waits for trees."},
    {"tree_cache_dir", "none", "", "",
     "a path of at most 4096 printable ASCII characters, or empty", "\"\"",
     "Folder that keeps trees once they are built; it is made if it is missing. A file that is "
     "damaged or of another version is replaced. Empty: the folder that systemd names "
     "(CacheDirectory=), else none."},
    {"tree_cache_mb", "MB", "1", "1048576", "", "1024",
     "Maximum size of all files in tree_cache_dir together, in millions of bytes; the least "
     "recently used are removed first. A shape of a million triangles takes about 100."},
    {"state_dir", "none", "", "", "a path of at most 4096 printable ASCII characters, or empty",
     "\"\"",
     "Folder of the journal: what a service must remember when it is started again. It is made if "
     "it is missing. Empty: the folder that systemd names (StateDirectory=), else none."},
    {"on_state_failure", "none", "", "", "GO_ON or END", "GO_ON",
     "When the journal is damaged, or cannot be read or written: GO_ON serves with what is left of "
     "it, END ends the service with 74. It is logged either way. END needs a folder of the "
     "journal."},
    {"claim_wait_s", "s", "0", "60", "", "0.5",
     "How long a service that starts listens whether another one serves the world (on_occupied). "
     "Longer than the network needs to find it."},
    {"on_occupied", "none", "", "", "LEAVE or STAND_BY", "LEAVE",
     "Where another service serves the world: LEAVE ends with 75. STAND_BY stays, does the same "
     "work, publishes nothing of it, and takes over when the other one ends, falls silent or "
     "cannot be reached for its lease_s."},
    {"lease_s", "s", "0.05", "2", "", "2",
     "The network counts this service as gone when it has not been heard for so long; a standby "
     "then takes over. Under 0.1 a busy machine gives false alarms."},
    {"on_recording_failure", "none", "", "", "GO_ON or END", "GO_ON",
     "When the recording (--record) cannot be written any more, as on a full disk: GO_ON serves on "
     "without it, END ends the service with 74. It ends with a whole batch, and the log and the "
     "status tell of it, either way."},
    {"recorder_mb_max", "MB", "0", "1048576", "", "1024",
     "Maximum size of all segments of the flight recorder together, in millions of bytes; the "
     "oldest goes first, also when the disk is full. They lie in the folder recordings of "
     "state_dir; without state_dir nothing is recorded. 0: no flight recorder."},
    {"recorder_segment_mb", "MB", "1", "4096", "", "64",
     "Size at which the next segment begins, at most a quarter of recorder_mb_max. A segment "
     "begins with the newest inputs of all simulators, shapes included."},
    {"recorder_segment_s", "s", "1", "86400", "", "600",
     "Age at which the next segment begins: a replay begins with a segment."},
    {"recorder_keep_s", "s", "0", "1000000000", "", "0",
     "Segments that ended so long ago are removed. 0: none for its age."},
    {"contacts_mb_max", "MB", "0", "1048576", "", "256",
     "Maximum size of the journal of contacts, in millions of bytes, in the folder contacts of "
     "state_dir: what collisionctl events --since shows. A contact takes about 3 kB in all its "
     "revisions. The oldest go first. 0: none is kept."},
    {"tree_bytes_max", "bytes", "1048576", "1099511627776", "", "4294967296",
     "Maximum memory for the sphere trees of all shapes together, some hundred MB for a million "
     "triangles. A shape whose tree does not fit is refused; where only its finer tree does not, "
     "it "
     "keeps the coarse one."},
    {"credentials_dir", "none", "", "",
     "a path of at most 4096 printable ASCII characters, or empty", "\"\"",
     "Folder of this service's credentials, as collisionctl make-certificates makes it: the world "
     "is secured, and programs without credentials of the same authority are not heard "
     "(docker/SECURITY.md). COLLISION_CREDENTIALS and --credentials go before it."},
};

class Silent final : public google::protobuf::io::ErrorCollector {
  void AddError(int, google::protobuf::io::ColumnNumber, const std::string&) override {}
};

/// The message that holds an option's field, and the field.
template <typename Holder>
struct Place {
  Holder* message;
  const FieldDescriptor* field;
};

std::string_view LeafOf(std::string_view path) { return path.substr(path.rfind('.') + 1); }

const FieldDescriptor* FieldOf(const Message& message, std::string_view name) {
  return message.GetDescriptor()->FindFieldByName(std::string(name));
}

Place<const Message> Find(const v1::Config& config, const ConfigOption& option) {
  const bool nested = option.path.find('.') != std::string_view::npos;
  const Message& holder = nested ? static_cast<const Message&>(config.clock()) : config;
  return {&holder, FieldOf(holder, LeafOf(option.path))};
}

Place<Message> Find(v1::Config* config, const ConfigOption& option) {
  const bool nested = option.path.find('.') != std::string_view::npos;
  Message* holder = nested ? static_cast<Message*>(config->mutable_clock()) : config;
  return {holder, FieldOf(*holder, LeafOf(option.path))};
}

bool IsLogLevel(std::string_view text) {
  constexpr std::string_view kLevels[] = {"trace", "debug",    "info", "warn",
                                          "error", "critical", "off"};
  return std::ranges::find(kLevels, text) != std::end(kLevels);
}

bool IsAllowedText(std::string_view path, const std::string& text) {
  if (path == "world") return wire::IsName(text);
  if (path == "log_level") return IsLogLevel(text);
  const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
  const bool is_label = path == "frame" || path == "epoch_utc";
  return text.size() <= (is_label ? wire::kLabelMax : 4096) && std::ranges::all_of(text, printable);
}

/// Whether a number lies in the option's range; text that is no number lies in none. Text to double
/// is exact for every limit in the table but 2^64 - 1, which no value can exceed.
bool IsInRange(const std::string& value, const ConfigOption& option) {
  const double number = std::strtod(value.c_str(), nullptr);
  return number >= std::strtod(option.least.data(), nullptr) &&
         number <= std::strtod(option.most.data(), nullptr);
}

/// Protobuf takes any number for an enum; 0 is "not set".
bool IsChoice(const FieldDescriptor& field, int value) {
  return value != 0 && field.enum_type()->FindValueByNumber(value) != nullptr;
}

bool IsAllowed(const v1::Config& config, const ConfigOption& option) {
  const auto [message, field] = Find(config, option);
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_STRING:
      return IsAllowedText(option.path, message->GetReflection()->GetString(*message, field));
    case FieldDescriptor::CPPTYPE_ENUM:
      return IsChoice(*field, message->GetReflection()->GetEnumValue(*message, field));
    default:
      return IsInRange(ValueText(config, option), option);
  }
}

}  // namespace

std::span<const ConfigOption> ConfigOptions() { return kOptions; }

const ConfigOption* FindConfigOption(std::string_view name) {
  const auto* found = std::ranges::find_if(
      kOptions, [&](const ConfigOption& option) { return LeafOf(option.path) == name; });
  return found == std::end(kOptions) ? nullptr : found;
}

std::string AllowedRange(const ConfigOption& option) {
  if (option.least.empty()) return std::string(option.allowed);
  return std::string(option.least) + " to " + std::string(option.most);
}

std::string_view DefaultOf(const ConfigOption& option, const v1::Config& config) {
  const bool wall = config.clock().kind() == v1::Clock::REAL_TIME;
  return wall && !option.wall_value.empty() ? option.wall_value : option.value;
}

bool IsSet(const v1::Config& config, const ConfigOption& option) {
  const auto [message, field] = Find(config, option);
  return message->GetReflection()->HasField(*message, field);
}

std::string ValueText(const v1::Config& config, const ConfigOption& option) {
  const auto [message, field] = Find(config, option);
  std::string text;
  google::protobuf::TextFormat::PrintFieldValueToString(*message, field, -1, &text);
  return text;
}

bool SetValue(v1::Config* config, const ConfigOption& option, std::string_view text) {
  const auto [message, field] = Find(config, option);
  Silent silent;  // Without it the parser writes to standard error.
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&silent);
  return parser.ParseFieldValueFromString(std::string(text), field, message);
}

std::string CheckValue(const v1::Config& config, const ConfigOption& option) {
  if (IsAllowed(config, option)) return {};
  const std::string unit = option.unit == "none" ? "" : " [" + std::string(option.unit) + "]";
  return ValueText(config, option) + " is not allowed; allowed: " + AllowedRange(option) + unit;
}

}  // namespace collision::server
