// Goal:   a field check accepts its whole range, refuses what lies beyond either end, and keeps
//         the first fault.
// Method: values at, just inside and just outside the ends; numbers that are not finite.
#include "server/codec/field_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace collision::server {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

v1::Vector3 Vector(double x, double y, double z) {
  v1::Vector3 v;
  v.set_x(x);
  v.set_y(y);
  v.set_z(z);
  return v;
}

TEST(FieldCheck, NumberIncludesBothEndsAndNothingBeyond) {
  for (const double value : {-1.0, 0.0, 2.0}) {
    FieldCheck check({});
    check.Number("f", value, -1, 2);
    EXPECT_TRUE(check.passed()) << value;
  }
  for (const double value : {std::nextafter(-1.0, -2.0), std::nextafter(2.0, 3.0)}) {
    FieldCheck check({});
    check.Number("f", value, -1, 2);
    ASSERT_FALSE(check.passed()) << value;
    EXPECT_EQ(check.refusal()->reason, v1::REJECTED_OUT_OF_RANGE);
  }
}

TEST(FieldCheck, NumberRefusesWhatIsNotFinite) {
  for (const double value : {kNaN, kInf, -kInf}) {
    FieldCheck check({});
    check.Number("f", value, -kInf, kInf);
    ASSERT_FALSE(check.passed()) << value;
    EXPECT_EQ(check.refusal()->reason, v1::REJECTED_NOT_FINITE);
  }
}

TEST(FieldCheck, IntegerRefusesForTheReasonThatItIsGiven) {
  FieldCheck check({});
  check.Integer("f", 0, 0, 63);
  check.Integer("f", 63, 0, 63);
  EXPECT_TRUE(check.passed());
  check.Integer("f", 64, 0, 63, v1::REJECTED_CHUNK_TOO_LARGE);
  ASSERT_FALSE(check.passed());
  EXPECT_EQ(check.refusal()->reason, v1::REJECTED_CHUNK_TOO_LARGE);
  EXPECT_EQ(check.refusal()->detail, "64; allowed: 0 to 63");
  FieldCheck below({});
  below.Integer("f", -1, 0, 63);
  EXPECT_FALSE(below.passed());
}

TEST(FieldCheck, VectorNamesTheComponent) {
  FieldCheck check({});
  check.Vector("p", Vector(5, -5, 5), 5);
  EXPECT_TRUE(check.passed());
  check.Vector("p", Vector(5, -5.5, 6), 5);
  ASSERT_FALSE(check.passed());
  EXPECT_EQ(check.refusal()->field, "p.y");
  EXPECT_EQ(check.refusal()->detail, "-5.5; allowed: -5 to 5");
  FieldCheck nan({});
  nan.Vector("p", Vector(0, 0, kNaN), 5);
  ASSERT_FALSE(nan.passed());
  EXPECT_EQ(nan.refusal()->field, "p.z");
  EXPECT_EQ(nan.refusal()->reason, v1::REJECTED_NOT_FINITE);
}

TEST(FieldCheck, TextCountsBytes) {
  FieldCheck check({});
  check.Text("name", "ab", 2);
  EXPECT_TRUE(check.passed());
  check.Text("name", "\xc3\xa4\x62", 2);
  ASSERT_FALSE(check.passed());
  EXPECT_EQ(check.refusal()->detail, "3 bytes; allowed: 0 to 2");
}

TEST(FieldCheck, TextsHaveNoControlCharacters) {
  for (const std::string& text :
       {std::string("a\tb"), std::string("a\0b", 3), std::string("a\x7f"), std::string("a\xc2\x80"),
        std::string("a\xc2\x9f"), std::string("a\xe2\x80\xa8"), std::string("a\xe2\x80\xae"),
        std::string("a\xe2\x81\xa6"), std::string("a\xe2\x81\xa9"), std::string("a\xe2\x80\x8e"),
        std::string("a\xd8\x9c")}) {
    FieldCheck check({});
    check.Text("name", text, 64);
    ASSERT_FALSE(check.passed());
    EXPECT_EQ(check.refusal()->detail,
              "a control character, as byte 1; allowed: printable characters");
  }
  FieldCheck check({});
  check.Text("name", "\xc2\xa0\xc3\xa4 \xe2\x82\xac ~ \xe2\x80\x93 \xd8\x9d \xe2", 64);
  EXPECT_TRUE(check.passed());
}

TEST(FieldCheck, TheFirstFaultStaysAndKeepsItsPlace) {
  FieldCheck check({.topic = v1::TOPIC_SHAPE, .simulator_id = 7, .run = 3, .slot = 9});
  check.Integer("first", 2, 0, 1);
  check.Number("second", kNaN, 0, 1);
  check.Refuse(v1::REJECTED_STALE, "third", "late");
  ASSERT_TRUE(check.refusal());
  EXPECT_EQ(check.refusal()->field, "first");
  EXPECT_EQ(check.refusal()->reason, v1::REJECTED_OUT_OF_RANGE);
  EXPECT_EQ(check.refusal()->topic, v1::TOPIC_SHAPE);
  EXPECT_EQ(check.refusal()->simulator_id, 7u);
  EXPECT_EQ(check.refusal()->run, 3u);
  EXPECT_EQ(check.refusal()->slot, 9u);
}

TEST(FieldCheck, ShowsNineDigits) {
  EXPECT_EQ(Show(0.1), "0.1");
  EXPECT_EQ(Show(1.0000000049), "1");
  EXPECT_EQ(Show(123456789), "123456789");
}

}  // namespace
}  // namespace collision::server
