#pragma once
// From the part of a case to its mesh, its order, and where the nodes lie.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/closed_part.hpp"
#include "fem/to_tolerance.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/selection.hpp"
#include "mesh/solid/solid_mesh.hpp"
#include "mesh/tet_mesh.hpp"
#include "study/part/part_input.hpp"
#include "study/part/solution.hpp"

namespace thinwall::study {

/// The division of the part into elements, in the part's own coordinates (before it is bent).
struct Discretisation {
  mesh::TetMesh mesh;
  int order = 2;
  std::optional<fem::Estimate> estimate;  ///< with a tolerance
  std::optional<Solution> solved;         ///< what a tolerance or a fit has left, until the part is changed
};

/// The first mesh of a part whose surface or mesh a file holds, as discretise() makes it. Throws what that throws
/// before it solves anything, InputError for a mesh of more degrees of freedom than are solved among it. Cost: some
/// tenths of a second, seconds for a curved surface, and minutes for one that no mesher can fill.
[[nodiscard]] mesh::TetMesh coarsest_mesh(const PartInput& source);

/// The first mesh of a part of a file's closed surface that is solved to a tolerance, for discretise(); empty for other
/// parts. Errors and cost as coarsest_mesh().
[[nodiscard]] std::shared_ptr<const fem::FirstMesh> first_mesh(const PartInput& source);

/// True if a part's mesh is that of a file, which is solved by one order more, too, for its error; not above order 5.
[[nodiscard]] bool is_solved_one_order_higher(const setup::Part& part, int order);

/// Points at which the tolerance on receptances is to hold: at the interface, and at both ends and the middle of the
/// path.
[[nodiscard]] std::vector<fem::NamedPoint> watched_points(const PartInput& source);

/// Mesh and order: from the tolerance (fem::refine_to_tolerance), or as the case gives them. `first`: what first_mesh()
/// has made of the same input, or empty.
[[nodiscard]] Discretisation discretise(const PartInput& source, std::shared_ptr<const fem::FirstMesh> first = {});

}  // namespace thinwall::study
