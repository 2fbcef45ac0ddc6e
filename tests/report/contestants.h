// Who competes in the charts, and how each is drawn: one colour and one mark on all pages.
#pragma once

#include <string>

#include "client/programs/chart/chart.h"

namespace collision::report {

/// The contestant that a series belongs to: "FCL" of "FCL OBBRSS distance" and of "FCL, windows".
/// A series that begins with no known contestant is one by itself.
std::string ContestantOf(const std::string& series);

/// A name without the exponent that a chart of growth puts behind it: " (N^1.10)".
std::string WithoutGrowth(const std::string& series);

/// Gives the series of known contestants their colours and marks, and the dashes of their variants.
/// All others get a look by their names. Series that have a look keep it.
void DrawByContestant(chart::Chart* chart);

}  // namespace collision::report
