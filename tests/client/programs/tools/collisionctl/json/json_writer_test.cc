// Goal:   every text, number and instant is written so that any reader gets it back.
// Method: texts are compared; numbers are read back.
#include "client/programs/tools/collisionctl/json/json_writer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace collision::client {
namespace {

TEST(JsonWriter, EscapesWhatATextMustNotHold) {
  EXPECT_EQ(JsonText("a\"b\\c\n\x01 ½"), "\"a\\\"b\\\\c\\u000a\\u0001 ½\"");
  EXPECT_EQ(JsonText(""), "\"\"");
}

TEST(JsonWriter, NumbersReadBackAsTheyWere) {
  for (const double value : {0.1, -0.0, 1e300, 5e-324, 1.0 / 3, 123456789.125}) {
    EXPECT_EQ(std::strtod(JsonNumber(value).c_str(), nullptr), value) << JsonNumber(value);
  }
  EXPECT_EQ(JsonNumber(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(JsonNumber(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(JsonVector({1, 0.5, -2}), "[1,0.5,-2]");
  EXPECT_EQ(JsonArray({}), "[]");
}

TEST(JsonWriter, InstantsAreExactInBothUnits) {
  EXPECT_EQ(JsonObject().Instant("at", 1'795'229'895'022'000'001).Json(),
            "{\"at_ns\":\"1795229895022000001\",\"at_s\":1795229895.022000001}");
  EXPECT_EQ(JsonObject().Instant("at", -1).Json(), "{\"at_ns\":\"-1\",\"at_s\":-0.000000001}");
  for (const std::int64_t none :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    EXPECT_EQ(JsonObject().Instant("at", none).Json(), "{\"at_ns\":null,\"at_s\":null}");
  }
}

TEST(JsonWriter, IdsAreHexadecimal) {
  EXPECT_EQ(JsonObject().Id("id", ~std::uint64_t{0}).Json(), "{\"id\":\"ffffffffffffffff\"}");
  EXPECT_EQ(JsonObject().Count("n", ~std::uint64_t{0}).Json(), "{\"n\":18446744073709551615}");
}

TEST(JsonWriter, DocumentsSayWhatTheyAre) {
  EXPECT_EQ(JsonDocument("gap").TextOrNull("a", "").TextOrNull("b", "x").Flag("c", true).Json(),
            "{\"schema\":\"collision/1\",\"kind\":\"gap\",\"a\":null,\"b\":\"x\",\"c\":true}");
}

}  // namespace
}  // namespace collision::client
