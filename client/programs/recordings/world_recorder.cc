#include "client/programs/recordings/world_recorder.h"

#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "client/library/identity/library_version.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

constexpr std::int64_t kChunkPeriodNs = 1'000'000'000;  ///< What a crash loses, by the wall clock.

constexpr std::int64_t kBackNs = 1'000'000'000;  ///< Time has begun anew.

/// A time of the file: there is none before 0.
std::uint64_t FileTime(std::int64_t time_ns) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
}

/// The file and all that it imports.
void AddWithImports(const google::protobuf::FileDescriptor& file, std::set<std::string>* added,
                    google::protobuf::FileDescriptorSet* set) {
  if (!added->insert(std::string(file.name())).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) {
    AddWithImports(*file.dependency(i), added, set);
  }
  file.CopyTo(set->add_file());
}

/// As the field of the oneof is called, but where topics are called otherwise.
std::string TopicOf(const google::protobuf::FieldDescriptor& field,
                    const google::protobuf::Message& message) {
  std::string name(field.name());
  if (name == "collision_event") {
    const auto& event = static_cast<const v1::CollisionEvent&>(message);
    name = event.contacts_sequence() > 0 ? "contact" : "forecast";
  }
  if (name == "shape_part") name = "shape";
  if (name == "event_heard") name = "event_of_another_service";
  return "collision/v1/" + name;
}

std::string NumberedPath(const std::string& path, int number) {
  if (number == 1) return path;
  const std::filesystem::path whole(path);
  const std::string name =
      whole.stem().string() + "." + std::to_string(number) + whole.extension().string();
  return (whole.parent_path() / name).string();
}

bool HasAgents(const Arrivals& arrivals) {
  return std::ranges::any_of(arrivals.inputs,
                             [](const v1::Input& input) { return input.has_agent_description(); });
}

/// The time of a service that serves: what late joiners hear again of events is of before.
std::optional<std::int64_t> NowOf(const v1::Output& output) {
  if (output.has_clearance()) return output.clearance().now_ns();
  const bool serves =
      output.has_service_status() && output.service_status().phase() == v1::PHASE_SERVING;
  return serves ? std::optional(output.service_status().now_ns()) : std::nullopt;
}

}  // namespace

WorldRecorder::WorldRecorder(std::unique_ptr<Receiver> receiver, WorldRecorderOptions options)
    : options_(std::move(options)),
      times_(PeriodNs(options_.rate_hz)),
      stream_(std::make_unique<HeardFirst>(std::move(receiver),
                                           [this](const Arrivals& arrivals) { Hear(arrivals); })) {
  Begin();
}

WorldRecorder::~WorldRecorder() = default;

std::size_t WorldRecorder::Poll(std::chrono::nanoseconds timeout) {
  const std::size_t messages = stream_.Poll(timeout);
  if (messages == 0) return 0;
  if (times_.IsDue(now_ns_)) WritePage();
  if (options_.wall_ns() >= chunk_due_ns_) {
    chunk_due_ns_ = options_.wall_ns() + kChunkPeriodNs;
    file_->EndChunk();
  }
  return messages;
}

void WorldRecorder::Close() {
  WritePage();
  files_[file_->path()] = file_->messages();
  file_->Close();
}

void WorldRecorder::Begin() {
  file_ = std::make_unique<McapWriter>(NumberedPath(options_.path, ++number_));
  file_->WriteMetadata("collision", {{"version", LibraryVersion()},
                                     {"wire_revision", std::to_string(wire::kWireRevision)}});
  channels_.clear();
  schemas_.clear();
  page_ = file_->Add(
      McapWriter::Channel{.schema = 0, .topic = "/page", .message_encoding = "collision.page.v1"});
  readers_.clear();
  foxglove_ = std::make_unique<FoxgloveChannels>();
  for (const Channel& channel : Channels()) {
    readers_.push_back(
        std::make_unique<ChannelReader>(foxglove_.get(), static_cast<ChannelId>(channel.id)));
  }
  stream_.BeginAnew();
  times_.BeginAnew();
  newest_ns_ = std::numeric_limits<std::int64_t>::min();
  has_agents_ = false;
  chunk_due_ns_ = std::numeric_limits<std::int64_t>::min();
}

void WorldRecorder::Hear(const Arrivals& arrivals) {
  for (const v1::Output& output : arrivals.outputs) {
    const auto now_ns = NowOf(output);
    if (now_ns && *now_ns >= -wire::kInstantMax) now_ns_ = *now_ns;
  }
  // What a service says before the first agent of another epoch belongs to the former.
  if (HasAgents(arrivals)) {
    if (has_agents_ && (stream_.IsOver() || now_ns_ < newest_ns_ - kBackNs)) {
      Close();
      Begin();
    }
    has_agents_ = true;
  }
  if (times_.AreStatesDue(arrivals)) WritePage();
  newest_ns_ = std::max(newest_ns_, now_ns_);
  for (const v1::Input& input : arrivals.inputs) WriteMessage(input);
  for (const v1::Output& output : arrivals.outputs) WriteMessage(output);
}

/// `holder`: an input or an output, of which the message is written.
void WorldRecorder::WriteMessage(const google::protobuf::Message& holder) {
  const google::protobuf::Reflection& reflection = *holder.GetReflection();
  const google::protobuf::FieldDescriptor* field =
      reflection.GetOneofFieldDescriptor(holder, holder.GetDescriptor()->oneof_decl(0));
  if (field == nullptr) return;
  const google::protobuf::Message& message = reflection.GetMessage(holder, field);
  file_->Write(ChannelOf(TopicOf(*field, message), message), FileTime(now_ns_),
               FileTime(options_.wall_ns()), message.SerializeAsString());
}

std::uint16_t WorldRecorder::ChannelOf(const std::string& topic,
                                       const google::protobuf::Message& message) {
  const auto known = channels_.find(topic);
  if (known != channels_.end()) return known->second;
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  google::protobuf::FileDescriptorSet set;
  std::set<std::string> added;
  AddWithImports(*type.file(), &added, &set);
  const std::uint16_t schema = SchemaOf({.name = std::string(type.full_name()),
                                         .encoding = "protobuf",
                                         .data = set.SerializeAsString()});
  return channels_[topic] = file_->Add(
             McapWriter::Channel{.schema = schema, .topic = topic, .message_encoding = "protobuf"});
}

/// One for each name.
std::uint16_t WorldRecorder::SchemaOf(const McapWriter::Schema& schema) {
  const auto known = schemas_.find(schema.name);
  if (known != schemas_.end()) return known->second;
  return schemas_[schema.name] = file_->Add(schema);
}

void WorldRecorder::WritePage() {
  times_.Taken(now_ns_);
  if (stream_.IsOver()) return;
  std::string message;
  for (const Board::Item& item : stream_.TakeNew()) message += *item.payload;
  if (message.empty()) return;
  // Each builds upon those before: readers by time must get them in this order.
  file_->Write(page_, FileTime(newest_ns_), FileTime(options_.wall_ns()), message);
  WriteForFoxglove();
}

void WorldRecorder::WriteForFoxglove() {
  foxglove_->Put(stream_.scene(), stream_.changes(), stream_.monitor().service_alive());
  for (const Channel& channel : Channels()) {
    while (const Payload message = readers_[channel.id - 1]->Next()) {
      if (channels_.count(channel.topic) == 0) {
        const std::uint16_t schema = SchemaOf({.name = channel.schema_name,
                                               .encoding = channel.schema_encoding,
                                               .data = channel.schema});
        channels_[channel.topic] = file_->Add(McapWriter::Channel{
            .schema = schema, .topic = channel.topic, .message_encoding = channel.encoding});
      }
      file_->Write(channels_[channel.topic], FileTime(TimeOf(*message)),
                   FileTime(options_.wall_ns()), std::string(MessageOf(*message)));
    }
  }
}

}  // namespace collision::client
