// Whether documents are what schema.json of collisionctl says, by Debian's python3-jsonschema.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace collision::client {

/// What the schema has against these documents; empty: nothing.
inline std::string ComplaintsAbout(const std::vector<std::string>& documents) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("schema_test." + std::to_string(getpid()) + ".jsonl");
  std::ofstream file(path);
  for (const std::string& document : documents) file << document << '\n';
  file.close();
  const std::string command = std::string("/usr/bin/python3 ") + COLLISION_JSON_VALIDATOR + " " +
                              COLLISION_JSON_SCHEMA + " " + path.string() + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string said;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) said += buffer;
  const int status = pclose(pipe);
  std::filesystem::remove(path);
  return said.empty() && status != 0 ? "the validator ended with " + std::to_string(status) : said;
}

}  // namespace collision::client
