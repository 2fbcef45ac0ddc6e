// Cases with closed answers, one of each kind.
#include <cmath>
#include <numbers>

#include "tests/bench/pairs/contact_case.h"

namespace collision::bench {
namespace {

constexpr auto Box = MovingBody::Box;
constexpr auto Ball = MovingBody::Ball;

constexpr double kPi = std::numbers::pi;

std::array<double, 4> AboutZ(double angle) {
  return {std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
}

MovingBody Turned(MovingBody body, std::array<double, 4> q) {
  body.q = q;
  return body;
}

/// Both 1e6 m from the origin, and moving at 1e4 m/s.
ContactCase FarAndFast(ContactCase of) {
  of.name += ", far and fast";
  for (MovingBody* body : {&of.a, &of.b}) {
    body->p[0] += 1e6;
    body->v[1] += 1e4;
  }
  return of;
}

void AddCubes(std::vector<ContactCase>* cases) {
  const std::array<double, 3> half{0.5, 0.5, 0.5};
  ContactCase flat{"cubes", Box(half, {}, {}), Box(half, {5, 0, 0}, {-10, 0, 0})};
  flat.begin = 0.4;
  ContactCase turned = flat;
  turned.name = "cubes, one turned 45 deg";
  turned.b = Turned(turned.b, AboutZ(kPi / 4));
  turned.begin = (4.5 - std::sqrt(0.5)) / 10;
  for (const ContactCase& of : {flat, turned}) {
    cases->push_back(of);
    cases->push_back(FarAndFast(of));
  }
}

void AddBars(std::vector<ContactCase>* cases) {
  ContactCase slow{"bar turns into a ball", Box({2, 0.1, 0.1}, {}, {}), Ball(0.2, {0, 1, 0}, {})};
  slow.a.w = {0, 0, 1};
  slow.duration = 2;
  slow.begin = std::acos(0.3);
  cases->push_back(slow);
  ContactCase fast = slow;
  fast.name = "bar turns 350 deg in a step";
  fast.duration = 1;
  fast.a.w = {0, 0, 350 * kPi / 180};
  fast.begin = std::acos(0.3) / fast.a.w[2];
  fast.both_ends = true;
  cases->push_back(fast);
}

void AddFastBalls(std::vector<ContactCase>* cases) {
  for (const double miss : {-0.001, 0.001}) {
    const double aside = 0.5 + miss;
    ContactCase of{
        miss < 0 ? "balls at 10 km a step, hit by 1 mm" : "balls at 10 km a step, miss by 1 mm",
        Ball(0.25, {}, {}), Ball(0.25, {-5000, aside, 0}, {1e4, 0, 0})};
    if (miss < 0) of.begin = (5000 - std::sqrt(0.25 - aside * aside)) / 1e4;
    cases->push_back(of);
  }
}

void AddTouching(std::vector<ContactCase>* cases) {
  const std::array<double, 3> half{0.5, 0.5, 0.5};
  ContactCase rest{"resting", Box(half, {}, {}), Box(half, {0, 0, 1}, {})};
  rest.begin = 0;
  rest.touches_by_nothing = true;
  ContactCase slide = rest, leave = rest, overlap = rest;
  slide.name = "sliding";
  slide.b.v = {0.3, 0, 0};
  leave.name = "leaving contact";
  leave.b.v = {0, 0, 1};
  overlap.name = "starts in overlap";
  overlap.b.p = {0.3, 0.2, 0.5};
  overlap.touches_by_nothing = false;
  for (const ContactCase& of : {rest, slide, leave, overlap}) cases->push_back(of);
}

void AddThin(std::vector<ContactCase>* cases) {
  ContactCase plates{"thin plates, flat on", Box({1, 1, 0.0005}, {}, {}),
                     Box({1, 1, 0.0005}, {0.1, 0.2, 50}, {0, 0, -100})};
  plates.begin = (50 - 0.001) / 100;
  cases->push_back(plates);
  // Two bars across each other, each on its edge.
  ContactCase edges{"edge sweeps through an edge", Box({2, 0.1, 0.1}, {}, {}),
                    Box({0.1, 2, 0.1}, {0, 0, 10}, {0, 0, -20})};
  edges.a.q = {std::cos(kPi / 8), std::sin(kPi / 8), 0, 0};
  edges.b.q = {std::cos(kPi / 8), 0, std::sin(kPi / 8), 0};
  edges.begin = (10 - 0.2 * std::sqrt(2)) / 20;
  cases->push_back(edges);
}

}  // namespace

std::vector<ContactCase> ClosedContactCases() {
  std::vector<ContactCase> cases;
  AddCubes(&cases);
  AddBars(&cases);
  AddFastBalls(&cases);
  AddTouching(&cases);
  AddThin(&cases);
  return cases;
}

}  // namespace collision::bench
