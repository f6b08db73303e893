#include "case/data_files.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <variant>

#include "case/robot_binding.hpp"
#include "case/urdf_arm.hpp"
#include "core/error.hpp"
#include "io/manifest.hpp"
#include "io/urdf.hpp"
#include "setup/contact_model.hpp"
#include "setup/data_files.hpp"
#include "setup/identified/posture_tables.hpp"
#include "setup/imported_part.hpp"
#include "setup/robot_tip.hpp"

namespace thinwall::cases {

namespace {

/// Reports an error in one line at the key.
void report_error(const std::string& key, Findings& findings, const core::Error& error) {
  std::string text = error.what();
  for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n', end)) text.replace(end, 1, "; ");
  findings.report(key, text);
}

/// Reads a file by `read`; what is wrong with it is reported at the key, or at the key of the chain's end that is.
void read_or_report(const std::string& key, Findings& findings, const std::function<void()>& read) {
  try {
    read();
  } catch (const core::Interrupted&) {
    throw;  // nothing is wrong with the file
  } catch (const io::UrdfEndError& error) {
    report_error(key + (error.tip ? "_tip" : "_base"), findings, error);
  } catch (const setup::TabledRobotError& error) {
    report_error("robot." + error.key, findings, error);
  } catch (const core::Error& error) {
    report_error(key, findings, error);
  }
}

bool is_file(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

/// False of folders, pipes and devices, which the checks report.
bool file_or_absent(const std::filesystem::path& file) {
  std::error_code ignored;
  return is_file(file) || !std::filesystem::exists(file, ignored);
}

/// The model of the robot, where it is of that kind; null otherwise.
template <class Model>
Model* model_of(Case& source) {
  return source.robot ? std::get_if<Model>(&source.robot->model) : nullptr;
}

/// The arm with joints of the case: the robot itself, or the mean of its modes over postures; null if there is none.
setup::JointedRobot* jointed_of(Case& source) {
  if (auto* tabled = model_of<setup::TabledRobot>(source)) return tabled->mean ? &*tabled->mean : nullptr;
  return model_of<setup::JointedRobot>(source);
}

/// The arm of a URDF, unless keys speak against it, which the checks report.
void read_arm(Case& source, setup::JointedRobot& robot, Findings& findings) {
  if (robot.urdf.empty() || robot.joints.empty() || array_size(source.values, "robot.links") > 0) return;
  if (!file_or_absent(robot.urdf) || !file_or_absent(robot.joints)) return;
  const Table table{source.values, "robot"};
  read_or_report("robot.urdf", findings, [&] {
    source.urdf_arm = std::make_shared<const UrdfArm>(
        urdf_arm(robot.urdf, table.text("urdf_base"), table.text("urdf_tip"), robot.joints));
    robot.arm = arm_in_place(table, source.urdf_arm->arm);
  });
}

}  // namespace

void read_described_files(Case& source, Findings& findings) {
  if (auto* robot = jointed_of(source)) read_arm(source, *robot, findings);
  if (auto* robot = model_of<setup::TabledRobot>(source);
      robot != nullptr && !robot->table.empty() && (robot->postures || file_or_absent(robot->table)))
    read_or_report("robot.table", findings, [&] { setup::read_table_of_modes(*robot); });
  for (std::size_t i = 0; i < source.contacts.size(); ++i) {
    auto* tabled = std::get_if<setup::TabledContact>(&source.contacts[i].model);
    if (tabled == nullptr || !is_file(tabled->table)) continue;
    read_or_report(indexed("contacts", i) + ".table", findings, [&] {
      tabled->rows = std::make_shared<const coupling::ContactTable>(setup::read_contact_table(tabled->table));
    });
  }
}

void read_data_files(Case& source) {
  setup::read_data_files(source);
  if (source.part && source.part->imported && source.part->imported->mesh) {
    for (const auto& path : source.part->imported->mesh->included) source.data_files.push_back({path, "part", {}});
  }
  std::map<std::filesystem::path, std::string> checksums;  // a file may be named more than once
  for (DataFile& file : source.data_files) {
    const auto [place, is_new] = checksums.try_emplace(file.path);
    if (is_new) place->second = io::sha256_of_file(file.path);
    file.sha256 = place->second;
  }
}

void share_data_files(Case& varied, const Case& read) {
  setup::share_data_files(varied, read);
  varied.data_files = read.data_files;
  varied.urdf_arm = read.urdf_arm;
  auto* robot = jointed_of(varied);
  if (robot != nullptr && varied.urdf_arm) robot->arm = arm_in_place({varied.values, "robot"}, varied.urdf_arm->arm);
}

}  // namespace thinwall::cases
