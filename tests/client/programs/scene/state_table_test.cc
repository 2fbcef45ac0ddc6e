// Goal:   what the page unpacks is what was told.
// Method: the packed bytes are read by the layout that the header documents.
#include "client/programs/scene/state_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/support/random.h"

namespace collision::client {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

template <class Value>
Value At(const std::string& bytes, std::size_t at) {
  Value value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

v1::AgentStates StatesOf(std::uint64_t simulator, std::uint32_t run = 1) {
  v1::AgentStates states;
  states.set_simulator_id(simulator);
  states.set_run(run);
  return states;
}

v1::AgentState* Add(v1::AgentStates* states, std::uint32_t slot, double x_m,
                    std::int64_t stamp_ns) {
  v1::AgentState* state = states->add_states();
  state->set_slot(slot);
  state->set_stamp_ns(stamp_ns);
  state->mutable_position_m()->set_x(x_m);
  state->mutable_orientation()->set_w(1);
  return state;
}

TEST(StateTable, PacksWhatWasTold) {
  StateTable table;
  v1::AgentStates states = StatesOf(7);
  v1::AgentState* state = Add(&states, 3, 6.9e6, 100 * kSecondNs);
  state->mutable_velocity_m_s()->set_y(7500.25);
  state->mutable_acceleration_m_s2()->set_z(-8.2);
  state->mutable_angular_velocity_rad_s()->set_x(0.5);
  state->mutable_orientation()->set_w(0.6);
  state->mutable_orientation()->set_z(-0.8);
  state->set_position_error_m(12);
  state->set_velocity_error_m_s(0.25);
  Add(&states, 4, -6.9e6, 99 * kSecondNs);
  table.Take(states);
  v1::Clearance clearance;
  clearance.set_simulator_id(7);
  clearance.add_agents()->set_slot(3);
  clearance.mutable_agents(0)->set_clear_until_ns(102 * kSecondNs);
  clearance.mutable_agents(0)->set_not_clear(true);
  table.Take(clearance);

  const auto chunks = table.TakeChanged();
  ASSERT_EQ(chunks.size(), 1u);
  const std::string bytes = table.Pack(chunks[0]);
  ASSERT_EQ(bytes.size(), 8u + 2 * 96u);
  EXPECT_EQ(At<std::uint32_t>(bytes, 0), 0u);
  EXPECT_EQ(At<std::uint32_t>(bytes, 4), 2u);
  EXPECT_EQ(At<std::uint32_t>(bytes, 8), 1u | 2u);
  EXPECT_EQ(At<float>(bytes, 8 + 4), 2) << "clear for two seconds";
  EXPECT_EQ(At<double>(bytes, 8 + 8), 100);
  EXPECT_EQ(At<double>(bytes, 8 + 16), 6.9e6);
  EXPECT_EQ(At<float>(bytes, 8 + 44), 7500.25f);
  EXPECT_EQ(At<float>(bytes, 8 + 60), -8.2f);
  EXPECT_EQ(At<float>(bytes, 8 + 64), 0.5f);
  EXPECT_EQ(At<float>(bytes, 8 + 76), 12);
  EXPECT_EQ(At<float>(bytes, 8 + 80), 0.25f);
  EXPECT_NEAR(At<std::int16_t>(bytes, 8 + 84) / 32000.0, 0.6, 4e-5);
  EXPECT_NEAR(At<std::int16_t>(bytes, 8 + 90) / 32000.0, -0.8, 4e-5);
  EXPECT_EQ(At<double>(bytes, 104 + 8), 99);
  EXPECT_EQ(At<double>(bytes, 104 + 16), -6.9e6);
  EXPECT_EQ(At<float>(bytes, 104 + 4), -std::numeric_limits<float>::infinity());
}

// Goal:   what the service would refuse is not shown, and hides nobody else.
TEST(StateTable, StatesThatCannotBeAreLeftOut) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  StateTable table;
  v1::AgentStates states = StatesOf(7);
  Add(&states, 0, 1, 1);
  Add(&states, 1, kNaN, 1);
  Add(&states, 2, 1e300, 1);
  Add(&states, 3, 1, std::numeric_limits<std::int64_t>::min());
  Add(&states, 4, 1, 1)->mutable_velocity_m_s()->set_y(kNaN);
  Add(&states, 0xffffffff, 1, 1);
  table.Take(states);
  const auto chunks = table.TakeChanged();
  ASSERT_EQ(chunks.size(), 1u);
  const std::string bytes = table.Pack(chunks[0]);
  EXPECT_EQ(At<std::uint32_t>(bytes, 4), 1u);
  EXPECT_EQ(At<double>(bytes, 8 + 16), 1);
}

TEST(StateTable, TellsOnlyChunksThatChanged) {
  StateTable table;
  v1::AgentStates states = StatesOf(7);
  for (std::uint32_t slot = 0; slot < 3 * StateTable::kStatesOfAChunk; ++slot) {
    Add(&states, slot, slot, 0);
  }
  table.Take(states);
  EXPECT_EQ(table.TakeChanged().size(), 3u);
  EXPECT_TRUE(table.TakeChanged().empty());
  v1::AgentStates one = StatesOf(7);
  Add(&one, StateTable::kStatesOfAChunk + 5, 1, 1);
  table.Take(one);
  const auto chunks = table.TakeChanged();
  ASSERT_EQ(chunks.size(), 1u);
  EXPECT_EQ(chunks[0], 1u);
  EXPECT_EQ(At<std::uint32_t>(table.Pack(1), 0), StateTable::kStatesOfAChunk);
}

TEST(StateTable, AnAgentThatLeftHasNoStateAndKeepsItsNumber) {
  StateTable table;
  v1::AgentStates states = StatesOf(7, 2);
  Add(&states, 0, 1, 1);
  table.Take(states);
  EXPECT_EQ(table.NumberOf(7, 0), 0u);
  EXPECT_EQ(table.NumberOf(8, 0), 1u);
  EXPECT_EQ(table.NumberOf(7, 0), 0u);
  v1::AgentStates old = StatesOf(7, 1);
  Add(&old, 0, 99, 99);
  table.Take(old);
  EXPECT_EQ(At<double>(table.Pack(table.TakeChanged().at(0)), 8 + 16), 1) << "of an earlier run";
  table.Clear(7, 0);
  EXPECT_EQ(At<std::uint32_t>(table.Pack(table.TakeChanged().at(0)), 8), 0u);
}

/// Rows of PackAfter(), one behind the other.
std::vector<std::string> RowsOf(const std::string& planes) {
  constexpr std::size_t kRow = StateTable::kHeaderBytes + StateTable::kStateBytes;
  EXPECT_EQ(planes.size() % kRow, 0u);
  const std::size_t count = planes.size() / kRow;
  std::vector<std::string> rows(count);
  for (std::size_t at = 0; at < planes.size(); ++at) rows[at % count] += planes[at];
  return rows;
}

// Goal:   after a change come the agents that have changed since, as chunks have them, and no more.
TEST(StateTable, PacksEachAgentThatHasChangedSince) {
  StateTable table;
  EXPECT_EQ(table.PackAfter(0), "");
  v1::AgentStates states = StatesOf(7);
  for (std::uint32_t slot = 0; slot < 5; ++slot) Add(&states, slot, 10.5 * slot, kSecondNs);
  table.Take(states);
  const auto all = RowsOf(table.PackAfter(0));
  ASSERT_EQ(all.size(), 5u);
  const std::string chunk = table.Pack(0);
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(At<std::uint32_t>(all[i], 0), i);
    EXPECT_EQ(all[i].substr(8), chunk.substr(8 + 96 * i, 96)) << i;
  }
  const std::uint64_t seen = table.newest_change();
  EXPECT_EQ(table.PackAfter(seen), "");
  v1::AgentStates two = StatesOf(7);
  Add(&two, 3, 1, 2 * kSecondNs);
  Add(&two, 1, 2, 2 * kSecondNs);
  table.Take(two);
  table.Clear(7, 4);
  const auto some = RowsOf(table.PackAfter(seen));
  ASSERT_EQ(some.size(), 3u);
  EXPECT_EQ(At<std::uint32_t>(some[0], 0), 1u);
  EXPECT_EQ(At<double>(some[0], 8 + 16), 2);
  EXPECT_EQ(At<std::uint32_t>(some[1], 0), 3u);
  EXPECT_EQ(At<std::uint32_t>(some[2], 0), 4u);
  EXPECT_EQ(At<std::uint32_t>(some[2], 8), 0u) << "it has left";
}

// Goal:   numbers are within half a step, and multiples of it; the time is not rounded, and rates
//         are not rounded as coarsely as the places of large agents are.
TEST(StateTable, RoundsToAStep) {
  Random random(2009);
  for (const double step : {0.0, 0x1p-10, 0.5, 4.0}) {
    StateTable table;
    v1::AgentStates states = StatesOf(7);
    for (std::uint32_t slot = 0; slot < 100; ++slot) {
      v1::AgentState* state = Add(&states, slot, random.Uniform(-1e6, 1e6), 1234567891);
      state->mutable_velocity_m_s()->set_y(random.Uniform(-100, 100));
      state->set_position_error_m(random.Uniform(0, 10));
    }
    table.Take(states);
    const auto rows = RowsOf(table.PackAfter(0, step));
    ASSERT_EQ(rows.size(), 100u);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const v1::AgentState& told = states.states(static_cast<int>(i));
      EXPECT_EQ(At<double>(rows[i], 8 + 8), 1.234567891);
      const double x = At<double>(rows[i], 8 + 16), v = At<float>(rows[i], 8 + 44);
      const double error = At<float>(rows[i], 8 + 76);
      EXPECT_LE(std::abs(x - told.position_m().x()), step / 2);
      const double rate_step = std::min(step, 0x1p-10);
      EXPECT_LE(std::abs(v - told.velocity_m_s().y()), rate_step / 2 + 1e-5);
      EXPECT_LE(std::abs(error - told.position_error_m()), step / 2 + 1e-6);
      if (step == 0) continue;
      EXPECT_EQ(std::remainder(x, step), 0) << x;
      EXPECT_EQ(std::remainder(v, rate_step), 0) << v;
    }
  }
}

}  // namespace
}  // namespace collision::client
