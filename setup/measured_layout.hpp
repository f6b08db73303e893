#pragma once
// Which files of FRFs make a matrix, told from what the case says of them: no file is read.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// "P.x" as a DOF. Throws InputError for a name without point or direction.
[[nodiscard]] dynamics::Dof dof_of(const std::string& name);

/// Name of the point of a DOF: "P" of "P.x".
[[nodiscard]] std::string point_of(const std::string& dof);

/// The matrix that files make, and where its entries are.
struct MeasuredLayout {
  std::vector<std::string> dofs;  ///< names, in the order in which the files mention them
  Eigen::MatrixXi file;           ///< number of the file of an entry (row: response, column: force), or of its
                                  ///< transpose (reciprocity) where only that is given; −1: none
};

/// The layout of these files. Of an entry that is given twice the first counts. Cost O(files · DOFs).
[[nodiscard]] MeasuredLayout measured_layout(const std::vector<MeasuredFrf>& files);

/// Why files make no matrix, in a line with the remedy (empty: they do), and the file to correct where it is one.
struct LayoutFault {
  std::string text;
  std::optional<std::size_t> file;  ///< number
};

/// An entry that is given twice; two DOFs along one line of a point (P.x and P.-x), which would count its motion twice;
/// an entry that no file gives, nor its transpose (the first, and how many more). All names must be DOFs (dof_of()).
[[nodiscard]] LayoutFault fault_of_layout(const std::vector<MeasuredFrf>& files);

}  // namespace thinwall::setup
