#pragma once
// Errors of the structure of a chart, and their effect on its depths.

#include <optional>
#include <vector>

#include "milling/chart/sampled_uncertainty.hpp"
#include "setup/machining_setup.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// Beside a CutStructure. What is empty is not known to be wrong.
struct StructureErrors {
  std::optional<milling::RelativeStructure> richer{};  ///< its poles with what a reduction left out, part axes
  std::vector<Eigen::Matrix3cd> truncation{};          ///< of its samples, signed, tool axes, one a line
  milling::SampleCovariance noise{};                   ///< of its samples, tool axes, one a line
  std::vector<milling::RelativeStructure> draws{};     ///< its poles by each draw of what was identified, part axes
  std::vector<std::vector<Eigen::Matrix3cd>> drawn_changes{};  ///< of its samples likewise, tool axes, one a line

  /// True if nothing is known to be wrong.
  [[nodiscard]] bool none() const {
    return !richer && truncation.empty() && noise.empty() && draws.empty() && drawn_changes.empty();
  }
};

/// Of cut_structure() with the part (`richer_part`: with what its reduction left out, null if nothing was) or with the
/// supported part by its poles: noise of a measured tool. `carrier` as in cut_poles().
[[nodiscard]] StructureErrors structure_errors(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                               const CutStructure& structure, const dynamics::ModalModel* richer_part,
                                               const dynamics::ModalModel* carrier = nullptr);

/// Of sampled_structure() with the coupled response of `results`: its noise and truncation at the point that is cut,
/// and the noise of a measured tool.
[[nodiscard]] StructureErrors sampled_structure_errors(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                                       const Results& results);

/// The errors of the limit of a row: truncation and noise of its first crossing, first order in both
/// (milling/chart/sensitivity.hpp, milling/chart/sampled_uncertainty.hpp), and the range by draws of what was
/// identified (milling/chart/depth_band.hpp). Where a crossing is not found again, or stands where its depth has no
/// derivative, nothing is known. Errors as theirs otherwise.
[[nodiscard]] DepthError depth_error(const CutStructure& structure, const StructureErrors& errors,
                                     const milling::MillingProcess& process, const milling::LobeRow& row,
                                     const milling::StabilityOptions& options);

}  // namespace thinwall::study
