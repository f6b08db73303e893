#include "fem/disc_quadrature.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/gauss_rule.hpp"

namespace thinwall::fem {

namespace {

using Corners = Eigen::Matrix<double, 2, 3>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A straight piece of the boundary, from p to q.
struct Segment {
  Eigen::Vector2d p, q;
};

/// An arc of the circle about the origin, from an angle through a positive one (rad).
struct Arc {
  double from = 0.0, through = 0.0;
};

/// The boundary of the intersection of a triangle and a disc, and a point inside.
struct Boundary {
  std::vector<Segment> segments;
  std::vector<Arc> arcs;
  bool cut = false;  ///< false if the whole triangle lies in the disc
  Eigen::Vector2d inside = Eigen::Vector2d::Zero();
};

Eigen::Vector2d on_circle(double radius, double angle) {
  return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// The part of the segment from a to b in the disc: |a + t (b − a)| = R has the roots t = (−a·d ± √D) / d·d with
/// D = (a·d)² − d·d (a·a − R²) = d·d R² − (a × d)², of which the second form does not cancel.
std::optional<Segment> inside_disc(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius) {
  const Eigen::Vector2d d = b - a;
  const double dd = d.squaredNorm();
  const double off = cross(a, d);
  const double D = dd * radius * radius - off * off;
  if (D <= 0.0) return {};
  const double from = std::max(0.0, (-a.dot(d) - std::sqrt(D)) / dd);
  const double to = std::min(1.0, (-a.dot(d) + std::sqrt(D)) / dd);
  if (to - from < 1e-12) return {};
  return Segment{from == 0.0 ? a : Eigen::Vector2d(a + from * d), to == 1.0 ? b : Eigen::Vector2d(a + to * d)};
}

/// True if x lies in the triangle, whose corners rotate counter-clockwise.
bool contains(const Corners& corners, const Eigen::Vector2d& x) {
  for (int e = 0; e < 3; ++e) {
    const Eigen::Vector2d a = corners.col(e), b = corners.col((e + 1) % 3);
    if (cross(b - a, x - a) < 0.0) return false;
  }
  return true;
}

/// The boundary for corners that rotate counter-clockwise. Where one segment does not begin at the end of the one
/// before, the circle leads from there to here.
Boundary boundary_of(const Corners& corners, double radius) {
  Boundary boundary;
  for (int e = 0; e < 3; ++e)
    if (const auto s = inside_disc(corners.col(e), corners.col((e + 1) % 3), radius)) boundary.segments.push_back(*s);
  const std::size_t count = boundary.segments.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d &end = boundary.segments[i].q, &begin = boundary.segments[(i + 1) % count].p;
    if (end == begin) continue;
    const double from = std::atan2(end.y(), end.x());
    double through = std::atan2(begin.y(), begin.x()) - from;
    if (through <= 0.0) through += 2.0 * std::numbers::pi;
    // Beside a corner on the circle round-off may reverse an arc of no length, which then seems to be the whole circle.
    if (contains(corners, on_circle(radius, from + 0.5 * through))) boundary.arcs.push_back({from, through});
  }
  if (count == 0 && contains(corners, Eigen::Vector2d::Zero())) boundary.arcs.push_back({0.0, 2.0 * std::numbers::pi});
  boundary.cut = count < 3 || !boundary.arcs.empty();
  for (const Segment& s : boundary.segments) boundary.inside += 0.5 * (s.p + s.q);
  for (const Arc& arc : boundary.arcs)
    if (count > 0) boundary.inside += on_circle(radius, arc.from + 0.5 * arc.through);
  if (count > 0) boundary.inside /= static_cast<double>(count + boundary.arcs.size());
  return boundary;
}

/// Points and their areas, as they are collected.
struct Samples {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> areas;

  void add(const Eigen::Vector2d& x, double area) {
    points.push_back(x);
    areas.push_back(area);
  }
};

void add_triangle(const Eigen::Vector2d& c, const Segment& edge, const TriangleQuadrature& rule, Samples& samples) {
  Corners corners;
  corners << c, edge.p, edge.q;
  const double area = 0.5 * cross(edge.p - c, edge.q - c);
  for (Eigen::Index i = 0; i < rule.weight.size(); ++i)
    samples.add(corners * rule.lambda.col(i), area * rule.weight(i));
}

void add_sector(const Eigen::Vector2d& c, const Arc& arc, double radius, const core::GaussRule& radial,
                const core::GaussRule& along, Samples& samples) {
  const int pieces = static_cast<int>(std::ceil(arc.through / (std::numbers::pi / 6.0)));
  const double angle = arc.through / pieces;
  for (int piece = 0; piece < pieces; ++piece) {
    for (Eigen::Index t = 0; t < along.node.size(); ++t) {
      const Eigen::Vector2d on = on_circle(radius, arc.from + angle * (piece + along.node(t)));
      // |(γ − c) × γ'| with γ' = angle · (−y, x)
      const double swept = angle * (on - c).dot(on) * along.weight(t);
      for (Eigen::Index s = 0; s < radial.node.size(); ++s)
        samples.add(c + radial.node(s) * (on - c), swept * radial.node(s) * radial.weight(s));
    }
  }
}

/// The rule of samples by their barycentric coordinates in a triangle.
TriangleQuadrature as_rule(const Samples& samples, const Corners& corners) {
  Eigen::Matrix2d edges;
  edges << corners.col(1) - corners.col(0), corners.col(2) - corners.col(0);
  const Eigen::Matrix2d inverse = edges.inverse();
  const double area = 0.5 * std::abs(edges.determinant());
  TriangleQuadrature rule;
  rule.lambda.resize(3, static_cast<Eigen::Index>(samples.points.size()));
  rule.weight.resize(rule.lambda.cols());
  for (Eigen::Index i = 0; i < rule.lambda.cols(); ++i) {
    const Eigen::Vector2d xi = inverse * (samples.points[static_cast<std::size_t>(i)] - corners.col(0));
    rule.lambda.col(i) << 1.0 - xi.sum(), xi;
    rule.weight(i) = samples.areas[static_cast<std::size_t>(i)] / area;
  }
  return rule;
}

}  // namespace

TriangleQuadrature disc_quadrature(const Corners& corners, double radius, int points) {
  assert(radius > 0.0 && points >= 1 && points <= 16);
  Corners turned = corners;
  if (cross(corners.col(1) - corners.col(0), corners.col(2) - corners.col(0)) < 0.0) turned.col(1).swap(turned.col(2));
  const Boundary boundary = boundary_of(turned, radius);
  TriangleQuadrature straight = triangle_quadrature(points);
  if (!boundary.cut) return straight;
  Samples samples;
  for (const Segment& edge : boundary.segments) add_triangle(boundary.inside, edge, straight, samples);
  const core::GaussRule radial = core::gauss_legendre(points), along = core::gauss_legendre(points + 4);
  for (const Arc& arc : boundary.arcs) add_sector(boundary.inside, arc, radius, radial, along, samples);
  return as_rule(samples, corners);
}

}  // namespace thinwall::fem
