#include "case/contact_binding.hpp"

#include "case/measured_binding.hpp"

namespace thinwall::cases {

namespace {

setup::ContactBall bind_ball(const Table& table) {
  return {table.number("radius"), {table.number("youngs_modulus"), table.number("poisson_ratio")}};
}

std::optional<coupling::Elastic> bind_surface(const Table& table) {
  if (!table.exists()) return std::nullopt;
  return coupling::Elastic{table.number("youngs_modulus"), table.number("poisson_ratio")};
}

setup::ContactModel bind_model(const Table& table, std::size_t directions, const std::filesystem::path& folder) {
  const Table ball = table.table("ball"), surface = table.table("surface");
  const std::vector<double> damping = table.numbers("damping", directions);
  switch (table.choice<setup::ContactKind>("model")) {
    case setup::ContactKind::springs:
      break;
    case setup::ContactKind::table:
      return setup::TabledContact{
          table.optional("preload"), table.has("table") ? folder / table.text("table") : std::filesystem::path(), {}};
    case setup::ContactKind::hertz:
      return setup::BallContact{table.optional("preload"), damping, bind_ball(ball), bind_surface(surface)};
    case setup::ContactKind::caster:
      return setup::CasterContact{table.optional("preload"),
                                  damping,
                                  bind_ball(ball),
                                  bind_surface(surface),
                                  ball.integer("supports"),
                                  ball.number("support_radius"),
                                  ball.number("support_angle")};
  }
  return setup::SpringContact{table.numbers("stiffness", directions), damping,
                              bind_all_measured(table.tables("measured"), folder),
                              table.choice<setup::DampingSought>("damping_model"), table.numbers("noise", 3)};
}

}  // namespace

std::vector<setup::SupportContact> bind_contacts(const std::vector<Table>& tables,
                                                 const std::filesystem::path& folder) {
  std::vector<setup::SupportContact> list;
  list.reserve(tables.size());
  for (const Table& table : tables) {
    std::vector<Eigen::Vector3d> directions = table.directions("directions");
    const std::size_t count = directions.size();
    list.push_back({table.text("part"), table.text("robot"), std::move(directions), table.number("loss_factor"),
                    bind_model(table, count, folder)});
  }
  return list;
}

}  // namespace thinwall::cases
