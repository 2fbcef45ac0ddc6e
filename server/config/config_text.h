// The text of a configuration, read as far as it can be read.
#pragma once

#include <google/protobuf/text_format.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "idl/config.pb.h"

namespace collision::server {

/// Line and column in a text, from 0. Line -1: not from the text.
using TextPlace = std::pair<int, int>;

/// By the place of the field; of several errors of one field the first is the one that matters.
using ErrorsByPlace = std::map<TextPlace, std::string>;

/// Reads protobuf text into `config`. A field with an error is left out, and what stands before and
/// after it is read all the same, also within `clock`. Errors name the path of the field, as in
/// "clock.kind: ...", and what is allowed there. Returns where the fields stand that were read.
std::unique_ptr<google::protobuf::TextFormat::ParseInfoTree> ReadConfigText(const std::string& text,
                                                                            v1::Config* config,
                                                                            ErrorsByPlace* errors);

}  // namespace collision::server
