#include "coupling/contact_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

/// The slope at row i (Fritsch & Butland 1984, Eq. 5). At the ends it is that of a parabola through three rows, limited
/// to the sign of the secant and to three times its value, which keeps the cubic monotone.
double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::Index i) {
  const Eigen::Index last = x.size() - 1;
  const auto step = [&](Eigen::Index k) { return x(k + 1) - x(k); };
  const auto secant = [&](Eigen::Index k) { return (y(k + 1) - y(k)) / step(k); };
  if (last == 1) return secant(0);
  if (i == 0 || i == last) {
    const Eigen::Index near = i == 0 ? 0 : last - 1, far = i == 0 ? 1 : last - 2;
    const double d =
        ((2.0 * step(near) + step(far)) * secant(near) - step(near) * secant(far)) / (step(near) + step(far));
    if (d * secant(near) <= 0.0) return 0.0;
    return std::abs(d) > 3.0 * std::abs(secant(near)) ? 3.0 * secant(near) : d;
  }
  const double before = secant(i - 1), after = secant(i);
  if (before * after <= 0.0) return 0.0;
  const double w = (step(i - 1) + 2.0 * step(i)) / (3.0 * (step(i - 1) + step(i)));
  return before * after / (w * after + (1.0 - w) * before);
}

/// The Hermite cubic between the rows k and k + 1, at `at`.
double between_rows(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::Index k, double at) {
  const double h = x(k + 1) - x(k), t = (at - x(k)) / h, u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * y(k) + t * t * (1.0 + 2.0 * u) * y(k + 1) +
         h * t * u * (u * slope(x, y, k) - t * slope(x, y, k + 1));
}

}  // namespace

void require_valid(const ContactTable& table) {
  constexpr double most_n = 1e9, most_n_per_m = 1e18, most_n_s_per_m = 1e12;  // no contact of a machine has more
  std::ostringstream faults;
  const auto begin = [&]() -> std::ostream& { return faults << (faults.tellp() > 0 ? "; " : "") << "contact table: "; };
  const Eigen::Index rows = table.preload.size();
  if (rows < 2) begin() << rows << " rows: give two preloads or more";
  if (table.stiffness.size() != rows || table.damping.size() != rows) {
    begin() << rows << " preloads, " << table.stiffness.size() << " stiffnesses and " << table.damping.size()
            << " dampings: give one of each a row";
    throw core::InputError(faults.str());
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (!(std::abs(table.preload(i)) <= most_n) || (i > 0 && !(table.preload(i) > table.preload(i - 1)))) {
      begin() << "the preload in row " << i + 1 << " is " << table.preload(i) << " N, but preloads must rise, within "
              << most_n << " N";
    }
    if (!(table.stiffness(i) > 0.0 && table.stiffness(i) <= most_n_per_m)) {
      begin() << "the stiffness in row " << i + 1 << " is " << table.stiffness(i) << " N/m, but it must be positive, "
              << most_n_per_m << " at most";
    }
    if (!(table.damping(i) >= 0.0 && table.damping(i) <= most_n_s_per_m)) {
      begin() << "the damping in row " << i + 1 << " is " << table.damping(i) << " N s/m, but it must be from 0 to "
              << most_n_s_per_m;
    }
  }
  if (faults.tellp() > 0) throw core::InputError(faults.str());
}

ContactSpring spring_at(const ContactTable& table, double preload, const Eigen::Vector3d& direction) {
  require_valid(table);
  const Eigen::VectorXd& F = table.preload;
  const Eigen::Index last = F.size() - 1;
  if (!(preload >= F(0) && preload <= F(last))) {
    std::ostringstream text;
    text << "the preload is " << preload << " N, but the contact was measured from " << F(0) << " to " << F(last)
         << " N: measure it there, or change the preload";
    throw core::InputError(text.str());
  }
  const auto above = std::upper_bound(F.begin(), F.end() - 1, preload);
  const Eigen::Index k = std::max<Eigen::Index>(0, (above - F.begin()) - 1);
  ContactSpring spring;
  spring.direction = direction;
  spring.stiffness = between_rows(F, table.stiffness, k, preload);
  spring.damping = between_rows(F, table.damping, k, preload);
  return spring;
}

}  // namespace thinwall::coupling
