#pragma once
// The headers of fem/ that other programs may include.
// Internal: curved_boundary, curved_element, disc_quadrature, edge_exponent, elastic_clamps, error_of_orders,
// face_points, harmonic_extension, interpolation, node_graph, quadrature, receptance_change, reference_element,
// solution_bytes.

#include "core/eigen_alignment.hpp"
#include "fem/assembly.hpp"
#include "fem/attach.hpp"
#include "fem/attachments.hpp"
#include "fem/beam.hpp"
#include "fem/closed_part.hpp"
#include "fem/determined_motions.hpp"
#include "fem/free_motions.hpp"
#include "fem/material.hpp"
#include "fem/mode_check.hpp"
#include "fem/model.hpp"
#include "fem/modes.hpp"
#include "fem/patch.hpp"
#include "fem/points.hpp"
#include "fem/rigid_body.hpp"
#include "fem/rigid_patch.hpp"
#include "fem/supports.hpp"
#include "fem/to_tolerance.hpp"
