#include "tests/bench/pairs/method.h"

#include "tests/bench/harness/json.h"
#include "tests/bench/pairs/motion.h"

namespace collision::bench {

const char* Name(Task task) {
  switch (task) {
    case Task::kDecision:
      return "decision";
    case Task::kDistance:
      return "distance";
    case Task::kBracket:
      return "bracket";
  }
  return "";
}

const char* Name(Motion motion) {
  switch (motion) {
    case Motion::kTranslation:
      return "translation";
    case Motion::kRotation:
      return "rotation";
    case Motion::kGrazing:
      return "grazing";
  }
  return "";
}

std::string SettingText(const char* what, double value, const char* unit) {
  std::string text = Format("%g", value);
  if (what[0] != '\0') text = std::string(what) + " " + text;
  return unit[0] == '\0' ? text : text + " " + unit;
}

}  // namespace collision::bench
