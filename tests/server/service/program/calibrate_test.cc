#include "server/service/program/calibrate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "server/config/config.h"

namespace collision::server {
namespace {

// Goal:   what is measured is a number that the configuration takes, on any machine and in any
//         build.
TEST(Calibrate, MeasuresARateThatCanBeConfigured) {
  v1::Config config = CompleteConfig({});
  const double rate = MeasureWorkUnitsPerUs();
  EXPECT_GT(rate, 0);
  config.set_work_units_per_us(std::max(rate, 1.0));
  EXPECT_TRUE(CheckConfig(config).empty()) << rate;
}

// Goal:   the budget in time becomes the nearest whole number of units, exactly at the defaults and
//         at the ends of both ranges.
TEST(Calibrate, ABudgetBecomesWorkUnits) {
  v1::Config config = CompleteConfig({});
  EXPECT_EQ(WorkUnitsPerEvaluation(config), 40'000u);
  config.set_time_budget_us(0);
  EXPECT_EQ(WorkUnitsPerEvaluation(config), 0u);
  config.set_time_budget_us(0.08);
  EXPECT_EQ(WorkUnitsPerEvaluation(config), 2u);
  config.set_time_budget_us(1e6);
  config.set_work_units_per_us(1e6);
  EXPECT_EQ(WorkUnitsPerEvaluation(config), 1'000'000'000'000u);
  config.set_step_budget_us(0);
  EXPECT_EQ(WorkUnitsPerStep(config), 0u) << "no limit";
  config.set_step_budget_us(1e6);
  EXPECT_EQ(WorkUnitsPerStep(config), 1'000'000'000'000u);
  config.set_work_units_per_us(1);
  config.set_step_budget_us(1e-9);
  EXPECT_EQ(WorkUnitsPerStep(config), 1u) << "a limit, however small";
}

}  // namespace
}  // namespace collision::server
