#include <algorithm>
#include <cstdio>

#include "reduction/trust/model_report.hpp"

namespace thinwall::reduction {

namespace {

/// One line of text with printf's formats.
template <typename... Values>
std::string line(const char* format, Values... values) {
  char buffer[240];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return std::string(buffer) + "\n";
}

std::string findings_text(const ReducedModelReport& report) {
  std::string text;
  for (const Finding& finding : report.findings) {
    text += line("  %-4s %-38s %10.2e  bound %9.2e", finding.ok ? "ok" : "NOT", finding.name.c_str(), finding.value,
                 finding.bound);
    if (!finding.ok) text += "       " + finding.advice + "\n";
  }
  return text;
}

std::string six(const char* label, const Eigen::Ref<const Eigen::VectorXd>& values) {
  return line("  %-24s %10.3e %10.3e %10.3e %10.3e %10.3e %10.3e", label, values(0), values(1), values(2), values(3),
              values(4), values(5));
}

std::string body_text(const RigidBodyState& rigid) {
  const dynamics::RigidBody& body = rigid.body;
  std::string text;
  text += line("  free rigid motions %d of 6", rigid.free_motions);
  for (const std::string& motion : rigid.in_words) text += "  free: " + motion + "\n";
  text += line("  mass %.6g kg, centre (%.6g, %.6g, %.6g) m", body.mass_kg, body.centre_m.x(), body.centre_m.y(),
               body.centre_m.z());
  const Eigen::Matrix3d& I = body.inertia_kg_m2;
  text += line("  inertia about the centre xx %.5g, yy %.5g, zz %.5g, xy %.5g, yz %.5g, zx %.5g kg m^2", I(0, 0),
               I(1, 1), I(2, 2), I(0, 1), I(1, 2), I(2, 0));
  if (rigid.free_motions < 6) text += "  (of what the interface carries along: a held part's own mass is more)\n";
  text += line("about (%.6g, %.6g, %.6g) m                  x          y          z         rx         ry         rz",
               rigid.reference.x(), rigid.reference.y(), rigid.reference.z());
  text += six("grounding, N/m, N m/rad", rigid.grounding_stiffness);
  text += six("grounding, Hz", rigid.grounding_hz);
  return text;
}

/// The table of modes that carry at least a hundredth of a mass or inertia, and of the sum over all modes.
std::string effective_text(const EffectiveMass& effective) {
  if (!effective.available) return "  no effective masses: M is not positive definite with the interface held\n";
  std::string text = "effective mass, share of the whole\n";
  const auto share = [&](const Eigen::VectorXd& part) { return part.cwiseQuotient(effective.total).eval(); };
  for (Eigen::Index k = 0; k < effective.mass.rows(); ++k) {
    const Eigen::VectorXd shares = share(effective.mass.row(k).transpose());
    if (shares.maxCoeff() < 0.01) continue;
    char label[40];
    std::snprintf(label, sizeof label, "%.2f Hz", effective.frequency_hz(k));
    text += six(label, shares);
  }
  text += six("all modes", share(effective.mass.colwise().sum().transpose()));
  text += six("the interface's own", share(effective.interface_own));
  return text;
}

}  // namespace

std::string text(const ReducedModelReport& report) {
  std::string text = line("%d coordinates; DOFs: %d translations, %d rotations, %d amplitudes", report.coordinates,
                          report.translations, report.rotations, report.amplitudes);
  text += report.trustworthy() ? "nothing found against this model\n" : "this model should not be trusted as it is\n";
  text += findings_text(report);
  text += "frequencies";
  for (const double hz : report.frequencies_hz) {
    char buffer[24];
    std::snprintf(buffer, sizeof buffer, "  %.2f", hz);
    text += buffer;
  }
  text += " Hz\n";
  if (const ModesWithoutEnergy& free = report.without_energy; free.count > 0)
    text += line("modes counted as free: %d, up to %.2g Hz", free.count, free.highest_hz);
  if (report.rigid && report.rigid->sets.seen < 6)
    text +=
        line("rigid body not judged: the DOFs show %d of 6 motions; three points that do not lie on one line show all",
             report.rigid->sets.seen);
  if (report.rigid && report.rigid->sets.seen == 6)
    text += "rigid body\n" + body_text(*report.rigid) +
            (report.rigid->effective.total.size() > 0 ? effective_text(report.rigid->effective) : "");
  return text;
}

}  // namespace thinwall::reduction
