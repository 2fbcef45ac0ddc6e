// The time of contact of two large meshes: how time and work are distributed.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/bench/harness/measure.h"
#include "tests/bench/narrow_phase/parts.h"
#include "tests/bench/pairs/contact_ours.h"
#include "tests/bench/pairs/peers.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 9;

/// As narrow as the libraries are asked for, of the step of 1 s.
constexpr narrow_phase::ContactTolerance kTolerance{1e-4, 0};

/// FCL's advancement has no other end where it makes no progress [s].
constexpr double kCutOff = 5;

/// Two bodies of one mesh, turning, in a step of 1 s that brings one past the middle of the other,
/// up to 1.2 diameters aside: some meet, some pass by.
ContactCase MeshCase(const std::shared_ptr<const PlainMesh>& mesh, double diameter,
                     Random& random) {
  ContactCase of;
  const auto plain = [](const Eigen::Vector3d& v) {
    return std::array<double, 3>{v.x(), v.y(), v.z()};
  };
  for (MovingBody* body : {&of.a, &of.b}) {
    body->kind = MovingBody::Kind::kMesh;
    body->mesh = mesh;
    const Eigen::Vector3d axis = random.UnitVector();
    const double angle = random.Uniform(0, std::numbers::pi);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, axis));
    body->q = {q.w(), q.x(), q.y(), q.z()};
    body->w = plain(random.Uniform(0, 2) * random.UnitVector());
  }
  const Eigen::Vector3d towards = random.UnitVector();
  const Eigen::Vector3d across = towards.cross(random.UnitVector()).normalized();
  const Eigen::Vector3d aside = random.Uniform(0, 1.2) * diameter * across;
  of.b.p = plain(1.2 * diameter * towards + aside);
  of.b.v = plain(-1.2 * diameter * towards);
  return of;
}

/// The result of a library for one step, run in a process of its own.
struct LibraryStep {
  bool ended = false;
  double seconds = 0;
  std::optional<double> begin;
};

LibraryStep StepOf(const ContactMethod& library, const ContactCase& of) {
  const ContactQuery ask = library.make(of);
  const ApartResult result = RunApart(kCutOff, [&] {
    const CpuStopwatch watch;
    const auto begin = ask().begin();
    return std::vector<double>{watch.seconds(), begin ? 1.0 : 0.0, begin.value_or(0)};
  });
  if (result.status != ApartStatus::kDone) return {};
  LibraryStep reply{true, result.values[0], std::nullopt};
  if (result.values[1] != 0) reply.begin = result.values[2];
  return reply;
}

/// All steps, ours.
struct OurSteps {
  std::vector<narrow_phase::TimeOfContactResult> found;
  std::vector<double> seconds, work;

  std::string Text() const {
    std::size_t contacts = 0, undecided = 0;
    for (const narrow_phase::TimeOfContactResult& one : found) {
      contacts += one.status == narrow_phase::ContactStatus::kContact;
      undecided += one.status == narrow_phase::ContactStatus::kUndecided;
    }
    return std::to_string(found.size()) + " steps, " + std::to_string(contacts) + " contacts, " +
           std::to_string(undecided) + " undecided; p90 " + SecondsText(Quantile(seconds, 0.9)) +
           ", most " + SecondsText(Quantile(seconds, 1)) +
           Format("; work p50 %.3g,", Median(work)) + Format(" p90 %.3g,", Quantile(work, 0.9)) +
           Format(" most %.3g units", Quantile(work, 1));
  }
};

OurSteps RunOurs(const std::vector<ContactCase>& cases, const ContactShapes& shapes) {
  OurSteps steps;
  for (const ContactCase& of : cases) {
    double least = std::numeric_limits<double>::infinity();
    narrow_phase::TimeOfContactResult found;
    for (int i = 0; i < 2; ++i) {
      const CpuStopwatch watch;
      found = OurContact(of, shapes, kTolerance);
      least = std::min(least, watch.seconds());
    }
    steps.found.push_back(found);
    steps.seconds.push_back(least);
    steps.work.push_back(static_cast<double>(found.work));
  }
  return steps;
}

/// Only steps count in which both give the same answer.
void RunLibrary(const std::vector<ContactCase>& cases, const ContactMethod& library,
                const OurSteps& ours, NarrowRow row, NarrowReport* report) {
  std::vector<double> all, theirs, own;
  std::size_t missed = 0, endless = 0, other = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const narrow_phase::TimeOfContactResult& found = ours.found[i];
    const LibraryStep reply = StepOf(library, cases[i]);
    endless += !reply.ended;
    if (!reply.ended) continue;
    all.push_back(reply.seconds);
    std::optional<double> begin;
    if (found.status == narrow_phase::ContactStatus::kContact) begin = found.begin.upper;
    const bool right = found.status != narrow_phase::ContactStatus::kUndecided &&
                       IsRight(reply.begin, begin, cases[i].duration);
    missed += !right && begin && !reply.begin;
    other += !right && reply.begin;
    if (right) theirs.push_back(reply.seconds), own.push_back(ours.seconds[i]);
  }
  row.contestant = library.name;
  if (!all.empty()) row.warm = Median(all);
  row.remark = "right in " + std::to_string(theirs.size()) + " of " + std::to_string(cases.size()) +
               " steps; misses " + std::to_string(missed) + " contacts, reports " +
               std::to_string(other) + " at a wrong time, does not end in " +
               std::to_string(endless) + Format(" within %g s", kCutOff);
  if (!theirs.empty()) {
    const double ratio = Median(theirs) / Median(own);
    row.remark += Format("; where it is right it takes %.3g times ours", ratio);
    report->Figure("contact_vs_fcl_ca_worst", ratio);
  }
  report->Add(std::move(row));
}

}  // namespace

void ContactPart(const NarrowSettings& settings, NarrowReport* report) {
  const BenchMesh mesh = ContestMeshes(settings.data_dir, true).back();
  NarrowRow row = RowOf("contact", mesh, "ours");
  if (!settings.Wants(row.path())) return;
  const auto plain = std::make_shared<const PlainMesh>(PlainOf(mesh.mesh));
  Random random(kSeed);
  std::vector<ContactCase> cases;
  for (std::size_t i = 0; i < settings.contacts(); ++i) {
    cases.push_back(MeshCase(plain, mesh.diameter(), random));
  }
  const auto shape = ShapeOf(cases.front().a);
  const OurSteps ours = RunOurs(cases, {shape, shape});
  row.warm = Median(ours.seconds);
  row.remark = ours.Text();
  report->Add(row);
  report->Figure("contact_work_max", Quantile(ours.work, 1));
  for (const ContactMethod& library : ContactPeers()) {
    if (library.make(cases.front())) RunLibrary(cases, library, ours, row, report);
  }
}

}  // namespace collision::bench
