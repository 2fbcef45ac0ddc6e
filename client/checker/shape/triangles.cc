#include "client/checker/shape/triangles.h"

namespace collision::checker {
namespace {

// Whether all corners lie strictly on one side of the plane of `triangle`.
bool Beside(const Triangle& corners, const Triangle& triangle, const Vector& normal) {
  const double first = Dot(normal, corners[0] - triangle[0]);
  for (int i = 1; i < 3; ++i) {
    if (!(first * Dot(normal, corners[i] - triangle[0]) > 0)) return false;
  }
  return true;
}

// Six times the volume of the tetrahedron p q r s.
double Volume(const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
  return Dot(p - s, Cross(q - s, r - s));
}

// Whether the segment passes through the inside of the triangle, from one side to the other.
bool Pierces(const Vector& p, const Vector& q, const Triangle& t) {
  const double above = Volume(t[0], t[1], t[2], p);
  const double below = Volume(t[0], t[1], t[2], q);
  if (!(above * below < 0)) return false;
  const double u = Volume(p, q, t[0], t[1]);
  const double v = Volume(p, q, t[1], t[2]);
  const double w = Volume(p, q, t[2], t[0]);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

bool MayCross(const Triangle& a, const Triangle& b) {
  return !Beside(b, a, Cross(a[1] - a[0], a[2] - a[0])) &&
         !Beside(a, b, Cross(b[1] - b[0], b[2] - b[0]));
}

bool AnEdgePierces(const Triangle& edges, const Triangle& t) {
  return Pierces(edges[0], edges[1], t) || Pierces(edges[1], edges[2], t) ||
         Pierces(edges[2], edges[0], t);
}

double BestMargin(const Triangle& edges, const Triangle& t) {
  double best = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector& p = edges[i];
    const Vector& q = edges[(i + 1) % 3];
    if (!Pierces(p, q, t)) continue;
    double margin = std::min(Squared(NearestPoint(p, t) - p), Squared(NearestPoint(q, t) - q));
    for (int k = 0; k < 3; ++k)
      margin = std::min(margin, SquaredDistance(p, q, t[k], t[(k + 1) % 3]));
    best = std::max(best, margin);
  }
  return best;
}

}  // namespace

// Lumelsky, "On fast computation of distance between line segments", Information Processing
// Letters 21, 1985.
double SquaredDistance(const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
  const Vector d = q - p, e = s - r, w = p - r;
  const double dd = Squared(d), ee = Squared(e), de = Dot(d, e), dw = Dot(d, w), ew = Dot(e, w);
  double u = 0;
  const double denominator = dd * ee - de * de;
  if (denominator > 0) u = std::clamp((de * ew - ee * dw) / denominator, 0.0, 1.0);
  double v = ee > 0 ? (de * u + ew) / ee : 0;
  if (v < 0 || v > 1 || !(denominator > 0)) {
    v = std::clamp(v, 0.0, 1.0);
    u = dd > 0 ? std::clamp((de * v - dw) / dd, 0.0, 1.0) : 0;
  }
  double best = Squared(w + u * d - v * e);
  // Also compare the ends: for nearly parallel segments u and v are inaccurate.
  const auto end = [&](const Vector& point, const Vector& origin, const Vector& along,
                       double length) {
    const double at = length > 0 ? std::clamp(Dot(point - origin, along) / length, 0.0, 1.0) : 0;
    best = std::min(best, Squared(point - origin - at * along));
  };
  if (denominator <= 1e-6 * dd * ee) {
    end(p, r, e, ee);
    end(q, r, e, ee);
    end(r, p, d, dd);
    end(s, p, d, dd);
  }
  return best;
}

// By Voronoi regions: Ericson, "Real-Time Collision Detection", 2005, 5.1.5.
Vector NearestPoint(const Vector& point, const Triangle& t) {
  const Vector ab = t[1] - t[0], ac = t[2] - t[0], ap = point - t[0];
  const double d1 = Dot(ab, ap), d2 = Dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Vector bp = point - t[1];
  const double d3 = Dot(ab, bp), d4 = Dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * ab;
  const Vector cp = point - t[2];
  const double d5 = Dot(ab, cp), d6 = Dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  const double scale = 1 / (va + vb + vc);
  return t[0] + vb * scale * ab + vc * scale * ac;
}

double Distance(const Triangle& a, const Triangle& b) {
  if (MayCross(a, b) && (AnEdgePierces(a, b) || AnEdgePierces(b, a))) return 0;
  double best = INFINITY;
  for (int i = 0; i < 3; ++i) {
    best = std::min(best, Squared(NearestPoint(a[i], b) - a[i]));
    best = std::min(best, Squared(NearestPoint(b[i], a) - b[i]));
    for (int k = 0; k < 3; ++k)
      best = std::min(best, SquaredDistance(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return std::sqrt(best);
}

double CrossingMargin(const Triangle& a, const Triangle& b) {
  if (!MayCross(a, b)) return 0;
  return std::sqrt(std::max(BestMargin(a, b), BestMargin(b, a)));
}

}  // namespace collision::checker
