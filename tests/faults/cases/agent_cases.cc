// Agents that change: they jump, are described anew, come and go, and have shapes.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "collision/shape.h"
#include "tests/faults/cases/cases.h"
#include "tests/faults/cases/fleet.h"

namespace collision::faults {
namespace {

constexpr double kCalm = 4, kWild = 12;  ///< Bounds on the acceleration [m/s²].

/// In a cube of this size [m].
server::WanderOptions Wandering(double half_side, bool jumps) {
  return {.half_side = half_side,
          .speed = 8,
          .acceleration_max = kCalm,
          .jumps_per_piece = jumps ? 0.4 : 0,
          .piece_min_ns = 200 * kMillisecond,
          .piece_max_ns = kSecond};
}

/// Faster changes of the velocity between the two instants, three times as wild.
Motion WildBetween(const Motion& calm, std::int64_t from_ns, std::int64_t until_ns) {
  Motion motion = calm;
  for (std::size_t i = 0; i < motion.pieces.size(); ++i) {
    server::Piece& piece = motion.pieces[i];
    if (i > 0) {
      const server::Piece& before = motion.pieces[i - 1];
      const server::Piece at = before.From(before.end_ns);
      piece.p = at.p;
      piece.v = at.v;
    }
    if (from_ns <= piece.start_ns && piece.end_ns <= until_ns) piece.a *= kWild / kCalm;
  }
  return motion;
}

/// One third jumps; one third declares a wider bound and, `lead_ns` later, makes use of it, until
/// it declares a narrower one; one third is removed, and others are added.
std::vector<Flight> Changing(int count, std::int64_t end_ns, std::int64_t lead_ns, Random* random) {
  std::vector<Flight> flights;
  for (int i = 0; i < count; ++i) {
    const server::WanderOptions options = Wandering(7, i % 3 == 0);
    Flight flight{.motion = server::Wander(options, end_ns, random),
                  .radius = random->Uniform(0.4, 1.2),
                  .acceleration_max = kCalm};
    const auto at_ns = static_cast<std::int64_t>(random->Uniform(1, 3) * 1e9);
    if (i % 3 == 1) {
      const std::int64_t until_ns = at_ns + lead_ns + 3 * kSecond;
      flight.changes = {{at_ns, kWild}, {until_ns, kCalm}};
      flight.motion = WildBetween(flight.motion, at_ns + lead_ns, until_ns);
    }
    if (i % 3 == 2) {
      Flight next = flight;
      flight.until_ns = at_ns;
      next.from_ns = at_ns + kSecond;
      next.motion = server::Wander(options, end_ns, random);
      flights.push_back(next);
    }
    flights.push_back(flight);
  }
  return flights;
}

void ReportChanges(const Scene& scene, Outcome* outcome) {
  for (const SimulatorProgram* one : scene.simulators()) {
    outcome->Add("lowered", static_cast<double>(one->lowered()));
    outcome->Add("described_anew", static_cast<double>(one->changes_told()));
    for (const Flown& flown : one->flown()) {
      outcome->Add("jumps", static_cast<double>(flown.flight.motion.jumps_ns.size()));
      outcome->Add("removed", flown.removed_ns == client::kNever ? 0 : 1);
    }
  }
}

/// In lock-step, as on a perfect network; what changed is counted while all are still there.
void FlyChanging(const Fleet& fleet, Outcome* outcome) {
  const auto report = [&](Scene* scene) {
    scene->When(fleet.end_ns - kSecond, [scene, outcome] { ReportChanges(*scene, outcome); });
  };
  FlyAsPerfect(fleet, report, outcome);
}

void ChangesInLockStep(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet{.network = Faulty(seed), .seed = seed};
    // Others are granted time up to a step ahead.
    fleet.flights = [](int count, std::int64_t end_ns, Random* random) {
      return Changing(count, end_ns, kSecond / 2, random);
    };
    FlyChanging(fleet, outcome);
  }
  ExpectContacts(4, outcome);
  outcome->Expect(outcome->Get("lowered") > 0, "no promise was ever lowered");
}

/// Each place is taken by one agent after the other; most of them live for less than a second. One
/// in three jumps.
std::vector<Flight> ShortLived(int count, std::int64_t end_ns, Random* random) {
  std::vector<Flight> flights;
  for (int i = 0; i < count; ++i) {
    const server::WanderOptions options = Wandering(4, i % 3 == 0);
    std::int64_t from_ns = static_cast<std::int64_t>(random->Uniform(0, 1) * 1e9);
    // What counts only after the end of the run is announced by nobody.
    while (from_ns < end_ns - 2 * kSecond) {
      Flight flight{.motion = server::Wander(options, end_ns, random),
                    .radius = random->Uniform(0.4, 1.2),
                    .acceleration_max = kCalm,
                    .from_ns = from_ns};
      flight.until_ns = from_ns + static_cast<std::int64_t>(random->Uniform(0.1, 1.2) * 1e9);
      from_ns = flight.until_ns + static_cast<std::int64_t>(random->Uniform(0.1, 0.5) * 1e9);
      flights.push_back(std::move(flight));
    }
  }
  return flights;
}

/// All of them are granted up to two seconds at once: most come and go within one round.
void ShortLivesInLockStep(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet{.network = Faulty(seed), .seed = seed, .flights = ShortLived};
    fleet.config.mutable_clock()->set_grant_ahead_max_s(2);
    FlyChanging(fleet, outcome);
  }
  ExpectContacts(4, outcome);
  outcome->Expect(outcome->Get("removed") >= 20 * outcome->Get("runs"), "hardly any agent left");
}

void ChangesOnTheWallClock(const std::function<Fleet(std::uint64_t seed)>& make,
                           const JudgeOptions& judge, int runs, Outcome* outcome) {
  for (int i = 0; i < runs; ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet = make(seed);
    // A wider bound counts once all others know, or after the lease and twice the skew.
    fleet.flights = [](int count, std::int64_t end_ns, Random* random) {
      return Changing(count, end_ns, 5 * kSecond / 2, random);
    };
    const auto scene = MakeScene(fleet);
    Fly(fleet, scene.get(), {}, outcome);
    Report(scene->Judged(judge), seed, outcome);
    ExpectAllHeard(scene->monitor(), seed, outcome);
    ReportChanges(*scene, outcome);
    outcome->Expect(scene->service().counter("breaches") == 0,
                    "seed " + std::to_string(seed) + ": an honest agent counts as a breach");
  }
  ExpectContacts(4, outcome);
  outcome->Expect(outcome->Get("lowered") > 0, "no promise was ever lowered");
}

void ChangesAtLeisure(const Setting& setting, Outcome* outcome) {
  ChangesOnTheWallClock(WallFleet, WallJudge(), setting.Many(6, 100), outcome);
}

/// So often, and in so many samples, that some of them replace others which were lost.
void ChangesAtAHighRate(const Setting& setting, Outcome* outcome) {
  const auto make = [](std::uint64_t seed) {
    Fleet fleet = WallFleet(seed);
    fleet.network.loss = 0.3;
    fleet.network.resend_ns = 20 * kMillisecond;
    fleet.streams = true;
    fleet.pace = 8;
    fleet.chunk_size = 1;
    return fleet;
  };
  JudgeOptions judge = WallJudge();
  judge.hearing_ns = 200 * kMillisecond;  // Lost eight times: once in 15,000.
  ChangesOnTheWallClock(make, judge, setting.Many(4, 40), outcome);
  outcome->Expect(outcome->Get("overwritten") > 1000, "hardly any sample was replaced");
}

/// A ball as a solid, and within it a sheet of so many triangles that it is sent in two parts.
std::shared_ptr<const client::Shape> BallWithSheet(double radius) {
  constexpr std::uint32_t kSide = 32;
  client::Geometry geometry{.solids = {client::Solid::Ball(radius)}};
  const double spacing = radius / kSide;
  for (std::uint32_t i = 0; i <= kSide; ++i) {
    for (std::uint32_t j = 0; j <= kSide; ++j) {
      geometry.triangles.vertices_m.push_back({spacing * i - radius / 2, spacing * j - radius / 2});
      if (i == kSide || j == kSide) continue;
      const std::uint32_t at = i * (kSide + 1) + j, right = at + kSide + 1;
      geometry.triangles.indices.push_back({at, right, at + 1});
      geometry.triangles.indices.push_back({at + 1, right, right + 1});
    }
  }
  return client::Shape::Make(std::move(geometry));
}

void Shapes(const Setting& setting, Outcome* outcome) {
  const std::array<double, 3> radii = {0.5, 0.8, 1.1};
  std::array<std::shared_ptr<const client::Shape>, 3> shapes;
  std::transform(radii.begin(), radii.end(), shapes.begin(), BallWithSheet);
  outcome->Expect(shapes[0]->bytes().size() > wire::kShapePartBytes, "a shape is sent in one part");
  for (int i = 0; i < setting.Many(2, 20); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet{.network = Faulty(seed), .seed = seed};
    fleet.flights = [&](int count, std::int64_t end_ns, Random* random) {
      std::vector<Flight> flights = Wanderers(count, end_ns, random);
      for (std::size_t one = 0; one < flights.size(); ++one) {
        flights[one].radius = radii[one % 3];
        flights[one].shape = shapes[one % 3];
      }
      return flights;
    };
    FlyAsPerfect(fleet, {}, outcome);
  }
  ExpectContacts(4, outcome);
}

}  // namespace

std::vector<Case> AgentCases() {
  const std::string promise = "no contact late or unheard, no promise covers one, brackets hold";
  const std::string network =
      "a tenth lost, of samples to the service doubled, up to 5 ms of delay";
  const std::string changes =
      "; agents jump, declare three times the acceleration and use it, declare the old one again, "
      "are removed and added";
  const std::string clocks = "; clocks off by up to 0.9 of 20 ms";
  const std::string within = promise + ", within the bound on clocks";
  return {
      {"agents", "changes-lock-step",
       promise + "; the same events, bit for bit, as on a perfect network", ChangesInLockStep,
       network + changes},
      {"agents", "short-lives-lock-step",
       promise + "; the same events, bit for bit, as on a perfect network", ShortLivesInLockStep,
       network + "; agents jump, and most come and go within one grant of two seconds"},
      {"agents", "shapes-lock-step",
       promise + "; the same events, bit for bit, as on a perfect network", Shapes,
       network + "; each agent has a shape, which is sent in two parts"},
      {"agents", "changes-wall-clock", within, ChangesAtLeisure, network + changes + clocks},
      {"agents", "changes-high-rate", within, ChangesAtAHighRate,
       "three tenths lost and sent again 20 ms later, while each agent writes a sample of its "
       "own every 5 to 31 ms; up to 5 ms of delay" +
           changes + clocks}};
}

}  // namespace collision::faults
