#include "client/checker/motion/true_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "client/checker/motion/contact_assembly.h"

namespace collision::checker {
namespace {

constexpr std::int64_t kSlab = 250'000'000;  // [ns]: agents move about a box's size in it
constexpr std::int64_t kSlabsMax = 4096;     // longer runs take longer slabs

struct Box {
  double lower[3] = {INFINITY, INFINITY, INFINITY};
  double upper[3] = {-INFINITY, -INFINITY, -INFINITY};

  void Include(int axis, double x) {
    lower[axis] = std::min(lower[axis], x);
    upper[axis] = std::max(upper[axis], x);
  }
};

// The box of the piece's Bézier points contains the piece; widened for their rounding.
void Include(const Piece& piece, double radius, Box* box) {
  const double h = static_cast<double>(piece.t1_ns - piece.t0_ns) * 1e-9;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = piece.p_WA[axis];
    const double p1 = c[0] + c[1] * h / 3;
    const double p2 = c[0] + 2 * c[1] * h / 3 + c[2] * h * h / 3;
    const double p3 = c[0] + h * (c[1] + h * (c[2] + h * c[3]));
    for (const double p : {c[0], p1, p2, p3}) {
      const double margin = radius + 1e-9 * (1 + std::fabs(p));
      box->Include(axis, p - margin);
      box->Include(axis, p + margin);
    }
  }
}

bool Overlap(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
  }
  return true;
}

// An agent's pieces within one slab of time.
struct Slice {
  std::size_t agent = 0;
  const Piece* begin = nullptr;
  const Piece* end = nullptr;
  Box box;
};

// One piece of an agent's motion.
struct AgentPiece {
  std::size_t agent;
  const Piece& piece;
};

// Bodies with a shape are evaluated while their balls, a little enlarged [m, and share of their
// size], overlap: the shapes decide about contact.
constexpr long double kBallSpare = 1e-9L;

class ContactFinder {
 public:
  ContactFinder(const std::vector<AgentMotion>& motions, const MayMeet& may_meet)
      : motions_(motions), may_meet_(may_meet) {}

  std::vector<TrueContact> Find() {
    std::int64_t begin = std::numeric_limits<std::int64_t>::max();
    std::int64_t end = std::numeric_limits<std::int64_t>::min();
    for (const AgentMotion& motion : motions_) {
      begin = std::min(begin, motion.begin_ns());
      end = std::max(end, motion.end_ns());
    }
    const std::int64_t width =
        motions_.empty() ? kSlab : std::max(kSlab, (end - begin) / kSlabsMax);
    for (std::int64_t t = begin; t < end; t += width) SearchSlab(t, std::min(end, t + width));
    return Finish();
  }

 private:
  void SearchSlab(std::int64_t s0, std::int64_t s1) {
    std::vector<Slice> slices;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const auto& pieces = motions_[i].pieces;
      const auto first = std::partition_point(pieces.begin(), pieces.end(),
                                              [&](const Piece& p) { return p.t1_ns <= s0; });
      const auto last =
          std::partition_point(first, pieces.end(), [&](const Piece& p) { return p.t0_ns < s1; });
      if (first == last) continue;
      Slice slice{i, &*first, &*first + (last - first), {}};
      const double reach = motions_[i].half_space ? std::numeric_limits<double>::infinity()
                                                  : motions_[i].radius_m + motions_[i].margin_m;
      for (const Piece* p = slice.begin; p != slice.end; ++p) Include(*p, reach, &slice.box);
      slices.push_back(slice);
    }
    // Compare only agents whose boxes overlap along x.
    std::stable_sort(slices.begin(), slices.end(), [](const Slice& x, const Slice& y) {
      return x.box.lower[0] < y.box.lower[0];
    });
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const Slice& a = slices[i];
      for (std::size_t j = i + 1; j < slices.size(); ++j) {
        const Slice& b = slices[j];
        if (b.box.lower[0] > a.box.upper[0]) break;
        if (!Overlap(a.box, b.box)) continue;
        if (!CanMeet(motions_[a.agent], motions_[b.agent])) continue;
        if (a.agent < b.agent) {
          SearchPair(a, b, s0, s1);
        } else {
          SearchPair(b, a, s0, s1);
        }
      }
    }
  }

  bool CanMeet(const AgentMotion& a, const AgentMotion& b) const {
    return !a.IsOfOneAssemblyWith(b) && !(a.half_space && b.half_space) && may_meet_(a, b);
  }

  void SearchPair(const Slice& a, const Slice& b, std::int64_t s0, std::int64_t s1) {
    const Piece* pa = a.begin;
    const Piece* pb = b.begin;
    while (pa != a.end && pb != b.end) {
      const std::int64_t from = std::max({pa->t0_ns, pb->t0_ns, s0});
      const std::int64_t to = std::min({pa->t1_ns, pb->t1_ns, s1});
      if (from < to) SearchPieces({a.agent, *pa}, {b.agent, *pb}, from, to);
      if (pa->t1_ns <= pb->t1_ns) {
        ++pa;
      } else {
        ++pb;
      }
    }
  }

  void SearchPieces(const AgentPiece& a, const AgentPiece& b, std::int64_t from, std::int64_t to) {
    const Body body_a = motions_[a.agent].body();
    const Body body_b = motions_[b.agent].body();
    const bool balls = !body_a.HasShape() && !body_b.HasShape();  // or half-spaces
    const PairMotion motion(a.piece, b.piece, from);
    const long double reach = static_cast<long double>(body_a.reach()) + body_b.reach();
    const long double duration = static_cast<long double>(to - from) * 1e-9L;
    const long double spare = balls ? 0 : kBallSpare * (1 + reach);
    const auto instant = [&](long double seconds) { return from + seconds * 1e9L; };
    for (const Span& span : SpansOfBalls(body_a, body_b, motion, duration, reach + spare)) {
      ContactAssembly& pair = pairs_[{a.agent, b.agent}];
      pair.AddBalls(instant(span.begin), instant(span.end));
      if (balls) {
        pair.Add(Stretch::Kind::kContact, true, instant(span.begin), instant(span.end));
        continue;
      }
      for (const Stretch& s : StretchesOf(body_a, body_b, motion, span.begin, span.end))
        pair.Add(s.kind, s.deep, instant(s.begin), instant(s.end));
    }
  }

  // A half-space is reached by what comes as near to its plane.
  static std::vector<Span> SpansOfBalls(const Body& a, const Body& b, const PairMotion& motion,
                                        long double duration, long double reach) {
    const Body& flat = a.half_space != nullptr ? a : b;
    if (flat.half_space == nullptr) return SpansWithin(motion.difference(), duration, reach);
    const long double sign = a.half_space != nullptr ? 1 : -1;
    std::array<long double, 4> height{};
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 4; ++i)
        height[i] += sign * flat.half_space->normal[axis] * motion.difference()[axis][i];
    }
    return SpansBelow(height, duration, flat.half_space->offset_m + flat.grown_m + reach);
  }

  std::vector<TrueContact> Finish() {
    std::vector<TrueContact> all;
    for (auto& [pair, assembly] : pairs_) {
      const AgentMotion& a = motions_[pair.first];
      const AgentMotion& b = motions_[pair.second];
      const auto start = static_cast<long double>(std::max(a.begin_ns(), b.begin_ns()));
      const auto end = static_cast<long double>(std::min(a.end_ns(), b.end_ns()));
      const auto contacts = assembly.Contacts(pair.first, pair.second, start, end);
      all.insert(all.end(), contacts.begin(), contacts.end());
    }
    std::stable_sort(all.begin(), all.end(), [](const TrueContact& x, const TrueContact& y) {
      return x.begin_ns < y.begin_ns;
    });
    return all;
  }

  const std::vector<AgentMotion>& motions_;
  const MayMeet& may_meet_;
  std::map<std::pair<std::size_t, std::size_t>, ContactAssembly> pairs_;
};

}  // namespace

std::vector<TrueContact> TrueContacts(const std::vector<AgentMotion>& motions,
                                      const MayMeet& may_meet) {
  return ContactFinder(motions, may_meet).Find();
}

}  // namespace collision::checker
