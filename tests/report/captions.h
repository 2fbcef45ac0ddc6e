// What one sees in a chart, in a sentence made of its own numbers.
//
// A sentence is empty where the chart lacks what it speaks of: captions begin with one that holds
// for any numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/programs/chart/chart.h"

namespace collision::report {

/// Errors below these are what rounding leaves open: of a distance [m], of a time of contact [s].
inline constexpr double kDistanceFloor = 1e-13, kContactFloor = 1e-11;

/// A library's right answer, and the time in which ours certifies an error as small.
struct EqualError {
  std::string who;
  double error = 0;
  double theirs_s = 0, ours_s = 0;

  double ratio() const { return theirs_s / ours_s; }
};

/// One for each right answer of a library that ours certifies as narrowly. x is the time of a query
/// [s], y the error; errors below `floor` are rounding, and count as it.
std::vector<EqualError> AtEqualError(const chart::Chart& chart, double floor);

/// "FCL comes within 1e-06 m in 3 µs; ours certifies as much in 1 µs. Wrong at times (crosses):
/// Bullet." `unit` is that of the error.
std::string MostExact(const chart::Chart& chart, double floor, const std::string& unit);

/// "With 100,000 agents ours takes 25 ms and the best other, Bullet, 50 ms: that takes 2 times as
/// long." At the greatest x that ours shares with another contestant; y is a time [s].
std::string TimesAtTheEnd(const chart::Chart& chart, const std::string& of_x);

/// "With 10,000 agents ours manages 20,000 updates a second and the no-op program 100,000: ours
/// reaches 0.2 of it."
std::string RatesAtTheEnd(const chart::Chart& chart, const std::string& of_x,
                          const std::string& of_y);

/// "The slowest frame of each: ours 3 ms; Turk, cell 4 m 1 ms."
std::string Slowest(const chart::Chart& chart);

/// "ours 11 to 0.06 ms; Bullet 12 to 3 ms.": the first point and the last of each series, without
/// the name of an only one.
std::string FirstToLast(const chart::Chart& chart, const std::string& unit);

}  // namespace collision::report
