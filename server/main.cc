// collisiond: README.md in this folder.
#include <iostream>

#include "server/service/program/options.h"
#include "server/service/program/program.h"

int main(int argc, char** argv) {
  const auto parsed = collision::server::ParseOptions(argc, argv);
  std::cout << parsed.output << std::flush;
  std::cerr << parsed.error;
  if (!parsed.options) return parsed.exit_code;
  return collision::server::RunProgram(*parsed.options);
}
