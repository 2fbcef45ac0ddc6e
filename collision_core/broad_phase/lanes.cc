#include "collision_core/broad_phase/lanes.h"

namespace collision {
namespace {

// Its square is infinite, and reaches that are as large find everybody, as they should.
constexpr float kFarAway = 1e30f;

// Up, by more than a conversion to single precision takes.
float Up(double x) { return static_cast<float>(x) * (1 + 0x1p-22f); }

void SetTimes(const Placing& placing, Stretch stretch, LaneQuery* query) {
  query->first = static_cast<float>(stretch.first - placing.middle());
  query->last = static_cast<float>(stretch.last - placing.middle());
  query->time = Up(stretch.last);
}

}  // namespace

void Lanes::Resize(std::uint32_t size) {
  for (std::vector<float>* array : {&x_, &y_, &z_, &vx_, &vy_, &vz_, &speed_, &s0_, &s1_, &s2_}) {
    array->resize(size + kLanesMax, 0);
  }
  agents_.resize(size, kNobody);
}

LaneView Lanes::view() const {
  return {x_.data(),  y_.data(),  z_.data(),  vx_.data(), vy_.data(),
          vz_.data(), s0_.data(), s1_.data(), s2_.data()};
}

void Lanes::Vacate(std::uint32_t k) {
  x_[k] = kFarAway;
  agents_[k] = kNobody;
}

LaneQuery Lanes::QueryOf(std::uint32_t k, const Placing& placing, Stretch stretch) const {
  const double x = stretch.last;
  LaneQuery query{vx_[k], vy_[k], vz_[k], Up(s0_[k] + x * (s1_[k] + x * s2_[k])), 0, 0, 0};
  SetTimes(placing, stretch, &query);
  return query;
}

float Lanes::Reach(std::uint32_t k, const Placing& placing, Stretch stretch) const {
  const struct { float s0, s1, s2, speed; } horn{s0_[k], s1_[k], s2_[k], speed_[k]};
  return Up(placing.Reach(horn, stretch));
}

LaneQuery QueryOf(const PlacedHorn& horn, const Placing& placing, Stretch stretch) {
  const double x = stretch.last;
  LaneQuery query{horn.v[0], horn.v[1], horn.v[2], Up(horn.s0 + x * (horn.s1 + x * horn.s2)),
                  0,         0,         0};
  SetTimes(placing, stretch, &query);
  return query;
}

void ScanInto(const Lanes& lanes, const LaneQuery& query, const std::vector<LaneRange>& ranges,
              std::vector<std::uint32_t>* hits, std::vector<std::uint32_t>* agents) {
  std::size_t room = kLanesMax;
  for (const LaneRange& range : ranges) room += range.end - range.begin;
  if (hits->size() < room) hits->resize(room);
  static const LaneScan scan = WidestLaneScan();
  const std::uint32_t count = scan(lanes.view(), query, ranges.data(),
                                   static_cast<std::uint32_t>(ranges.size()), hits->data());
  for (std::uint32_t hit = 0; hit < count; ++hit) {
    const std::uint32_t agent = lanes.agent((*hits)[hit]);
    if (agent != Lanes::kNobody) agents->push_back(agent);
  }
}

}  // namespace collision
