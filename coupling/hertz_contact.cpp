#include "coupling/hertz_contact.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

[[noreturn]] void refuse(const std::string& what, double value, const std::string& bound) {
  std::ostringstream text;
  text << "Hertz contact: " << what << " is " << value << ", but it must " << bound;
  throw core::InputError(text.str());
}

void require_valid(const Elastic& material) {
  if (!(material.E > 0.0 && std::isfinite(material.E))) refuse("Young's modulus (Pa)", material.E, "be positive");
  if (!(material.nu > -1.0 && material.nu <= 0.5)) refuse("Poisson's ratio", material.nu, "lie in (-1, 0.5]");
}

}  // namespace

double relative_radius(double r, double other) {
  if (!(r > 0.0 && std::isfinite(r))) refuse("a ball's radius (m)", r, "be positive");
  if (!(other > 0.0 || other < -r)) refuse("the other body's radius (m)", other, "be positive, or a wider hollow");
  return 1.0 / (1.0 / r + 1.0 / other);
}

HertzState hertz(const HertzContact& contact, double preload) {
  require_valid(contact.one);
  require_valid(contact.other);
  const double R = contact.radius, F = preload;
  if (!(R > 0.0 && std::isfinite(R))) refuse("the relative radius (m)", R, "be positive");
  if (!(F > 0.0 && std::isfinite(F))) refuse("the preload (N)", F, "be positive: without one the bodies part");
  const auto plane = [](const Elastic& body) { return (1.0 - body.nu * body.nu) / body.E; };
  const auto shear = [](const Elastic& body) { return (2.0 - body.nu) * 2.0 * (1.0 + body.nu) / body.E; };
  const double E = 1.0 / (plane(contact.one) + plane(contact.other));
  const double G = 1.0 / (shear(contact.one) + shear(contact.other));
  HertzState state;
  state.contact_radius = std::cbrt(3.0 * F * R / (4.0 * E));
  state.approach = state.contact_radius * state.contact_radius / R;
  state.peak_pressure = 3.0 * F / (2.0 * std::numbers::pi * state.contact_radius * state.contact_radius);
  state.normal = 2.0 * E * state.contact_radius;
  state.tangential = 8.0 * G * state.contact_radius;
  return state;
}

double caster_stiffness(const BallCaster& caster, const Elastic& part, double preload) {
  if (caster.balls < 3) refuse("the number of carrying balls", caster.balls, "be three or more");
  if (!(caster.angle >= 0.0 && caster.angle < 0.5 * std::numbers::pi)) {
    refuse("the angle of the carrying balls (rad)", caster.angle, "lie in [0, pi/2)");
  }
  const double r = caster.ball_radius, s = caster.support_radius, cosine = std::cos(caster.angle);
  const double Q = preload / (caster.balls * cosine);
  const double at_part = hertz({relative_radius(r), caster.steel, part}, preload).normal;
  const double at_ball = hertz({relative_radius(r, s), caster.steel, caster.steel}, Q).normal;
  const double at_cup = hertz({relative_radius(s, -(r + 2.0 * s)), caster.steel, caster.steel}, Q).normal;
  const double support = 1.0 / (1.0 / at_ball + 1.0 / at_cup);
  return 1.0 / (1.0 / at_part + 1.0 / (caster.balls * cosine * cosine * support));
}

}  // namespace thinwall::coupling
