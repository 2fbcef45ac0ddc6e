// The earliest possible intersection in a lattice, in which all agents tie, and in a jittered one.
#include <string>
#include <vector>

#include "collision_core/detection/detector.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/service/parts.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

constexpr double kStep = 1.0 / 60;             // [s]
constexpr int kStepsPerAnswer = 6;             // earliest_period_s of 0.1 s
constexpr std::size_t kQueriesMax = 64;        // as the daemon asks
constexpr double kSpacing = 100, kJitter = 3;  // [m]
constexpr std::uint32_t kRow = 100;

struct Times {
  std::vector<double> steps, answers;  // [s] of the processor
};

/// Agents at rest that tell their states 60 times a second.
Times Rest(std::uint32_t agents, double jitter, int steps) {
  detection::Detector detector({.agents_max = agents});
  Random random(7);
  std::vector<motion::MotionState> states(agents);
  const auto id = [](std::uint32_t slot) { return detection::AgentId{1, slot, 1, 1}; };
  for (std::uint32_t slot = 0; slot < agents; ++slot) {
    const Eigen::Vector3d offset{random.Uniform(-1, 1), random.Uniform(-1, 1), 0};
    states[slot].p_WA = kSpacing * Eigen::Vector3d(slot % kRow, slot / kRow, 0) + jitter * offset;
    detector.Admit(id(slot), {.limits = {1, 1e-1}}, states[slot], Instant());
  }
  Times times;
  for (int step = 1; step <= steps; ++step) {
    const Instant now = Instant::FromNanoseconds(static_cast<std::int64_t>(1e9 * kStep * step));
    const CpuStopwatch watch;
    for (std::uint32_t slot = 0; slot < agents; ++slot) {
      states[slot].stamp = now;
      detector.Update(id(slot), states[slot], now);
    }
    detector.SetHeardUntil({1, 1}, now);
    detector.Advance(now);
    if (step % kStepsPerAnswer == 0) {
      const CpuStopwatch answer;
      detector.Earliest(kQueriesMax);
      times.answers.push_back(answer.seconds());
    }
    times.steps.push_back(watch.seconds());
  }
  return times;
}

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

void AtRestPart(const ServiceSettings& settings, ServiceReport* report) {
  for (const std::uint32_t agents : {1000u, 10000u}) {
    const std::string name = "at-rest/" + std::to_string(agents);
    if (!settings.Wants(name)) continue;
    const int steps = settings.quick ? 120 : 1200;
    double mean[2] = {};
    for (const bool lattice : {false, true}) {
      const Times times = Rest(agents, lattice ? 0 : kJitter, steps);
      mean[lattice] = Mean(times.steps);
      const std::string contestant = lattice ? "lattice" : "jittered";
      report->Add(
          {Padded(name + "/" + contestant, 26) + Padded("step " + SecondsText(mean[lattice]), 18) +
               Padded("answer " + SecondsText(Mean(times.answers)), 20) + "worst " +
               SecondsText(Quantile(times.answers, 1)),
           {Text("part", "at-rest"), Text("contestant", contestant), Number("agents", agents),
            Number("step_mean_s", mean[lattice]), Number("answer_mean_s", Mean(times.answers)),
            Number("answer_max_s", Quantile(times.answers, 1))}});
    }
    report->Figure("lattice_step_ratio_" + std::to_string(agents), mean[true] / mean[false]);
  }
}

}  // namespace collision::bench
