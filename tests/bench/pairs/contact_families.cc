// Families of cases with closed answers: error against time.
#include <cmath>
#include <numbers>

#include "tests/bench/pairs/contact_case.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 33;
constexpr int kGrazes = 10;
constexpr double kSlack = 1e-15;

using Wide = long double;
using Triple = MovingBody::Triple;

Triple Plain(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Triple InBox(Random& random, const Triple& half) {
  Triple p;
  for (int i = 0; i < 3; ++i) p[i] = random.Uniform(-half[i], half[i]);
  return p;
}

/// When boxes along the axes begin to overlap, given that they do.
Wide BoxesBegin(const ContactCase& of) {
  Wide begin = 0;
  for (int i = 0; i < 3; ++i) {
    const Wide between = Wide(of.b.p[i]) - of.a.p[i], speed = Wide(of.b.v[i]) - of.a.v[i];
    const Wide gap = std::abs(between) - (Wide(of.a.half[i]) + of.b.half[i]);
    if (gap > 0) begin = std::max(begin, gap / std::abs(speed));
  }
  return begin;
}

/// Likewise of balls: the smaller root.
Wide BallsBegin(const ContactCase& of) {
  Wide square = 0, along = 0, speed = 0;
  for (int i = 0; i < 3; ++i) {
    const Wide p = Wide(of.b.p[i]) - of.a.p[i], v = Wide(of.b.v[i]) - of.a.v[i];
    square += p * p, along += p * v, speed += v * v;
  }
  const Wide reach = Wide(of.a.half[0]) + of.b.half[0];
  const Wide gap = square - reach * reach;
  return gap / (-along + std::sqrt(along * along - speed * gap));
}

/// B meets A `at` seconds after the start at about this place.
void LetMeet(Random& random, const Triple& place, const Triple& velocity, ContactCase* of) {
  const double at = random.Uniform(0.3, 0.8);
  of->a.p = InBox(random, {2, 2, 2});
  of->a.v = InBox(random, {3, 3, 3});
  for (int i = 0; i < 3; ++i) {
    of->b.v[i] = of->a.v[i] + velocity[i];
    of->b.p[i] = of->a.p[i] + place[i] - velocity[i] * at;
  }
}

Triple Velocity(Random& random, double speed) { return Plain(speed * random.UnitVector()); }

ContactCase MeetingBoxes(Random& random, bool plates) {
  for (;;) {
    ContactCase of;
    const auto half = [&]() -> Triple {
      if (plates) return {1, 1, 0.0005};
      const double x = random.Uniform(0.2, 0.6), y = random.Uniform(0.2, 0.6);
      return {x, y, random.Uniform(0.2, 0.6)};
    };
    of.a = MovingBody::Box(half()), of.b = MovingBody::Box(half());
    Triple place;
    for (int i = 0; i < 3; ++i) place[i] = 0.6 * (of.a.half[i] + of.b.half[i]);
    place = InBox(random, place);
    Triple velocity = Velocity(random, random.Uniform(5, 20));
    if (plates) velocity = {random.Uniform(-1, 1), random.Uniform(-1, 1), -100};
    LetMeet(random, place, velocity, &of);
    of.begin = static_cast<double>(BoxesBegin(of));
    if (*of.begin > 0.05) return of;
  }
}

ContactCase MeetingBalls(Random& random, double speed) {
  for (;;) {
    ContactCase of;
    of.a = MovingBody::Ball(random.Uniform(0.2, 0.6)),
    of.b = MovingBody::Ball(random.Uniform(0.2, 0.6));
    const double reach = 0.3 * (of.a.half[0] + of.b.half[0]);
    const Triple place = InBox(random, {reach, reach, reach});
    LetMeet(random, place, Velocity(random, speed), &of);
    of.begin = static_cast<double>(BallsBegin(of));
    if (*of.begin > 0.05) return of;
  }
}

/// A bar about z, a ball beside it: its side comes to the ball. Half a turn in the step at most.
ContactCase TurningBar(Random& random) {
  ContactCase of;
  const double length = random.Uniform(1, 2), half = random.Uniform(0.05, 0.15);
  of.a = MovingBody::Box({length, half, half});
  of.b = MovingBody::Ball(random.Uniform(0.1, 0.3));
  const double reach = half + of.b.half[0];
  const double away = random.Uniform(1.2 * reach, 0.8 * length);
  of.b.p = {0, away, 0};
  const Wide angle = std::acos((Wide(half) + of.b.half[0]) / Wide(away));
  of.a.w = {0, 0, static_cast<double>(angle) / random.Uniform(0.5, 0.9)};
  of.begin = static_cast<double>(angle / of.a.w[2]);
  return of;
}

/// A cube about z above a plate: its edge comes to the plate.
ContactCase TurningCube(Random& random) {
  ContactCase of;
  const double half = random.Uniform(0.3, 0.6);
  of.a = MovingBody::Box({half, half, half});
  of.b = MovingBody::Box({2, 0.0625, 2});
  of.b.p = {0, -half * random.Uniform(1.05, 1.35) - 0.0625, 0};
  const Wide height = -Wide(of.b.p[1]) - 0.0625L;
  const Wide angle =
      std::numbers::pi_v<Wide> / 4 - std::acos(height / (Wide(half) * std::sqrt(Wide(2))));
  of.a.w = {0, 0, static_cast<double>(angle) / random.Uniform(0.5, 0.9)};
  of.begin = static_cast<double>(angle / of.a.w[2]);
  return of;
}

/// By how much of the size they graze, and on which side.
double Graze(std::size_t index) {
  const double by = std::pow(10.0, -3 - static_cast<int>(index / 2 % kGrazes));
  return index % 2 == 0 ? by : -by;
}

ContactCase PassingBalls(double by) {
  ContactCase of;
  of.a = MovingBody::Ball(0.25), of.b = MovingBody::Ball(0.375);
  const double aside = 0.625 * (1 - by);
  // Not nearest in any frame of the steppers.
  of.b.p = {-4.8713, aside, 0}, of.b.v = {10, 0, 0};
  const Wide reach = 0.625L;
  if (by > 0) {
    of.begin = static_cast<double>(
        (-Wide(of.b.p[0]) - std::sqrt((reach - Wide(aside)) * (reach + Wide(aside)))) / 10);
  }
  return of;
}

/// Contact begins while the edge is the nearest part of the cube, at an angle φ before it points at
/// the ball: 4 ρ d sin²(φ/2) = r² − (d − ρ)².
ContactCase PassingEdge(double by, double* slack) {
  ContactCase of;
  of.a = MovingBody::Box({0.5, 0.5, 0.5}), of.b = MovingBody::Ball(0.3);
  const Wide edge = std::sqrt(Wide(0.5)), radius = Wide(0.3);
  const double away = static_cast<double>(radius + edge * (1 - Wide(by)));
  of.b.p = {0, away, 0};
  of.a.w = {0, 0, 1.2};
  if (by <= 0) return of;
  const Wide overlap = Wide(of.b.half[0]) + edge - Wide(away);
  const Wide square = overlap * (Wide(of.b.half[0]) + Wide(away) - edge) / (4 * edge * Wide(away));
  const Wide angle = 2 * std::asin(std::sqrt(square));
  of.begin = static_cast<double>((std::numbers::pi_v<Wide> / 4 - angle) / Wide(of.a.w[2]));
  // The edge is known to 2^-64.
  *slack += 1e-18 / static_cast<double>(angle);
  return of;
}

template <typename Draw>
ContactFamily Family(Motion motion, const std::string& name, std::size_t count, const Draw& draw) {
  ContactFamily family{motion, name, {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    double slack = kSlack;
    family.cases.push_back(draw(i, &slack));
    family.cases.back().name = name;
    family.slack.push_back(slack);
  }
  return family;
}

}  // namespace

std::vector<ContactFamily> ContactFamilies(std::size_t count) {
  Random random(kSeed);
  const auto drawn = [&random](ContactCase (*draw)(Random&)) {
    return [&random, draw](std::size_t, double*) { return draw(random); };
  };
  const std::size_t grazes = std::max<std::size_t>(count, 2 * kGrazes);
  return {Family(Motion::kTranslation, "boxes", count,
                 drawn([](Random& of) { return MeetingBoxes(of, false); })),
          Family(Motion::kTranslation, "balls", count,
                 drawn([](Random& of) { return MeetingBalls(of, 10); })),
          Family(Motion::kTranslation, "balls at 10 km/s", count,
                 drawn([](Random& of) { return MeetingBalls(of, 1e4); })),
          Family(Motion::kTranslation, "plates", count,
                 drawn([](Random& of) { return MeetingBoxes(of, true); })),
          Family(Motion::kRotation, "bar into ball", count, drawn(TurningBar)),
          Family(Motion::kRotation, "cube's edge into plate", count, drawn(TurningCube)),
          Family(Motion::kGrazing, "balls that pass", grazes,
                 [](std::size_t i, double*) { return PassingBalls(Graze(i)); }),
          Family(Motion::kGrazing, "cube's edge past ball", grazes,
                 [](std::size_t i, double* slack) { return PassingEdge(Graze(i), slack); })};
}

}  // namespace collision::bench
