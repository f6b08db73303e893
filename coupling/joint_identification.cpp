#include "coupling/joint_identification.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <sstream>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

using Complex = std::complex<double>;
using dynamics::ResponseModel;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double quantile_95 = 1.959963984540054;
constexpr int most_passes = 20;

/// The measured receptances in the contact's directions, an n × n matrix for each line.
struct Measured {
  std::vector<Eigen::MatrixXcd> H_PP, H_aP, H_Pb, H_ab, H_RR, G_ab;
  Eigen::VectorXd omega;
  bool same_response = false, same_force = false;  ///< a' = P, b' = P: some of these are then the same measurement
};

/// The relative noise of one measured matrix at a line, from one value for all lines or one for each.
double at(const Eigen::VectorXd& values, Eigen::Index line) {
  return values.size() == 1 ? values(0) : values(line);
}

Eigen::MatrixXd rows(const dynamics::DofTable& dofs, const std::string& point, const Joints& joints) {
  Eigen::MatrixXd B(static_cast<Eigen::Index>(dofs.size()), joints.size());
  for (Eigen::Index j = 0; j < joints.size(); ++j) {
    const JoinedDirection& joined = joints.directions[static_cast<std::size_t>(j)];
    B.col(j) = joined.scale * dynamics::displacement_row(dofs, point, joined.direction, joined.kind);
    if (B.col(j).isZero(0.0)) {
      throw core::InputError("point \"" + point + "\" was not measured along a direction of the contact " +
                             joints.directions.front().point_a + "-" + joints.directions.front().point_b +
                             ": leave the direction out, or measure it");
    }
  }
  return B;
}

std::vector<Eigen::MatrixXcd> in_directions(const ResponseModel& model, const std::string& response,
                                            const std::string& force, const Joints& joints) {
  const Eigen::MatrixXd B_response = rows(model.responses, response, joints),
                        B_force = rows(model.forces, force, joints);
  std::vector<Eigen::MatrixXcd> lines;
  lines.reserve(model.H.size());
  for (const Eigen::MatrixXcd& H : model.H) lines.emplace_back(B_response.transpose() * H * B_force);
  return lines;
}

Measured measured(const ResponseModel& part, const ResponseModel& robot, const ResponseModel& coupled,
                  const Joints& joints, const IdentificationOptions& options) {
  for (const ResponseModel* model : {&part, &robot, &coupled}) {
    dynamics::require_equal(part.axis, model->axis);
    dynamics::require_complete(*model);
  }
  const std::string& P = joints.directions.front().point_a;
  const std::string& R = joints.directions.front().point_b;
  const std::string& a = options.response_point.empty() ? P : options.response_point;
  const std::string& b = options.force_point.empty() ? P : options.force_point;
  Measured all{in_directions(part, P, P, joints),
               in_directions(part, a, P, joints),
               in_directions(part, P, b, joints),
               in_directions(part, a, b, joints),
               in_directions(robot, R, R, joints),
               in_directions(coupled, a, b, joints),
               2.0 * M_PI * part.axis.hz,
               a == P,
               b == P};
  return all;
}

/// The joint's stiffness at a line by docs/theory/coupling.md, Eq. 16; NaN if H − G or its S cannot be inverted.
Eigen::MatrixXcd stiffness(const Measured& data, std::size_t line) {
  const Eigen::Index n = data.H_PP[line].rows();
  Eigen::MatrixXcd none = Eigen::MatrixXcd::Constant(n, n, Complex(nan, nan));
  const Eigen::FullPivLU<Eigen::MatrixXcd> E(data.H_ab[line] - data.G_ab[line]);
  if (!E.isInvertible()) return none;
  const Eigen::FullPivLU<Eigen::MatrixXcd> compliance(data.H_Pb[line] * E.solve(data.H_aP[line]) - data.H_PP[line] -
                                                      data.H_RR[line]);
  return compliance.isInvertible() ? Eigen::MatrixXcd(compliance.inverse()) : none;
}

/// A measured matrix X with the effect of its error on the joint's compliance, δ(Z⁻¹) = Σ left δX right.
struct Source {
  const Eigen::MatrixXcd& X;
  double relative_noise;
  std::vector<std::pair<Eigen::MatrixXcd, Eigen::MatrixXcd>> terms{};
};

/// The error sources of one line, at the joint's stiffness Z (docs/theory/coupling.md, Eq. 17). From Z⁻¹ = H_Pb E⁻¹
/// H_aP − H_PP − H_RR with E = H_ab − G_ab, each matrix contributes its derivative; δ(E⁻¹) = −E⁻¹ δE E⁻¹. A measurement
/// that enters at several places, as H_PP does if the assembly was measured at P, is one source.
std::vector<Source> sources(const Measured& data, Eigen::Index index, const Eigen::MatrixXcd& Z,
                            const RelativeNoise& noise) {
  const auto line = static_cast<std::size_t>(index);
  const Eigen::MatrixXcd I = Eigen::MatrixXcd::Identity(Z.rows(), Z.cols());
  const Eigen::MatrixXcd S = data.H_PP[line] + data.H_RR[line] + Z.inverse();
  const Eigen::MatrixXcd right = data.H_Pb[line].inverse() * S;  // E⁻¹ H_aP
  const Eigen::MatrixXcd left = S * data.H_aP[line].inverse();   // H_Pb E⁻¹
  const double part = at(noise.part, index);
  std::vector<Source> all{{data.H_PP[line], part},
                          {data.H_Pb[line], part},
                          {data.H_aP[line], part},
                          {data.H_ab[line], part},
                          {data.H_RR[line], at(noise.robot, index), {{-I, I}}},
                          {data.G_ab[line], at(noise.coupled, index), {{left, right}}}};
  // Places in `all` of H_aP and H_Pb: both are H_PP if the assembly was measured, or excited, at P; likewise H_ab.
  const std::size_t a = data.same_response ? 0 : 2, b = data.same_force ? 0 : 1;
  all[0].terms.emplace_back(-I, I);
  all[b].terms.emplace_back(I, right);
  all[a].terms.emplace_back(left, I);
  all[a + b].terms.emplace_back(-left, right);
  return all;
}

/// The standard deviation of (Z + Zᵀ)/2 due to all sources, with δZ = −Z δ(Z⁻¹) Z.
Eigen::MatrixXd spread(const std::vector<Source>& sources, const Eigen::MatrixXcd& Z) {
  const Eigen::Index n = Z.rows();
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(n, n);
  for (const Source& source : sources) {
    std::vector<std::pair<Eigen::MatrixXcd, Eigen::MatrixXcd>> terms;
    for (const auto& [left, right] : source.terms) terms.emplace_back(Z * left, right * Z);
    for (Eigen::Index k = 0; k < n; ++k) {
      for (Eigen::Index l = 0; l < n; ++l) {
        Eigen::MatrixXcd slope = Eigen::MatrixXcd::Zero(n, n);
        for (const auto& [left, right] : terms) slope += left.col(k) * right.row(l);
        const double sigma = source.relative_noise * std::abs(source.X(k, l));
        variance += sigma * sigma * (0.5 * (slope + slope.transpose())).cwiseAbs2();
      }
    }
  }
  return variance.cwiseSqrt();
}

/// The fitted K, C, D of one entry with their variances.
struct EntryFit {
  double K = nan, C = 0.0, D = 0.0;
  double K_variance = 0.0, C_variance = 0.0, D_variance = 0.0;
  double chi_squared = 0.0;
  int lines = 0;
};

/// The weighted mean of Re z, and the weighted least-squares fit of Im z = D + ωC, over the lines with a spread above
/// zero. ω is divided by its largest value, which keeps the normal equations well conditioned.
EntryFit fit(const Eigen::VectorXd& omega, const Eigen::VectorXcd& z, const Eigen::VectorXd& spread,
             const IdentificationOptions& options) {
  const int of_loss = (options.viscous ? 1 : 0) + (options.structural ? 1 : 0);
  const double unit = omega.maxCoeff();
  double weights = 0.0, real = 0.0;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  EntryFit result;
  for (Eigen::Index line = 0; line < omega.size(); ++line) {
    if (!(spread(line) > 0.0)) continue;
    ++result.lines;
    const double weight = 2.0 / (spread(line) * spread(line));  // half of the variance belongs to the real part
    const Eigen::Vector2d basis(options.viscous ? omega(line) / unit : 0.0, options.structural ? 1.0 : 0.0);
    weights += weight;
    real += weight * z(line).real();
    normal += weight * basis * basis.transpose();
    right += weight * z(line).imag() * basis;
  }
  if (result.lines <= std::max(1, of_loss)) return result;
  if (!options.viscous) normal(0, 0) = 1.0;
  if (!options.structural) normal(1, 1) = 1.0;
  const Eigen::FullPivLU<Eigen::Matrix2d> lu(normal);
  if (!lu.isInvertible()) return result;
  const Eigen::Vector2d loss = lu.solve(right);
  const Eigen::Matrix2d covariance = lu.inverse();
  result.K = real / weights;
  result.K_variance = 1.0 / weights;
  if (options.viscous) {
    result.C = loss(0) / unit;
    result.C_variance = covariance(0, 0) / (unit * unit);
  }
  if (options.structural) {
    result.D = loss(1);
    result.D_variance = covariance(1, 1);
  }
  for (Eigen::Index line = 0; line < omega.size(); ++line) {
    if (!(spread(line) > 0.0)) continue;
    const Complex rest = z(line) - Complex(result.K, result.D + omega(line) * result.C);
    result.chi_squared += 2.0 * std::norm(rest / spread(line));
  }
  result.chi_squared /= 2.0 * result.lines - 1.0 - of_loss;
  return result;
}

Eigen::MatrixXcd at_frequency(const JointMatrices& joint, double omega) {
  Eigen::MatrixXcd Z = joint.K.cast<Complex>();
  Z.imag() = joint.D + omega * joint.C;
  return Z;
}

/// The first values of the iteration: the median of Re Z of every entry, without loss. A median is not affected by the
/// few lines near singularities where Z has no digits.
JointMatrices first_guess(const std::vector<Eigen::MatrixXcd>& Z) {
  const Eigen::Index n = Z.front().rows();
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n, n);
  JointMatrices guess{zero, zero, zero};
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      std::vector<double> values;
      for (const Eigen::MatrixXcd& line : Z) {
        if (line.allFinite()) values.push_back(0.5 * (line(i, j) + line(j, i)).real());
      }
      if (values.empty()) return {};
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      guess.K(i, j) = i == j ? std::abs(*middle) : *middle;
    }
  }
  return guess;
}

/// The fit over the band, which alternates between the spreads at the fitted joint and the fit with weights from them.
class Band {
 public:
  Band(const Measured& data, const IdentificationOptions& options, IdentifiedJoint& result)
      : data_(data), options_(options), result_(result) {}

  /// Makes one pass; returns the largest change of a value relative to its half width.
  double pass();

 private:
  void set_spreads();
  void set_entry(Eigen::Index i, Eigen::Index j, const EntryFit& fit);

  const Measured& data_;
  const IdentificationOptions& options_;
  IdentifiedJoint& result_;
};

void Band::set_spreads() {
  for (Eigen::Index line = 0; line < data_.omega.size(); ++line) {
    const Eigen::MatrixXcd Z = at_frequency(result_.joint, data_.omega(line));
    result_.spread[static_cast<std::size_t>(line)] = spread(sources(data_, line, Z, options_.noise), Z);
  }
}

void Band::set_entry(Eigen::Index i, Eigen::Index j, const EntryFit& fit) {
  const double grown = quantile_95 * std::sqrt(std::max(1.0, fit.chi_squared));
  const auto set = [&](Eigen::MatrixXd& matrix, double value) { matrix(i, j) = matrix(j, i) = value; };
  set(result_.joint.K, fit.K);
  set(result_.joint.C, fit.C);
  set(result_.joint.D, fit.D);
  set(result_.half_width.K, grown * std::sqrt(fit.K_variance));
  set(result_.half_width.C, grown * std::sqrt(fit.C_variance));
  set(result_.half_width.D, grown * std::sqrt(fit.D_variance));
  result_.lines_used(i, j) = result_.lines_used(j, i) = fit.lines;
}

double Band::pass() {
  set_spreads();
  const JointMatrices before = result_.joint;
  const Eigen::Index n = before.K.rows(), lines = data_.omega.size();
  double entries = 0.0;
  result_.chi_squared = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) {
      Eigen::VectorXcd z = Eigen::VectorXcd::Zero(lines);
      Eigen::VectorXd used = Eigen::VectorXd::Zero(lines);
      for (Eigen::Index line = 0; line < lines; ++line) {
        const auto k = static_cast<std::size_t>(line);
        const Eigen::MatrixXcd Z = at_frequency(before, data_.omega(line));
        const double size = std::sqrt(std::abs(Z(i, i)) * std::abs(Z(j, j)));
        const double sigma = result_.spread[k](i, j);
        if (!(sigma <= options_.largest_spread * size) || !result_.Z[k].allFinite()) continue;
        z(line) = 0.5 * (result_.Z[k](i, j) + result_.Z[k](j, i));
        used(line) = sigma;
      }
      const EntryFit entry = fit(data_.omega, z, used, options_);
      set_entry(i, j, entry);
      result_.chi_squared += entry.chi_squared;
      entries += 1.0;
    }
  }
  result_.chi_squared /= entries;
  const auto moved = [](const Eigen::MatrixXd& now, const Eigen::MatrixXd& then, const Eigen::MatrixXd& half_width) {
    return ((now - then).array().abs() / (half_width.array() + std::numeric_limits<double>::min())).maxCoeff();
  };
  return std::max({moved(result_.joint.K, before.K, result_.half_width.K),
                   moved(result_.joint.C, before.C, result_.half_width.C),
                   moved(result_.joint.D, before.D, result_.half_width.D)});
}

void require_valid(const IdentificationOptions& options, Eigen::Index lines) {
  std::ostringstream faults;
  const auto begin = [&]() -> std::ostream& { return faults << (faults.tellp() > 0 ? "; " : ""); };
  for (const auto& [whose, noise] : {std::pair{"part", &options.noise.part}, std::pair{"robot", &options.noise.robot},
                                     std::pair{"coupled", &options.noise.coupled}}) {
    if (noise->size() != 1 && noise->size() != lines) {
      begin() << "the noise of the " << whose << " response has " << noise->size() << " values for " << lines
              << " lines: give one, or one a line";
    }
    if (!(noise->array() > 0.0).all() || !noise->allFinite()) {
      begin() << "a noise of the " << whose << " response is not positive: weights and confidence follow from it";
    }
  }
  if (!(options.largest_spread > 0.0 && options.largest_spread < 1.0)) {
    begin() << "largest_spread is " << options.largest_spread << ", but it must lie between 0 and 1";
  }
  if (faults.tellp() > 0) throw core::InputError(faults.str());
}

/// Converts results from the scaled directions to the contact's own units, Z ← Λ Z Λ.
void scale_back(const Joints& joints, IdentifiedJoint& result) {
  Eigen::VectorXd scale(joints.size());
  for (Eigen::Index i = 0; i < scale.size(); ++i) scale(i) = joints.directions[static_cast<std::size_t>(i)].scale;
  const Eigen::MatrixXd units = scale * scale.transpose();
  for (Eigen::MatrixXcd& Z : result.Z) Z = Z.cwiseProduct(units.cast<Complex>()).eval();
  for (Eigen::MatrixXd& sigma : result.spread) sigma = sigma.cwiseProduct(units).eval();
  for (JointMatrices* joint : {&result.joint, &result.half_width}) {
    for (Eigen::MatrixXd* matrix : {&joint->K, &joint->C, &joint->D}) *matrix = matrix->cwiseProduct(units).eval();
  }
}

}  // namespace

Eigen::VectorXd noise_from_coherence(const Eigen::VectorXd& coherence, int averages) {
  if (averages < 1 || !(coherence.array() > 0.0).all() || !(coherence.array() <= 1.0).all()) {
    throw core::InputError(
        "noise from coherence: each value must lie above 0 and not above 1, and averages be 1 or more");
  }
  const auto gamma = coherence.array();
  return ((1.0 - gamma) / (gamma * static_cast<double>(averages))).sqrt().max(1e-6).matrix();
}

IdentifiedJoint identify_joint(const ResponseModel& part, const ResponseModel& robot, const ResponseModel& coupled,
                               const Contact& contact, const IdentificationOptions& options) {
  require_valid(options, part.axis.size());
  const Joints joints = coupling::joints({contact}, default_length);
  const Measured data = measured(part, robot, coupled, joints, options);
  const Eigen::Index n = joints.size();
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n, n);
  IdentifiedJoint result;
  for (std::size_t line = 0; line < data.H_PP.size(); ++line) result.Z.push_back(stiffness(data, line));
  result.spread.assign(result.Z.size(), zero);
  result.half_width = {zero, zero, zero};
  result.lines_used.setZero(n, n);
  result.joint = first_guess(result.Z);
  if (result.joint.K.size() == 0) result.joint = {zero.array() + nan, zero, zero};
  Band band(data, options, result);
  for (int pass = 0; pass < most_passes && result.joint.K.allFinite(); ++pass) {
    if (band.pass() < 1e-3) break;
  }
  if (!result.joint.K.allFinite()) result.status = IdentificationStatus::no_information;
  scale_back(joints, result);
  if (options.structural) {
    const auto K = result.joint.K.array(), D = result.joint.D.array();
    result.loss_factor = D / K;
    result.loss_factor_half_width =
        ((result.half_width.D.array() / K).square() + (D * result.half_width.K.array() / K.square()).square()).sqrt();
  }
  return result;
}

}  // namespace thinwall::coupling
