#include "tests/fuzz/ballistic_truth.h"

#include <algorithm>

namespace collision::fuzz {
namespace {

using Wide = __float128;  // 113 bits

constexpr double kShare = 0x1p-90;  // of all that is compared: far above its own rounding

struct Line {
  Wide p[3];  // of b relative to a
  Wide v[3];
  Wide size[3];  // of what was subtracted
};

Wide SecondsFrom(Instant from, Instant to) {
  return (Wide(to.nanoseconds()) - Wide(from.nanoseconds())) / Wide(1e9);
}

Wide Magnitude(Wide x) { return x < 0 ? -x : x; }

/// B relative to A at `t`.
Line RelativeAt(const Ballistic& a, const Ballistic& b, Instant t) {
  const Wide sa = SecondsFrom(a.state.stamp, t), sb = SecondsFrom(b.state.stamp, t);
  Line line{};
  for (int i = 0; i < 3; ++i) {
    const Wide pa = Wide(a.state.p_WA[i]) + Wide(a.state.v_WA[i]) * sa;
    const Wide pb = Wide(b.state.p_WA[i]) + Wide(b.state.v_WA[i]) * sb;
    line.p[i] = pb - pa;
    line.v[i] = Wide(b.state.v_WA[i]) - Wide(a.state.v_WA[i]);
    line.size[i] = Magnitude(Wide(a.state.p_WA[i])) + Magnitude(Wide(b.state.p_WA[i])) +
                   Magnitude(Wide(a.state.v_WA[i]) * sa) + Magnitude(Wide(b.state.v_WA[i]) * sb);
  }
  return line;
}

/// |distance of centres|² − (radii)², and what rounding can be of it.
struct Excess {
  Wide value = 0;
  Wide error = 0;
};

Excess ExcessAt(const Ballistic& a, const Ballistic& b, Instant t) {
  const Line line = RelativeAt(a, b, t);
  const Wide reach = Wide(a.radius) + Wide(b.radius);
  Excess excess{.value = -reach * reach, .error = reach * reach};
  for (int i = 0; i < 3; ++i) {
    excess.value += line.p[i] * line.p[i];
    excess.error += line.size[i] * (Magnitude(line.p[i]) + line.size[i] * kShare);
  }
  excess.error *= kShare;
  return excess;
}

}  // namespace

bool CertainlyOverlap(const Ballistic& a, const Ballistic& b, Instant t) {
  const Excess excess = ExcessAt(a, b, t);
  return excess.value < -excess.error;
}

bool CertainlyApart(const Ballistic& a, const Ballistic& b, Instant t) {
  const Excess excess = ExcessAt(a, b, t);
  return excess.value > excess.error;
}

Instant NearestWithin(const Ballistic& a, const Ballistic& b, Instant from, Instant until) {
  const Line line = RelativeAt(a, b, from);
  Wide along = 0, square = 0;
  for (int i = 0; i < 3; ++i) {
    along -= line.p[i] * line.v[i];
    square += line.v[i] * line.v[i];
  }
  if (square == 0 || along <= 0) return from;
  const Wide ns = Wide(from.nanoseconds()) + along / square * Wide(1e9);
  if (ns >= Wide(until.nanoseconds())) return until;
  return Instant::FromNanoseconds(static_cast<std::int64_t>(ns));
}

}  // namespace collision::fuzz
