#include "client/programs/foxglove/channels/scene_channel.h"

#include <algorithm>
#include <optional>

#include "client/programs/foxglove/channels/body.h"
#include "collision/event_text.h"

namespace collision::client {
namespace {

constexpr double kTranslucent = 0.3;  ///< In place of a shape that is not drawn.
constexpr double kFontSize = 14;      ///< [pixels]

/// Those of the gateway's page: colors that the colour-blind tell apart.
/// Source: Okabe and Ito, "Color Universal Design", 2008.
foxglove::Color ColorOf(AlertLevel level, double opacity = 1) {
  static constexpr std::array<std::array<int, 3>, 4> kColors = {
      {{0x4d, 0x7e, 0xa8}, {0x56, 0xb4, 0xe9}, {0xe6, 0x9f, 0x00}, {0xd5, 0x5e, 0x00}}};
  const auto& [r, g, b] = kColors[static_cast<std::size_t>(level)];
  foxglove::Color color;
  color.set_r(r / 255.0);
  color.set_g(g / 255.0);
  color.set_b(b / 255.0);
  color.set_a(opacity);
  return color;
}

foxglove::SceneEntity* AddEntity(const std::string& id, const std::string& frame,
                                 std::int64_t now_ns, foxglove::SceneUpdate* update) {
  foxglove::SceneEntity* entity = update->add_entities();
  SetTime(now_ns, entity->mutable_timestamp());
  entity->set_frame_id(frame);
  entity->set_id(id);
  entity->set_frame_locked(true);
  return entity;
}

/// Only what is older than its time is deleted.
foxglove::SceneUpdate Deletion(const std::string& id, std::int64_t now_ns) {
  foxglove::SceneUpdate update;
  foxglove::SceneEntityDeletion* deletion = update.add_deletions();
  SetTime(now_ns + 1, deletion->mutable_timestamp());
  deletion->set_id(id);
  if (id == "all") deletion->set_type(foxglove::SceneEntityDeletion::ALL);
  return update;
}

void AddFact(const std::string& key, const std::string& value, foxglove::SceneEntity* entity) {
  if (value.empty()) return;
  foxglove::KeyValuePair* pair = entity->add_metadata();
  pair->set_key(key);
  pair->set_value(value);
}

std::array<double, 3> ArrayOf(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

void AddBody(const Scene& scene, const ShownAgent& agent, const v1::AgentDescription& description,
             foxglove::SceneEntity* entity) {
  if (agent.is_half_space) {
    const v1::HalfSpace& half_space = description.half_space();
    AddHalfSpace(ArrayOf(half_space.normal()), half_space.offset_m(), ColorOf(agent.level), entity);
    return;
  }
  if (agent.shape.empty()) return AddBall({}, agent.radius, ColorOf(agent.level), entity);
  if (const Payload bytes = scene.shapes().Find(agent.shape)) {
    std::string error;
    const auto shape = DecodeShape(*bytes, &error);
    if (shape && AddShape(*shape, ColorOf(agent.level), entity)) return;
  }
  AddBall({}, agent.radius, ColorOf(agent.level, kTranslucent), entity);
}

std::string AgentName(std::uint32_t number) { return "agent/" + std::to_string(number); }

/// Where the marks of a contact have a size that fits to its agents.
double MarkSize(const SceneStep& step, const v1::CollisionEvent& event) {
  double least = 0;
  for (const v1::AgentId& id : {event.lower(), event.higher()}) {
    const auto number = step.scene.NumberOf({id.simulator_id(), id.slot()});
    if (!number || *number >= step.world.agents().size()) continue;
    const double radius = step.world.agents()[*number].radius;
    if (radius > 0 && (least == 0 || radius < least)) least = radius;
  }
  return least > 0 ? least : 1;
}

void AddContact(const SceneStep& step, const v1::CollisionEvent& event,
                foxglove::SceneEntity* entity) {
  const WorldView& view = step.scene.view();
  const double size = MarkSize(step, event);
  const foxglove::Color color =
      ColorOf(event.level().empty() ? AlertLevel::kContact : AlertLevel::kSoon);
  const auto point = ArrayOf(event.proximity().point_m());
  AddBall(point, 0.15 * size, color, entity);
  foxglove::Pose pose = entity->spheres(0).pose();
  if (event.proximity().has_normal()) {
    const auto normal = ArrayOf(event.proximity().normal().direction());
    foxglove::ArrowPrimitive* arrow = entity->add_arrows();
    *arrow->mutable_pose() = pose;
    *arrow->mutable_pose()->mutable_orientation() = TurnOf(0, normal);
    arrow->set_shaft_length(1.5 * size);
    arrow->set_shaft_diameter(0.1 * size);
    arrow->set_head_length(0.4 * size);
    arrow->set_head_diameter(0.25 * size);
    *arrow->mutable_color() = color;
  }
  const std::string names =
      view.Name(FromMessage(event.lower())) + " × " + view.Name(FromMessage(event.higher()));
  foxglove::TextPrimitive* text = entity->add_texts();
  pose.mutable_position()->set_z(pose.position().z() + size);
  *text->mutable_pose() = pose;
  text->set_billboard(true);
  text->set_scale_invariant(true);
  text->set_font_size(kFontSize);
  *text->mutable_color() = color;
  text->set_text(names + "\n" + (event.level().empty() ? "" : event.level() + " ") + "from " +
                 InstantText(event.begin().earliest_ns(), 0, 3));
}

std::set<std::uint32_t> ChangedAgents(const SceneStep& step) {
  std::set<std::uint32_t> numbers;
  for (const SceneChanges::Slot& slot : step.changes.agents) {
    if (const auto number = step.scene.NumberOf(slot)) numbers.insert(*number);
  }
  if (step.changes.shapes.empty()) return numbers;
  const std::set<std::string> shapes(step.changes.shapes.begin(), step.changes.shapes.end());
  const std::vector<ShownAgent>& agents = step.world.agents();
  for (std::uint32_t number = 0; number < agents.size(); ++number) {
    if (shapes.count(agents[number].shape) > 0) numbers.insert(number);
  }
  return numbers;
}

}  // namespace

void SceneChannel::PutAll(const SceneStep& step, ChannelBoard* board) {
  shown_.clear();
  contacts_.clear();
  free_.clear();
  ended_.clear();
  is_crowded_ = step.world.is_crowded();
  board->Put("all", Deletion("all", step.now_ns));
  const auto count = static_cast<std::uint32_t>(step.world.agents().size());
  for (std::uint32_t number = 0; number < count; ++number) PutAgent(step, number, board);
  for (std::uint32_t first = 0; first < count; first += StateTable::kStatesOfAChunk) {
    PutChunk(step, first / StateTable::kStatesOfAChunk, board);
  }
  for (const std::uint64_t number : step.world.open_events()) PutEvent(step, number, board);
}

void SceneChannel::PutChanges(const SceneStep& step, ChannelBoard* board) {
  const std::set<std::uint32_t> changed = ChangedAgents(step);
  std::set<std::uint32_t> chunks(step.changes.chunks.begin(), step.changes.chunks.end());
  for (const std::uint32_t number : changed) {
    PutAgent(step, number, board);
    chunks.insert(number / StateTable::kStatesOfAChunk);
  }
  for (const std::uint32_t number : step.world.releveled()) {
    chunks.insert(number / StateTable::kStatesOfAChunk);
    const auto shown = shown_.find(number);
    const bool is_small = shown != shown_.end() && shown->second <= kRecoloredBytesMax;
    if (is_small && changed.count(number) == 0) PutAgent(step, number, board);
  }
  for (const std::uint32_t chunk : chunks) PutChunk(step, chunk, board);
  for (const std::uint64_t number : step.changes.events.dropped) EndContact(number, step.now_ns);
  for (const std::uint64_t number : step.changes.events.changed) PutEvent(step, number, board);
  RemoveEnded(step, board);
}

void SceneChannel::PutAgent(const SceneStep& step, std::uint32_t number, ChannelBoard* board) {
  const ShownAgent& agent = step.world.agents()[number];
  const StateTable::Agent& place = step.scene.states().agents()[number];
  const std::string name = AgentName(number);
  const auto view = step.world.IsApart(agent)
                        ? step.scene.view().Newest(place.simulator, place.slot)
                        : std::nullopt;
  if (!view) {
    if (shown_.erase(number) > 0) board->Put(name, Deletion(name, step.now_ns));
    return;
  }
  const v1::AgentDescription& description = view->description;
  foxglove::SceneUpdate update;
  foxglove::SceneEntity* entity =
      AddEntity(name, agent.is_half_space ? step.world.frame() : agent.frame, step.now_ns, &update);
  AddFact("agent", description.agent_name(), entity);
  AddFact("simulator", step.scene.view().SimulatorName(place.simulator), entity);
  AddFact("class", description.class_name(), entity);
  AddFact("assembly", description.assembly(), entity);
  AddBody(step.scene, agent, description, entity);
  const std::string bytes = update.SerializeAsString();
  shown_[number] = bytes.size();
  board->Put(name, bytes);
}

void SceneChannel::PutChunk(const SceneStep& step, std::uint32_t chunk, ChannelBoard* board) {
  if (!is_crowded_) return;
  const std::vector<ShownAgent>& agents = step.world.agents();
  const std::size_t first = std::size_t{chunk} * StateTable::kStatesOfAChunk;
  const std::size_t end = std::min(first + StateTable::kStatesOfAChunk, agents.size());
  const std::string name = "chunk/" + std::to_string(chunk);
  foxglove::SceneUpdate update;
  foxglove::SceneEntity* entity = AddEntity(name, step.world.frame(), step.now_ns, &update);
  for (std::size_t i = first; i < end; ++i) {
    const ShownAgent& agent = agents[i];
    const StateTable::Agent& state = step.scene.states().agents()[i];
    if (!agent.is_there || step.world.IsApart(agent) || !state.has_state) continue;
    AddBall(state.p, agent.radius, ColorOf(agent.level), entity);
  }
  board->Put(name, update);
}

void SceneChannel::PutEvent(const SceneStep& step, std::uint64_t number, ChannelBoard* board) {
  const v1::CollisionEvent& event = step.scene.events().At(number).newest;
  if (event.status() != v1::EVENT_CONFIRMED) return EndContact(number, step.now_ns);
  if (!event.has_proximity()) return;
  auto place = contacts_.find(number);
  if (place == contacts_.end()) {
    const std::size_t used = contacts_.size() + ended_.size() + free_.size();
    if (free_.empty() && used >= kContactsMax) return;
    if (free_.empty()) free_.insert(static_cast<std::uint32_t>(used));
    place = contacts_.emplace(number, *free_.begin()).first;
    free_.erase(free_.begin());
  }
  const std::string name = "contact/" + std::to_string(place->second);
  foxglove::SceneUpdate update;
  AddContact(step, event, AddEntity(name, step.world.frame(), step.now_ns, &update));
  board->Put(name, update);
}

void SceneChannel::EndContact(std::uint64_t number, std::int64_t now_ns) {
  const auto place = contacts_.find(number);
  if (place == contacts_.end()) return;
  ended_.emplace_back(now_ns + kAfterContactNs, place->second);
  contacts_.erase(place);
}

void SceneChannel::RemoveEnded(const SceneStep& step, ChannelBoard* board) {
  while (!ended_.empty() && ended_.front().first <= step.now_ns) {
    const std::string name = "contact/" + std::to_string(ended_.front().second);
    free_.insert(ended_.front().second);
    ended_.pop_front();
    board->Put(name, Deletion(name, step.now_ns));
  }
}

}  // namespace collision::client
