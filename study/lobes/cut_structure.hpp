#pragma once
// The structure that the cut feels: the part at the point that is cut, and the tool.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "milling/cut/tool.hpp"
#include "milling/structure/relative_structure.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::study {

/// Poles where everything is known by its modes (part axes); the fit of samples, with the part's poles beside them,
/// where the tool tip is measured.
using CutStructure = std::variant<milling::RelativeStructure, milling::FittedStructure>;

/// The poles of what is known by its modes: the part (null: a rigid one), the tool where it is given by modes, and the
/// tip of the robot that carries the tool (null: none, or a rigid one). They are in series, so that their receptances
/// add. None if nothing is known so.
[[nodiscard]] std::optional<milling::RelativeStructure> cut_poles(const setup::CutSetup& source,
                                                                  const dynamics::ModalModel* part,
                                                                  const dynamics::ModalModel* carrier = nullptr);

/// The modes of the part that the cut feels: up to lobes.modes_up_to where that is given, the others statically.
[[nodiscard]] dynamics::ModalModel kept_modes(const setup::CutSetup& source, const dynamics::ModalModel& part);

/// The modes that kept_modes() has, at the point that is cut, part axes. Errors as milling::relative_structure().
[[nodiscard]] milling::RelativeStructure part_structure(const setup::CutSetup& source,
                                                        const dynamics::ModalModel& part);

/// The bound above which modes of a reduced part act by their static compliance in a chart whose case does not say, Hz:
/// one and a half times the highest fixed-interface mode that the reduction keeps, given by all that it keeps. Beyond,
/// the reduced model's modes are no longer those of the part, and resolving the waves of modes of 100 kHz and more in
/// the cut takes a thousand nodes at low speeds. None where no mode is kept.
[[nodiscard]] std::optional<double> usual_modes_up_to_hz(const Eigen::VectorXd& fixed_interface_hz);

/// 0, 1, 2 of "tool.x", "tool.y", "tool.z".
[[nodiscard]] int direction_of_dof(const std::string& dof);

/// True if one of the files is the transpose of `file`, an entry off the diagonal.
[[nodiscard]] bool gives_reverse(const std::vector<setup::MeasuredFrf>& files, const setup::MeasuredFrf& file);

/// Part, tool and what carries it together; `frame` is the cut's, `part` must hold the point that is cut, null: a rigid
/// part; `carrier` as in cut_poles(). Samples lie on the lines of the first measured file; what speaks against them is
/// logged as a warning: a driving point that gives energy, or one whose lines are all 0. Throws InputError if nothing
/// moves or the lines cannot be fitted (milling::fitted_structure()), DataError as io::resample.
[[nodiscard]] CutStructure cut_structure(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                         const dynamics::ModalModel* part,
                                         const dynamics::ModalModel* carrier = nullptr);

/// As above, with what is known by its modes given as cut_poles() gives it.
[[nodiscard]] CutStructure cut_structure(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                         const std::optional<milling::RelativeStructure>& modal);

/// The lines of the tip of a tool that setup::known_by_lines(), tool axes, as cut_structure() fits them, with its
/// warnings and errors but those of the fit.
[[nodiscard]] milling::SampledReceptance tip_lines(const setup::CutSetup& source, const milling::ToolFrame& frame);

/// The receptance of a measured or swapped tool's tip as its fitted poles alone give it, part axes, on the lines of the
/// fit; those of the part are left out. None of a tool that is known by its modes or rigid. Cost O(lines poles).
[[nodiscard]] std::optional<milling::SampledReceptance> synthesised_tip(const setup::CutSetup& source,
                                                                        const CutStructure& structure);

/// The part as it is held by a robot that has no poles: samples of `coupled` (part axes) at the point that is cut, on
/// its lines, and the tool: its modes as poles, or its measured receptance put on these lines. Warns as above. Throws
/// DataError as io::resample.
[[nodiscard]] milling::FittedStructure sampled_structure(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                                         const dynamics::ResponseModel& coupled);

}  // namespace thinwall::study
