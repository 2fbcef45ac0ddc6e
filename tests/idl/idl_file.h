// collision.idl as data: its structs and enums.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace collision {

/// One field of a struct: `type` without bounds ("unsigned long", "string", "AgentState",
/// "octet[]").
struct IdlField {
  std::string type;
  std::string name;
  std::size_t bound = 0;  ///< Of a string, sequence or array; 0: none of these.
  bool sequence = false;
  bool key = false;
};

struct IdlFile {
  std::map<std::string, std::size_t> constants;
  std::map<std::string, std::vector<IdlField>> structs;
  std::map<std::string, std::vector<std::string>> enums;
};

/// Reads the file: just the forms that it uses. Throws std::runtime_error if it meets another one.
const IdlFile& Idl();

}  // namespace collision
