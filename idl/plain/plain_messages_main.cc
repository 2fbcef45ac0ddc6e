// Writes the messages of idl/messages.proto as plain C++: the accessors that protoc would write,
// over standard containers, without protobuf behind them. Run by the build.
//
//     plain-messages messages.desc messages.pb.h
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>

namespace collision {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
using google::protobuf::OneofDescriptor;

/// A template line in which @ is the field's name, $ its type, and # its place in a oneof.
std::string Filled(const std::string& text, const std::string& name, const std::string& type,
                   const std::string& place = "") {
  std::string filled;
  for (const char c : text) {
    if (c == '@') {
      filled += name;
    } else if (c == '$') {
      filled += type;
    } else if (c == '#') {
      filled += place;
    } else {
      filled += c;
    }
  }
  return filled;
}

bool IsText(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_STRING;
}

bool IsMessage(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
}

std::string TypeOf(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return "std::int32_t";
    case FieldDescriptor::CPPTYPE_INT64:
      return "std::int64_t";
    case FieldDescriptor::CPPTYPE_UINT32:
      return "std::uint32_t";
    case FieldDescriptor::CPPTYPE_UINT64:
      return "std::uint64_t";
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "double";
    case FieldDescriptor::CPPTYPE_FLOAT:
      return "float";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "bool";
    case FieldDescriptor::CPPTYPE_STRING:
      return "std::string";
    case FieldDescriptor::CPPTYPE_ENUM:
      return field.enum_type()->name();
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return field.message_type()->name();
  }
  throw std::logic_error("a type of field that no message has");
}

/// As protoc: agent_description is kAgentDescription.
std::string CaseOf(const FieldDescriptor& field) {
  std::string name = field.camelcase_name();
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return "k" + name;
}

std::string Repeated(const FieldDescriptor& field) {
  std::string text =
      "  const plain::List<$>& @() const { return @_; }\n"
      "  plain::List<$>* mutable_@() { return &@_; }\n"
      "  int @_size() const { return @_.size(); }\n"
      "  void clear_@() { @_.Clear(); }\n";
  if (IsMessage(field) || IsText(field)) {
    text +=
        "  const $& @(int i) const { return @_[i]; }\n"
        "  $* mutable_@(int i) { return &@_[i]; }\n"
        "  $* add_@() { return @_.Add(); }\n";
  } else {
    text +=
        "  $ @(int i) const { return @_[i]; }\n"
        "  void set_@(int i, $ value) { @_[i] = value; }\n";
  }
  if (!IsMessage(field)) text += "  void add_@($ value) { *@_.Add() = std::move(value); }\n";
  return text;
}

std::string Member(const FieldDescriptor& field) {
  if (IsMessage(field)) {
    return "  bool has_@() const { return @_.has_value(); }\n"
           "  const $& @() const { return @_ ? *@_ : $::default_instance(); }\n"
           "  $* mutable_@() { return @_ ? &*@_ : &@_.emplace(); }\n"
           "  void clear_@() { @_.reset(); }\n";
  }
  if (IsText(field)) {
    return "  const $& @() const { return @_; }\n"
           "  void set_@($ value) { @_ = std::move(value); }\n"
           "  void set_@(const void* bytes, std::size_t size) {\n"
           "    @_.assign(static_cast<const char*>(bytes), size);\n"
           "  }\n"
           "  $* mutable_@() { return &@_; }\n"
           "  void clear_@() { @_.clear(); }\n";
  }
  if (field.has_presence()) {
    return "  bool has_@() const { return @_.has_value(); }\n"
           "  $ @() const { return @_.value_or($()); }\n"
           "  void set_@($ value) { @_ = value; }\n"
           "  void clear_@() { @_.reset(); }\n";
  }
  return "  $ @() const { return @_; }\n"
         "  void set_@($ value) { @_ = value; }\n"
         "  void clear_@() { @_ = {}; }\n";
}

std::string OneofText(const OneofDescriptor& oneof) {
  std::string text, types, cases, places;
  for (int i = 0; i < oneof.field_count(); ++i) {
    const FieldDescriptor& field = *oneof.field(i);
    if (!IsMessage(field)) throw std::logic_error(field.full_name() + ": not a message");
    types += ", " + TypeOf(field);
    cases += CaseOf(field) + " = " + std::to_string(field.number()) + ", ";
    places += ", " + CaseOf(field);
    text += Filled(
        "  bool has_@() const { return ONE_.index() == #; }\n"
        "  const $& @() const {\n"
        "    return has_@() ? *std::get_if<#>(&ONE_) : $::default_instance();\n"
        "  }\n"
        "  $* mutable_@() { return has_@() ? std::get_if<#>(&ONE_) : &ONE_.emplace<#>(); }\n",
        field.name(), TypeOf(field), std::to_string(i + 1));
  }
  const std::string& name = oneof.name();
  std::string upper = name;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string type = name;
  type[0] = upper[0];
  for (std::size_t at; (at = text.find("ONE_")) != std::string::npos;)
    text.replace(at, 4, name + "_");
  return "  enum " + type + "Case { " + cases + upper + "_NOT_SET = 0 };\n" + text + "  " + type +
         "Case " + name + "_case() const {\n    constexpr " + type + "Case cases[] = {" + upper +
         "_NOT_SET" + places + "};\n    return cases[" + name + "_.index()];\n  }\n" +
         "  void clear_" + name + "() { " + name + "_.emplace<0>(); }\n\n private:\n" +
         "  std::variant<std::monostate" + types + "> " + name + "_;\n\n public:\n";
}

std::string MessageText(const Descriptor& message) {
  const std::string& name = message.name();
  std::string accessors, members;
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor& field = *message.field(i);
    if (field.real_containing_oneof() != nullptr) continue;
    const std::string type = TypeOf(field);
    accessors += Filled(field.is_repeated() ? Repeated(field) : Member(field), field.name(), type);
    const bool optional = !IsText(field) && field.has_presence();
    members += Filled(field.is_repeated() ? "  plain::List<$> @_;\n"
                      : optional          ? "  std::optional<$> @_;\n"
                                          : "  $ @_{};\n",
                      field.name(), type);
  }
  for (int i = 0; i < message.real_oneof_decl_count(); ++i) {
    accessors += OneofText(*message.oneof_decl(i));
  }
  return "class " + name + " {\n public:\n  static const " + name +
         "& default_instance() {\n    static const " + name +
         " instance;\n    return instance;\n  }\n  void Clear() { *this = " + name +
         "(); }\n  void CopyFrom(const " + name + "& other) { *this = other; }\n  void Swap(" +
         name + "* other) { std::swap(*this, *other); }\n" + accessors + "\n private:\n" + members +
         "};\n\n";
}

std::string EnumText(const EnumDescriptor& values) {
  std::string list, names;
  for (int i = 0; i < values.value_count(); ++i) {
    const std::string& name = values.value(i)->name();
    list += "  " + name + " = " + std::to_string(values.value(i)->number()) + ",\n";
    names += "    case " + name + ":\n      return \"" + name + "\";\n";
  }
  return "enum " + values.name() + " : int {\n" + list + "};\n\ninline std::string " +
         values.name() + "_Name(" + values.name() + " value) {\n  switch (value) {\n" + names +
         "  }\n  return \"\";\n}\n\n";
}

/// A member needs its whole type: what a message holds stands before it.
void Append(const Descriptor& message, std::set<const Descriptor*>* done, std::string* text) {
  if (!done->insert(&message).second) return;
  for (int i = 0; i < message.field_count(); ++i) {
    if (IsMessage(*message.field(i))) Append(*message.field(i)->message_type(), done, text);
  }
  *text += MessageText(message);
}

std::string FileText(const FileDescriptor& file) {
  std::string text = "// Written by plain-messages from " + file.name() +
                     ": the same messages without protobuf.\n#pragma once\n\n"
                     "#include \"idl/plain/list.h\"\n\n"
                     "#include <cstddef>\n#include <cstdint>\n#include <optional>\n"
                     "#include <string>\n#include <utility>\n#include <variant>\n\n"
                     "namespace collision::v1 {\n\n";
  for (int i = 0; i < file.enum_type_count(); ++i) text += EnumText(*file.enum_type(i));
  std::set<const Descriptor*> done;
  for (int i = 0; i < file.message_type_count(); ++i) Append(*file.message_type(i), &done, &text);
  return text + "}  // namespace collision::v1\n";
}

void Write(const char* descriptors, const char* header) {
  std::ifstream in(descriptors, std::ios::binary);
  google::protobuf::FileDescriptorSet set;
  if (!set.ParseFromIstream(&in) || set.file_size() != 1) {
    throw std::runtime_error(std::string(descriptors) + ": not one file of messages");
  }
  google::protobuf::DescriptorPool pool;
  const FileDescriptor* file = pool.BuildFile(set.file(0));
  if (file == nullptr) throw std::runtime_error(std::string(descriptors) + ": does not fit");
  std::ofstream out(header);
  out << FileText(*file);
  if (!out.flush()) throw std::runtime_error(std::string(header) + ": cannot be written");
}

}  // namespace
}  // namespace collision

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: plain-messages DESCRIPTORS HEADER\n";
    return 2;
  }
  try {
    collision::Write(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "plain-messages: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
