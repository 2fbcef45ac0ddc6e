// Goal:   a message survives the way to its C type and back bit for bit, up to the bounds of the
//         IDL; beyond a bound it is refused, naming field and bound.
// Method: every field of every message filled at random (fixed seeds), NaN, infinities and
//         denormals among them; lengths short, at the bound, and one over the bound for each
//         bounded field in turn.
#include "idl/dds/conversion.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/idl/idl_file.h"
#include "tests/idl/random_message.h"

namespace collision {
namespace {

using google::protobuf::Message;

template <class T>
std::string ThereAndBack(const T& message) {
  T back;
  dds::FromWire(*dds::ToWire(message), &back);
  return back.SerializeAsString();
}

template <class T>
class Conversion : public testing::Test {};

using Carried =
    testing::Types<v1::AgentDescription, v1::ShapePart, v1::AgentStates, v1::SimulatorClock,
                   v1::Clearance, v1::EarliestIntersection, v1::CollisionEvent, v1::Rejection,
                   v1::ServiceStatus, v1::SimulatorReport, v1::OperatorCommand, v1::ServiceHello,
                   v1::SimulatorHello, v1::Watch, v1::AgentBreach, v1::ScreeningEvent>;
TYPED_TEST_SUITE(Conversion, Carried);

TYPED_TEST(Conversion, RandomMessagesComeBackUnchanged) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    TypeParam message;
    FillRandomly(random, {}, &message);
    ASSERT_EQ(ThereAndBack(message), message.SerializeAsString()) << message.DebugString();
  }
}

TYPED_TEST(Conversion, MessagesAtEveryBoundComeBackUnchanged) {
  Random random(2);
  TypeParam message;
  FillRandomly(random, {.at_bound = true, .over = {}}, &message);
  EXPECT_EQ(ThereAndBack(message), message.SerializeAsString());
}

TYPED_TEST(Conversion, OneBeyondAnyBoundIsRefusedByName) {
  Random random(3);
  for (const auto& [structure, fields] : Idl().structs) {
    for (const IdlField& field : fields) {
      const bool optional = field.sequence && field.bound == 1;
      if (field.bound == 0 || optional) continue;
      TypeParam message;
      // Lists at their bounds, so that the field is met wherever it is nested.
      const Lengths lengths = {.at_bound = true, .over = structure + "." + field.name};
      if (!FillRandomly(random, lengths, &message)) continue;
      try {
        dds::ToWire(message);
        FAIL() << lengths.over << " was taken";
      } catch (const std::length_error& error) {
        const std::string what = error.what();
        EXPECT_EQ(what.rfind(field.name + ": length " + std::to_string(field.bound + 1), 0), 0u)
            << what;
        EXPECT_NE(what.find(" " + std::to_string(field.bound), field.name.size() + 10),
                  std::string::npos)
            << what;
      }
    }
  }
}

TEST(ConversionOfHashes, NoBytesAndAllZeroAreTheSame) {
  v1::AgentDescription message;
  message.set_shape_hash(std::string(32, '\0'));
  v1::AgentDescription back;
  dds::FromWire(*dds::ToWire(message), &back);
  EXPECT_TRUE(back.shape_hash().empty());
}

TEST(ConversionOfHashes, HalfAHashIsRefused) {
  v1::AgentDescription message;
  message.set_shape_hash("half");
  EXPECT_THROW(dds::ToWire(message), std::length_error);
}

// What a foreign writer sends must not make a recording unreadable.
TEST(ConversionOfText, BytesThatAreNotUtf8AreReplaced) {
  auto wire = dds::ToWire(v1::SimulatorClock());
  wire->simulator_name[0] = 'a';
  wire->simulator_name[1] = '\xff';
  v1::SimulatorClock message;
  dds::FromWire(*wire, &message);
  EXPECT_EQ(message.simulator_name(), "a?");
  EXPECT_TRUE(v1::SimulatorClock().ParseFromString(message.SerializeAsString()));
}

}  // namespace
}  // namespace collision
