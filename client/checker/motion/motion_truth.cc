#include "client/checker/motion/motion_truth.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>

#include "client/checker/shape/placement.h"

namespace collision::checker {
namespace {

// The fields of one line. strtod reads back the writer's numbers exactly, and is much faster than a
// stream.
class Fields {
 public:
  explicit Fields(const std::string& line) : at_(line.c_str()) {}

  std::string Word() {
    while (*at_ == ' ') ++at_;
    const char* begin = at_;
    while (*at_ != '\0' && *at_ != ' ') ++at_;
    return {begin, at_};
  }

  bool Number(double* value) {
    char* end = nullptr;
    *value = std::strtod(at_, &end);
    return Advance(end) && std::isfinite(*value);
  }

  bool Whole(std::int64_t* value) {
    char* end = nullptr;
    *value = std::strtoll(at_, &end, 10);
    return Advance(end) && (*at_ == ' ' || *at_ == '\0');
  }

  template <std::size_t n>
  bool Numbers(std::array<double, n>* values) {
    for (double& value : *values) {
      if (!Number(&value)) return false;
    }
    return true;
  }

  bool AtEnd() {
    while (*at_ == ' ' || *at_ == '\r') ++at_;
    return *at_ == '\0';
  }

 private:
  bool Advance(const char* end) {
    const bool read = end != at_;
    at_ = end;
    return read;
  }

  const char* at_;
};

double LengthOf(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

class LogReader {
 public:
  LogReader(std::istream& text, const std::string& simulator)
      : text_(text), simulator_(simulator) {}

  std::vector<AgentMotion> Read() {
    std::string line;
    if (!NextLine(&line) || !IsFormat(line))
      Fail("the first line is none of \"motion-log 1\" to \"motion-log 5\"");
    while (NextLine(&line)) ReadRecord(line);
    std::vector<AgentMotion> moved;
    for (AgentMotion& motion : motions_) {
      if (motion.pieces.empty()) continue;
      CheckTurned(motion);
      moved.push_back(std::move(motion));
    }
    return moved;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw std::runtime_error(simulator_ + ":" + std::to_string(line_) + ": " + what);
  }

  static bool IsFormat(const std::string& line) {
    return line == "motion-log 1" || line == "motion-log 2" || line == "motion-log 3" ||
           line == "motion-log 4" || line == "motion-log 5";
  }

  bool NextLine(std::string* line) {
    ++line_;
    return static_cast<bool>(std::getline(text_, *line));
  }

  void ReadRecord(const std::string& line) {
    Fields fields(line);
    const std::string kind = fields.Word(), name = fields.Word();
    if (kind == "agent") {
      ReadAgent(&fields, name);
    } else if (kind == "half-space") {
      ReadHalfSpace(&fields, name);
    } else if (kind == "mesh") {
      ReadMesh(&fields, name);
    } else if (kind == "solid") {
      ReadSolid(&fields, name);
    } else {
      const auto found = index_.find(name);
      if (found == index_.end()) Fail("agent \"" + name + "\" has no agent line before");
      ReadMotion(kind, &fields, &motions_[found->second]);
    }
    if (!fields.AtEnd()) Fail("the " + kind + " has more fields than it should");
  }

  void ReadMotion(const std::string& kind, Fields* fields, AgentMotion* motion) {
    if (kind == "piece") {
      ReadPiece(fields, motion);
    } else if (kind == "turn") {
      ReadTurn(fields, motion);
    } else if (kind == "jump") {
      std::int64_t stamp_ns = 0;
      if (!fields->Whole(&stamp_ns)) Fail("a jump needs an instant");
      motion->jumps_ns.push_back(stamp_ns);
    } else if (kind == "assembly") {
      motion->assembly = fields->Word();
      if (motion->assembly.empty()) Fail("an assembly needs a name");
    } else if (kind == "class") {
      motion->class_name = fields->Word();
      if (motion->class_name.empty()) Fail("a class needs a name");
    } else if (kind == "margin") {
      if (!fields->Number(&motion->margin_m) || !(motion->margin_m >= 0))
        Fail("a margin needs a length, at least 0");
    } else {
      Fail("unknown record \"" + kind + "\"");
    }
  }

  void ReadAgent(Fields* fields, const std::string& name) {
    AgentMotion motion{simulator_, name, 0, {}, {}};
    if (!fields->Number(&motion.radius_m) || !(motion.radius_m >= 0))
      Fail("an agent needs a radius");
    const std::string shape = fields->Word();
    if (!shape.empty()) TakeShape(shape, &motion);
    Add(std::move(motion));
  }

  // All x with n·x <= offset, for an n of any length.
  void ReadHalfSpace(Fields* fields, const std::string& name) {
    AgentMotion motion{simulator_, name, 0, {}, {}};
    std::array<double, 3> n{};
    double offset = 0;
    if (!fields->Numbers(&n) || !fields->Number(&offset) || !(LengthOf(n) > 0))
      Fail("a half-space needs a normal and an offset");
    const double scale = 1 / LengthOf(n);
    motion.half_space = HalfSpace{scale * Vector{n[0], n[1], n[2]}, scale * offset};
    Add(std::move(motion));
  }

  void Add(AgentMotion motion) {
    const std::string name = motion.agent;
    if (!index_.emplace(name, motions_.size()).second)
      Fail("agent \"" + name + "\" is there twice");
    motions_.push_back(std::move(motion));
  }

  void TakeShape(const std::string& name, AgentMotion* motion) {
    const auto mesh = meshes_.find(name);
    const auto solids = solids_.find(name);
    if (mesh == meshes_.end() && solids == solids_.end())
      Fail("shape \"" + name + "\" has no mesh or solid line before");
    if (mesh != meshes_.end()) motion->mesh = mesh->second;
    if (solids != solids_.end()) motion->solids = solids->second;
    taken_.insert(name);
    const double reach = motion->body().reach();
    if (reach > motion->radius_m * (1 + 1e-9))
      Fail("shape \"" + name + "\" reaches " + std::to_string(reach) +
           " m, beyond the agent's radius of " + std::to_string(motion->radius_m) + " m");
  }

  std::size_t Count(Fields* fields, const char* what) const {
    std::int64_t count = 0;
    if (!fields->Whole(&count) || count < 1 || count > static_cast<std::int64_t>(kMeshItemsMax))
      Fail(std::string("a mesh needs 1 to ") + std::to_string(kMeshItemsMax) + " " + what);
    return static_cast<std::size_t>(count);
  }

  void ReadMesh(Fields* fields, const std::string& name) {
    std::vector<Vector> vertices(Count(fields, "vertices"));
    std::vector<std::array<std::uint32_t, 3>> triangles(Count(fields, "triangles"));
    for (Vector& v : vertices) {
      if (!fields->Number(&v.x) || !fields->Number(&v.y) || !fields->Number(&v.z))
        Fail("a vertex needs three finite coordinates");
    }
    for (auto& triangle : triangles) {
      for (std::uint32_t& index : triangle) {
        std::int64_t value = 0;
        if (!fields->Whole(&value)) Fail("a triangle needs three indices");
        if (value < 0 || value >= static_cast<std::int64_t>(vertices.size()))
          Fail("index " + std::to_string(value) + " is not one of the mesh's " +
               std::to_string(vertices.size()) + " vertices");
        index = static_cast<std::uint32_t>(value);
      }
    }
    std::shared_ptr<const Mesh> mesh;
    try {
      mesh = std::make_shared<Mesh>(std::move(vertices), triangles);
    } catch (const std::runtime_error& error) {
      Fail(error.what());
    }
    if (!meshes_.emplace(name, mesh).second) Fail("mesh \"" + name + "\" is there twice");
  }

  void ReadSolid(Fields* fields, const std::string& name) {
    const std::string kind = fields->Word();
    std::array<double, 1> rounding{};
    std::array<double, 3> p{};
    std::array<double, 4> q{};
    if (!fields->Numbers(&rounding) || !fields->Numbers(&p) || !fields->Numbers(&q) ||
        !(rounding[0] >= 0))
      Fail("a solid needs a rounding, a position and an orientation");
    if (taken_.contains(name)) Fail("shape \"" + name + "\" has an agent already");
    auto& solids = solids_[name];
    if (!solids) solids = std::make_shared<std::vector<Solid>>();
    if (solids->size() == kSolidsMax)
      Fail("shape \"" + name + "\" has more than " + std::to_string(kSolidsMax) + " solids");
    const Vector at{p[0], p[1], p[2]};
    try {
      if (const auto round = RoundCore::KindOf(kind)) {
        const RoundCore core(*round, RoundHalf(kind, fields), q, at);
        solids->push_back({Mesh::OfSegment(at, at), rounding[0], core});
        return;
      }
      solids->push_back({HullOf(Placed(CorePoints(kind, fields), q, at)), rounding[0]});
    } catch (const std::runtime_error& error) {
      Fail("shape \"" + name + "\": " + error.what());
    }
  }

  static Vector RoundHalf(const std::string& kind, Fields* fields) {
    std::array<double, 3> half{};
    if (kind == "ellipsoid") {
      if (!fields->Numbers(&half)) throw std::runtime_error("an ellipsoid needs its half axes");
    } else {
      if (!fields->Number(&half[0]) || !fields->Number(&half[2]))
        throw std::runtime_error("a " + kind + " needs its radius and half length");
      half[1] = half[0];
    }
    return {half[0], half[1], half[2]};
  }

  // The core is their hull.
  std::vector<Vector> CorePoints(const std::string& kind, Fields* fields) const {
    if (kind == "ball") return {Vector{}};
    std::array<double, 3> half{};
    if (kind == "capsule") {
      if (!fields->Number(&half[2])) throw std::runtime_error("a capsule needs its half length");
      return {{0, 0, -half[2]}, {0, 0, half[2]}};
    }
    if (kind == "box") {
      if (!fields->Numbers(&half)) throw std::runtime_error("a box needs its half extents");
      return BoxCorners({half[0], half[1], half[2]});
    }
    if (kind != "hull") throw std::runtime_error("unknown kind of solid \"" + kind + "\"");
    std::int64_t count = 0;
    if (!fields->Whole(&count) || count < 1 || count > static_cast<std::int64_t>(kHullPointsMax))
      throw std::runtime_error("a hull needs 1 to " + std::to_string(kHullPointsMax) + " points");
    std::vector<Vector> points(static_cast<std::size_t>(count));
    for (Vector& point : points) {
      if (!fields->Number(&point.x) || !fields->Number(&point.y) || !fields->Number(&point.z))
        throw std::runtime_error("a point needs three finite coordinates");
    }
    return points;
  }

  void ReadPiece(Fields* fields, AgentMotion* motion) const {
    Piece piece;
    if (!fields->Whole(&piece.t0_ns) || !fields->Whole(&piece.t1_ns))
      Fail("a piece needs two instants");
    for (auto& axis : piece.p_WA) {
      if (!fields->Numbers(&axis)) Fail("a piece needs twelve finite coefficients");
    }
    if (piece.t1_ns < piece.t0_ns || (!motion->pieces.empty() && piece.t0_ns < motion->end_ns())) {
      Fail("the piece goes back in time");
    }
    CheckTurned(*motion);
    if (motion->half_space && piece.p_WA != Piece().p_WA) Fail("a half-space never moves");
    motion->pieces.push_back(piece);
  }

  // An agent that turns in one piece has a turn in each.
  void CheckTurned(const AgentMotion& motion) const {
    if (motion.pieces.empty() || !motion.pieces.front().turn || motion.pieces.back().turn) return;
    Fail("agent \"" + motion.agent + "\" turned before, but its last piece has no turn");
  }

  void ReadTurn(Fields* fields, AgentMotion* motion) const {
    std::int64_t t0_ns = 0, t1_ns = 0;
    if (!fields->Whole(&t0_ns) || !fields->Whole(&t1_ns)) Fail("a turn needs two instants");
    Turn turn;
    if (!fields->Numbers(&turn.q) || !fields->Numbers(&turn.w) || !fields->Numbers(&turn.b))
      Fail("a turn needs ten finite numbers");
    const double norm =
        std::hypot(std::hypot(turn.q[0], turn.q[1]), std::hypot(turn.q[2], turn.q[3]));
    if (!(std::fabs(norm - 1) < 1e-6)) Fail("the turn's quaternion is not of unit length");
    if (motion->half_space) Fail("a half-space never turns");
    if (motion->pieces.empty() || motion->pieces.back().turn)
      Fail("a turn follows the piece that it belongs to");
    if (t0_ns != motion->pieces.back().t0_ns || t1_ns != motion->pieces.back().t1_ns)
      Fail("the turn's instants are not those of the piece before it");
    if (motion->pieces.size() > 1 && !motion->pieces.front().turn)
      Fail("earlier pieces of agent \"" + motion->agent + "\" have no turn");
    const double seconds = static_cast<double>(t1_ns - t0_ns) * 1e-9;
    const double angle = (LengthOf(turn.w) + LengthOf(turn.b) * seconds) * seconds;
    if (!(angle <= kRotationAngleMax))
      Fail("the turn is " + std::to_string(angle) + " rad, more than " +
           std::to_string(kRotationAngleMax));
    motion->pieces.back().turn = turn;
  }

  std::istream& text_;
  const std::string& simulator_;
  std::size_t line_ = 0;
  std::vector<AgentMotion> motions_;
  std::map<std::string, std::size_t> index_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
  std::map<std::string, std::shared_ptr<std::vector<Solid>>> solids_;
  std::set<std::string> taken_;  // shapes that an agent has
};

}  // namespace

std::vector<AgentMotion> ReadMotionLog(std::istream& text, const std::string& simulator) {
  return LogReader(text, simulator).Read();
}

}  // namespace collision::checker
