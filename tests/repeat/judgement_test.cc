// Goal:   flights that differ are found, and so are those that prove nothing; equal ones pass.
// Method: rows by hand, with one thing wrong in each.
#include "tests/repeat/judgement.h"

#include <gtest/gtest.h>

namespace collision::repeat {
namespace {

const std::string kLog = "event log: 3 events, hash 0000000000000001";
const std::string kOther = "event log: 3 events, hash 0000000000000002";
const std::string kEmpty = "event log: 0 events, hash cbf29ce484222325";

Flight Satisfied(const std::string& log) { return {.satisfied = true, .event_log = log}; }

Row RowOf(const std::string& scene, double seconds, const std::vector<std::string>& logs) {
  Row row{{scene, seconds, AllConditions().front()}, {}};
  for (const std::string& log : logs) row.flights.push_back(Satisfied(log));
  return row;
}

TEST(Judgement, EqualEventLogsOfEachSceneAndLengthAreNoFault) {
  EXPECT_TRUE(Faults({RowOf("a", 5, {kLog, kLog}), RowOf("a", 5, {kLog}), RowOf("a", 9, {kOther}),
                      RowOf("b", 5, {kOther})})
                  .empty());
}

TEST(Judgement, ADifferentFlightIsFoundInOneRowAndAcrossRows) {
  const std::vector<std::string> fault = {"a of 5 s: 2 different event logs"};
  EXPECT_EQ(Faults({RowOf("a", 5, {kLog, kLog, kOther}), RowOf("b", 5, {kLog})}), fault);
  EXPECT_EQ(Faults({RowOf("a", 5, {kLog, kLog}), RowOf("a", 5, {kOther, kOther})}), fault);
}

TEST(Judgement, AFailedFlightIsAFault) {
  Row row = RowOf("a", 5, {kLog, kLog});
  row.flights.back().satisfied = false;
  EXPECT_EQ(Faults({row}), std::vector<std::string>{"a of 5 s: 1 flights failed"});
}

TEST(Judgement, FlightsWithoutEventsOrWithoutALogProveNothing) {
  EXPECT_EQ(Faults({RowOf("a", 5, {kEmpty, kEmpty})}),
            std::vector<std::string>{"a of 5 s: no events"});
  EXPECT_EQ(Faults({RowOf("a", 5, {"", ""})}),
            std::vector<std::string>{"a of 5 s: a flight without an event log"});
}

TEST(Judgement, TheTableAndTheFileTellHowManyLogsARowHas) {
  const Row row = RowOf("a", 5, {kLog, kOther});
  EXPECT_NE(TableLine(row).find("3 events, hash 0000000000000001 | 3 events, hash 00000000000000"
                                "02"),
            std::string::npos);
  EXPECT_NE(Json({row}).find("\"event_logs\": 2"), std::string::npos);
}

}  // namespace
}  // namespace collision::repeat
