#include "milling/cut/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/gauss_rule.hpp"

namespace thinwall::milling {

namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

/// A point of the meridian by radius and height, m.
struct Joint {
  double radius_m = 0.0;
  double height_m = 0.0;
};

/// Roots of x² − 2 p x + q, the lower and the upper; a tangent that misses by round-off touches.
struct Roots {
  double lower = 0.0, upper = 0.0;
};

std::optional<Roots> roots(double p, double q, double scale) {
  const double square = p * p - q;
  if (square < -1e-9 * scale * scale) return std::nullopt;
  const double root = square < 1e-14 * scale * scale ? 0.0 : std::sqrt(square);
  return Roots{p - root, p + root};
}

double side_radius(const Envelope& e, double diameter_m, double height_m) {
  return 0.5 * diameter_m * (1.0 - std::tan(e.tip_angle_rad) * std::tan(e.taper_rad)) +
         height_m * std::tan(e.taper_rad);
}

/// The place where the arc leaves the tip cone z = r tan α: the outer of the two intersections.
std::optional<Joint> cone_joint(const Envelope& e) {
  const double slope = std::tan(e.tip_angle_rad);
  const double square = 1.0 + slope * slope;
  const double R = e.corner_radius_m;
  const double from_axis = e.corner_radial_m;
  const double from_tip = e.corner_axial_m;
  const auto r =
      roots((from_axis + from_tip * slope) / square, (from_axis * from_axis + from_tip * from_tip - R * R) / square, R);
  if (!r) return std::nullopt;
  return Joint{r->upper, r->upper * slope};
}

/// The place where the arc meets the side r = u + z tan β: the lower of the two intersections.
std::optional<Joint> side_joint(const Envelope& e, double diameter_m) {
  const double slope = std::tan(e.taper_rad);
  const double square = 1.0 + slope * slope;
  const double R = e.corner_radius_m;
  const double off = side_radius(e, diameter_m, 0.0) - e.corner_radial_m;
  const auto z = roots((e.corner_axial_m - off * slope) / square,
                       (off * off + e.corner_axial_m * e.corner_axial_m - R * R) / square, R);
  if (!z) return std::nullopt;
  return Joint{side_radius(e, diameter_m, z->lower), z->lower};
}

double kappa_on_arc(const MeridianPiece& piece, double height_m) {
  return std::acos(std::clamp((piece.corner_axial_m - height_m) / piece.corner_radius_m, -1.0, 1.0));
}

}  // namespace

Envelope ball_end(double diameter_m) {
  return bull_nose(diameter_m, 0.5 * diameter_m);
}

Envelope bull_nose(double diameter_m, double corner_radius_m) {
  Envelope envelope;
  envelope.corner_radius_m = corner_radius_m;
  envelope.corner_radial_m = 0.5 * diameter_m - corner_radius_m;
  envelope.corner_axial_m = corner_radius_m;
  return envelope;
}

MeridianPoint MeridianPiece::at(double height_m) const {
  if (straight()) return {radius_m + (height_m - from_m) / std::tan(kappa_rad), kappa_rad};
  const double kappa = kappa_on_arc(*this, height_m);
  return {corner_radial_m + corner_radius_m * std::sin(kappa), kappa};
}

std::vector<MeridianPiece> meridian(const Envelope& e, double diameter_m) {
  const double edge_of_cone = 0.5 * diameter_m * std::tan(e.tip_angle_rad);
  Joint leaves{0.5 * diameter_m, edge_of_cone};
  Joint meets = leaves;
  if (e.corner_radius_m > 0.0) {
    leaves = cone_joint(e).value_or(leaves);
    meets = side_joint(e, diameter_m).value_or(meets);
  }
  std::vector<MeridianPiece> pieces;
  const auto add = [&](MeridianPiece piece) {
    piece.to_m = std::min(piece.to_m, e.height_m);
    if (piece.to_m > piece.from_m + 1e-12 * diameter_m) pieces.push_back(piece);
  };
  add({0.0, leaves.height_m, e.tip_angle_rad, 0.0});
  add({std::max(0.0, leaves.height_m), meets.height_m, 0.0, 0.0, e.corner_radius_m, e.corner_radial_m,
       e.corner_axial_m});
  add({std::max(0.0, meets.height_m), std::numeric_limits<double>::infinity(), right_angle - e.taper_rad,
       side_radius(e, diameter_m, meets.height_m)});
  return pieces;
}

MeridianPoint at_height(const Envelope& envelope, double diameter_m, double height_m) {
  const auto pieces = meridian(envelope, diameter_m);
  const auto above =
      std::find_if(pieces.begin(), pieces.end(), [&](const MeridianPiece& p) { return height_m < p.to_m; });
  return (above == pieces.end() ? pieces.back() : *above).at(height_m);
}

std::vector<EdgeSlice> edge_slices(const MeridianPiece& piece, double low_m, double high_m, int points) {
  const double from = piece.straight() ? 0.0 : kappa_on_arc(piece, low_m);
  const double to = piece.straight() ? 0.0 : kappa_on_arc(piece, high_m);
  const core::GaussRule rule = core::gauss_legendre(points);
  std::vector<EdgeSlice> slices;
  for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
    if (piece.straight()) {
      slices.push_back({low_m + rule.node(i) * (high_m - low_m), piece.kappa_rad,
                        rule.weight(i) * (high_m - low_m) / std::sin(piece.kappa_rad)});
    } else {
      const double kappa = from + rule.node(i) * (to - from);
      slices.push_back({piece.corner_axial_m - piece.corner_radius_m * std::cos(kappa), kappa,
                        rule.weight(i) * (to - from) * piece.corner_radius_m});
    }
  }
  return slices;
}

int exact_points(const MeridianPiece& piece, double low_m, double high_m, double turn_rad) {
  const double kappa = piece.straight() ? 0.0 : kappa_on_arc(piece, high_m) - kappa_on_arc(piece, low_m);
  return 6 + static_cast<int>(std::ceil(std::abs(turn_rad) + 1.5 * kappa));
}

std::vector<std::string> validate(const Envelope& e, double diameter_m) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const char* what, double value, const char* bound) {
    if (holds) return;
    std::ostringstream text;
    text << "envelope: " << what << " " << value << ", must be " << bound;
    violations.push_back(text.str());
  };
  constexpr double degree = std::numbers::pi / 180.0;
  require(e.corner_radius_m >= 0.0 && std::isfinite(e.corner_radius_m), "corner radius in m", e.corner_radius_m,
          "0 or more; leave it out for a sharp corner");
  require(std::isfinite(e.corner_radial_m), "radial place of the corner's centre in m", e.corner_radial_m,
          "a number; D/2 − R for a bull nose");
  require(std::isfinite(e.corner_axial_m), "axial place of the corner's centre in m", e.corner_axial_m,
          "a number; R for a bull nose");
  require(e.tip_angle_rad >= 0.0 && e.tip_angle_rad <= 85.0 * degree, "tip angle in rad", e.tip_angle_rad,
          "from 0 to 85°; measure it from the plane across the axis");
  require(std::abs(e.taper_rad) <= 80.0 * degree, "taper in rad", e.taper_rad,
          "from −80° to 80°; measure it from the axis");
  require(e.height_m > 0.0, "height of the edges in m", e.height_m, "positive; give the cutting length");
  if (!violations.empty() || !(diameter_m > 0.0)) return violations;
  if (e.corner_radius_m > 0.0) {
    const auto leaves = cone_joint(e);
    const auto meets = side_joint(e, diameter_m);
    const double slack = 1e-9 * diameter_m;
    require(leaves && leaves->radius_m >= -slack && meets && meets->height_m >= leaves->height_m - slack &&
                meets->radius_m >= leaves->radius_m - slack,
            "corner radius in m", e.corner_radius_m,
            "such that the arc leaves the tip cone outwards and then meets the side; for a ball or bull nose at most "
            "half the diameter");
  }
  const double top = e.taper_rad < 0.0 ? side_radius(e, diameter_m, e.height_m) : diameter_m;
  require(top > 0.0, "radius in m at the top of the edges", top, "positive; give a lower height or less taper");
  return violations;
}

}  // namespace thinwall::milling
