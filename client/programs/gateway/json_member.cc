#include "client/programs/gateway/json_member.h"

namespace collision::gateway {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Value;

const Value& MemberOf(const google::protobuf::Struct& object, const std::string& name) {
  const google::protobuf::Reflection& of_object = *object.GetReflection();
  const FieldDescriptor* members = object.GetDescriptor()->field(0);
  for (int i = 0; i < of_object.FieldSize(object, members); ++i) {
    const Message& member = of_object.GetRepeatedMessage(object, members, i);
    const google::protobuf::Reflection& of_member = *member.GetReflection();
    const google::protobuf::Descriptor& type = *member.GetDescriptor();
    if (of_member.GetString(member, type.map_key()) != name) continue;
    return static_cast<const Value&>(of_member.GetMessage(member, type.map_value()));
  }
  return Value::default_instance();
}

}  // namespace collision::gateway
