// Runs every fixed scene in each way that must not matter, and prints the hash of its event log.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "server/process/logging.h"
#include "tests/bench/harness/json.h"
#include "tests/same_bits/run_scene.h"

namespace collision::server {
namespace {

struct Arguments {
  std::string only;
  std::string json;
};

/// What became of one scene.
struct Row {
  std::string name;
  RunHashes hashes;
  bool replayed = false;      ///< A replay of its recording gives the same hashes.
  bool built_beside = false;  ///< A run with shapes that are built on threads does.
  bool by_chance = false;     ///< Threads finish at any time: a replay of that run equals the run.
  bool side_by_side = false;  ///< A run while all scenes run at once, each in a thread, does.

  bool same() const { return replayed && built_beside && by_chance && side_by_side; }
};

Row RunAlone(const Scene& scene, const std::string& file) {
  Row row{.name = scene.name, .hashes = RunScene(scene, Builders::kOwn, file)};
  row.replayed = Replay(file) == row.hashes;
  row.built_beside = RunScene(scene, Builders::kThreads) == row.hashes;
  const RunHashes chance = RunScene(scene, Builders::kChance, file);
  row.by_chance = Replay(file) == chance;
  return row;
}

/// All at once: separate daemons share nothing that could be seen.
void RunTogether(const std::vector<Scene>& scenes, std::vector<Row>* rows) {
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    threads.emplace_back([&scene = scenes[i], &row = (*rows)[i]] {
      row.side_by_side = RunScene(scene, Builders::kOwn) == row.hashes;
    });
  }
  for (std::thread& thread : threads) thread.join();
}

std::string Hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

const char* YesOrNo(bool yes) { return yes ? "same" : "DIFFERS"; }

void Print(const std::vector<Row>& rows) {
  std::printf("%-14s %7s  %-16s  %-16s  %-7s  %-7s  %-7s  %s\n", "scene", "events", "event_log",
              "all_outputs", "replay", "threads", "chance", "at_once");
  for (const Row& row : rows) {
    std::printf("%-14s %7llu  %s  %s  %-7s  %-7s  %-7s  %s\n", row.name.c_str(),
                static_cast<unsigned long long>(row.hashes.events), Hex(row.hashes.log).c_str(),
                Hex(row.hashes.outputs).c_str(), YesOrNo(row.replayed), YesOrNo(row.built_beside),
                YesOrNo(row.by_chance), YesOrNo(row.side_by_side));
  }
}

void WriteJson(const std::vector<Row>& rows, const std::string& path) {
  bench::Figures figures({"scenes", "same"});
  double same = 0;
  std::vector<std::string> measurements;
  for (const Row& row : rows) {
    same += row.same();
    measurements.push_back(bench::Object(
        {bench::Text("part", "same-bits"), bench::Text("scene", row.name),
         bench::Number("events", row.hashes.events), bench::Text("event_log", Hex(row.hashes.log)),
         bench::Text("all_outputs", Hex(row.hashes.outputs)),
         bench::Text("replay", YesOrNo(row.replayed)),
         bench::Text("threads", YesOrNo(row.built_beside)),
         bench::Text("chance", YesOrNo(row.by_chance)),
         bench::Text("at_once", YesOrNo(row.side_by_side))}));
  }
  figures.Set("scenes", static_cast<double>(rows.size()));
  figures.Set("same", same);
  std::ofstream file(path);
  file << figures.Json(measurements);
  if (!file.flush()) throw std::runtime_error("--json " + path + ": cannot be written");
}

int Run(const Arguments& arguments) {
  std::vector<Scene> scenes;
  for (Scene& scene : Scenes()) {
    if (scene.name.find(arguments.only) != std::string::npos) scenes.push_back(std::move(scene));
  }
  if (scenes.empty()) throw std::runtime_error("--only " + arguments.only + ": no such scene");
  const auto file = std::filesystem::temp_directory_path() /
                    ("same-bits-" + std::to_string(getpid()) + ".recording");
  std::vector<Row> rows;
  for (const Scene& scene : scenes) {
    std::fprintf(stderr, "same-bits: %s\n", scene.name.c_str());
    rows.push_back(RunAlone(scene, file.string()));
  }
  std::filesystem::remove(file);
  std::fprintf(stderr, "same-bits: all at once\n");
  RunTogether(scenes, &rows);
  Print(rows);
  if (!arguments.json.empty()) WriteJson(rows, arguments.json);
  for (const Row& row : rows) {
    if (!row.same()) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace collision::server

int main(int argc, char** argv) {
  CLI::App app("Hashes of the event logs of fixed scenes: the same bits in every build");
  collision::server::Arguments arguments;
  app.add_option("--only", arguments.only, "only scenes whose name contains this");
  app.add_option("--json", arguments.json, "write the table as JSON to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    collision::server::StartLogging({.level = "off"});
    return collision::server::Run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "same-bits: %s\n", error.what());
    return 2;
  }
}
