#include "setup/identified/fitted_tip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "identification/drawn_fits.hpp"
#include "identification/fit_response.hpp"
#include "identification/fitted_model.hpp"
#include "io/frf/resample.hpp"
#include "setup/identified/draws.hpp"
#include "setup/measured.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::setup {

namespace {

/// The files that have directions in common with each other, directly or through others.
std::vector<std::vector<MeasuredFrf>> joined_files(const std::vector<MeasuredFrf>& files) {
  std::vector<std::vector<MeasuredFrf>> groups;
  for (const MeasuredFrf& file : files) {
    const auto shares = [&](const MeasuredFrf& other) {
      return other.response == file.response || other.response == file.force || other.force == file.response ||
             other.force == file.force;
    };
    std::vector<MeasuredFrf> group{file};
    std::erase_if(groups, [&](const std::vector<MeasuredFrf>& earlier) {
      if (std::ranges::none_of(earlier, shares)) return false;
      group.insert(group.end(), earlier.begin(), earlier.end());
      return true;
    });
    groups.push_back(std::move(group));
  }
  return groups;
}

/// The coherence of each line as a matrix; none unless all files have it, and their averages.
std::vector<Eigen::MatrixXd> coherence_of(const std::vector<MeasuredFrf>& files, const MeasuredLayout& layout,
                                          const dynamics::FrequencyAxis& axis) {
  std::vector<Eigen::MatrixXd> lines(static_cast<std::size_t>(axis.size()),
                                     Eigen::MatrixXd(layout.file.rows(), layout.file.cols()));
  for (Eigen::Index e = 0; e < layout.file.size(); ++e) {
    const MeasuredFrf& file = files[static_cast<std::size_t>(layout.file(e))];
    const Eigen::VectorXd values = io::coherence_on(receptance_of(file), axis);
    if (values.size() != axis.size() || !file.averages) return {};
    for (Eigen::Index i = 0; i < values.size(); ++i) lines[static_cast<std::size_t>(i)](e) = values(i);
  }
  return lines;
}

/// A figure of the files as one of each entry; empty unless every file has it.
template <class Figure>
identification::OfEntries of_entries(const std::vector<MeasuredFrf>& files, const MeasuredLayout& layout,
                                     const Figure& figure) {
  identification::OfEntries all(layout.file.rows(), layout.file.cols());
  for (Eigen::Index e = 0; e < layout.file.size(); ++e) {
    const auto value = figure(files[static_cast<std::size_t>(layout.file(e))]);
    if (!value || !(*value > 0)) return {};
    all(e) = *value;
  }
  return all;
}

/// Modes and a constant alone; noise and averages where every file states them.
identification::ResponseFitOptions options_of(const std::vector<MeasuredFrf>& files, const MeasuredLayout& layout) {
  identification::ResponseFitOptions options;
  options.identify.terms = identification::ResidualTerms{false, 0};
  options.noise = of_entries(files, layout, [](const MeasuredFrf& file) { return file.noise; });
  options.averages = of_entries(files, layout, [](const MeasuredFrf& file) { return file.averages; });
  return options;
}

void tell(const identification::ResponseFit& fit, const dynamics::ResponseModel& measured,
          const identification::ResponseFitOptions& options, FittedTip& tip) {
  constexpr double two_sided = 1.96;
  for (const identification::FittedMode& mode : fit.found.fit.modes) {
    tip.notes.push_back(fmt::format(
        "the tool's mode at {:.5g} Hz (± {:.1g} %) with a damping of {:.3g} % (± {:.2g} % of it)", mode.frequency_hz,
        100.0 * two_sided * mode.sd_ln_frequency, 100.0 * mode.damping_ratio, 100.0 * two_sided * mode.sd_ln_damping));
  }
  for (const std::string& doubt : identification::doubts_about(fit, measured.responses, measured.forces, options))
    tip.warnings.push_back("the tool's fit: " + doubt);
}

/// The models beside each other: no poles or residual in common.
dynamics::ModalModel beside(const dynamics::ModalModel& a, const dynamics::ModalModel& b) {
  if (a.dofs.empty()) return b;
  const auto joined = [](const auto& upper, const auto& lower) {
    using Matrix = typename std::decay_t<decltype(upper)>::PlainObject;
    Matrix all = Matrix::Zero(upper.rows() + lower.rows(), upper.cols() + lower.cols());
    all.topLeftCorner(upper.rows(), upper.cols()) = upper;
    all.bottomRightCorner(lower.rows(), lower.cols()) = lower;
    return all;
  };
  dynamics::ModalModel both;
  both.poles.resize(a.poles.size() + b.poles.size());
  both.poles << a.poles, b.poles;
  both.right = joined(a.right, b.right);
  both.left = joined(a.left, b.left);
  both.scaling = Eigen::VectorXcd::Ones(both.poles.size());
  both.residual = joined(a.residual, b.residual);
  both.dofs = a.dofs;
  both.dofs.insert(both.dofs.end(), b.dofs.begin(), b.dofs.end());
  return both;
}

}  // namespace

FittedTip fitted_tip(const Tool& tool) {
  FittedTip tip;
  unsigned seed = 1;
  for (const std::vector<MeasuredFrf>& files : joined_files(tool.measured)) {
    const dynamics::FrequencyAxis axis = receptance_of(tool.measured.front()).axis;
    const dynamics::ResponseModel measured = measured_response(files, axis);
    const MeasuredLayout layout = measured_layout(files);
    identification::ResponseFitOptions options = options_of(files, layout);
    const identification::ResponseFit fit =
        identification::fit_of_any_rank(measured, coherence_of(files, layout, axis), options);
    tell(fit, measured, options, tip);
    const auto add = [&](dynamics::ModalModel& model, const identification::ModalFit& found) {
      model = beside(model, identification::modal_model(found, measured.responses, measured.forces));
    };
    add(tip.model, fit.found.fit);
    const std::vector<identification::ModalFit> drawn =
        identification::drawn_fits(fit.lines, fit.found.fit, {fit.found.terms, options.identify.residues},
                                   measured_layout(files).file, identified_draws, seed);
    seed += identified_draws;  // each group has draws of its own
    tip.drawn.resize(drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) add(tip.drawn[i], drawn[i]);
  }
  return tip;
}

}  // namespace thinwall::setup
