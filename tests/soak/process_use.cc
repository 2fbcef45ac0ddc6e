#include "tests/soak/process_use.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace collision::soak {

ProcessUse UseOf(pid_t process) {
  const std::string folder = "/proc/" + std::to_string(process);
  ProcessUse use;
  std::ifstream status(folder + "/status");
  for (std::string word; status >> word;) {
    if (word == "VmRSS:" && status >> use.resident_mb) use.resident_mb /= 1000;
    if (word == "Threads:") status >> use.threads;
  }
  std::error_code ignored;
  const std::filesystem::directory_iterator descriptors(folder + "/fd", ignored);
  use.descriptors = static_cast<double>(std::distance(begin(descriptors), end(descriptors)));
  return use;
}

double MedianOf(const std::vector<UseAt>& readings, double ProcessUse::*what, double from,
                double to) {
  std::vector<double> values;
  for (const UseAt& one : readings) {
    if (from < one.part && one.part <= to) values.push_back(one.use.*what);
  }
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace collision::soak
