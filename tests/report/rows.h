// The measurements of an experiment, as rows of named values.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "idl/report.pb.h"

namespace collision::report {

using Row = google::protobuf::Struct;

/// A field must be this text. "!text": must not be it; "text*": must begin with it.
using Condition = std::pair<std::string, std::string>;

/// Nullopt: not there, null, or not a number.
std::optional<double> NumberOf(const Row& row, const std::string& field);
/// Numbers as short as they are exact enough; empty: not there or null.
std::string TextOf(const Row& row, const std::string& field);
/// The texts of the fields, with ", " between those that are not empty.
std::string TextOf(const Row& row, const std::vector<std::string>& fields);

/// Null: there is none of that name.
const v1::Experiment* FindExperiment(const v1::Results& results, const std::string& name);
std::optional<double> FigureOf(const v1::Results& results, const std::string& experiment,
                               const std::string& figure);

/// The rows that meet all conditions, in their order. None where the experiment is missing.
std::vector<const Row*> Select(const v1::Results& results, const std::string& experiment,
                               const std::vector<Condition>& conditions);

/// The different texts of a field, in the order in which they come.
std::vector<std::string> TextsOf(const std::vector<const Row*>& rows, const std::string& field);

}  // namespace collision::report
