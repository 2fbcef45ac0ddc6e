// Results of a made-up run in which every experiment took part, with the names that the benchmarks
// give to their contestants.
#pragma once

#include "idl/report.pb.h"

namespace collision::report {

v1::Results SampleResults();

/// The experiment of that name. Throws std::logic_error if there is none.
v1::Experiment* SampleExperiment(v1::Results* results, const std::string& name);

/// Replaces the value of a figure, or adds it.
void SetFigure(v1::Results* results, const std::string& experiment, const std::string& figure,
               double value);

}  // namespace collision::report
