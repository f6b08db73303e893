#pragma once
// All that case/ offers to other programs.
// Internal: alternatives, binding, case_alternatives, case_sections, checks, contact_binding, contact_checks,
// cutting_checks, data_files, doubts, findings, joint_binding, json_schema, keys, kept_points, lobes_binding,
// lobes_checks, material_doubts, material_values, measured_binding, measured_checks, mesh_size, observed_checks,
// part_checks, part_description_checks, path_checks, physical_range, robot_binding, robot_checks, schema,
// schema_bounds, simulation_binding, simulation_checks, table, template_texts, templates, toml_nesting, toml_node,
// toml_values, tool_checks, tool_file, updating_checks, writer.

#include "case/expectation.hpp"
#include "case/machining_case.hpp"
#include "case/numbers.hpp"
#include "case/operating_point.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/urdf_arm.hpp"
#include "case/values.hpp"
#include "core/eigen_alignment.hpp"
