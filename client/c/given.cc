#include "client/c/given.h"

#include <cmath>
#include <limits>

namespace collision::client::c {
namespace {

constexpr double kNotDeclared = std::numeric_limits<double>::quiet_NaN();
// More than the library takes, and no more than memory holds: it names its own limits.
constexpr std::size_t kTagsMax = 64;
constexpr std::size_t kPointsMax = 2'000'000;
constexpr std::size_t kTrianglesMax = 10'000'000;
constexpr std::size_t kSolidsMax = 200'000;

constexpr std::uint32_t kDomainOfEnvironment = std::numeric_limits<std::uint32_t>::max();

Vector3 VectorOf(const double (&values)[3]) { return {values[0], values[1], values[2]}; }

Quaternion QuaternionOf(const double (&values)[4]) {
  return {values[0], values[1], values[2], values[3]};
}

std::string TextOf(const char* text) { return text == nullptr ? "" : text; }

std::optional<double> Declared(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

/// An array of so many elements, of which there can be at most `most`.
void RequireArray(const char* name, const void* array, std::size_t count, std::size_t most) {
  if (count > 0) Require(name, array);
  if (count <= most) return;
  throw std::invalid_argument(std::string(name) + ": " + std::to_string(count) +
                              " elements, allowed: 0 to " + std::to_string(most));
}

std::vector<std::string> TextsOf(const char* name, const char* const* texts, std::size_t count) {
  constexpr std::size_t kTextsMax = 64;
  RequireArray(name, texts, count, kTextsMax);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < count; ++i) {
    Require(name, texts[i]);
    all.emplace_back(texts[i]);
  }
  return all;
}

Solid SolidOf(const collision_solid& given) {
  if (given.kind < COLLISION_BALL || given.kind > COLLISION_CONE) {
    throw std::invalid_argument("kind: " + std::to_string(given.kind) +
                                ", allowed: COLLISION_BALL to COLLISION_CONE");
  }
  Solid solid{.kind = static_cast<Solid::Kind>(given.kind),
              .half_extents_m = VectorOf(given.half_extents_m),
              .rounding_m = given.rounding_m,
              .position_m = VectorOf(given.position_m)};
  RequireArray("points_m", given.points_m, given.points, kPointsMax);
  for (std::size_t i = 0; i < given.points; ++i) {
    const double* point = given.points_m + 3 * i;
    solid.points_m.push_back({point[0], point[1], point[2]});
  }
  const Quaternion orientation = QuaternionOf(given.orientation);
  if (orientation != Quaternion{}) solid.orientation = orientation;
  return solid;
}

}  // namespace

void RequireSize(std::size_t size) {
  if (size >= sizeof(std::uint64_t)) return;
  throw std::invalid_argument("size: " + std::to_string(size) + ", allowed: that of the structure");
}

collision_world_options DefaultWorldOptions() {
  const WorldOptions defaults{.world = "default", .domain = 0, .credentials = ""};
  collision_world_options options{};
  options.struct_size = sizeof options;
  options.domain = kDomainOfEnvironment;
  options.lock_step = defaults.lock_step ? 1 : 0;
  options.on_demand = defaults.on_demand ? 1 : 0;
  options.lead_ns = defaults.lead.count();
  return options;
}

collision_monitor_options DefaultMonitorOptions() {
  collision_monitor_options options{};
  options.struct_size = sizeof options;
  options.domain = kDomainOfEnvironment;
  options.service = 1;
  return options;
}

collision_agent_description DefaultDescription() {
  collision_agent_description description{};
  description.struct_size = sizeof description;
  description.radius_m = description.acceleration_max_m_s2 = kNotDeclared;
  description.angular_acceleration_max_rad_s2 = description.speed_max_m_s = kNotDeclared;
  description.time_step_s = kNotDeclared;
  return description;
}

collision_geometry DefaultGeometry() {
  collision_geometry geometry{};
  geometry.struct_size = sizeof geometry;
  return geometry;
}

collision_state DefaultState() {
  collision_state state{};
  state.struct_size = sizeof state;
  state.orientation[0] = 1;
  state.direction_until_ns = state.expiry_ns = kNever;
  return state;
}

WorldOptions FromC(const collision_world_options& given) {
  WorldOptions options{
      .world = given.world == nullptr ? DefaultWorld() : given.world,
      .simulator = TextOf(given.simulator),
      .domain = given.domain == kDomainOfEnvironment ? DefaultDomain() : given.domain};
  if (given.credentials != nullptr) options.credentials = given.credentials;
  options.frame = TextOf(given.frame);
  options.lock_step = given.lock_step != 0;
  options.run = given.run;
  options.incarnation = given.incarnation;
  options.on_demand = given.on_demand != 0;
  options.lead = std::chrono::nanoseconds(given.lead_ns);
  options.chunk_size = given.chunk_size;
  options.on_leave = given.leave_agents != 0 ? OnLeave::kLeave : OnLeave::kRemove;
  options.levels = TextsOf("levels", given.levels, given.levels_count);
  if (given.wall_clock != nullptr) {
    options.wall_clock = [clock = given.wall_clock, user = given.wall_clock_user] {
      return clock(user);
    };
  }
  return options;
}

MonitorOptions FromC(const collision_monitor_options& given) {
  return {.world = given.world == nullptr ? DefaultWorld() : given.world,
          .domain = given.domain == kDomainOfEnvironment ? DefaultDomain() : given.domain,
          .service = given.service != 0,
          .simulators = given.simulators != 0,
          .credentials = given.credentials == nullptr ? DefaultCredentials() : given.credentials};
}

AgentDescription FromC(const collision_agent_description& given) {
  AgentDescription description{.name = TextOf(given.name),
                               .radius_m = Declared(given.radius_m),
                               .margin_m = given.margin_m,
                               .acceleration_max_m_s2 = Declared(given.acceleration_max_m_s2),
                               .jerk_max_m_s3 = given.jerk_max_m_s3};
  description.angular_acceleration_max_rad_s2 = Declared(given.angular_acceleration_max_rad_s2);
  description.speed_max_m_s = Declared(given.speed_max_m_s);
  description.time_step_s = Declared(given.time_step_s);
  description.class_name = TextOf(given.class_name);
  description.assembly = TextOf(given.assembly);
  description.meets_in_assembly =
      TextsOf("meets_in_assembly", given.meets_in_assembly, given.meets_in_assembly_count);
  description.never_meets = TextsOf("never_meets", given.never_meets, given.never_meets_count);
  RequireArray("tags", given.tags, given.tags_count, kTagsMax);
  for (std::size_t i = 0; i < given.tags_count; ++i) {
    description.tags.push_back({TextOf(given.tags[i].key), TextOf(given.tags[i].value)});
  }
  if (given.shape != nullptr) description.shape = given.shape->shape;
  const Vector3 normal = VectorOf(given.half_space_normal);
  if (normal != Vector3{}) description.half_space = {normal, given.half_space_offset_m};
  description.hypothetical = given.hypothetical != 0;
  return description;
}

State FromC(const collision_state& given) {
  State state{.stamp_ns = given.stamp_ns,
              .position_m = VectorOf(given.position_m),
              .velocity_m_s = VectorOf(given.velocity_m_s),
              .acceleration_m_s2 = VectorOf(given.acceleration_m_s2),
              .orientation = QuaternionOf(given.orientation),
              .angular_velocity_rad_s = VectorOf(given.angular_velocity_rad_s)};
  state.position_error_m = given.position_error_m;
  state.velocity_error_m_s = given.velocity_error_m_s;
  state.rotation_error_rad = given.rotation_error_rad;
  const Vector3 direction = VectorOf(given.thrust_direction);
  if (direction != Vector3{}) state.thrust_direction = direction;
  state.direction_until_ns = given.direction_until_ns;
  if (given.expiry_ns != kNever) state.expiry_ns = given.expiry_ns;
  state.discontinuity = given.discontinuity != 0;
  return state;
}

AgentId FromC(const collision_agent_id& id) {
  return {id.simulator, id.run, id.slot, id.generation};
}

Geometry FromC(const collision_geometry& given) {
  RequireArray("vertices_m", given.vertices_m, given.vertices, 3 * kTrianglesMax);
  RequireArray("indices", given.indices, given.triangles, kTrianglesMax);
  RequireArray("solids", given.solids, given.solids_count, kSolidsMax);
  Geometry geometry;
  for (std::size_t i = 0; i < given.vertices; ++i) {
    const double* vertex = given.vertices_m + 3 * i;
    geometry.triangles.vertices_m.push_back({vertex[0], vertex[1], vertex[2]});
  }
  for (std::size_t i = 0; i < given.triangles; ++i) {
    const std::uint32_t* corners = given.indices + 3 * i;
    geometry.triangles.indices.push_back({corners[0], corners[1], corners[2]});
  }
  for (std::size_t i = 0; i < given.solids_count; ++i) {
    geometry.solids.push_back(SolidOf(given.solids[i]));
  }
  return geometry;
}

}  // namespace collision::client::c
