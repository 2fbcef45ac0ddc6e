#include "tests/report/sample_results.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/report/rows.h"

namespace collision::report {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;
using Numbers = std::vector<std::pair<std::string, double>>;

void AddRow(v1::Experiment* experiment, const Texts& texts, const Numbers& numbers) {
  Row* row = experiment->add_measurements();
  for (const auto& [name, text] : texts) (*row->mutable_fields())[name].set_string_value(text);
  for (const auto& [name, value] : numbers) (*row->mutable_fields())[name].set_number_value(value);
}

v1::Experiment* Add(v1::Results* results, const std::string& name, const Numbers& figures) {
  v1::Experiment* experiment = results->add_experiments();
  experiment->set_name(name);
  experiment->set_title("Title of " + name);
  for (const auto& [figure, value] : figures) {
    v1::Figure* added = experiment->add_figures();
    added->set_name(figure);
    added->set_value(value);
  }
  return experiment;
}

/// Each method at two settings: ours certifies widths, the others have errors.
void AddMethods(v1::Experiment* experiment, const std::string& part, const std::string& mesh,
                const std::vector<std::string>& ours, const std::vector<std::string>& peers) {
  double factor = 1;
  for (const auto* methods : {&ours, &peers}) {
    for (const std::string& method : *methods) {
      factor += 0.1;
      const bool is_ours = methods == &ours;
      for (const double width : {1e-3, 1e-6}) {
        AddRow(experiment,
               {{"part", part},
                {"motion", "translation"},
                {"mesh", mesh},
                {"method", method},
                {"who", is_ours ? "ours" : "peer"}},
               {{"seconds", factor * 1e-9 / width}, {is_ours ? "width" : "error", width}});
      }
    }
  }
}

void AddPrecision(v1::Results* results) {
  v1::Experiment* precision = Add(results, "precision",
                                  {{"ours_misses", 0},
                                   {"ours_false_alarms", 0},
                                   {"ours_brackets_without_the_truth", 0},
                                   {"contact_ours_misses", 0},
                                   {"contact_ours_false_alarms", 0},
                                   {"contact_ours_brackets_without_the_truth", 0},
                                   {"peers_misses_at_best", 5},
                                   {"peers_false_alarms_at_best", 6},
                                   {"contact_peers_misses_at_best", 7},
                                   {"contact_peers_false_alarms_at_best", 8},
                                   {"contact_peer_over_ours_at_equal_error", 1.1}});
  AddMethods(
      precision, "precision", "homer 500",
      {"fitted tree, by budget", "fitted tree, by width", "octree, by budget", "octree, by width",
       "refinement, level by level", "refinement, largest first", "exact triangles", "yes or no"},
      {"FCL RSS distance", "FCL OBBRSS distance", "FCL OBB", "FCL OBBRSS", "Bullet GImpact",
       "ODE OPCODE", "CGAL", "BSP trees"});
  AddMethods(precision, "precision", "box and hull",
             {"convex routine, by width", "full search, by budget", "yes or no at a glance"},
             {"FCL libccd distance", "FCL libccd yes or no", "FCL own solver distance",
              "FCL own solver yes or no", "Bullet GJK"});
  AddMethods(precision, "contact", "boxes", {"ours", "ours, as solids"},
             {"stepping", "FCL naive", "FCL polynomial", "FCL ray shooting",
              "FCL advancement, libccd", "FCL advancement, own", "FCL advancement, meshes",
              "Bullet continuous", "Bullet GJK cast", "Bullet sub-simplex cast"});
}

void AddBudget(v1::Results* results) {
  v1::Experiment* budget = Add(results, "budget", {{"unannounced_misses", 0}, {"runs_failed", 0}});
  for (const char* kind : {"a pair's turn", "a step of all pairs"}) {
    for (const double us : {50.0, 2000.0, 10'000.0}) {
      AddRow(budget, {{"kind", kind}},
             {{"budget_us", us},
              {"begin_width_p50_s", 0.1 / us},
              {"separation_width_p50_m", 1 / us},
              {"undecided_share", 1 / us}});
    }
  }
}

void AddPaper(v1::Results* results) {
  v1::Experiment* turk = Add(results, "turk", {{"turk_total_worst", 1.2}});
  for (const char* scene : {"cubes 0.01 %", "cubes 0.1 %", "cubes 1 %", "cubes 10 %"}) {
    for (const double cubes : {10.0, 100.0}) {
      for (const char* who : {"window loop, chosen", "local loop, chosen", "Turk, cell 2"}) {
        AddRow(turk, {{"scene", scene}, {"contestant", who}},
               {{"agents", cubes}, {"seconds", cubes * 1e-6}});
      }
    }
  }
  v1::Experiment* hubbard =
      Add(results, "hubbard", {{"frames_that_differ", 0}, {"service_missed", 0}});
  for (const char* method : {"horns and sphere trees", "horns and BSP trees",
                             "Turk, cell 4 m and sphere trees", "Turk, cell 4 m and BSP trees"}) {
    AddRow(hubbard, {{"part", "both"}, {"scene", "20 drones"}, {"method", method}}, {});
    auto* row = hubbard->mutable_measurements(hubbard->measurements_size() - 1);
    auto* frames = (*row->mutable_fields())["frame_series_s"].mutable_list_value();
    for (const double seconds : {1e-6, 3e-6, 2e-6}) {
      frames->add_values()->set_number_value(seconds);
    }
  }
}

void AddStepping(v1::Results* results) {
  v1::Experiment* stepping = Add(
      results, "stepping", {{"ours_misses", 0}, {"stepping_60hz_misses", 3}, {"runs_failed", 0}});
  for (const char* method : {"ours", "60 Hz"}) {
    for (const double contact : {0.001, 0.1}) {
      AddRow(stepping, {{"part", "shrunk"}, {"method", method}},
             {{"contact_s", contact}, {"found", 1}});
    }
  }
}

void AddBroadPhase(v1::Results* results) {
  v1::Experiment* scratch =
      Add(results, "broad-phase",
          {{"scratch_100k_at_once", 2}, {"scratch_100k_half", 2}, {"scratch_100k_never", 2}});
  v1::Experiment* streaming = Add(results, "streaming", {{"incremental_100k", 20}});
  v1::Experiment* special = Add(results, "special-scenes", {{"worst_scene_ratio", 0.5}});
  const std::vector<std::pair<std::string, double>> contestants = {{"all-pairs", 9},
                                                                   {"face-sweep", 2},
                                                                   {"spatial-index", 1.1},
                                                                   {"chosen", 1},
                                                                   {"Embree", 3},
                                                                   {"Embree, windows", 2},
                                                                   {"FCL", 6},
                                                                   {"FCL, windows", 5},
                                                                   {"Bullet", 8},
                                                                   {"Bullet, windows", 7},
                                                                   {"CGAL", 10},
                                                                   {"CGAL, windows", 9}};
  for (const double agents : {1000.0, 100'000.0}) {
    for (const auto& [who, times] : contestants) {
      for (const char* scene : {"uniform at_once", "uniform half", "uniform never"}) {
        AddRow(scratch, {{"part", "scratch"}, {"scene", scene}, {"contestant", who}},
               {{"agents", agents}, {"seconds", times * agents * 1e-7}});
      }
    }
    for (const auto& [who, times] :
         Numbers{{"all-pairs", 9}, {"chosen", 1}, {"Bullet", 20}, {"Bullet, asked lazily", 0.5}}) {
      AddRow(streaming, {{"part", "incremental"}, {"scene", "drones"}, {"contestant", who}},
             {{"agents", agents}, {"seconds", times * 1e-6}});
    }
  }
  for (const auto& [scene, times] : Numbers{{"clusters", 0.5}, {"grid", 3}}) {
    AddRow(special, {{"part", "scenes"}, {"scene", scene}, {"contestant", "chosen"}},
           {{"agents", 10'000}, {"seconds", 1}});
    AddRow(special, {{"part", "scenes"}, {"scene", scene}, {"contestant", "Embree, windows"}},
           {{"agents", 10'000}, {"seconds", times}});
  }
}

void AddNarrowPhase(v1::Results* results) {
  v1::Experiment* narrow = Add(results, "narrow-phase",
                               {{"decision_worst", 3},
                                {"decision_gap_0_1pct_worst", 1.5},
                                {"decision_gap_50pct_worst", 4},
                                {"distance_worst", 9},
                                {"convex_decision_cold_worst", 0.8},
                                {"convex_decision_gap_0_1pct_cold_worst", 0.6},
                                {"convex_decision_gap_50pct_cold_worst", 0.7},
                                {"build_vs_fcl_bvh_worst", 0.05}});
  for (const auto& [part, peer, times] : {std::tuple{"decision", "FCL OBB", 1.5},
                                          {"distance", "FCL RSS", 9.0},
                                          {"convex decision", "FCL libccd", 0.6},
                                          {"build", "FCL OBBRSS", 0.05}}) {
    AddRow(narrow, {{"part", part}, {"mesh", "spot"}, {"contestant", "ours"}},
           {{"warm_s", 1e-6}, {"cold_s", 1e-6}});
    AddRow(narrow, {{"part", part}, {"mesh", "spot"}, {"contestant", peer}},
           {{"warm_s", times * 1e-6}, {"cold_s", times * 1e-6}});
    AddRow(narrow,
           {{"part", part},
            {"mesh", "spot"},
            {"contestant", "Bullet GImpact"},
            {"remark", "ANSWERS DIFFER: 90 of 100; does not count"}},
           {{"warm_s", 1e-9}, {"cold_s", 1e-9}});
  }
}

void AddService(v1::Results* results) {
  v1::Experiment* service = Add(results, "service",
                                {{"service_updates_ratio_10000", 0.35},
                                 {"service_updates_per_s_10000", 35'000},
                                 {"network_updates_per_s_10000", 100'000},
                                 {"service_event_p50_ratio_10000", 1.5},
                                 {"service_event_p50_s_10000", 1.5e-4},
                                 {"network_event_p50_s_10000", 1e-4}});
  for (const double agents : {100.0, 10'000.0}) {
    for (const auto& [who, times] : Numbers{{"network", 1}, {"ours", 1.5}}) {
      AddRow(service, {{"part", "latency"}, {"contestant", who}},
             {{"agents", agents},
              {"event_p50_s", times * 1e-4},
              {"event_p99_s", times * 1e-3},
              {"updates_per_s", 1e5 / times}});
    }
  }
  for (const auto& [sweep, field] : {std::pair{"acceleration=1", "acceleration_max_m_s2"},
                                     {"acceleration=9", "acceleration_max_m_s2"},
                                     {"spacing=10", "spacing_m"},
                                     {"speed=5", "speed_m_s"}}) {
    AddRow(service, {{"part", "messages"}, {"sweep", sweep}}, {{field, 1}, {"ratio", 20}});
  }
}

void AddFaults(v1::Results* results) {
  v1::Experiment* faults = Add(results, "faults", {});
  AddRow(faults, {{"group", "network"}, {"name", "loss"}, {"kept", "yes"}},
         {{"runs", 60}, {"contacts", 1200}, {"late", 0}, {"unheard", 0}});
  v1::Experiment* network = Add(results, "network", {});
  for (const char* fault : {"killed", "stopped", "unplugged"}) {
    AddRow(network, {{"group", "take-over"}, {"name", fault}, {"kept", "yes"}},
           {{"take_overs", 2}, {"within_lease_and_50_ms", 2}, {"promised_ms", 150}});
    auto* row = network->mutable_measurements(network->measurements_size() - 1);
    auto* times = (*row->mutable_fields())["take_over_ms"].mutable_list_value();
    for (const double ms : {90.0, 120.0}) times->add_values()->set_number_value(ms);
  }
  AddRow(network, {{"group", "lock-step"}, {"name", "loss"}, {"kept", "yes"}}, {});
  v1::Experiment* gateway = Add(results, "gateway", {{"page_bytes", 4e6}});
  AddRow(gateway, {{"part", "cost"}},
         {{"agents", 10000}, {"viewers", 100}, {"cores", 0.4}, {"updates_a_second_least", 9.5}});
  v1::Experiment* soak = Add(results, "soak", {});
  for (const char* bad : {"keys", "pairs"}) {
    AddRow(soak, {{"group", "beside"}, {"name", bad}, {"kept", "yes"}}, {});
  }
}

}  // namespace

v1::Results SampleResults() {
  v1::Results results;
  AddPrecision(&results);
  AddBudget(&results);
  AddPaper(&results);
  AddStepping(&results);
  AddBroadPhase(&results);
  AddNarrowPhase(&results);
  AddService(&results);
  AddFaults(&results);
  Add(&results, "left-out",
      {{"chosen_over_best_units_worst", 1},
       {"left_out_missed_count", 0},
       {"answers_differ_count", 0}});
  for (const char* name : {"stress", "mutants"}) Add(&results, name, {});
  return results;
}

v1::Experiment* SampleExperiment(v1::Results* results, const std::string& name) {
  for (v1::Experiment& experiment : *results->mutable_experiments()) {
    if (experiment.name() == name) return &experiment;
  }
  throw std::logic_error(name);
}

void SetFigure(v1::Results* results, const std::string& experiment, const std::string& figure,
               double value) {
  v1::Experiment* of_name = SampleExperiment(results, experiment);
  for (v1::Figure& known : *of_name->mutable_figures()) {
    if (known.name() == figure) return known.set_value(value);
  }
  v1::Figure* added = of_name->add_figures();
  added->set_name(figure);
  added->set_value(value);
}

}  // namespace collision::report
