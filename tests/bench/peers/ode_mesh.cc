// ODE: its collider of two triangle meshes, by OPCODE's trees; one contact is enough.
#include <ode/ode.h>

#include <memory>

#include "tests/bench/pairs/peers.h"

namespace collision::bench {
namespace {

class Opcode {
 public:
  explicit Opcode(const PlainMesh& mesh) {
    // Once for the whole process; what it leaves to the end is none of ours.
    static const int initialised = dInitODE2(0);
    static_cast<void>(initialised);
    for (const auto& p : mesh.vertices) points_.insert(points_.end(), p.begin(), p.end());
    for (const auto& t : mesh.triangles) corners_.insert(corners_.end(), t.begin(), t.end());
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, points_.data(), 3 * sizeof(double),
                                static_cast<int>(mesh.vertices.size()), corners_.data(),
                                static_cast<int>(corners_.size()), 3 * sizeof(dTriIndex));
    a_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
    b_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }
  ~Opcode() {
    dGeomDestroy(a_);
    dGeomDestroy(b_);
    dGeomTriMeshDataDestroy(data_);
  }
  Opcode(const Opcode&) = delete;
  Opcode& operator=(const Opcode&) = delete;

  bool Touching(const PlainPose& at) {
    const auto& r = at.rotation;
    const dMatrix3 rotation = {r[0][0], r[0][1], r[0][2], 0,       r[1][0], r[1][1],
                               r[1][2], 0,       r[2][0], r[2][1], r[2][2], 0};
    dGeomSetRotation(b_, rotation);
    dGeomSetPosition(b_, at.offset[0], at.offset[1], at.offset[2]);
    dContactGeom contact;
    return dCollide(a_, b_, static_cast<int>(CONTACTS_UNIMPORTANT | 1), &contact, sizeof contact) >
           0;
  }

 private:
  std::vector<double> points_;
  std::vector<dTriIndex> corners_;
  dTriMeshDataID data_;
  dGeomID a_, b_;
};

}  // namespace

PairMethods OdeMesh(const PlainMesh& mesh) {
  const auto opcode = std::make_shared<Opcode>(mesh);
  const auto ask = [opcode](const PlainPose& at) { return Plain(opcode->Touching(at)); };
  return {{.name = "ODE OPCODE",
           .task = Task::kDecision,
           .limited_by = "single precision within OPCODE",
           .ask = ask}};
}

}  // namespace collision::bench
