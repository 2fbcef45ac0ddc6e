#include "collision_core/broad_phase/all_pairs.h"

#include <algorithm>
#include <cmath>

namespace collision {
namespace {

// What two positions, as seen from a corner so far away, lose in single precision.
float LostAt(const double* offset) {
  return static_cast<float>((std::abs(offset[0]) + std::abs(offset[1]) + std::abs(offset[2])) *
                            0x1p-22);
}

}  // namespace

void AllPairs::PlaceAll() {
  lanes_.Resize(table().size());
  bool first = true;
  for (std::uint32_t agent = 0; agent < table().size(); ++agent) {
    lanes_.Vacate(agent);
    if (!table().contains(agent) || table().row(agent).wild || placing_.blind()) continue;
    if (first) std::copy_n(placing_.Place(table(), agent).c, 3, corner_);
    first = false;
    PlaceOne(agent);
  }
}

void AllPairs::PlaceOne(std::uint32_t agent) {
  if (lanes_.size() <= agent) lanes_.Resize(agent + 1);
  const PlacedHorn horn = placing_.Place(table(), agent);
  const double offset[3] = {horn.c[0] - corner_[0], horn.c[1] - corner_[1], horn.c[2] - corner_[2]};
  lanes_.Set(agent, horn, corner_, LostAt(offset));
}

void AllPairs::Unplace(std::uint32_t agent) { lanes_.Vacate(agent); }

void AllPairs::Scan(const LaneQuery& query, const LaneRange& range) {
  work_.filter_tests += range.end - range.begin;
  ++work_.visits;
  ranges_.assign(1, range);
  ScanInto(lanes_, query, ranges_, &hits_, &near_);
}

void AllPairs::Join(Stretch stretch, BestMeeting* best) {
  for (std::uint32_t agent = 0; agent < lanes_.size(); ++agent) {
    if (lanes_.agent(agent) == Lanes::kNobody) continue;
    near_.clear();
    stretch.last = std::min(stretch.last, std::max(stretch.first, best->limit()));
    Scan(lanes_.QueryOf(agent, placing_, stretch),
         {agent + 1, lanes_.size(), lanes_.x()[agent], lanes_.y()[agent], lanes_.z()[agent]});
    for (const std::uint32_t other : near_) best->Offer(agent, other);
  }
}

void AllPairs::FindNear(const PlacedHorn& horn, Stretch stretch) {
  LaneRange all{0, lanes_.size(), 0, 0, 0};
  float* const at[3] = {&all.x, &all.y, &all.z};
  double offset[3];
  for (int axis = 0; axis < 3; ++axis) {
    offset[axis] = horn.c[axis] - corner_[axis];
    *at[axis] = static_cast<float>(offset[axis]);
  }
  LaneQuery query = QueryOf(horn, placing_, stretch);
  query.reach += LostAt(offset);
  Scan(query, all);
  if (stretch.first > placing_.window()) wasted_ += near_.size();
}

}  // namespace collision
