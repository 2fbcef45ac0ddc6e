// fast-dds-simulator: two balls that meet, in step with all simulators of their world.
#include <iostream>

#include "options.h"
#include "simulator.h"

namespace {

const char* const kHelp =
    "fast-dds-simulator [--world W] [--domain D] [--simulator NAME] [--seconds S]\n"
    "Two balls that meet head-on, in lock-step; prints each of their contacts.\n"
    "  --world W         default: COLLISION_WORLD, else \"default\"\n"
    "  --domain D        0 to 230; default: COLLISION_DOMAIN, else 0\n"
    "  --simulator NAME  default: fast-dds\n"
    "  --seconds S       of world time that they fly; default: 10\n"
    "Exit status: 0; 1 no service, or one that does not fit; 2 wrong words.\n";

int Main(int argc, char** argv) {
  example::Options defaults;
  defaults.simulator = "fast-dds";
  defaults.seconds = 10;
  const example::Options options = example::ParseOptions(argc, argv, defaults);
  if (options.help) {
    std::cout << kHelp;
  } else {
    example::Simulator(options).Run(options.seconds);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Main(argc, argv);
  } catch (const example::UsageError& error) {
    std::cerr << "fast-dds-simulator: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "fast-dds-simulator: " << error.what() << "\n";
    return 1;
  }
}
