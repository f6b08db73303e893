#include "case/checks/part_description_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/mesh/inp_text.hpp"
#include "mesh/box.hpp"
#include "mesh/triangle_soup.hpp"
#include "setup/imported_part.hpp"
#include "setup/loose_pieces.hpp"
#include "setup/part_materials.hpp"

namespace thinwall::cases {

namespace {

std::vector<std::string> faces_and_selections(const Case& source) {
  std::vector<std::string> known(mesh::face_names().begin(), mesh::face_names().end());
  for (const auto& selection : source.selections) known.push_back(selection.name);
  return known;
}

/// Names of sets are known in capitals; a case may write them otherwise.
std::string as_in_file(const std::string& name, const std::vector<std::string>& known) {
  const auto same =
      std::ranges::find_if(known, [&](const std::string& k) { return io::capitals(k) == io::capitals(name); });
  return same == known.end() ? name : *same;
}

/// A set of nodes of the file that names a node which the file does not have.
void require_sound_set(const Case& source, const mesh::SolidMesh* solid, const std::string& name,
                       const std::string& key, Findings& findings) {
  if (solid == nullptr || !names_node_set(source, name)) return;
  for (const auto& set : solid->node_sets)
    if (io::capitals(set.name) == io::capitals(name) && !set.fault.empty()) findings.report(key, set.fault);
}

void check_supports(const Case& source, Findings& findings) {
  const auto& supports = source.part->supports;
  const mesh::SolidMesh* solid = setup::solid_of(*source.part);
  if (setup::kind(*source.part) == setup::ShapeKind::mesh && solid == nullptr) return;
  std::vector<std::string> known = faces_and_selections(source);
  if (solid != nullptr) {
    for (const auto& set : solid->node_sets) known.push_back(set.name);
  }
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const std::string key = "part.supports[" + std::to_string(i) + "]";
    require_sound_set(source, solid, supports[i].on, key + ".on", findings);
    findings.require_known(key + ".on", as_in_file(supports[i].on, known), known,
                           solid == nullptr ? "face or selection" : "face, selection or set of nodes");
    if (source.part->mesh.order.value_or(2) > 2 && names_node_set(source, supports[i].on))
      findings.report(key + ".on",
                      "a set of nodes holds those of the file; take part.mesh.order = 2, or a face or selection");
  }
}

void check_material(const Case& source, Findings& findings) {
  const setup::Part& part = *source.part;
  if (setup::kind(part) == setup::ShapeKind::matrices ||
      (setup::kind(part) == setup::ShapeKind::mesh && (part.imported == nullptr || setup::materials_in_file(part))))
    return;
  for (const auto& [key, meaning] : {std::pair{"part.material.youngs_modulus", "Young's modulus"},
                                     {"part.material.poisson_ratio", "Poisson's ratio"},
                                     {"part.material.density", "density"}}) {
    if (findings.given(key)) continue;
    const bool in_file = setup::kind(part) == setup::ShapeKind::mesh && !part.imported->mesh->materials.empty();
    findings.report(key, "missing; " + std::string(meaning) +
                             (in_file ? ", or part.mass_unit to take the materials of the file" : ""));
  }
}

/// A material that the case gives to a set of the file goes before the file's own.
bool given_by_case(const setup::Part& part, const std::string& set) {
  return std::ranges::any_of(part.materials,
                             [&](const setup::MaterialRegion& r) { return io::capitals(r.on) == io::capitals(set); });
}

/// Sections of the file whose material lacks something, where the case gives nothing in its place.
void check_materials_of_file(const Case& source, Findings& findings) {
  const setup::Part& part = *source.part;
  if (!setup::materials_in_file(part) || findings.given("part.material.youngs_modulus")) return;
  for (const io::InpMaterial& m : part.imported->mesh->materials) {
    const std::string lacking = io::what_lacks(m);
    if (lacking.empty() || given_by_case(part, m.element_set)) continue;
    findings.report("part.file", "the material \"" + m.name + "\" of the set " + m.element_set + " has no " + lacking +
                                     "; give [part.material], or [[part.materials]] with on = \"" + m.element_set +
                                     "\"");
  }
}

void check_materials(const Case& source, Findings& findings) {
  std::vector<std::string> known;
  for (const auto& selection : source.selections) known.push_back(selection.name);
  const mesh::SolidMesh* solid = setup::solid_of(*source.part);
  if (setup::kind(*source.part) == setup::ShapeKind::mesh && solid == nullptr) return;
  if (solid != nullptr) {
    for (const auto& set : solid->element_sets) known.push_back(set.name);
  }
  for (std::size_t i = 0; i < source.part->materials.size(); ++i) {
    const std::string key = "part.materials[" + std::to_string(i) + "].on", &on = source.part->materials[i].on;
    findings.require_known(key, as_in_file(on, known), known,
                           solid == nullptr ? "selection" : "selection or set of elements");
    const auto selection = std::ranges::find(source.selections, on, &setup::Selection::name);
    if (selection != source.selections.end() && selection->plane)
      findings.report(key, "a plane holds no elements; take a box or a sphere");
  }
}

void check_carrier(const Case& source, const std::string& key, const std::string& name, Findings& findings) {
  std::vector<std::string> known;
  for (const auto& point : source.points) known.push_back(point.name);
  findings.require_known(key + ".at", name, known, "point");
  const auto found = std::ranges::find(source.points, name, &setup::Point::name);
  if (found != source.points.end() && !(found->patch_radius > 0.0))
    findings.report("points." + name, "carries a mass or springs and needs a patch: give patch_radius");
}

void check_attachments(const Case& source, Findings& findings) {
  const setup::Part& part = *source.part;
  for (std::size_t i = 0; i < part.clamps.size(); ++i) {
    const std::string key = "part.clamps[" + std::to_string(i) + "]";
    findings.require_known(key + ".on", part.clamps[i].on, faces_and_selections(source), "face or selection");
    if (part.clamps[i].normal == 0.0 && part.clamps[i].tangential == 0.0)
      findings.report(key, "holds nothing; give normal_stiffness or tangential_stiffness");
  }
  for (std::size_t i = 0; i < part.masses.size(); ++i)
    check_carrier(source, "part.masses[" + std::to_string(i) + "]", part.masses[i].at, findings);
  for (std::size_t i = 0; i < part.springs.size(); ++i) {
    const std::string key = "part.springs[" + std::to_string(i) + "]";
    check_carrier(source, key, part.springs[i].at, findings);
    if (part.springs[i].stiffness.isZero() && part.springs[i].rotation_stiffness.isZero())
      findings.report(key, "holds nothing; give stiffness or rotation_stiffness");
  }
}

/// Reports keys that a mesh from a file cannot take.
void check_given_mesh(const Case& source, Findings& findings) {
  const setup::Part& part = *source.part;
  const mesh::SolidMesh* solid = setup::solid_of(part);
  for (const auto* key : {"part.mesh.element_size", "part.mesh.tolerance"}) {
    const bool other = key == std::string("part.mesh.tolerance") ? part.mesh.tolerance != setup::usual_tolerance(part)
                                                                 : part.mesh.element_size.has_value();
    if (other) findings.report(key, "the mesh is given; part.mesh.order alone can make it better; remove this key");
  }
  if (part.mesh.time_budget)
    findings.report("part.mesh.time_budget", "the mesh is given and not refined; remove this key");
  if (solid == nullptr || !part.mesh.order) return;
  if (*part.mesh.order < solid->nodes.order)
    findings.report("part.mesh.order",
                    "the file's elements are of order " + std::to_string(solid->nodes.order) + "; take that or more");
  if (*part.mesh.order > 2 && solid->midside_offset > 1e-6)
    findings.report("part.mesh.order", "the file's elements are curved; their order can be 2 only");
}

/// A piece that nothing holds, beside others that are held, would fly off.
void check_pieces(const Case& source, Findings& findings) {
  const std::vector<setup::MeshPiece> loose = setup::loose_pieces(source);
  if (loose.empty()) return;
  const int pieces = setup::solid_of(*source.part)->pieces;
  findings.report("part.file",
                  fmt::format("the mesh is in {} pieces that share no node, and nothing holds {} of them, "
                              "the first with {} tetrahedra at {}; join the pieces, hold each, or leave "
                              "them out",
                              pieces, loose.size(), loose.front().tets, mesh::place_text(loose.front().place)));
}

}  // namespace

void check_description(const Case& source, Findings& findings) {
  check_material(source, findings);
  check_materials(source, findings);
  check_materials_of_file(source, findings);
  check_supports(source, findings);
  check_attachments(source, findings);
  if (setup::kind(*source.part) == setup::ShapeKind::mesh) check_given_mesh(source, findings);
  check_pieces(source, findings);
}

}  // namespace thinwall::cases
