#include "milling/structure/periodic_motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

double length_of(const CutElement& e) {
  return e.to_rad - e.from_rad;
}

/// Places of the element's nodes in (0, 1).
Eigen::VectorXd places(const ContactGrid& grid, const CutElement& e) {
  return (grid.node_rad.segment(e.first_node, e.nodes).array() - e.from_rad) / length_of(e);
}

/// Polynomials through the nodes of an element, read where the nodes of its first `share` would lie: nodes × nodes.
Eigen::MatrixXd onto_first(const Eigen::VectorXd& place, double share) {
  Eigen::MatrixXd rows(place.size(), place.size());
  for (Index i = 0; i < place.size(); ++i) rows.row(i) = lagrange_polynomials(place, share * place(i)).transpose();
  return rows;
}

/// ∫₀^length e^{λ (length − s)} f(s) ds of the polynomial through f at Gauss's nodes.
complex<double> driven(complex<double> pole, double length_s, const Eigen::RowVectorXcd& f) {
  const ProductRule& rule = shared_product_rule(static_cast<int>(f.size()), std::abs(pole) * length_s);
  return length_s * (rule.end(pole * length_s).transpose().array() * f.transpose().array()).sum();
}

/// The modes from rest through a period, and then by what the start of the periodic motion adds to that.
void march(PeriodicMotion& m) {
  const double period_s = m.grid.period_rad * m.seconds_per_rad;
  for (Index k = 0; k < m.structure.poles.size(); ++k) {
    const complex<double> pole = m.structure.poles(k) * m.seconds_per_rad;
    complex<double> z = 0.0;
    double at = 0.0;
    Index column = 0;
    for (const CutElement& e : m.grid.elements) {
      z *= std::exp(pole * (e.from_rad - at));
      m.at_from(k, column) = z;
      z = z * std::exp(pole * length_of(e)) + driven(m.structure.poles(k), length_of(e) * m.seconds_per_rad,
                                                     m.modal_force.row(k).segment(e.first_node, e.nodes));
      m.at_to(k, column++) = z;
      at = e.to_rad;
    }
    z *= std::exp(pole * (m.grid.period_rad - at));
    m.at_start(k) = z / (1.0 - std::exp(m.structure.poles(k) * period_s));
    column = 0;
    for (const CutElement& e : m.grid.elements) {
      m.at_from(k, column) += m.at_start(k) * std::exp(pole * e.from_rad);
      m.at_to(k, column++) += m.at_start(k) * std::exp(pole * e.to_rad);
    }
  }
}

Eigen::VectorXcd modes_in_flight(const PeriodicMotion& m, double rotation_rad) {
  Eigen::VectorXcd z = m.at_start;
  double since = 0.0;
  Index column = 0;
  for (const CutElement& e : m.grid.elements) {
    if (e.to_rad > rotation_rad + 1e-12) break;
    z = m.at_to.col(column++);
    since = e.to_rad;
  }
  const double time_s = (rotation_rad - since) * m.seconds_per_rad;
  return z.array() * (m.structure.poles.array() * time_s).exp();
}

Eigen::VectorXcd modes_in_cut(const PeriodicMotion& m, const Moment& moment) {
  const CutElement& e = m.grid.elements[static_cast<std::size_t>(moment.element)];
  const double turned = moment.rotation_rad - e.from_rad;
  const double time_s = turned * m.seconds_per_rad;
  const Eigen::MatrixXcd f = m.modal_force.middleCols(e.first_node, e.nodes) *
                             onto_first(places(m.grid, e), turned / length_of(e)).transpose().cast<complex<double>>();
  Eigen::VectorXcd z = m.at_from.col(moment.element).array() * (m.structure.poles.array() * time_s).exp();
  for (Index k = 0; k < z.size(); ++k) z(k) += driven(m.structure.poles(k), time_s, f.row(k));
  return z;
}

}  // namespace

Moment moment_at(const ContactGrid& grid, double rotation_rad) {
  Moment moment{rotation_rad - grid.period_rad * std::floor(rotation_rad / grid.period_rad), -1};
  const auto element = std::find_if(grid.elements.begin(), grid.elements.end(), [&](const CutElement& e) {
    return e.from_rad <= moment.rotation_rad && moment.rotation_rad <= e.to_rad;
  });
  if (element != grid.elements.end()) moment.element = static_cast<int>(element - grid.elements.begin());
  return moment;
}

Eigen::VectorXd at_moment(const ContactGrid& grid, const Eigen::MatrixXd& at_nodes, const Moment& moment) {
  if (moment.element < 0) return Eigen::VectorXd::Zero(at_nodes.rows());
  const CutElement& e = grid.elements[static_cast<std::size_t>(moment.element)];
  return at_nodes.middleCols(e.first_node, e.nodes) *
         lagrange_polynomials(places(grid, e), (moment.rotation_rad - e.from_rad) / length_of(e));
}

PeriodicMotion periodic_motion(const RelativeStructure& structure, const ContactGrid& grid, double spindle_speed_rpm,
                               const Eigen::MatrixXd& force) {
  const Index poles = structure.poles.size();
  const auto elements = static_cast<Index>(grid.elements.size());
  PeriodicMotion m{structure,
                   grid,
                   30.0 / (std::numbers::pi * spindle_speed_rpm),
                   force,
                   structure.b.transpose() * force.cast<complex<double>>(),
                   Eigen::VectorXcd(poles),
                   Eigen::MatrixXcd(poles, elements),
                   Eigen::MatrixXcd(poles, elements)};
  march(m);
  return m;
}

Eigen::Vector3d displacement(const PeriodicMotion& m, const Moment& moment) {
  const Eigen::VectorXcd z = moment.element < 0 ? modes_in_flight(m, moment.rotation_rad) : modes_in_cut(m, moment);
  const Eigen::VectorXd share = m.structure.poles.imag().unaryExpr([](double w) { return w != 0.0 ? 2.0 : 1.0; });
  return (m.structure.phi * (share.array() * z.array()).matrix()).real() +
         m.structure.R * at_moment(m.grid, m.force, moment);
}

Eigen::Matrix3Xd displacement_at_nodes(const PeriodicMotion& m) {
  Eigen::Matrix3Xd q(3, m.grid.node_rad.size());
  for (std::size_t e = 0; e < m.grid.elements.size(); ++e) {
    const CutElement& element = m.grid.elements[e];
    for (int node = element.first_node; node < element.first_node + element.nodes; ++node)
      q.col(node) = displacement(m, {m.grid.node_rad(node), static_cast<int>(e)});
  }
  return q;
}

}  // namespace thinwall::milling
