#include "report/fit/fit_text.hpp"

#include <fmt/format.h>

#include "identification/fitted_model.hpp"

namespace thinwall::report {

namespace {

using identification::FittedMode;

std::string terms_text(const identification::ResidualTerms& terms) {
  std::string text = terms.inertia ? "LR/s^2" : "";
  for (int power = 0; power <= terms.highest_power; ++power)
    text += fmt::format("{}c{}{}", text.empty() ? "" : ", ", power,
                        power == 0   ? ""
                        : power == 1 ? " s"
                                     : fmt::format(" s^{}", power));
  return text.empty() ? "none" : text;
}

std::string mode_line(std::size_t number, const FittedMode& mode,
                      const std::optional<identification::PointMode>& point) {
  std::string line = fmt::format("  {:>4}  {:>10.5g} ± {:<8.2g}  {:>8.4g} ± {:<8.2g}", number, mode.frequency_hz,
                                 two_sided * mode.sd_ln_frequency * mode.frequency_hz, 100.0 * mode.damping_ratio,
                                 100.0 * two_sided * mode.sd_ln_damping * mode.damping_ratio);
  line += point ? fmt::format("  {:>9.4g}  {:>9.4g}", point->mass_kg, point->stiffness_N_m * 1e-6)
                : fmt::format("  {:>9}  {:>9}", "-", "-");
  return line + fmt::format("  {:>7.2g}\n", mode.second_singular);
}

}  // namespace

std::string fit_text(const FitReport& found) {
  const identification::ModalFit& fit = found.fit.found.fit;
  const identification::MeasuredLines& lines = found.fit.lines;
  const auto points = identification::point_modes(fit, found.measured.responses, found.measured.forces);
  std::string text = fmt::format("{} x {} receptances, {} lines from {:.6g} to {:.6g} Hz, weighed by {}\n",
                                 lines.responses(), lines.references(), lines.lines(), lines.hz(0),
                                 lines.hz(lines.lines() - 1), core::word_of(found.fit.weights));
  text += fmt::format("  {:>4}  {:>21}  {:>19}  {:>9}  {:>9}  {:>7}\n", "mode", "frequency (Hz, 95 %)",
                      "damping (%, 95 %)", "mass (kg)", "k (N/um)", "s2/s1");
  for (std::size_t r = 0; r < fit.modes.size(); ++r) text += mode_line(r + 1, fit.modes[r], points[r]);
  text += fmt::format("  chi2        {:.3g} a degree of freedom; 1 where model and weights are right\n",
                      fit.chi2_per_dof());
  text += fmt::format("  terms       {}\n", terms_text(found.fit.found.terms));
  text += fmt::format("  misfit      {:.2g} % of the entry that is worst\n", 100.0 * found.fit.misfit.maxCoeff());
  if (found.fit.passive && found.fit.passive->before == 0.0) text += "  passive     as it was fitted\n";
  else if (found.fit.passive)
    text += fmt::format(
        "  passive     residues moved by at most {:.2g} %, for the fit gave energy by {:.2g} % of its size\n",
        100.0 * found.fit.passive->moved, 100.0 * found.fit.passive->before);
  for (const std::string& doubt : found.doubts) text += "  warning     " + doubt + "\n";
  for (const std::string& note : found.notes) text += "  note        " + note + "\n";
  return text;
}

}  // namespace thinwall::report
