// ./run report: each optional part on and off, and what the scene profile chose.
//
// Fifteen scenes (quick: twelve, of up to 600 agents) of the detector alone.
//
// - By each broad phase and by the profile's choice: counted work, time, memory, messages. Exit
//   status 1 if the choice costs more than 1.1 times the best made by hand (the face sweep counts
//   up to 600 agents), if answers differ, or if a part that is not needed is not named.
// - Each of ten optional parts off, and on with so little of it that no answer changes: the price
//   of the part (quick: one of the ten in each scene).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "collision_core/numeric/seconds.h"
#include "collision_core/shape/shape.h"
#include "tests/bench/harness/json.h"
#include "tests/bench/harness/options.h"
#include "tests/bench/scenes/detector_scene.h"

namespace collision::bench {
namespace {

/// So little of a part that it changes no answer, and all of its price.
constexpr double kNothing = 1e-300;

/// The exhaustive index asks about every partner of one agent: with more agents, no user would pick
/// it by hand.
constexpr std::size_t kExhaustiveMax = 600;

/// In larger scenes parts are not tried one by one: that takes minutes, and tells nothing new.
constexpr std::size_t kPartsMax = 2000;

/// What the profile chose costs at most so many times the counted work of the best by hand.
constexpr double kWorstMax = 1.1;

/// A part that a scene can do without: how it is asked for, and what the profile says without it.
struct Part {
  std::string name;
  std::string left_out;  ///< How its line in Profile::left_out begins.
  Variation without, with;
};

std::shared_ptr<const shape::Shape> UnitBall() {
  shape::ConvexDescription ball;
  ball.rounding = 1;
  return shape::Shape::Compound(nullptr, {shape::ConvexSolid::Build(ball)});
}

Part MakePart(const std::string& name, const std::string& left_out, const Variation& without,
              const Variation& with) {
  Part part;
  part.name = name, part.left_out = left_out, part.without = without, part.with = with;
  return part;
}

template <typename Change>
Variation Changed(const Change& change) {
  Variation variation;
  variation.change = change;
  return variation;
}

void NotAccelerate(SceneAgent* agent) { agent->declaration.limits.acceleration_max = 0; }
void AsLargeAsTheBall(SceneAgent* agent) {
  agent->declaration.limits.radius = std::max(agent->declaration.limits.radius, 1.0);
}

std::vector<Part> Parts() {
  const Variation plain, coasting = Changed(NotAccelerate), large = Changed(AsLargeAsTheBall);
  Variation skewed;
  skewed.options.skew = kNothing;
  const auto shape = UnitBall();
  const auto take_shape = [shape](SceneAgent* agent) {
    AsLargeAsTheBall(agent);
    agent->declaration.shape = shape;
    agent->declaration.limits.angular_acceleration_max = 0;
  };
  const Variation shaped = Changed(take_shape);
  const Variation turning = Changed([take_shape](SceneAgent* agent) {
    take_shape(agent);
    agent->declaration.limits.angular_acceleration_max = kNothing;
  });
  // Without forces: an agent with a direction may not be pushed back along it.
  Variation growing,
      directed =
          Changed([](SceneAgent*agent) { agent->state.direction = Eigen::Vector3d::UnitX(); });
  growing.forces = directed.forces = false;
  const Variation capped =
      Changed([](SceneAgent* agent) { agent->declaration.limits.speed_max = 1e12; });
  const Variation stepping =
      Changed([](SceneAgent* agent) { agent->declaration.limits.time_step = kNothing; });
  const Variation uncertain = Changed([](SceneAgent* agent) {
    agent->state.position_error = agent->state.velocity_error = kNothing;
  });
  const Variation expiring = Changed(
      [](SceneAgent* agent) { agent->state.expiry = numeric::AddRoundedDown(Instant(), 1e9); });
  const Variation masked = Changed([](SceneAgent* agent) { agent->declaration.filter.group = 3; });
  std::vector<Part> parts;
  parts.push_back(MakePart("parabolic growth", "parabolic growth", coasting, growing));
  parts.push_back(MakePart("speed caps", "speed caps", plain, capped));
  parts.push_back(MakePart("integrator step", "integrator step", plain, stepping));
  parts.push_back(MakePart("state errors", "growth by state errors", plain, uncertain));
  parts.push_back(MakePart("expiry", "expiry", plain, expiring));
  parts.push_back(MakePart("masks", "masks", plain, masked));
  parts.push_back(MakePart("clock skew", "clock skew", plain, skewed));
  parts.push_back(MakePart("direction", "directional boxes", growing, directed));
  parts.push_back(MakePart("sphere trees", "sphere trees and rotation", large, shaped));
  parts.push_back(MakePart("rotation", "rotation of sphere trees", shaped, turning));
  return parts;
}

struct Bench {
  std::vector<std::string> rows;
  Figures figures{{"chosen_over_best_units_worst", "scenes_count", "parts_count",
                   "left_out_missed_count", "answers_differ_count"}};
  double worst = 0, missed = 0, differ = 0;
  std::map<std::string, bool> parts_seen;
  double scenes = 0;

  bool kept() const { return worst <= kWorstMax && missed == 0 && differ == 0; }
};

std::vector<Field> CostFields(const DetectorCost& cost) {
  return {Number("units", cost.units()),
          Number("broad_units", cost.broad_units),
          Number("narrow_units", cost.narrow_units),
          Number("seconds", cost.seconds),
          Number("bytes", cost.bytes),
          Number("messages", cost.messages),
          Text("hash", cost.hash)};
}

void AddRow(std::vector<Field> fields, const DetectorCost& cost, Bench* bench) {
  for (Field& field : CostFields(cost)) fields.push_back(std::move(field));
  bench->rows.push_back(Object(fields));
}

/// By hand, each method that could be meant, and by the profile.
void Profile(const DetectorScene& scene, Bench* bench) {
  const auto agents = Number("agents", static_cast<double>(scene.agents.size()));
  std::optional<DetectorCost> best, chosen;
  std::string best_name;
  for (const broad_phase::BroadPhaseMethod method :
       {broad_phase::BroadPhaseMethod::kAllPairs, broad_phase::BroadPhaseMethod::kSpatialIndex,
        broad_phase::BroadPhaseMethod::kExhaustive, broad_phase::BroadPhaseMethod::kAuto}) {
    if (method == broad_phase::BroadPhaseMethod::kExhaustive &&
        scene.agents.size() > kExhaustiveMax)
      continue;
    Variation variation;
    variation.options.broad_phase = method;
    const DetectorCost cost = Cost(scene, variation);
    AddRow(
        {Text("part", "method"), Text("scene", scene.name), agents, Text("method", Name(method))},
        cost, bench);
    if (method == broad_phase::BroadPhaseMethod::kAuto) {
      chosen = cost;
    } else if (!best || cost.units() < best->units()) {
      best = cost, best_name = Name(method);
    }
    if (cost.hash != best->hash) ++bench->differ;
  }
  const double ratio = chosen->units() / best->units();
  bench->worst = std::max(bench->worst, ratio);
  ++bench->scenes;
  std::string left_out;
  for (const std::string& line : chosen->profile.left_out) {
    left_out += (left_out.empty() ? "" : ", ") + line.substr(0, line.find(':'));
  }
  bench->rows.push_back(
      Object({Text("part", "profile"), Text("scene", scene.name), agents,
              Text("chosen", chosen->profile.broad_phase), Number("units", chosen->units()),
              Text("best", best_name), Number("best_units", best->units()), Number("ratio", ratio),
              Number("seconds", chosen->seconds), Number("best_seconds", best->seconds),
              Text("why", chosen->profile.why), Text("left_out", left_out)}));
  std::fprintf(stderr, "bench: %s: %s, %.3f of the units of %s\n", scene.name.c_str(),
               chosen->profile.broad_phase.c_str(), ratio, best_name.c_str());
}

bool LeavesOut(const DetectorCost& cost, const Part& part) {
  for (const std::string& line : cost.profile.left_out) {
    if (line.starts_with(part.left_out)) return true;
  }
  return false;
}

void OnAndOff(const DetectorScene& scene, const Part& part, Bench* bench) {
  const DetectorCost without = Cost(scene, part.without), with = Cost(scene, part.with);
  const bool noticed = LeavesOut(without, part) && !LeavesOut(with, part);
  bench->missed += noticed ? 0 : 1;
  bench->parts_seen[part.name] = true;
  for (const bool on : {false, true}) {
    AddRow({Text("part", "part"), Text("scene", scene.name), Text("name", part.name),
            Text("setting", on ? "on" : "off"), Text("noticed", noticed ? "yes" : "NO"),
            Number("units_over_off", with.units() / without.units()),
            Number("seconds_over_off", with.seconds / without.seconds)},
           on ? with : without, bench);
  }
  std::fprintf(stderr, "bench: %s, %s: %.2f of the units, %.2f of the time of without it%s\n",
               scene.name.c_str(), part.name.c_str(), with.units() / without.units(),
               with.seconds / without.seconds, noticed ? "" : "; NOT NOTICED");
}

}  // namespace
}  // namespace collision::bench

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app(
      "Each optional part on and off in a dozen scenes and more, and what the profile chose.",
      "left-out-bench");
  CommonOptions options;
  options.AddTo(&app, "shorter scenes of up to 600 agents, each part in one of them",
                "only scenes whose name contains this");
  CLI11_PARSE(app, count, arguments);
  Bench bench;
  const auto parts = Parts();
  std::size_t number = 0;
  for (const DetectorScene& scene : DetectorScenes(options.quick, options.quick ? 20 : 100)) {
    if (!options.Wants(scene.name)) continue;
    Profile(scene, &bench);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (scene.agents.size() > kPartsMax) break;
      if (!options.quick || i == number % parts.size()) OnAndOff(scene, parts[i], &bench);
    }
    ++number;
  }
  bench.figures.Set("chosen_over_best_units_worst", bench.worst);
  bench.figures.Set("scenes_count", bench.scenes);
  bench.figures.Set("parts_count", static_cast<double>(bench.parts_seen.size()));
  bench.figures.Set("left_out_missed_count", bench.missed);
  bench.figures.Set("answers_differ_count", bench.differ);
  std::fputs(bench.figures.Table().c_str(), stdout);
  if (const int status = WriteJson(options.json, bench.figures.Json(bench.rows)); status != 0)
    return status;
  return bench.kept() ? 0 : 1;
}
