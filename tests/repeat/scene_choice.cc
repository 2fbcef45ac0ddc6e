#include "tests/repeat/scene_choice.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace collision::repeat {
namespace {

const std::set<std::string> kQuickScenes = {"swarm-100", "spaceships"};

std::vector<std::string> SceneNames(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".textproto") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Those that this machine allows; why another one is not goes to `left_out`.
std::vector<Condition> PossibleConditions(std::vector<std::string>* left_out) {
  std::vector<Condition> possible;
  for (const Condition& condition : AllConditions()) {
    if (condition.slow_network && (geteuid() != 0 || access("/dev/net/tun", R_OK | W_OK) != 0)) {
      left_out->push_back(condition.name + ": two hosts take root and /dev/net/tun");
    } else {
      possible.push_back(condition);
    }
  }
  return possible;
}

}  // namespace

std::string WhyNotRepeatable(const v1::Scene& scene) {
  const v1::Clock& clock = scene.config().clock();
  if (clock.kind() != v1::Clock::LOCK_STEP) return "it runs with the wall clock";
  if (clock.has_shape_wait_max_s() && clock.shape_wait_max_s() == 0) {
    return "its time does not wait for shapes: from when on a tree counts is chance";
  }
  return "";
}

std::vector<Series> SeriesOf(const std::string& name, double scene_seconds, const Choice& choice,
                             const std::vector<Condition>& conditions) {
  const double seconds = choice.seconds > 0 ? choice.seconds : scene_seconds;
  std::vector<Series> series;
  for (const Condition& condition : conditions) {
    const double speed = condition.paced ? std::max(1.0, seconds / choice.paced_max_s) : 0;
    series.push_back({name, seconds, speed, condition});
  }
  std::erase_if(
      series, [&](const Series& one) { return one.name().find(choice.only) == std::string::npos; });
  return series;
}

Chosen Choose(const client::Folders& folders, const Choice& choice) {
  Chosen chosen;
  const std::vector<Condition> conditions = PossibleConditions(&chosen.left_out);
  for (const std::string& name : SceneNames(folders.scenes)) {
    if (choice.quick && !kQuickScenes.contains(name)) continue;
    try {
      const v1::Scene scene = client::LoadScene(folders, name);
      const std::string why = WhyNotRepeatable(scene);
      if (!why.empty()) {
        chosen.left_out.push_back(name + ": " + why);
        continue;
      }
      const auto series = SeriesOf(name, scene.seconds(), choice, conditions);
      chosen.series.insert(chosen.series.end(), series.begin(), series.end());
    } catch (const std::runtime_error& error) {
      chosen.left_out.push_back(name + ": " + error.what());
    }
  }
  return chosen;
}

}  // namespace collision::repeat
