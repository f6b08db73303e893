#pragma once
// From the part of a case to its mesh, its order, and where the nodes lie.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "fem/to_tolerance.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/selection.hpp"
#include "mesh/solid/solid_mesh.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::study {

/// The part's matrices, their factor and the modes that the case asks for.
struct Solution {
  fem::Model model;
  fem::Factored factored;
  fem::Modes modes;
};

/// How the part is cut into elements, in the part's own coordinates (before it is bent).
struct Discretisation {
  mesh::TetMesh mesh;
  int order = 2;
  std::optional<fem::Estimate> estimate;  ///< with a tolerance
  std::optional<Solution> solved;         ///< what a tolerance or a fit has left, until the part is changed
};

/// The part's prism in its plane: of a box, length and height; x, y, z of the mesher run along `axes` of the part.
struct PlanarPart {
  mesh::Prism prism;
  std::array<int, 3> axes{0, 1, 2};
};
[[nodiscard]] PlanarPart planar(const setup::Part& part);

/// A graded mesh of one layer of elements through the wall; the coarsest is level 0, whose elements are a third as long
/// as a bending wave of the highest mode wanted.
[[nodiscard]] mesh::TetMesh graded_mesh(const cases::Case& source, int level);

/// The part's bend in its own coordinates; the part must have one.
[[nodiscard]] mesh::Bend bend_of(const setup::Part& part);

/// Moves the nodes of the flat mesh onto the bent part; empty for a part that is not bent.
[[nodiscard]] fem::Shaping shaping(const setup::Part& part);

/// Mass of the part, kg, in closed form on the flat mesh: ρ ∫ (1 + w/R) dV, R infinite without a bend.
[[nodiscard]] double mass(const setup::Part& part, const mesh::TetMesh& flat);

/// A face of the box around the part, or a selection, by its name.
[[nodiscard]] mesh::Region region_of(const cases::Case& source, const std::string& name);

/// The nodes of a mesh from a file that are held: 3·node + axis of the supports on its sets.
[[nodiscard]] std::vector<int> rows_held_by_sets(const cases::Case& source, const mesh::SolidMesh& solid);

[[nodiscard]] fem::Material material_of(const setup::Part& part);
/// Supports on faces and selections; those on sets of nodes are rows_held_by_sets().
[[nodiscard]] std::vector<fem::Support> supports_of(const cases::Case& source);
/// How far (m) the elements may lie off a place that is given on the part: nothing where they fill it exactly; 0.01 of
/// the diagonal where they follow a file's surface by chords (outside_part() has held the place to the surface itself);
/// what the edges of a file's curved elements bow by.
[[nodiscard]] double off_surface(const setup::Part& part);
[[nodiscard]] fem::NamedPoint named_point(const cases::Case& source, const std::string& name);
[[nodiscard]] fem::ModeOptions mode_options(const cases::Case& source);

/// A line for each point on whose receptance no tolerance can be met, for it has no patch: a force on a single place of
/// a solid moves it without bound as elements shrink. None where size or mesh are given.
[[nodiscard]] std::vector<std::string> unreachable_tolerances(const cases::Case& source);

/// Mesh and order: from the tolerance (fem::refine_to_tolerance), or as the case gives them.
[[nodiscard]] Discretisation discretise(const cases::Case& source);

}  // namespace thinwall::study
