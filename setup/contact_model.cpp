#include "setup/contact_model.hpp"

#include <cmath>

#include "core/error.hpp"
#include "io/results/csv_table.hpp"

namespace thinwall::setup {

namespace {

double required_preload(const SupportSetup& source, const Contact& contact) {
  if (const auto preload = preload_of(source, contact)) return *preload;
  throw core::InputError(
      "its stiffness depends on the preload, and none presses it: give contacts.preload" +
      std::string(source.contacts.size() == 1 ? ", or robot.preload along its first direction" : ""));
}

coupling::Elastic surface_of(const PartSetup& source, const Contact& contact) {
  if (contact.surface) return *contact.surface;
  if (source.part && source.part->shape != PartShape::matrices)
    return {source.part->material.youngs_modulus, source.part->material.poisson_ratio};
  throw core::InputError("what the ball touches is not known: give [contacts.surface]");
}

coupling::BallCaster caster_of(const ContactBall& ball) {
  return {ball.radius, ball.support_radius.value_or(0.0), ball.supports.value_or(0), ball.support_angle.value_or(0.0),
          ball.steel};
}

/// Stiffness of a ball along each direction, N/m.
std::vector<double> ball_stiffness(const PartSetup& source, const Contact& contact, JoinedContact& result) {
  if (!contact.ball) throw core::InputError("its ball is not known: give [contacts.ball]");
  const coupling::Elastic surface = surface_of(source, contact);
  const coupling::HertzContact touch{coupling::relative_radius(contact.ball->radius), contact.ball->steel, surface};
  result.hertz = coupling::hertz(touch, *result.preload_n);
  if (contact.model == ContactModel::caster)
    return {coupling::caster_stiffness(caster_of(*contact.ball), surface, *result.preload_n)};
  std::vector<double> stiffness(contact.directions.size(), result.hertz->tangential);
  stiffness.front() = result.hertz->normal;
  return stiffness;
}

}  // namespace

std::optional<double> preload_of(const SupportSetup& source, const Contact& contact) {
  if (contact.preload) return contact.preload;
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

JoinedContact joined_contact(const PartSetup& part, const SupportSetup& support, const Contact& contact,
                             const std::optional<coupling::JointMatrices>& identified) {
  JoinedContact result{core::word_of(contact.model), {contact.part_point, contact.robot_point, {}, {}}, {}, {}};
  if (identified) {
    result.model = "identified";
    result.contact.matrices = *identified;
    for (const auto& direction : contact.directions) result.contact.springs.push_back({direction});
    return result;
  }
  if (contact.model != ContactModel::springs) result.preload_n = required_preload(support, contact);
  if (contact.model == ContactModel::table) {
    if (!contact.rows) throw core::InputError("its table was not read; call setup::read_data_files()");
    result.contact.springs.push_back(coupling::spring_at(*contact.rows, *result.preload_n, contact.directions.front()));
    result.contact.springs.back().loss_factor = contact.loss_factor;
    return result;
  }
  const std::vector<double> stiffness =
      contact.model == ContactModel::springs ? contact.stiffness : ball_stiffness(part, contact, result);
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    result.contact.springs.push_back({contact.directions[i], stiffness[i], contact.damping[i], contact.loss_factor});
  return result;
}

std::vector<JoinedContact> joined_contacts(const PartSetup& part, const SupportSetup& support,
                                           const std::optional<coupling::JointMatrices>& identified) {
  std::vector<JoinedContact> list;
  list.reserve(support.contacts.size());
  for (const Contact& contact : support.contacts) {
    try {
      list.push_back(joined_contact(part, support, contact, list.empty() ? identified : std::nullopt));
    } catch (const core::InputError& error) {
      throw core::InputError("contact " + contact.part_point + "-" + contact.robot_point + ": " + error.what());
    }
  }
  return list;
}

}  // namespace thinwall::setup
