// ./run report: what a loop of 60 frames a second misses in each scene of ./run demo, and its
// price.
//
// The scenes (quick: five) are stepped through at 60 Hz over their true motion: contacts missed,
// delay of the others, pair tests, and the time of one. The satellites' contact is also made
// shorter until it is missed.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "client/checker/motion/motion.h"
#include "tests/bench/harness/json.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/scenes/frame_stepping.h"
#include "tests/bench/scenes/scene_run.h"

namespace collision::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kRate = 60;

/// With fewer pairs a frame the clock takes longer than the tests.
constexpr double kPairsTimed = 1000;

struct SceneLength {
  const char* scene;
  double seconds;        ///< In full; 0: the scene's own.
  double quick_seconds;  ///< 0: not in a quick run.
};
constexpr SceneLength kScenes[] = {
    {"iridium-cosmos", 0, 660}, {"corridor", 0, 110},     {"spaceships", 0, 10},
    {"spaceships-100", 0, 8},   {"spaceships-500", 0, 0}, {"swarm-100", 0, 20},
    {"swarm-1000", 0, 0},       {"swarm", 2, 0},          {"terrain", 0, 0},
    {"terrain-million", 0, 0},  {"drone-arms", 0, 0}};

/// How long the shrunk contact lasts [s]; the true one 0.123.
constexpr double kLengths[] = {0.1, 0.06, 0.03, 0.02, 0.0167, 0.01, 0.005, 0.002, 0.001};
constexpr double kQuickLengths[] = {0.06, 0.02, 0.01, 0.002};

struct TrueScene {
  v1::RunReport report;
  std::vector<checker::AgentMotion> motions;
  std::vector<checker::TrueContact> contacts;
};

std::optional<TrueScene> Observe(const SceneFolders& folders, SceneRequest request) {
  const ScratchFolder scratch;
  request.logs = scratch.path();
  auto report = RunScene(folders, request);
  if (!report) return std::nullopt;
  TrueScene scene{std::move(*report), {}, {}};
  std::vector<fs::path> logs;
  for (const auto& entry : fs::directory_iterator(scratch.path())) {
    if (entry.path().extension() == ".motion") logs.push_back(entry.path());
  }
  std::sort(logs.begin(), logs.end());
  for (const fs::path& log : logs) {
    std::ifstream file(log);
    for (auto& motion : checker::ReadMotionLog(file, log.stem().string())) {
      scene.motions.push_back(std::move(motion));
    }
  }
  scene.contacts = checker::TrueContacts(scene.motions);
  return scene;
}

/// The pairs that the service queried or filtered, as of its last status.
std::optional<double> PairsLookedAt(const v1::RunReport& report) {
  double sum = 0;
  for (const v1::Counter& counter : report.counters()) {
    if (counter.name() == "pair_queries" || counter.name() == "filter_tests") {
      sum += static_cast<double>(counter.value());
    }
  }
  return sum > 0 ? std::optional(sum) : std::nullopt;
}

struct Sums {
  double contacts = 0, missed = 0, missed_ours = 0, failed = 0;
  std::optional<double> shortest_seen, longest_missed;
};

std::string SceneRow(const char* name, const TrueScene& scene, const SteppingResult& stepped) {
  const auto& late = stepped.late;
  const double tests = static_cast<double>(stepped.pair_tests);
  return Object(
      {Text("part", "scene"), Text("scene", name),
       Number("agents", static_cast<double>(scene.motions.size())),
       Number("simulated_seconds", scene.report.simulated_seconds()), Number("rate_hz", kRate),
       Number("frames", static_cast<double>(stepped.frames)),
       Number("contacts", static_cast<double>(stepped.contacts)),
       Number("missed", static_cast<double>(stepped.missed)),
       Number("missed_ours", static_cast<double>(scene.report.contacts_unannounced())),
       Number("late_s", late.empty() ? std::nullopt : std::optional(Median(late))),
       Number("latest_s", late.empty() ? std::nullopt : std::optional(Quantile(late, 1))),
       Number("pair_tests", tests), Number("pair_tests_ours", PairsLookedAt(scene.report)),
       Number("shape_tests", static_cast<double>(stepped.shape_tests)),
       Number("seconds_per_pair_s", tests > kPairsTimed * static_cast<double>(stepped.frames)
                                        ? std::optional(stepped.ball_seconds / tests)
                                        : std::nullopt),
       Number("seconds_per_shape_test_s",
              stepped.shape_tests > 0
                  ? std::optional(stepped.shape_seconds / static_cast<double>(stepped.shape_tests))
                  : std::nullopt),
       Number("cpu_seconds_per_simulated_second",
              (stepped.ball_seconds + stepped.shape_seconds) / scene.report.simulated_seconds()),
       Number("cpu_seconds_per_simulated_second_ours",
              scene.report.cpu_seconds_per_simulated_second())});
}

void EachScene(const SceneOptions& options, std::vector<std::string>* rows, Sums* sums) {
  for (const SceneLength& length : kScenes) {
    if (!options.Wants(length.scene)) continue;
    if (options.quick && length.quick_seconds == 0) continue;
    const double seconds = options.quick ? length.quick_seconds : length.seconds;
    const auto scene = Observe(options.folders, {.scene = length.scene, .seconds = seconds});
    if (!scene) {
      ++sums->failed;
      continue;
    }
    const SteppingResult stepped = StepThrough(scene->motions, scene->contacts, kRate);
    std::fprintf(stderr, "bench: %s: %zu of %zu contacts missed at 60 Hz, %.3g pair tests\n",
                 length.scene, stepped.missed, stepped.contacts,
                 static_cast<double>(stepped.pair_tests));
    rows->push_back(SceneRow(length.scene, *scene, stepped));
    sums->contacts += static_cast<double>(stepped.contacts);
    sums->missed += static_cast<double>(stepped.missed);
    sums->missed_ours += static_cast<double>(scene->report.contacts_unannounced());
  }
}

/// The scene's own text with other radii and without what the literature says of the contact; what
/// the scene reads, and the network's profile beside its folder, as links.
void CopyShrunk(const std::string& scenes, const std::string& copies, double radius) {
  fs::create_directory(copies);
  const auto link_all = [](const fs::path& from, const fs::path& to, const char* extension) {
    for (const auto& entry : fs::directory_iterator(from)) {
      if (entry.path().extension() != extension) continue;
      fs::create_symlink(fs::absolute(entry.path()), to / entry.path().filename());
    }
  };
  link_all(scenes, copies, ".csv");
  link_all(fs::path(scenes) / "..", fs::path(copies).parent_path(), ".xml");
  std::ifstream file(scenes + "/iridium-cosmos.textproto");
  std::ofstream copy(copies + "/iridium-shrunk.textproto");
  char text[40];
  std::snprintf(text, sizeof text, "\"%.9g\"", radius);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("expectation")) break;
    const std::size_t at = line.find("\"500\"");
    if (at != std::string::npos) line.replace(at, 5, text);
    copy << line << '\n';
  }
}

/// Closest approach and relative speed there, from the true contact of spheres of 500 m.
struct Passing {
  double distance, speed;
};

std::optional<Passing> PassingOf(const TrueScene& scene) {
  if (scene.contacts.size() != 1 || scene.motions.size() != 2) return std::nullopt;
  const checker::TrueContact& contact = scene.contacts[0];
  const auto middle = static_cast<std::int64_t>(0.5L * (contact.begin_ns + contact.end_ns));
  const auto piece = [&](std::size_t agent) {
    for (const checker::Piece& of : scene.motions[agent].pieces) {
      if (of.t0_ns <= middle && middle <= of.t1_ns) return of;
    }
    return scene.motions[agent].pieces.back();
  };
  const checker::Piece a = piece(0), b = piece(1);
  const checker::PairMotion motion(a, b, middle);
  double d = 0, v = 0;
  for (const auto& axis : motion.difference()) {
    d += static_cast<double>(axis[0] * axis[0]), v += static_cast<double>(axis[1] * axis[1]);
  }
  return Passing{std::sqrt(d), std::sqrt(v)};
}

void Shrink(const SceneOptions& options, std::vector<std::string>* rows, Sums* sums) {
  const auto whole = Observe(options.folders, {.scene = "iridium-cosmos"});
  const auto passing = whole ? PassingOf(*whole) : std::nullopt;
  if (!passing) {
    ++sums->failed;
    return;
  }
  std::vector<double> lengths(std::begin(kLengths), std::end(kLengths));
  if (options.quick) lengths.assign(std::begin(kQuickLengths), std::end(kQuickLengths));
  for (const double length : lengths) {
    // Half the chord that the one flies through the sphere about the other.
    const double half = 0.5 * length * passing->speed;
    const double radius = 0.5 * std::hypot(passing->distance, half);
    const ScratchFolder config;
    SceneFolders shrunk = options.folders;
    shrunk.scenes = config.File("scenes");
    CopyShrunk(options.folders.scenes, shrunk.scenes, radius);
    const auto scene = Observe(shrunk, {.scene = "iridium-shrunk"});
    if (!scene || scene->contacts.size() != 1) {
      ++sums->failed;
      continue;
    }
    const checker::TrueContact& contact = scene->contacts[0];
    const double lasts = 1e-9 * static_cast<double>(contact.end_ns - contact.begin_ns);
    const SteppingResult stepped = StepThrough(scene->motions, scene->contacts, kRate);
    const bool seen = stepped.missed == 0;
    // Announced ahead, and never dismissed. Where states come once a second, an overlap smaller
    // than the uncertainty of the bounds cannot be confirmed: it is reported as undecided.
    const bool ours = scene->report.contacts_unannounced() == 0 &&
                      scene->report.events_possible() > 0 && scene->report.events_dismissed() == 0;
    const bool confirmed = scene->report.events_confirmed() > 0;
    const auto& width = scene->report.begin_width_s();
    std::fprintf(stderr, "bench: contact of %s: %s at 60 Hz, %s by ours\n",
                 SecondsText(lasts).c_str(), seen ? "seen" : "missed",
                 !ours       ? "missed"
                 : confirmed ? "confirmed"
                             : "reported as undecided");
    if (seen) sums->shortest_seen = std::min(sums->shortest_seen.value_or(lasts), lasts);
    if (!seen) sums->longest_missed = std::max(sums->longest_missed.value_or(lasts), lasts);
    sums->missed_ours += ours ? 0 : 1;
    for (const bool is_ours : {false, true}) {
      const bool found = is_ours ? ours : seen;
      rows->push_back(
          Object({Text("part", "shrunk"), Text("scene", "iridium-cosmos"),
                  Text("method", is_ours ? "ours" : "60 Hz"), Number("contact_s", lasts),
                  Number("radius_m", radius), Number("found", found ? 1 : 0),
                  Text("told", !found                  ? "missed"
                               : is_ours && !confirmed ? "undecided"
                                                       : "contact"),
                  Number("begin_width_s", is_ours && width.count() > 0 ? std::optional(width.max())
                                                                       : std::nullopt)}));
    }
  }
}

}  // namespace
}  // namespace collision::bench

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app(
      "What a loop of 60 frames a second misses in the scenes of ./run demo, and its price.",
      "stepping-bench");
  SceneOptions options;
  options.AddTo(&app, "fewer scenes, fewer seconds", "only scenes whose name contains this");
  CLI11_PARSE(app, count, arguments);
  std::vector<std::string> rows;
  Sums sums;
  EachScene(options, &rows, &sums);
  if (options.Wants("iridium-cosmos")) Shrink(options, &rows, &sums);
  Figures figures({"contacts_count", "stepping_60hz_misses", "ours_misses",
                   "shortest_contact_seen_at_60hz_s", "longest_contact_missed_at_60hz_s",
                   "runs_failed"});
  figures.Set("contacts_count", sums.contacts);
  figures.Set("stepping_60hz_misses", sums.missed);
  figures.Set("ours_misses", sums.missed_ours);
  figures.Set("shortest_contact_seen_at_60hz_s", sums.shortest_seen);
  figures.Set("longest_contact_missed_at_60hz_s", sums.longest_missed);
  figures.Set("runs_failed", sums.failed);
  std::fputs(figures.Table().c_str(), stdout);
  if (const int status = WriteJson(options.json, figures.Json(rows)); status != 0) return status;
  return sums.failed == 0 ? 0 : 1;
}
