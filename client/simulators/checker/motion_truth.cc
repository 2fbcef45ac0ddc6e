#include "client/simulators/checker/motion_truth.h"

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace collision::checker {
namespace {

class LogReader {
 public:
  LogReader(std::istream& text, const std::string& simulator)
      : text_(text), simulator_(simulator) {}

  std::vector<AgentMotion> Read() {
    std::string line;
    if (!NextLine(&line) || line != "motion-log 1") Fail("the first line is not \"motion-log 1\"");
    while (NextLine(&line)) ReadRecord(line);
    std::vector<AgentMotion> moved;
    for (AgentMotion& motion : motions_) {
      if (!motion.pieces.empty()) moved.push_back(std::move(motion));
    }
    return moved;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw std::runtime_error(simulator_ + ":" + std::to_string(line_) + ": " + what);
  }

  bool NextLine(std::string* line) {
    ++line_;
    return static_cast<bool>(std::getline(text_, *line));
  }

  void ReadRecord(const std::string& line) {
    std::istringstream fields(line);
    std::string kind, name;
    fields >> kind >> name;
    if (kind == "agent") {
      ReadAgent(fields, name);
      return;
    }
    const auto found = index_.find(name);
    if (found == index_.end()) Fail("agent \"" + name + "\" has no agent line before");
    AgentMotion& motion = motions_[found->second];
    if (kind == "piece") {
      ReadPiece(line, &motion);
    } else if (kind == "jump") {
      std::int64_t stamp_ns = 0;
      if (!(fields >> stamp_ns)) Fail("a jump needs an instant");
      motion.jumps_ns.push_back(stamp_ns);
    } else {
      Fail("unknown record \"" + kind + "\"");
    }
  }

  void ReadAgent(std::istringstream& fields, const std::string& name) {
    AgentMotion motion{simulator_, name, 0, {}, {}};
    if (!(fields >> motion.radius_m) || !(motion.radius_m >= 0)) Fail("an agent needs a radius");
    if (!index_.emplace(name, motions_.size()).second)
      Fail("agent \"" + name + "\" is there twice");
    motions_.push_back(std::move(motion));
  }

  // strtod reads what the writer wrote to the last bit, and is much faster than a stream.
  void ReadPiece(const std::string& line, AgentMotion* motion) const {
    const char* at = line.c_str() + std::string("piece ").size() + motion->agent.size();
    char* end = nullptr;
    Piece piece;
    for (std::int64_t* time : {&piece.t0_ns, &piece.t1_ns}) {
      *time = std::strtoll(at, &end, 10);
      if (end == at) Fail("a piece needs two instants");
      at = end;
    }
    for (auto& axis : piece.p_WA) {
      for (double& coefficient : axis) {
        coefficient = std::strtod(at, &end);
        if (end == at || !std::isfinite(coefficient))
          Fail("a piece needs twelve finite coefficients");
        at = end;
      }
    }
    if (piece.t1_ns < piece.t0_ns || (!motion->pieces.empty() && piece.t0_ns < motion->end_ns())) {
      Fail("the piece goes back in time");
    }
    motion->pieces.push_back(piece);
  }

  std::istream& text_;
  const std::string& simulator_;
  std::size_t line_ = 0;
  std::vector<AgentMotion> motions_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace

std::vector<AgentMotion> ReadMotionLog(std::istream& text, const std::string& simulator) {
  return LogReader(text, simulator).Read();
}

}  // namespace collision::checker
