#include "milling/contact_grid.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "milling/product_rule.hpp"

namespace thinwall::milling {

namespace {

/// A = Σ force chipᵀ with as few terms as its rank has.
void add_contacts(const Eigen::Matrix3d& A, const Past& past, std::vector<Contact>& contacts) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& size = svd.singularValues();
  for (int k = 0; k < 3 && size(k) > 1e-13 * size(0); ++k)
    contacts.push_back({past.node, size(k) * svd.matrixU().col(k), svd.matrixV().col(k), {past}});
}

}  // namespace

ContactGrid contact_grid(const MillingProcess& process, const Eigen::Matrix3Xd& yielding, Resolution resolution) {
  const std::vector<CutSegment> segments = cut_segments(process.engagement, process.cutter);
  double longest = 0.0;
  for (const CutSegment& s : segments) longest = std::max(longest, s.to_rad - s.from_rad);
  const GaussRule rule = gauss_legendre(resolution.nodes);
  const Eigen::Matrix3d onto = yielding * yielding.transpose();
  ContactGrid grid;
  grid.period_rad = process.cutter.pitch_rad();
  std::vector<double> nodes;
  for (const CutSegment& s : segments) {
    const int count =
        std::max(1, static_cast<int>(std::ceil((s.to_rad - s.from_rad) / longest * resolution.elements - 1e-9)));
    const double length = (s.to_rad - s.from_rad) / count;
    for (int e = 0; e < count; ++e) {
      const double from = s.from_rad + e * length;
      grid.elements.push_back({from, from + length, static_cast<int>(nodes.size()), resolution.nodes});
      for (const double c : rule.node) {
        const double theta = from + c * length;
        Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
        for (int j = 0; j < s.teeth; ++j) {
          const double phi = process.engagement.entry_rad + theta + j * process.cutter.pitch_rad();
          A.leftCols<2>() += directional_matrix(process.coefficients, phi);
        }
        add_contacts(A * onto, {static_cast<int>(nodes.size()), true, 1.0}, grid.contacts);
        nodes.push_back(theta);
      }
    }
  }
  grid.node_rad = Eigen::Map<const Eigen::VectorXd>(nodes.data(), static_cast<Eigen::Index>(nodes.size()));
  return grid;
}

}  // namespace thinwall::milling
