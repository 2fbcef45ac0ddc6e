#include "tests/report/results.h"

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "tests/report/text.h"

namespace collision::report {
namespace {

using google::protobuf::Struct;
using google::protobuf::util::JsonStringToMessage;

using TakeFact = std::function<void(const std::string& name, const std::string& value)>;

void ReadFacts(const std::string& path, const TakeFact& take) {
  std::istringstream lines(ReadFile(path));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos) {
      throw std::runtime_error(path + ": no tab in '" + line + "'");
    }
    take(line.substr(0, tab), line.substr(tab + 1));
  }
}

void TakeMachineFact(const std::string& name, const std::string& value, v1::Results* results) {
  v1::Machine* machine = results->mutable_machine();
  if (name == "version") {
    results->set_version(value);
  } else if (name == "commit") {
    results->set_commit(value);
  } else if (name == "finished") {
    results->set_finished(value);
  } else if (name == "quick") {
    results->set_quick(value == "yes");
  } else if (name == "processor") {
    machine->set_processor(value);
  } else if (name == "processors") {
    machine->set_processors(static_cast<std::uint32_t>(std::stoul(value)));
  } else if (name == "memory_gib") {
    machine->set_memory_gib(std::stod(value));
  } else if (name == "system") {
    machine->set_system(value);
  } else if (name == "compiler") {
    machine->set_compiler(value);
  } else if (name == "build") {
    machine->set_build(value);
  } else if (name == "library") {
    const std::size_t space = value.find(' ');
    v1::Library* library = machine->add_libraries();
    library->set_name(value.substr(0, space));
    if (space != std::string::npos) library->set_version(value.substr(space + 1));
  }
}

void TakeExperimentFact(const std::string& name, const std::string& value,
                        v1::Experiment* experiment) {
  if (name == "title") {
    experiment->set_title(value);
  } else if (name == "command") {
    experiment->set_command(value);
  } else if (name == "seconds") {
    experiment->set_seconds(std::stod(value));
  } else if (name == "cut_off_s") {
    experiment->set_cut_off_s(std::stod(value));
  } else if (name == "failure") {
    experiment->set_failure(value);
  } else if (name == "seed") {
    experiment->add_seeds(std::stoull(value));
  }
}

// Reads nothing if the file does not exist: the experiment failed.
void ReadMeasurements(const std::string& path, v1::Experiment* experiment) {
  if (!std::ifstream(path)) return;
  Struct file;
  const auto status = JsonStringToMessage(ReadFile(path), &file);
  if (!status.ok()) throw std::runtime_error(path + ": " + status.ToString());
  std::vector<std::pair<std::string, google::protobuf::Value>> figures;
  for (const auto& figure : file.fields().at("figures").struct_value().fields()) {
    figures.emplace_back(figure.first, figure.second);
  }
  std::sort(figures.begin(), figures.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [name, value] : figures) {
    v1::Figure* figure = experiment->add_figures();
    figure->set_name(name);
    if (value.has_number_value()) figure->set_value(value.number_value());
  }
  for (const auto& row : file.fields().at("measurements").list_value().values()) {
    *experiment->add_measurements() = row.struct_value();
  }
}

}  // namespace

v1::Results Assemble(const std::string& folder) {
  v1::Results results;
  ReadFacts(folder + "/facts", [&](const std::string& name, const std::string& value) {
    TakeMachineFact(name, value, &results);
  });
  std::istringstream times(ReadFile(folder + "/reference"));
  for (double seconds = 0; times >> seconds;) results.add_reference_s(seconds);
  std::istringstream order(ReadFile(folder + "/order"));
  for (std::string name; std::getline(order, name);) {
    v1::Experiment* experiment = results.add_experiments();
    experiment->set_name(name);
    const std::string base = folder + "/" + name;
    ReadFacts(base + ".about", [&](const std::string& fact, const std::string& value) {
      TakeExperimentFact(fact, value, experiment);
    });
    ReadMeasurements(base + ".json", experiment);
  }
  return results;
}

std::string ToJson(const v1::Results& results) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  options.preserve_proto_field_names = true;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(results, &text, options);
  if (!status.ok()) throw std::runtime_error("results: " + status.ToString());
  return text;
}

v1::Results FromJson(const std::string& path) {
  v1::Results results;
  const auto status = JsonStringToMessage(ReadFile(path), &results);
  if (!status.ok())
    throw std::runtime_error(path + ": not the results of a report: " + status.ToString());
  return results;
}

double NoiseOf(const v1::Results& results) {
  std::vector<double> times(results.reference_s().begin(), results.reference_s().end());
  if (times.size() < 3) return 0;
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1) + 0.5)];
  };
  return (at(0.95) - at(0.05)) / at(0.5);
}

double TimeReference() {
  constexpr std::size_t kWords = std::size_t{1} << 20;  // 8 MB: more than one core's own caches
  constexpr int kSteps = 4'000'000;
  std::vector<std::uint64_t> words(kWords);
  std::uint64_t state = 1;
  for (std::uint64_t& word : words) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    word = state;
  }
  const auto processor_time = [] {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  const double start = processor_time();
  double sum = 1;
  for (int step = 0; step < kSteps; ++step) {
    state = words[state >> 40 & (kWords - 1)] ^ (state << 1 | 1);
    sum = std::sqrt(sum + static_cast<double>(state >> 12));
  }
  const double seconds = processor_time() - start;
  // So that the work is not left out.
  return sum > 0 ? seconds : 0;
}

}  // namespace collision::report
