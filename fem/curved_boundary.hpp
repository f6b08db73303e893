#pragma once
// Elements whose boundary follows a curved surface: the nodes of a straight mesh are moved onto the surface, and those
// within the elements after them.

#include <memory>

#include "fem/supports.hpp"
#include "mesh/surface/smooth_patches.hpp"

namespace thinwall::fem {

/// The places of the nodes of order 3 of a mesh whose elements follow a curved surface.
struct CubicShape {
  mesh::LagrangeNodes nodes;
  double volume_m3 = 0.0;  ///< of the curved elements
};

/// The shape of a mesh whose boundary has its vertices on a closed surface. A node on a face or an edge of the boundary
/// goes to the nearest place of the patch, or of the sharp line, that the face or edge represents; those within the
/// part follow by harmonic extension, so that the two sides of a thin wall carry along what is between them. Where an
/// element would be turned inside out, or its det J fall below a tenth of its mean, the displacements of its nodes are
/// made smaller, at last left out: such elements stay nearly straight, others as they are, and the volume tells by how
/// much. Faces of which no patch is known stay straight. `lowest_order`: that of the elements that take this shape;
/// those of orders below 3, through their own nodes on it, are held to the same bound. Cost: a search of the surface
/// for each node of the boundary, and a factorisation with one row for each node within.
[[nodiscard]] CubicShape curved_onto(const mesh::SmoothPatches& surface, const mesh::TetMesh& mesh,
                                     int lowest_order = 3);

/// The function that moves nodes of any order of the shape's mesh to their places on it (for SolidPart::shaping): x(λ)
/// = Σ N_a(λ) x_a over the nodes a of order 3.
[[nodiscard]] Shaping shaping_by(std::shared_ptr<const CubicShape> shape);

}  // namespace thinwall::fem
