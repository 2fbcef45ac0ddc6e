// The numbers that summarise a run.
#pragma once

#include <string>
#include <vector>

#include "client/checker/check.h"

namespace collision::client {

/// What the runner itself measured.
struct Measured {
  double wall_seconds = 0;
  double simulated_seconds = 0;
  double running_seconds = 0;  ///< Wall time that they took; 0: the run did not reach its end.
  double service_cpu_seconds = 0;
  std::vector<double> latencies;  ///< Update -> event [s].
  std::vector<v1::SimulatorTraffic> traffic;
};

/// The value below which a fraction `share` of the values lies; 0 without values.
double Quantile(std::vector<double> values, double share);

v1::Quantiles QuantilesOf(const std::vector<double>& values);

/// Widths of the begin brackets [s], one per confirmed contact.
std::vector<double> BeginWidthsAtConfirmation(const checker::Evidence& evidence);
std::vector<double> BeginWidthsFinal(const checker::Evidence& evidence);
std::vector<double> EndWidthsFinal(const checker::Evidence& evidence);

/// Numbers of the events in which at least one agent has a shape.
struct ShapeFigures {
  // At first confirmation, or when closed as undecided:
  std::vector<double> separation_widths_m;  ///< upper - lower, where both are finite.
  std::vector<double> point_errors_m;       ///< Where finite.
  std::vector<double> normal_errors_rad;
  std::vector<double> work_units;  ///< Of closed events that were not withdrawn.
  /// Numbers of events by decision; the rest is still open, or was withdrawn.
  std::size_t confirmed = 0, undecided = 0, dismissed = 0;

  std::size_t decided() const { return confirmed + undecided + dismissed; }
};
ShapeFigures FiguresOfShapes(const checker::Evidence& evidence);

/// The whole report. begin_width_s is that at confirmation.
v1::RunReport MakeReport(const std::string& scene, const checker::Evidence& evidence,
                         const checker::Violations& violations, const Measured& measured);

/// The summary as a table for people.
std::string SummaryTable(const v1::RunReport& report, const checker::Evidence& evidence);

}  // namespace collision::client
