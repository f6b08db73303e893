#include "setup/contact_model.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "io/results/csv_table.hpp"

namespace thinwall::setup {

namespace {

double required_preload(const SupportSetup& source, const SupportContact& contact) {
  if (const auto preload = preload_of(source, contact)) return *preload;
  throw core::InputError(
      "its stiffness depends on the preload, and none presses it: give contacts.preload" +
      std::string(source.contacts.size() == 1 ? ", or robot.preload along its first direction" : ""));
}

coupling::Elastic surface_of(const PartSetup& source, const std::optional<coupling::Elastic>& given) {
  if (given) return *given;
  if (source.part && kind(*source.part) != ShapeKind::matrices)
    return {source.part->material.youngs_modulus, source.part->material.poisson_ratio};
  throw core::InputError("what the ball touches is not known: give [contacts.surface]");
}

/// Between the ball and the surface under the preload.
coupling::HertzState touch(const ContactBall& ball, const coupling::Elastic& surface, double preload_n) {
  return coupling::hertz({coupling::relative_radius(ball.radius), ball.steel, surface}, preload_n);
}

/// Adds the springs that each model of a contact gives; the preload is in the result.
struct Joining {
  const PartSetup& part;
  const SupportContact& contact;
  JoinedContact& result;

  void add(const std::vector<double>& stiffness, const std::vector<double>& damping) const {
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      result.contact.springs.push_back({contact.directions[i], stiffness[i], damping[i], contact.loss_factor});
  }

  void operator()(const SpringContact& springs) const { add(springs.stiffness, springs.damping); }

  void operator()(const TabledContact& tabled) const {
    if (!tabled.rows) throw core::InputError("its table was not read; call setup::read_data_files()");
    result.contact.springs.push_back(coupling::spring_at(*tabled.rows, *result.preload_n, contact.directions.front()));
    result.contact.springs.back().loss_factor = contact.loss_factor;
  }

  void operator()(const BallContact& pressed) const {
    result.hertz = touch(pressed.ball, surface_of(part, pressed.surface), *result.preload_n);
    std::vector<double> stiffness(contact.directions.size(), result.hertz->tangential);
    stiffness.front() = result.hertz->normal;
    add(stiffness, pressed.damping);
  }

  void operator()(const CasterContact& caster) const {
    const coupling::Elastic surface = surface_of(part, caster.surface);
    result.hertz = touch(caster.ball, surface, *result.preload_n);
    const coupling::BallCaster balls{caster.ball.radius, caster.support_radius, caster.supports, caster.support_angle,
                                     caster.ball.steel};
    add({coupling::caster_stiffness(balls, surface, *result.preload_n)}, caster.damping);
  }
};

}  // namespace

std::optional<double> own_preload(const SupportContact& contact) {
  return std::visit(core::overloaded{[](const SpringContact&) { return std::optional<double>(); },
                                     [](const auto& pressed) { return pressed.preload; }},
                    contact.model);
}

std::optional<double> preload_of(const SupportSetup& source, const SupportContact& contact) {
  if (const auto preload = own_preload(contact)) return preload;
  if (!source.robot || source.contacts.size() != 1 || contact.directions.empty()) return std::nullopt;
  const Eigen::Vector3d& force = source.robot->preload;
  const double pressing = std::abs(force.dot(contact.directions.front()));
  return pressing > 1e-9 * force.norm() ? std::optional(pressing) : std::nullopt;
}

coupling::ContactTable read_contact_table(const std::filesystem::path& path) {
  const io::Table file = io::read_csv(path);
  const auto column = [&](const char* name) -> Eigen::VectorXd {
    const std::vector<double>& list = io::numbers(file, name, path);
    return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
  };
  coupling::ContactTable table{column("preload_n"), column("stiffness_n_per_m"), column("damping_n_s_per_m")};
  try {
    coupling::require_valid(table);
  } catch (const core::InputError& error) {
    throw core::DataError(path.string() + ": " + error.what());
  }
  return table;
}

JoinedContact joined_contact(const PartSetup& part, const SupportSetup& support, const SupportContact& contact,
                             const std::optional<coupling::JointMatrices>& identified) {
  JoinedContact result{core::word_of(kind(contact)), {contact.part_point, contact.robot_point, {}, {}}, {}, {}};
  if (identified) {
    result.model = "identified";
    result.contact.matrices = *identified;
    for (const auto& direction : contact.directions) result.contact.springs.push_back({direction});
    return result;
  }
  if (kind(contact) != ContactKind::springs) result.preload_n = required_preload(support, contact);
  std::visit(Joining{part, contact, result}, contact.model);
  return result;
}

std::vector<JoinedContact> joined_contacts(const PartSetup& part, const SupportSetup& support,
                                           const std::optional<coupling::JointMatrices>& identified) {
  std::vector<JoinedContact> list;
  list.reserve(support.contacts.size());
  for (const SupportContact& contact : support.contacts) {
    try {
      list.push_back(joined_contact(part, support, contact, list.empty() ? identified : std::nullopt));
    } catch (const core::InputError& error) {
      throw core::InputError("contact " + contact.part_point + "-" + contact.robot_point + ": " + error.what());
    }
  }
  return list;
}

}  // namespace thinwall::setup
