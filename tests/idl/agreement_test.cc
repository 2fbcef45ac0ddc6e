// Goal:   collision.idl and messages.proto say the same: every struct is a message, every field
//         has the same name, place and kind, every enumerator the same number.
// Method: the IDL file, read as text, against protobuf's descriptors.
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include "idl/messages.pb.h"
#include "tests/idl/idl_file.h"

namespace collision {
namespace {

using google::protobuf::FieldDescriptor;

const google::protobuf::FileDescriptor& Proto() { return *v1::Vector3::descriptor()->file(); }

/// The IDL's name for the type of a protobuf field.
std::string IdlType(const FieldDescriptor& field, const IdlField& idl) {
  switch (field.type()) {
    case FieldDescriptor::TYPE_DOUBLE:
      return "double";
    case FieldDescriptor::TYPE_UINT32:
      return "unsigned long";
    case FieldDescriptor::TYPE_FIXED64:
    case FieldDescriptor::TYPE_UINT64:
      return "unsigned long long";
    case FieldDescriptor::TYPE_INT64:
      return "long long";
    case FieldDescriptor::TYPE_BOOL:
      return "boolean";
    case FieldDescriptor::TYPE_STRING:
      return "string";
    case FieldDescriptor::TYPE_BYTES:
      return idl.sequence ? "octet" : "octet[]";
    case FieldDescriptor::TYPE_ENUM:
      return field.enum_type()->name();
    case FieldDescriptor::TYPE_MESSAGE:
      return field.message_type()->name();
    default:
      return "none";
  }
}

TEST(Agreement, EveryStructIsAMessageWithTheSameFields) {
  ASSERT_EQ(Idl().structs.size(), 39u);
  for (const auto& [name, fields] : Idl().structs) {
    const auto* message = Proto().FindMessageTypeByName(name);
    ASSERT_NE(message, nullptr) << name;
    ASSERT_EQ(static_cast<std::size_t>(message->field_count()), fields.size()) << name;
    for (int i = 0; i < message->field_count(); ++i) {
      const FieldDescriptor& field = *message->field(i);
      EXPECT_EQ(field.name(), fields[i].name) << name;
      EXPECT_EQ(field.number(), i + 1) << field.full_name();
      EXPECT_EQ(IdlType(field, fields[i]), fields[i].type) << field.full_name();
      // A sequence of at most one element is a field that may be absent.
      const bool optional = fields[i].sequence && fields[i].bound == 1;
      const bool list =
          fields[i].sequence && !optional && field.type() != FieldDescriptor::TYPE_BYTES;
      EXPECT_TRUE(!optional || field.has_presence()) << field.full_name();
      EXPECT_EQ(field.is_repeated(), list) << field.full_name();
    }
  }
}

TEST(Agreement, OnlyWhatABusAddsIsNoStruct) {
  const std::set<std::string> bus = {
      "AgentRemoval", "ShapeRemoval", "ShapeReady", "SimulatorLiveliness",
      "ServiceHeard", "Input",        "Output"};
  for (int i = 0; i < Proto().message_type_count(); ++i) {
    const std::string& name = Proto().message_type(i)->name();
    EXPECT_NE(Idl().structs.count(name), bus.count(name)) << name;
  }
}

TEST(Agreement, EveryEnumeratorHasTheSameNumber) {
  ASSERT_EQ(Idl().enums.size(), static_cast<std::size_t>(Proto().enum_type_count()));
  for (const auto& [name, enumerators] : Idl().enums) {
    const auto* type = Proto().FindEnumTypeByName(name);
    ASSERT_NE(type, nullptr) << name;
    ASSERT_EQ(static_cast<std::size_t>(type->value_count()), enumerators.size()) << name;
    for (int i = 0; i < type->value_count(); ++i) {
      EXPECT_EQ(type->value(i)->name(), enumerators[i]);
      EXPECT_EQ(type->value(i)->number(), i) << enumerators[i];
    }
  }
}

}  // namespace
}  // namespace collision
