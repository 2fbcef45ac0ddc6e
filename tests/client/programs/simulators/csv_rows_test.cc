#include "client/programs/simulators/player/csv_rows.h"

#include <gtest/gtest.h>

#include <sstream>

#include "client/programs/shared/exit_code.h"
#include "client/programs/simulators/player/player.h"

namespace collision::client {
namespace {

CsvRows Read(const std::string& text) {
  std::istringstream stream(text);
  return ReadCsv(stream, "file.csv");
}

std::string ErrorOf(const std::string& text) {
  try {
    Read(text);
  } catch (const CsvError& error) {
    return error.what();
  }
  return "no error";
}

// Goal:   columns are found by name, in any order, units converted, agents' rows interleaved.
TEST(CsvRows, ColumnsComeInAnyOrderAndUnit) {
  const CsvRows file = Read(
      "note,y_km,agent_id,x_mm,time_ms,vy_km_s,vx_m_s\r\n"
      "hi,2,b,1500,250,0.003,4\n"
      "ho,1,a,0,0,0,0\n"
      "\n"
      "he,2,b,1500,250.5,0,0\n");
  EXPECT_TRUE(file.velocities);
  ASSERT_EQ(file.rows.size(), 2u);
  const auto& b = file.rows.at("b");
  ASSERT_EQ(b.size(), 2u);
  EXPECT_EQ(b[0].time_ns, 250'000'000);
  EXPECT_EQ(b[1].time_ns, 250'500'000);
  EXPECT_EQ(b[0].position_m, (Vector3{1.5, 2000, 0}));
  EXPECT_EQ(b[0].velocity_m_s, (Vector3{4, 3, 0}));
}

// Goal:   what spreadsheets write is read: a byte-order mark, quotes around names and values.
TEST(CsvRows, ByteOrderMarkAndQuotesAreRead) {
  const CsvRows file = Read(
      "\xef\xbb\xbf\"time_s\",\"agent_id\" , x_m,\"y_m\",\"a \"\"note\"\", long\"\n"
      "\"1\",\"a\"\"b,c\",\"2\", 3 ,\"\"\r\n"
      "2,d,\"4\",5,\n");
  const auto& quoted = file.rows.at("a\"b,c");
  EXPECT_EQ(quoted[0].time_ns, 1'000'000'000);
  EXPECT_EQ(quoted[0].position_m, (Vector3{2, 3, 0}));
  EXPECT_EQ(quoted[0].line, 2u);
  EXPECT_EQ(file.rows.at("d")[0].position_m, (Vector3{4, 5, 0}));
  EXPECT_EQ(file.rows.at("d")[0].line, 3u);
}

TEST(CsvRows, BrokenQuotesAreReported) {
  const std::string header = "time_s,agent_id,x_m,y_m\n";
  const std::string what =
      "file.csv:2: a quote is not closed, or is followed by something else than a comma";
  EXPECT_EQ(ErrorOf(header + "1,\"a,0,0\n"), what);
  EXPECT_EQ(ErrorOf(header + "1,\"a\"b,0,0\n"), what);
  EXPECT_EQ(ErrorOf(header + "1,\"\"\",0,0\n"), what);
  EXPECT_EQ(ErrorOf(header + "1,\"\",0,0\n"), "file.csv:2: agent_id is empty");
}

// Goal:   a value that the client library would refuse is reported with its line before the start.
TEST(CsvRows, ValuesOutOfRangeAreReportedWithTheirLine) {
  const auto error = [](const std::string& rows, const PlayerOptions& options) {
    const CsvRows file = Read("time_s,agent_id,x_m,y_m\n" + rows);
    try {
      RequirePlayable({"a", Trajectory(file.rows.at("a"), file.velocities, 0)}, options, "f.csv");
    } catch (const CsvError& refused) {
      return std::string(refused.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error("0,a,0,0\n1,a,1,1\n", {}), "no error");
  EXPECT_EQ(error("0,a,0,0\n1,a,0,5e14\n", {.acceleration_max_m_s2 = 1}).substr(0, 40),
            "f.csv:2: agent a: velocity_m_s.y: 5e+14,");
  EXPECT_EQ(ErrorOf("time_s,agent_id,x_m,y_m\n0,a,2e15,0\n"),
            "file.csv:2: x_m: 2e15, allowed: -1e+15 to 1e+15 m");
  EXPECT_EQ(ErrorOf("time_s,agent_id,x_m,y_m,vx_m_s,vy_m_s\n0,a,0,0,0,-2e9\n"),
            "file.csv:2: vy_m_s: -2e9, allowed: -1e+09 to 1e+09 m/s");
  EXPECT_EQ(error("0,a,0,0\n0.000000001,a,0.9,0\n0.000000002,a,0,0\n", {}).substr(0, 41),
            "f.csv:2: agent a: acceleration_max_m_s2: ");
}

// Goal:   decimal seconds become the nearest nanosecond, far from zero too.
TEST(CsvRows, TimesAreRoundedToNanoseconds) {
  const auto rows =
      Read("time_s,agent_id,x_m,y_m\n0.1,a,0,0\n1234567890.123456789,a,0,0\n").rows.at("a");
  EXPECT_EQ(rows[0].time_ns, 100'000'000);
  EXPECT_EQ(rows[1].time_ns, 1'234'567'890'123'456'789);
}

// Goal:   the error of a malformed file names file, line and cause.
TEST(CsvRows, MalformedHeadersAreReportedWithTheirLine) {
  EXPECT_EQ(ErrorOf(""), "file.csv:1: the file is empty; its first line names the columns");
  EXPECT_EQ(ErrorOf("agent_id,x_m,y_m\n"),
            "file.csv:1: no column time_s, time_ms or time_ns in the header");
  EXPECT_EQ(ErrorOf("time_s,x_m,y_m\n"), "file.csv:1: no column agent_id in the header");
  EXPECT_EQ(ErrorOf("time_s,agent_id,x,y_m\n"),
            "file.csv:1: no column x_m (or x_km, x_mm) in the header");
  EXPECT_EQ(ErrorOf("time_s,agent_id,x_m,x_km,y_m\n"),
            "file.csv:1: column x_km is the second of its kind");
  EXPECT_EQ(ErrorOf("time_s,agent_id,x_m,y_m,z_m,vx_m_s,vy_m_s\n"),
            "file.csv:1: the header has velocities, but not the same axes as positions: see column "
            "vz_m_s");
  EXPECT_EQ(ErrorOf("time_s,agent_id,x_m,y_m\n"), "file.csv:1: no rows after the header");
}

TEST(CsvRows, BadRowsAreReportedWithTheirLine) {
  const std::string header = "time_s,agent_id,x_m,y_m\n0,a,0,0\n";
  EXPECT_EQ(ErrorOf(header + "1,a,0\n"), "file.csv:3: 3 columns, the header has 4");
  EXPECT_EQ(ErrorOf(header + "1,a,0,0,0\n"), "file.csv:3: 5 columns, the header has 4");
  EXPECT_EQ(ErrorOf(header + "1,a,one,0\n"), "file.csv:3: x_m \"one\" is not a finite number");
  EXPECT_EQ(ErrorOf(header + "1,a,1x,0\n"), "file.csv:3: x_m \"1x\" is not a finite number");
  EXPECT_EQ(ErrorOf(header + "1,a,nan,0\n"), "file.csv:3: x_m \"nan\" is not a finite number");
  EXPECT_EQ(ErrorOf(header + "1,a,inf,0\n"), "file.csv:3: x_m \"inf\" is not a finite number");
  EXPECT_EQ(ErrorOf(header + "1,a,,0\n"), "file.csv:3: x_m \"\" is not a finite number");
  EXPECT_EQ(ErrorOf(header + "1,,0,0\n"), "file.csv:3: agent_id is empty");
  EXPECT_EQ(ErrorOf(header + "1,a b,0,0\n"), "file.csv:3: agent_id has a space in it");
  EXPECT_EQ(ErrorOf(header + "1e300,a,0,0\n"), "file.csv:3: time is beyond a century from 0");
}

// Goal:   a column says where an agent jumps; other values than 0 and 1 are refused.
TEST(CsvRows, JumpsAreMarkedInAColumn) {
  const std::string header = "time_s,agent_id,x_m,y_m,jump\n0,a,0,0,0\n";
  const auto rows = Read(header + "1,a,9,0,1\n").rows.at("a");
  EXPECT_FALSE(rows[0].jump);
  EXPECT_TRUE(rows[1].jump);
  EXPECT_EQ(ErrorOf(header + "1,a,9,0,2\n"), "file.csv:3: jump: \"2\", allowed: 0 or 1");
  EXPECT_EQ(ErrorOf(header + "1,a,9,0,\n"), "file.csv:3: jump: \"\", allowed: 0 or 1");
  EXPECT_EQ(ErrorOf("time_s,agent_id,x_m,y_m,jump,jump\n"),
            "file.csv:1: column jump is the second of its kind");
}

// Goal:   two agents of one name, or of that of a half-space, are refused.
TEST(Player, NamesAreTheirAgentsOwn) {
  const auto refusal = [](const std::string& first, const std::string& second, bool floor) {
    const CsvRows file = Read("time_s,agent_id,x_m,y_m\n0,a,0,0\n1,a,1,1\n");
    const Trajectory curve(file.rows.at("a"), false, 0);
    PlayerOptions options;
    if (floor) options.half_spaces.push_back({{0, 0, 1}, 0});
    try {
      RequireNamesOfTheirOwn({{first, curve}, {second, curve}}, options);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("a", "b", true), "");
  EXPECT_EQ(refusal("a", "half-space-1", false), "");
  EXPECT_EQ(refusal("x", "x", false),
            "--agents: \"x\" names two agents, allowed: another name for each");
  EXPECT_EQ(refusal("a", "half-space-1", true),
            "--agents: \"half-space-1\" names two agents, allowed: another name for each");
}

// Goal:   times since 1970 are noticed, and what to do is said; a wait of a minute is none of them.
TEST(Player, AFirstRowLongAfterTheStartIsTold) {
  const auto text = [](const std::string& times, std::int64_t begin_ns) {
    const CsvRows file = Read("time_s,agent_id,x_m,y_m\n" + times);
    std::vector<PlayedAgent> agents;
    for (const auto& [name, rows] : file.rows) {
      agents.push_back({name, Trajectory(rows, false, -begin_ns)});
    }
    return LateStartText(agents, begin_ns);
  };
  const std::string rows = "1700000000.5,a,0,0\n1700000001,b,0,0\n";
  EXPECT_EQ(text(rows, 0),
            "the first row is at t = 1700000000 s, but the run begins at t = 0 s of the file, and "
            "nothing moves until then; --begin-at 1700000000 begins the run there");
  EXPECT_EQ(text(rows, 1'700'000'000'000'000'000), "");
  EXPECT_EQ(text("60,a,0,0\n", 0), "");
  EXPECT_NE(text("60.1,a,0,0\n", 0), "");
  EXPECT_EQ(text("60.1,a,0,0\n59,b,0,0\n", 0), "");
}

// Goal:   the time of one agent must increase; other agents do not matter.
TEST(CsvRows, TimeOfOneAgentMustIncrease) {
  const std::string header = "time_s,agent_id,x_m,y_m\n5,a,0,0\n1,b,0,0\n";
  EXPECT_EQ(ErrorOf(header + "5,a,1,1\n"),
            "file.csv:4: time 5 of agent a is not later than its row before");
  EXPECT_EQ(ErrorOf(header + "2,b,1,1\n"), "no error");
}

}  // namespace
}  // namespace collision::client
