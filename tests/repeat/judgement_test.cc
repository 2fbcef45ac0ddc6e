// Goal:   flights that differ are found, and so are those that prove nothing; equal ones pass.
// Method: rows by hand, with one thing wrong in each.
#include "tests/repeat/judgement.h"

#include <gtest/gtest.h>

namespace collision::repeat {
namespace {

const std::string kLog = "event log: 3 events, hash 0000000000000001";
const std::string kOther = "event log: 3 events, hash 0000000000000002";
const std::string kEmpty = "event log: 0 events, hash cbf29ce484222325";

Flight Ended(const std::string& log) {
  Flight flight;
  flight.ended = flight.satisfied = true;
  flight.event_log = log;
  return flight;
}

Row RowOf(const std::string& scene, const std::vector<std::string>& logs) {
  Row row{{scene, 5, 0, AllConditions().front()}, {}};
  for (const std::string& log : logs) row.flights.push_back(Ended(log));
  return row;
}

TEST(Judgement, EqualEventLogsOfEachSceneAreNoFault) {
  EXPECT_TRUE(Faults({RowOf("a", {kLog, kLog}), RowOf("a", {kLog}), RowOf("b", {kOther})}).empty());
}

TEST(Judgement, ADifferentFlightIsFoundInOneRowAndAcrossRows) {
  const std::vector<std::string> fault = {"a: 2 different event logs"};
  EXPECT_EQ(Faults({RowOf("a", {kLog, kLog, kOther}), RowOf("b", {kLog})}), fault);
  EXPECT_EQ(Faults({RowOf("a", {kLog, kLog}), RowOf("a", {kOther, kOther})}), fault);
}

TEST(Judgement, AFlightThatBreaksOffIsAFault) {
  Row row = RowOf("a", {kLog, kLog});
  row.flights.back().ended = row.flights.back().satisfied = false;
  EXPECT_EQ(Faults({row}), std::vector<std::string>{"a: 1 flights did not run to their end"});
}

TEST(Judgement, TheCheckersVerdictIsToldButIsNoFault) {
  Row row = RowOf("a", {kLog, kLog});
  row.flights.back().satisfied = false;
  EXPECT_TRUE(Faults({row}).empty());
  EXPECT_NE(Json({row}).find("\"satisfied\": 1,"), std::string::npos);
}

TEST(Judgement, FlightsWithoutEventsOrWithoutALogProveNothing) {
  EXPECT_EQ(Faults({RowOf("a", {kEmpty, kEmpty})}), std::vector<std::string>{"a: no events"});
  EXPECT_EQ(Faults({RowOf("a", {"", ""})}),
            std::vector<std::string>{"a: a flight without an event log"});
}

TEST(Judgement, StarvedFlightsInWhichNothingWasStoppedProveNothing) {
  Row row = RowOf("a", {kLog, kLog});
  row.series.condition = {.name = "starved", .text = {}, .starves_service = true};
  EXPECT_EQ(Faults({row}), std::vector<std::string>{"a/starved: nothing was stopped"});
  row.flights.back().stops = 1;
  EXPECT_TRUE(Faults({row}).empty());
}

TEST(Judgement, TheTableAndTheFileTellHowManyLogsARowHas) {
  const Row row = RowOf("a", {kLog, kOther});
  EXPECT_NE(TableLine(row).find("3 events, hash 0000000000000001 | 3 events, hash 00000000000000"
                                "02"),
            std::string::npos);
  EXPECT_NE(Json({row}).find("\"event_logs\": 2"), std::string::npos);
}

}  // namespace
}  // namespace collision::repeat
