#include "case/binding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "case/contact_binding.hpp"
#include "case/lobes_binding.hpp"
#include "case/measured_binding.hpp"
#include "case/robot_binding.hpp"
#include "case/schema/schema.hpp"
#include "case/simulation_binding.hpp"
#include "case/table.hpp"
#include "core/error.hpp"
#include "core/message_line.hpp"
#include "setup/imported_part.hpp"

namespace thinwall::cases {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

int axis_index(const std::string& letter) {
  return letter == "x" ? 0 : letter == "y" ? 1 : letter == "z" ? 2 : -1;
}

mesh::Polygon bind_polygon(const Table& table) {
  const auto list = table.numbers("outline");
  mesh::Polygon polygon;
  for (std::size_t i = 0; i + 1 < list.size(); i += 2) polygon.emplace_back(list[i], list[i + 1]);
  return polygon;
}

mesh::Prism bind_prism(const Table& table) {
  mesh::Prism prism;
  prism.outline = bind_polygon(table);
  prism.top = table.number("thickness");
  for (const auto& hole : table.tables("holes")) prism.holes.push_back(bind_polygon(hole));
  for (const auto& zone : table.tables("zones")) {
    const double bottom = zone.number("bottom");
    prism.zones.push_back({bind_polygon(zone), bottom, bottom + zone.number("thickness")});
  }
  return prism;
}

setup::PartFile bind_part_file(const Table& table, const std::filesystem::path& folder) {
  setup::PartFile file;
  if (const std::string name = table.text("file"); !name.empty()) file.path = folder / name;
  file.unit = table.text("unit");
  if (table.has("origin")) file.origin = table.vector("origin");
  return file;
}

mesh::SurfaceRepairOptions bind_repair(const Table& table) {
  mesh::SurfaceRepairOptions options;
  options.merge_tolerance_m = table.optional("merge_tolerance").value_or(0.0);
  options.largest_hole_edges = table.has("largest_hole") ? table.integer("largest_hole") : 0;
  options.largest_movement = table.optional("largest_movement").value_or(options.largest_movement);
  options.thinnest_wall_m = table.optional("thinnest_wall").value_or(0.0);
  return options;
}

setup::MatrixShape bind_matrices(const Table& table, const std::filesystem::path& folder) {
  const Table matrices = table.table("matrices");
  const auto file = [&](const char* key) {
    const std::string name = matrices.text(key);
    return name.empty() ? std::filesystem::path() : folder / name;
  };
  setup::MatrixShape shape;
  shape.files.stiffness = file("stiffness");
  shape.files.mass = file("mass");
  shape.files.damping = file("damping");
  shape.files.dofs = file("dofs");
  shape.files.positions = file("positions");
  shape.files.length_unit = table.text("unit");
  shape.files.mass_unit = table.text("mass_unit");
  if (table.has("origin")) shape.origin = table.vector("origin");
  return shape;
}

std::optional<setup::Bend> bind_bend(const Table& table) {
  if (!table.exists()) return std::nullopt;
  return setup::Bend{table.number("radius"),
                     table.has("along") ? std::optional(axis_index(table.text("along"))) : std::nullopt};
}

setup::PartShape bind_shape(const Table& table, const std::filesystem::path& folder) {
  const auto bend = bind_bend(table.table("bend"));
  switch (table.choice<setup::ShapeKind>("shape")) {
    case setup::ShapeKind::box:
      break;
    case setup::ShapeKind::prism:
      return setup::PrismShape{bind_prism(table), bend};
    case setup::ShapeKind::surface:
      return setup::SurfaceShape{bind_part_file(table, folder), bind_repair(table.table("repair"))};
    case setup::ShapeKind::mesh:
      return setup::MeshShape{bind_part_file(table, folder), table.text("mass_unit")};
    case setup::ShapeKind::matrices:
      return bind_matrices(table, folder);
  }
  return setup::BoxShape{table.number("length"),
                         table.number("height"),
                         table.number("thickness"),
                         axis_index(table.text("axes.length")),
                         axis_index(table.text("axes.height")),
                         axis_index(table.text("axes.thickness")),
                         bend};
}

setup::Material bind_material(const Table& table) {
  return {table.number("youngs_modulus"), table.number("poisson_ratio"), table.number("density")};
}

void bind_attachments(const Table& table, setup::Part& part) {
  for (const auto& region : table.tables("materials"))
    part.materials.push_back({region.text("on"), bind_material(region)});
  for (const auto& clamp : table.tables("clamps"))
    part.clamps.push_back({clamp.text("on"), clamp.number("normal_stiffness"), clamp.number("tangential_stiffness")});
  for (const auto& mass : table.tables("masses"))
    part.masses.push_back({mass.text("at"), mass.number("mass"), mass.vector("inertia"), mass.vector("offset")});
  for (const auto& spring : table.tables("springs"))
    part.springs.push_back(
        {spring.text("at"), spring.vector("stiffness"), spring.vector("rotation_stiffness"), spring.vector("offset")});
}

setup::Part bind_part(const Table& table, const std::filesystem::path& folder) {
  setup::Part part;
  part.shape = bind_shape(table, folder);
  const Table material = table.table("material"), mesh = table.table("mesh");
  part.material = bind_material(material);
  bind_attachments(table, part);
  const auto number = [&](const char* key) {
    const double value = mesh.number(key);  // NaN for "auto"
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  const auto order = number("order");
  const auto budget = mesh.optional("time_budget");
  part.mesh = {number("element_size"),
               mesh.optional("tolerance").value_or(setup::usual_tolerance(part)),
               order ? std::optional(static_cast<int>(*order)) : std::nullopt,
               mesh.number("quality"),
               mesh.optional("grading"),
               mesh.optional("point_element_size"),
               mesh.number("time_limit"),
               budget ? budget : setup::usual_time_budget(part),
               mesh.number("memory_limit")};
  for (const auto& support : table.tables("supports")) {
    setup::Support bound{support.text("on"), {}};
    for (const auto& letter : support.names("fixed")) bound.fixed.push_back(axis_index(letter));
    part.supports.push_back(std::move(bound));
  }
  return part;
}

std::vector<setup::Selection> bind_selections(const Table& table) {
  std::vector<setup::Selection> list;
  for (const auto& name : children(table.values, table.path)) {
    const Table selection = table.table(name);
    setup::Selection bound;
    bound.name = name;
    if (const Table plane = selection.table("plane"); plane.exists()) {
      bound.plane = {plane.vector("point"), plane.direction("normal")};
    }
    if (const Table box = selection.table("box"); box.exists()) bound.box = {box.vector("min"), box.vector("max")};
    if (const Table sphere = selection.table("sphere"); sphere.exists()) {
      bound.sphere = {sphere.vector("centre"), sphere.number("radius")};
    }
    list.push_back(std::move(bound));
  }
  return list;
}

std::vector<setup::Point> bind_points(const Table& table) {
  std::vector<setup::Point> list;
  for (const auto& name : children(table.values, table.path)) {
    const Table point = table.table(name);
    setup::Point bound;
    bound.name = name;
    if (point.has("at")) bound.at = point.vector("at");
    if (point.has("position")) bound.position = point.vector("position");
    if (point.has("node")) bound.node = point.integer("node");
    bound.offset = point.vector("offset");
    bound.patch_radius = point.number("patch_radius");
    bound.rigid = point.text("connection") == "rigid";
    if (point.has("face")) bound.face = point.text("face");
    bound.directions = point.directions("directions");
    list.push_back(std::move(bound));
  }
  return list;
}

/// count or up_to; `otherwise` modes if neither is given.
setup::ModeRange bind_range(const Table& table, std::string_view count, int otherwise) {
  setup::ModeRange range;
  if (table.has(count)) range.count = table.integer(count);
  range.up_to_hz = table.optional("up_to");
  if (!range.count && !range.up_to_hz) range.count = otherwise;
  return range;
}

setup::Damping bind_damping(const Table& table, const std::filesystem::path& folder) {
  if (!table.exists()) return {};
  switch (table.choice<setup::DampingKind>("model")) {
    case setup::DampingKind::modal:
      break;
    case setup::DampingKind::rayleigh:
      return setup::RayleighDamping{table.number("alpha"), table.number("beta")};
    case setup::DampingKind::structural:
      return setup::StructuralDamping{table.number("loss_factor")};
    case setup::DampingKind::matrices:
      return setup::MatrixDamping{};
  }
  setup::ModalDamping modal{table.number("ratio"), table.numbers("ratios"), {}};
  if (const Table frf = table.table("from_frf"); frf.exists()) modal.from_frf = bind_measured(frf, folder);
  return modal;
}

setup::ResponseOptions bind_response(const Table& table) {
  if (!table.exists()) return {};
  return {table.number("from"), table.number("to"), table.integer("lines"), table.text("spacing") == "logarithmic",
          table.names("points")};
}

/// An amount in the unit of `kind`; NaN if it is not such a quantity (check_case() says why).
double bind_amount(const std::string& text, const core::QuantityKind& kind) {
  try {
    return core::parse_quantity(text, kind);
  } catch (const core::InputError&) {
    return nan;
  }
}

std::vector<setup::Updating> bind_updating(const std::vector<Table>& tables) {
  std::vector<setup::Updating> list;
  for (const auto& table : tables) {
    setup::Updating updating{table.text("name"), table.choice<setup::FitOf>("on"), {}, {}};
    for (const auto& parameter : table.tables("parameters")) {
      const std::string key = full_path(case_schema(), parameter.text("key"));
      const Key* described = find_key(case_schema(), pattern_of(case_schema(), key));
      const auto& kind = described == nullptr ? core::kind::number : described->kind;
      updating.parameters.push_back({key, std::string(kind.unit), bind_amount(parameter.text("lower"), kind),
                                     bind_amount(parameter.text("upper"), kind)});
    }
    for (const auto& target : table.tables("targets")) {
      setup::UpdatingTarget bound;
      bound.quantity = target.choice<setup::FittedQuantity>("quantity");
      bound.value = bind_amount(target.text("value"), bound.quantity == setup::FittedQuantity::reduction_at
                                                          ? core::kind::number
                                                          : core::kind::frequency);
      bound.point = target.text("point");
      bound.match = target.choice<setup::ModeMatch>("match");
      bound.rank = target.integer("rank");
      bound.frequency_hz = target.has("frequency") ? target.number("frequency") : 0.0;
      bound.weight = target.number("weight");
      updating.targets.push_back(std::move(bound));
    }
    list.push_back(std::move(updating));
  }
  return list;
}

std::vector<setup::ToolStep> bind_steps(const std::vector<Table>& tables) {
  std::vector<setup::ToolStep> steps;
  steps.reserve(tables.size());
  for (const Table& step : tables) {
    steps.push_back({step.number("length"), step.number("outer_diameter"), step.number("inner_diameter"),
                     step.number("youngs_modulus"), step.number("poisson_ratio"), step.number("density")});
  }
  return steps;
}

setup::ToolSwap bind_swap(const Table& table, const std::filesystem::path& folder) {
  return {bind_all_measured(table.tables("measured"), folder),
          table.text("tip"),
          table.text("up"),
          table.number("distance"),
          table.choice<setup::SwapRotations>("rotations"),
          bind_steps(table.tables("reference")),
          bind_steps(table.tables("target")),
          table.optional("to"),
          {}};
}

setup::Tool bind_tool(const Table& table, const std::filesystem::path& folder) {
  setup::Tool tool;
  tool.teeth = table.integer("teeth");
  tool.diameter = table.number("diameter");
  tool.length = table.number("length");
  tool.pitches = table.numbers("pitches");
  tool.helices = table.numbers("helices");
  tool.runout = table.numbers("runout");
  tool.end = table.choice<setup::ToolEnd>("end");
  tool.corner_radius = table.optional("corner_radius").value_or(0.0);
  tool.corner_radial = table.optional("corner_radial").value_or(0.0);
  tool.corner_axial = table.optional("corner_axial").value_or(0.0);
  tool.tip_angle = table.optional("tip_angle").value_or(0.0);
  tool.taper = table.optional("taper").value_or(0.0);
  if (tool.helices.size() == 1) tool.helices.resize(static_cast<std::size_t>(tool.teeth), tool.helices.front());
  tool.modes = bind_modes(table.tables("modes"));
  tool.measured = bind_all_measured(table.tables("measured"), folder);
  tool.fit = table.flag("fit");
  if (const Table swap = table.table("swap"); swap.exists()) tool.swap = bind_swap(swap, folder);
  for (setup::MeasuredFrf& frf : tool.measured) {
    for (std::string* dof : {&frf.response, &frf.force}) {
      if (!dof->empty()) *dof = "tool." + *dof;
    }
  }
  return tool;
}

setup::Cutting bind_cutting(const Table& table) {
  setup::Cutting cutting;
  cutting.radial_depth = table.optional("radial_depth");
  cutting.entry_angles = table.numbers("entry_angle");
  cutting.exit_angles = table.numbers("exit_angle");
  cutting.lead_angle = table.number("lead_angle");
  cutting.down_milling = table.text("mode") != "up";
  cutting.feed_direction = table.direction("feed_direction");
  cutting.tool_axis = table.direction("tool_axis");
  cutting.at = table.text("at");
  cutting.Kt = table.number("Kt");
  cutting.Kr = table.number("Kr");
  cutting.Ka = table.number("Ka");
  cutting.Kte = table.number("Kte");
  cutting.Kre = table.number("Kre");
  cutting.Kae = table.number("Kae");
  cutting.law = table.choice<setup::ForceLawKind>("law");
  cutting.exponents = table.numbers("exponents", 3);
  cutting.chip_scale = table.optional("chip_scale");
  cutting.stiffness_ratio = table.optional("stiffness_ratio");
  cutting.orthogonal = {table.optional("shear_stress"), table.optional("shear_angle"), table.optional("friction_angle"),
                        table.optional("rake_angle")};
  cutting.process_damping = table.number("process_damping");
  cutting.process_damping_friction = table.number("process_damping_friction");
  cutting.spindle_speed_rpm = table.optional("spindle_speed");
  cutting.feed_rate = table.optional("feed_rate");
  cutting.feed_per_tooth = table.optional("feed_per_tooth");
  return cutting;
}

/// The point up the tool of the robot's tables, where another tool is swapped in at its modes.
std::optional<setup::PointUp> bind_point_up(const Case& bound) {
  if (!setup::carries_tool(bound.robot) || !bound.tool || !bound.cutting || !setup::swapped_on_robot(*bound.tool))
    return std::nullopt;
  const auto* robot = setup::tabled_robot(bound.robot);
  if (robot == nullptr) return std::nullopt;
  const setup::ToolSwap& swap = *bound.tool->swap;
  return setup::PointUp{swap.up, swap.distance * (robot->base.linear().transpose() * bound.cutting->tool_axis)};
}

std::vector<std::string> point_names(const std::vector<setup::Point>& points) {
  std::vector<std::string> names;
  names.reserve(points.size());
  for (const auto& point : points) names.push_back(point.name);
  return names;
}

}  // namespace

Case bind_case(CaseValues values, const std::filesystem::path& folder) {
  const Table root{values, ""};
  Case bound;
  bound.folder = folder;
  bound.title = core::printable_text(root.text("title"));
  if (root.has("part.shape")) bound.part = bind_part(root.table("part"), folder);
  bound.measured_part = bind_all_measured(root.tables("part.measured"), folder);
  bound.part_sensors = bind_sensors(root.tables("part.sensors"));
  bound.selections = bind_selections(root.table("selections"));
  bound.points = bind_points(root.table("points"));
  bound.modes = {bind_range(root.table("modes"), "count", 10), root.flag("modes.verify"),
                 root.has("modes.substructures") ? root.integer("modes.substructures") : 0};
  bound.reduction.fixed_interface = bind_range(root.table("reduction"), "modes", setup::usual_reduction_modes);
  bound.reduction.tolerance = root.table("reduction").optional("tolerance");
  bound.reduction.interface = root.names("reduction.interface");
  if (bound.reduction.interface.empty()) bound.reduction.interface = point_names(bound.points);
  if (root.has("reduction.check_frequencies"))
    bound.reduction.check_frequencies = root.integer("reduction.check_frequencies");
  bound.damping = bind_damping(root.table("damping"), folder);
  if (root.table("robot").exists()) bound.robot = bind_robot(root.table("robot"), folder);
  bound.contacts = bind_contacts(root.tables("contacts"), folder);
  if (root.table("coupling").exists())
    bound.coupling = {root.choice<coupling::Regularisation>("coupling.regularisation"),
                      root.table("coupling").optional("threshold").value_or(setup::CouplingChoice{}.threshold)};
  bound.response = bind_response(root.table("response"));
  if (bound.response.points.empty()) bound.response.points = bound.reduction.interface;
  bound.updating = bind_updating(root.tables("updating"));
  if (root.table("tool").exists()) bound.tool = bind_tool(root.table("tool"), folder);
  if (root.table("cutting").exists()) bound.cutting = bind_cutting(root.table("cutting"));
  if (root.table("lobes").exists()) bound.lobes = bind_lobes(root.table("lobes"), bound.tool);
  bound.observed = bind_observed(root.tables("observed"), folder);
  if (root.table("calibration").exists()) bound.calibration = bind_calibration(root.table("calibration"));
  if (root.table("machine").exists()) bound.machine = bind_machine(root.table("machine"));
  if (root.table("path").exists()) bound.path = bind_path(root.table("path"));
  if (setup::carries_tool(bound.robot)) {
    if (bound.cutting) bound.robot->cut_point = bound.cutting->at;
    if (auto* robot = setup::tabled_robot(bound.robot)) {
      robot->up = bind_point_up(bound);
      if (robot->up) bound.tool->swap->tip = robot->table_point;  // or the default could be the point up
    }
    if (bound.path) bound.path->robot_follows = true;  // with the tool
  }
  if (root.table("simulation").exists()) bound.simulation = bind_simulation(root.table("simulation"), bound.lobes);
  bound.values = std::move(values);
  bound.data_files = named_files(bound);
  return bound;
}

std::vector<Expectation> bind_expectations(const CaseValues& values) {
  std::vector<Expectation> list;
  for (const auto& table : Table{values, ""}.tables("expect")) {
    list.push_back({table.text("name"), table.text("quantity"), table.optional("value"), table.optional("tolerance"),
                    table.optional("relative"), table.optional("at_least"), table.optional("at_most"),
                    table.text("origin"), table.text("same_as")});
  }
  return list;
}

}  // namespace thinwall::cases
