// Goal:   a breach reads as one sentence whose number is not above what was seen, and above what
//         was declared.
// Method: whole sentences are compared; random numbers, read back from the sentence.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>

#include "collision/event_text.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

std::string NameOf(const AgentId&) { return "crane-3"; }

Breach ABreach() {
  return {.agent = {},
          .field = "acceleration_max_m_s2",
          .declared = 2,
          .seen = 3.4499,
          .from_ns = 1'200'000'000,
          .at_ns = 1'299'999'999,
          .count = 4};
}

TEST(BreachText, NamesFieldDeclaredSeenAndHowOften) {
  EXPECT_EQ(BreachText(ABreach(), NameOf, 0),
            "crane-3 broke acceleration_max_m_s2: declared 2, at least 3.44 seen between 1.200 s "
            "and 1.300 s (4 times)");
  Breach once = ABreach();
  once.count = 1;
  once.seen = std::numeric_limits<double>::infinity();
  EXPECT_EQ(BreachText(once, NameOf, 1'000'000'000),
            "crane-3 broke acceleration_max_m_s2: declared 2, no value explains what was seen "
            "between 0.200 s and 0.300 s (once)");
  Breach against = ABreach();
  against.field = "thrust_direction";
  against.declared = 0;
  EXPECT_NE(BreachText(against, NameOf, 0).find("at least 3.44 m/s² against it seen"),
            std::string::npos);
}

TEST(BreachText, ShowsAsManyDigitsAsTellSeenFromDeclared) {
  Random random(2106);
  for (int i = 0; i < 5000; ++i) {
    Breach breach = ABreach();
    breach.declared = std::strtod(std::to_string(random.LogUniform(1e-2, 1e6)).c_str(), nullptr);
    breach.seen = breach.declared * (1 + random.LogUniform(1e-15, 1e6));
    const std::string text = BreachText(breach, NameOf, 0);
    const std::string mark = "at least ";
    const double shown = std::strtod(text.c_str() + text.find(mark) + mark.size(), nullptr);
    ASSERT_LE(shown, breach.seen) << text;
    ASSERT_GE(shown, breach.declared) << text;
    ASSERT_EQ(shown > breach.declared, breach.seen > breach.declared) << text;
    ASSERT_GE(shown, 0.99 * breach.seen) << text;
  }
}

}  // namespace
}  // namespace collision::client
