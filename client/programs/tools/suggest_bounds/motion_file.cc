#include "client/programs/tools/suggest_bounds/motion_file.h"

#include <google/protobuf/io/zero_copy_stream_impl.h>
#include <google/protobuf/util/delimited_message_util.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "client/programs/shared/exit_code.h"
#include "client/programs/simulators/player/csv_rows.h"
#include "idl/recording_format.h"

namespace collision::client {
namespace {

constexpr std::size_t kLookedAt = 4096;  // bytes that tell text from a recording

bool IsText(std::ifstream* file) {
  std::string begin(kLookedAt, '\0');
  file->read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file->gcount()));
  file->clear();
  file->seekg(0);
  return std::ranges::none_of(
      begin, [](unsigned char c) { return c < 0x20 && c != '\n' && c != '\r' && c != '\t'; });
}

MotionFile FromCsv(std::ifstream* file, const std::string& path) {
  CsvRows rows;
  try {
    rows = ReadCsv(*file, path);
  } catch (const CsvError& error) {
    throw BadInput(error.what());
  }
  MotionFile motions;
  for (const auto& [name, its_rows] : rows.rows) {
    SampledAgent& agent = motions.agents.emplace_back();
    agent.name = name;
    agent.has_velocities = rows.velocities;
    for (const CsvRow& row : its_rows) {
      MotionSample& sample = agent.samples.emplace_back();
      sample.stamp_ns = row.time_ns;
      sample.position_m = row.position_m;
      sample.velocity_m_s = row.velocity_m_s;
      sample.discontinuity = row.jump;
    }
  }
  return motions;
}

std::string Left(const std::string& path, std::size_t entry, bool full,
                 const MotionSamples& samples) {
  const std::string place = path + ": entry " + std::to_string(entry);
  if (full) {
    return place + ": more than " + std::to_string(MotionSamples::kSamplesMax) +
           " states; what precedes it counts";
  }
  if (samples.refused() == 0) return "";
  return path + ": " + std::to_string(samples.refused()) +
         " states are out of range and left out, the first: " + samples.first_refusal();
}

MotionFile FromRecording(std::ifstream* file, const std::string& path) {
  google::protobuf::io::IstreamInputStream stream(file);
  MotionSamples samples;
  v1::RecordingEntry entry;
  bool at_end = false;
  std::size_t number = 0;
  while (!samples.full() &&
         google::protobuf::util::ParseDelimitedFromZeroCopyStream(&entry, &stream, &at_end)) {
    ++number;
    if (number == 1 && !entry.has_header()) break;
    if (const std::string refusal = wire::RefusalOfFormat(entry.header());
        entry.has_header() && !refusal.empty()) {
      throw BadInput(path + ": " + refusal);
    }
    for (const v1::Input& input : entry.batch().inputs()) {
      if (input.has_agent_description()) samples.Take(input.agent_description());
      if (input.has_agent_states()) samples.Take(input.agent_states());
    }
    entry.Clear();
  }
  MotionFile motions;
  motions.is_recording = true;
  motions.agents = samples.Agents();
  motions.warning = Left(path, number, samples.full(), samples);
  if (!at_end && !samples.full()) {
    const std::string place = path + ": entry " + std::to_string(std::max<std::size_t>(number, 1));
    if (number <= 1 && motions.agents.empty()) {
      throw BadInput(place + ": neither a CSV file nor a recording of collisiond");
    }
    motions.warning = place + ": cut off or damaged after it; what precedes counts";
  }
  if (motions.agents.empty()) throw BadInput(path + ": no state of any agent is in it");
  return motions;
}

}  // namespace

MotionFile ReadMotionFile(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw std::runtime_error(path + ": is a directory");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return IsText(&file) ? FromCsv(&file, path) : FromRecording(&file, path);
}

}  // namespace collision::client
