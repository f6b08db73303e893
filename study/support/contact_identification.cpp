#include "study/support/contact_identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "io/frf/measured_response.hpp"
#include "io/frf/resample.hpp"
#include "setup/measured.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::study {

namespace {

constexpr double far_above_one = 4.0;  // residuals twice the noise

std::string name_of(const setup::SupportContact& contact) {
  return contact.part_point + "-" + contact.robot_point;
}

/// The lines of `axis` from `from_hz` to `to_hz`.
std::vector<Eigen::Index> lines_within(const dynamics::FrequencyAxis& axis, double from_hz, double to_hz) {
  std::vector<Eigen::Index> lines;
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    if (axis.hz(line) >= from_hz - 1e-9 * to_hz && axis.hz(line) <= to_hz * (1.0 + 1e-9)) lines.push_back(line);
  }
  return lines;
}

/// The lines of `axis` that every file covers.
dynamics::FrequencyAxis common_axis(const std::vector<io::MeasuredFrf>& frfs, const dynamics::FrequencyAxis& axis) {
  double from = 0.0, to = axis.hz(axis.size() - 1);
  for (const io::MeasuredFrf& frf : frfs) {
    from = std::max(from, frf.axis.hz(0));
    to = std::min(to, frf.axis.hz(frf.axis.size() - 1));
  }
  const auto lines = lines_within(axis, from, to);
  if (!lines.empty()) return {axis.hz(lines)};
  std::string ranges;
  for (const io::MeasuredFrf& frf : frfs)
    ranges += fmt::format("{}{} from {:g} to {:g} Hz", ranges.empty() ? "" : ", ", frf.source, frf.axis.hz(0),
                          frf.axis.hz(frf.axis.size() - 1));
  throw core::InputError(
      fmt::format("no line of [response] ({:g} to {:g} Hz) lies where the assembly was measured: {}; set response.from "
                  "and response.to within what all files cover",
                  axis.hz(0), axis.hz(axis.size() - 1), ranges));
}

/// The response at fewer lines.
dynamics::ResponseModel at_lines(const dynamics::ResponseModel& all, const std::vector<Eigen::Index>& lines) {
  dynamics::ResponseModel few{{all.axis.hz(lines)}, all.responses, all.forces, {}};
  few.H.reserve(lines.size());
  for (const Eigen::Index line : lines) few.H.push_back(all.H[static_cast<std::size_t>(line)]);
  return few;
}

void add_name(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

/// Which file gives the entry, or else its transpose.
std::size_t file_of(const setup::MeasuredLayout& layout, const std::string& response, const std::string& force) {
  const auto place = [&](const std::string& name) {
    return std::ranges::find(layout.dofs, name) - layout.dofs.begin();
  };
  if (const int file = layout.file(place(response), place(force)); file >= 0) return static_cast<std::size_t>(file);
  throw core::InputError("no file gives the response of " + response + " to a force at " + force +
                         " while the robot holds the part: add one to contacts.measured");
}

dynamics::DofTable dofs_of(const std::vector<std::string>& names) {
  dynamics::DofTable dofs;
  std::ranges::transform(names, std::back_inserter(dofs), setup::dof_of);
  return dofs;
}

/// The nearest symmetric matrix without negative eigenvalues.
Eigen::MatrixXd without_negative_part(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  if (solver.eigenvalues().minCoeff() >= 0.0) return matrix;
  const Eigen::MatrixXd& V = solver.eigenvectors();
  const Eigen::MatrixXd raised = V * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * V.transpose();
  return 0.5 * (raised + raised.transpose());
}

coupling::IdentificationOptions options_of(const setup::SpringContact& sought) {
  coupling::IdentificationOptions options;
  options.response_point = setup::point_of(sought.measured.front().response);
  options.force_point = setup::point_of(sought.measured.front().force);
  // The case states the deviation of real and imaginary part, the library takes that of both together.
  const auto level = [&](std::size_t which) {
    return Eigen::VectorXd::Constant(1, std::numbers::sqrt2 * sought.noise[which]);
  };
  options.noise = {level(1), level(2), level(0)};
  options.viscous = sought.damping_sought != setup::DampingSought::structural;
  options.structural = sought.damping_sought != setup::DampingSought::viscous;
  return options;
}

/// Throws NumericalError unless there is a stiffness that can be joined.
void require_stiffness(const coupling::IdentifiedJoint& found, const setup::SupportContact& contact) {
  if (found.status == coupling::IdentificationStatus::no_information) {
    throw core::NumericalError(
        "the FRFs of the assembly hold too little of contact " + name_of(contact) +
        ": at nearly every line their noise (contacts.noise) hides it. Measure where it gives "
        "way, near resonances of the assembly, or nearer to it; or join it by a given stiffness, "
        "\"inf\" if it is far stiffer than both sides");
  }
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(found.joint.K).eigenvalues()(0);
  if (least > 1e-12 * found.joint.K.norm()) return;
  throw core::NumericalError(
      fmt::format("the stiffness that the FRFs of the assembly give contact {} is not positive ({:.3g} N/m along some "
                  "direction): check points, directions and signs of part, robot and assembly",
                  name_of(contact), least));
}

}  // namespace

dynamics::ResponseModel assembly_response(const std::vector<setup::MeasuredFrf>& files,
                                          const dynamics::FrequencyAxis& axis) {
  std::vector<io::MeasuredFrf> frfs;
  std::vector<std::string> responses, forces;
  const bool one_point = std::ranges::all_of(files, [](const setup::MeasuredFrf& file) {
    return setup::point_of(file.response) == setup::point_of(file.force);
  });
  for (const setup::MeasuredFrf& file : files) {
    frfs.push_back(setup::receptance_of(file));
    add_name(responses, file.response);
    add_name(one_point ? responses : forces, file.force);
  }
  if (one_point) forces = responses;
  dynamics::ResponseModel model{common_axis(frfs, axis), dofs_of(responses), dofs_of(forces), {}};
  const setup::MeasuredLayout layout = setup::measured_layout(files);
  const auto rows = static_cast<Eigen::Index>(responses.size()), columns = static_cast<Eigen::Index>(forces.size());
  model.H.assign(static_cast<std::size_t>(model.axis.size()), Eigen::MatrixXcd(rows, columns));
  std::vector<Eigen::VectorXcd> lines;
  lines.reserve(frfs.size());
  for (const io::MeasuredFrf& frf : frfs) lines.push_back(io::resample(frf, model.axis));
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      const Eigen::VectorXcd& H =
          lines[file_of(layout, responses[static_cast<std::size_t>(i)], forces[static_cast<std::size_t>(j)])];
      for (Eigen::Index line = 0; line < H.size(); ++line) model.H[static_cast<std::size_t>(line)](i, j) = H(line);
    }
  }
  return model;
}

ContactIdentification identify_contact(const setup::SupportContact& contact, const Component& part,
                                       const Component& robot) {
  const auto& sought = std::get<setup::SpringContact>(contact.model);
  const dynamics::ResponseModel assembly = assembly_response(sought.measured, part.response.axis);
  setup::warn_if_implausible(assembly, "the assembly's");
  const Eigen::VectorXd& hz = assembly.axis.hz;
  const auto lines = lines_within(part.response.axis, hz(0), hz(hz.size() - 1));
  coupling::Contact joined{contact.part_point, contact.robot_point, {}, {}};
  for (const auto& direction : contact.directions) joined.springs.push_back({direction});
  ContactIdentification result{coupling::identify_joint(at_lines(part.response, lines), at_lines(robot.response, lines),
                                                        assembly, joined, options_of(sought)),
                               {},
                               hz.size(),
                               hz(0),
                               hz(hz.size() - 1),
                               false};
  const coupling::JointMatrices& found = result.found.joint;
  require_stiffness(result.found, contact);
  result.joined = {found.K, without_negative_part(found.C), without_negative_part(found.D)};
  result.damping_raised = result.joined.C != found.C || result.joined.D != found.D;
  return result;
}

void warn_of_misfit(const setup::SupportContact& contact, const ContactIdentification& identification) {
  const std::string name = name_of(contact);
  const double chi_squared = identification.found.chi_squared;
  if (chi_squared > far_above_one) {
    core::warn(fmt::format(
        "contact {} leaves residuals {:.1f} times the noise (chi squared {:.3g}): its damping may be of another kind, "
        "a "
        "direction may be missing, the points may lie apart, or part or robot may be off; the intervals are widened, "
        "but no interval knows of a bias",
        name, std::sqrt(chi_squared), chi_squared));
  }
  if (identification.damping_raised)
    core::warn(fmt::format(
        "contact {}: the damping that was found gives energy along some direction; there none is taken", name));
}

}  // namespace thinwall::study
