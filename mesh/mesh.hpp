#pragma once
// The headers of mesh/ that other programs may include.
// Internal: beneath_curves, border_graph, cell_shape, cell_split, curve_order, edge_division, edge_layers, edge_rows,
// edge_uses, facet_repair, hole_filling, joined_sets, labelled_checks, layer_rows, matched_walls, mesh_findings,
// midside_order, nearest_point, orientation, pieces, placed_triangle, planar_mesh, plane_overlay, polyline,
// separate_bodies, smooth_patches, solid_union, surface_finding, sweep, tet_jacobian, triangle_tree.

#include "core/eigen_alignment.hpp"
#include "mesh/box.hpp"
#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/planar/box_mesh.hpp"
#include "mesh/planar/prism.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "mesh/planar/stacked_prisms.hpp"
#include "mesh/polygon.hpp"
#include "mesh/selection.hpp"
#include "mesh/solid/labelled_mesh.hpp"
#include "mesh/solid/locate.hpp"
#include "mesh/solid/plane_cut.hpp"
#include "mesh/solid/quality.hpp"
#include "mesh/solid/solid_mesh.hpp"
#include "mesh/solid/tessellation.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/remesh.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/surface/size_space.hpp"
#include "mesh/surface/surface_distance.hpp"
#include "mesh/surface/surface_features.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "mesh/surface/thin_walls.hpp"
#include "mesh/surface/wall_thickness.hpp"
#include "mesh/tet_mesh.hpp"
#include "mesh/triangle_soup.hpp"
#include "mesh/volume/delaunay_volume.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "mesh/volume/tetgen.hpp"
