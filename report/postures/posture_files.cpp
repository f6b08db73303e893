#include "report/postures/posture_files.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "core/atomic_file.hpp"
#include "io/json_file.hpp"
#include "io/results/csv_table.hpp"
#include "posture/mode_targets.hpp"
#include "report/page/page.hpp"
#include "report/postures/posture_page.hpp"
#include "report/postures/posture_summary.hpp"
#include "report/summary/write_json.hpp"

namespace thinwall::report {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A table that grows by rows of words and of numbers; columns are made by the first row.
class Rows {
 public:
  void word(const std::string& column, const std::string& value) { words(column).push_back(value); }
  void number(const std::string& column, double value) { numbers(column).push_back(value); }
  void place(const std::vector<std::string>& over, const Eigen::RowVectorXd& at) {
    for (std::size_t c = 0; c < over.size(); ++c) number(over[c], at(static_cast<Eigen::Index>(c)));
  }
  void write(const std::filesystem::path& file, const std::vector<std::string>& comments) const {
    if (!table_.empty()) io::write_csv(file, table_, comments);
  }

 private:
  io::Column& column(const std::string& name) {
    const auto found = std::ranges::find(table_, name, &io::Column::name);
    if (found != table_.end()) return *found;
    return table_.emplace_back(io::Column{name, std::vector<double>{}, true});
  }
  std::vector<double>& numbers(const std::string& name) { return std::get<std::vector<double>>(column(name).values); }
  std::vector<std::string>& words(const std::string& name) {
    io::Column& to = column(name);
    if (std::holds_alternative<std::vector<double>>(to.values)) to.values = std::vector<std::string>{};
    return std::get<std::vector<std::string>>(to.values);
  }

  io::Table table_;
};

void write_modes(const std::filesystem::path& file, const study::PostureStudy& study) {
  Rows rows;
  for (std::size_t i = 0; i < study.postures.size(); ++i) {
    const posture::TappedPosture& posture = study.postures[i];
    for (std::size_t k = 0; k < posture.modes.size(); ++k) {
      rows.word("posture", study.names[i]);
      rows.place(study.over, study.places.row(static_cast<Eigen::Index>(i)));
      rows.number("mode", posture.label[k] + 1);
      rows.number("frequency_hz", posture.modes[k].frequency_hz);
      rows.number("damping_ratio", posture.modes[k].damping_ratio);
      const Eigen::VectorXd numbers = posture::targets_of(posture.modes[k]);
      for (Eigen::Index t = 2; t < numbers.size(); ++t) rows.number(number_name(t, study.dofs) + "_per_kg", numbers(t));
    }
  }
  rows.write(file, {"Modes followed over the postures: one number is one mode of the robot.",
                    "re and im: parts of 2 i omega_d R L^T between response and force"});
}

/// Each number alone from all other postures, by posture, mode and number.
std::map<std::pair<std::size_t, int>, std::map<Eigen::Index, std::pair<double, double>>> left_out_of(
    const study::PostureStudy& study) {
  std::map<std::pair<std::size_t, int>, std::map<Eigen::Index, std::pair<double, double>>> left;
  const Eigen::Index entries = std::ssize(study.dofs) * std::ssize(study.dofs);
  for (const posture::SharedTasks& tasks : study.shared) {
    const std::vector<Eigen::Index> numbers = posture::numbers_of(tasks.group, entries);
    for (std::size_t i = 0; i < tasks.postures.size(); ++i) {
      for (std::size_t t = 0; t < numbers.size(); ++t) {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(t);
        left[{tasks.postures[i], tasks.label}][numbers[t]] = {tasks.left_out(row, column),
                                                              tasks.left_out_deviation(row, column)};
      }
    }
  }
  return left;
}

void write_errors(const std::filesystem::path& file, const study::PostureStudy& study) {
  if (!study.held_out) return;
  auto left = left_out_of(study);
  Rows rows;
  for (const posture::HeldOutMode& mode : study.held_out->modes) {
    auto& alone = left[{mode.posture, mode.label}];
    for (Eigen::Index t = 0; t < mode.measured.size(); ++t) {
      rows.word("posture", study.names[mode.posture]);
      rows.number("mode", mode.label + 1);
      rows.word("number", number_name(t, study.dofs));
      rows.number("measured", mode.measured(t));
      rows.number("predicted", mode.predicted(t));
      rows.number("deviation", mode.deviation(t));
      const auto known = alone.find(t);
      rows.number("left_out", known == alone.end() ? unknown : known->second.first);
      rows.number("left_out_deviation", known == alone.end() ? unknown : known->second.second);
    }
  }
  rows.write(file,
             {"Numbers of modes as others tell them: predicted from the postures of the other folds,",
              "left_out by a process of likeliest hyper-parameters from all other postures; deviations with noise"});
}

void write_depths(const std::filesystem::path& file, const study::PostureStudy& study) {
  if (!study.held_out || !study.spindle_speed_rpm) return;
  Rows rows;
  for (const posture::HeldOutDepths& at : study.held_out->depths) {
    rows.word("posture", study.names[at.posture]);
    rows.number("spindle_speed_rpm", *study.spindle_speed_rpm);
    rows.number("measured_depth_m", at.measured(0));
    rows.number("predicted_depth_m", at.predicted(0));
    rows.number("low_depth_m", at.low(0));
    rows.number("high_depth_m", at.high(0));
  }
  rows.write(file, {"Limiting depths with the modes that were measured, and as the other folds predict them; 95 % lie "
                    "between low and high"});
}

void write_curve(const std::filesystem::path& file, const study::PostureStudy& study) {
  if (!study.curves) return;
  Rows rows;
  const auto has_depth = [](const posture::LearningPoint& at) { return at.depth_error.has_value(); };
  const bool depths =
      std::ranges::any_of(study.curves->plain, has_depth) || std::ranges::any_of(study.curves->with_arm, has_depth);
  const auto add = [&](const char* mean, const std::vector<posture::LearningPoint>& curve) {
    for (const posture::LearningPoint& at : curve) {
      rows.word("mean", mean);
      rows.number("postures", at.postures);
      rows.number("frequency_error", at.frequency_error);
      if (depths) rows.number("depth_error", at.depth_error.value_or(unknown));
    }
  };
  add("none", study.curves->plain);
  add("arm", study.curves->with_arm);
  rows.write(file, {"Median relative errors at postures that were not learned from, by the number of those that were"});
}

void write_sharing(const std::filesystem::path& file, const study::PostureStudy& study) {
  const Eigen::Index entries = std::ssize(study.dofs) * std::ssize(study.dofs);
  Rows rows;
  for (const posture::SharedTasks& tasks : study.shared) {
    const std::vector<Eigen::Index> numbers = posture::numbers_of(tasks.group, entries);
    for (std::size_t t = 0; t < numbers.size(); ++t) {
      rows.number("mode", tasks.label + 1);
      rows.word("group", std::string(core::word_of(tasks.group)));
      rows.word("number", number_name(numbers[t], study.dofs));
      rows.number("r2_alone", tasks.R2_alone(static_cast<Eigen::Index>(t)));
      rows.number("r2_together", tasks.R2_together(static_cast<Eigen::Index>(t)));
      rows.number("ln_likelihood_alone", tasks.ln_p_alone);
      rows.number("ln_likelihood_together", tasks.ln_p_together);
      rows.word("sharing", std::string(core::word_of(tasks.sharing())));
    }
  }
  rows.write(file,
             {"Numbers of a mode, each learned alone and those of a group together; likelihoods are the group's"});
}

void write_map(const std::filesystem::path& file, const study::PostureStudy& study) {
  Rows rows;
  for (std::size_t i = 0; i < study.map.size(); ++i) {
    const posture::MappedPlace& at = study.map[i];
    rows.place(study.over, study.mapped_at.row(static_cast<Eigen::Index>(i)));
    rows.number("first_frequency_hz", at.first_hz.value);
    rows.number("first_frequency_low_hz", at.first_hz.low);
    rows.number("first_frequency_high_hz", at.first_hz.high);
    if (!at.depth) continue;
    rows.number("spindle_speed_rpm", at.depth->spindle_speed_rpm);
    rows.number("depth_m", at.depth->depth_m.value);
    rows.number("low_depth_m", at.depth->depth_m.low);
    rows.number("high_depth_m", at.depth->depth_m.high);
  }
  rows.write(file, {"First frequency and limiting depth over the workspace; 95 % lie between low and high"});
}

void write_envelope(const std::filesystem::path& file, const study::PostureStudy& study) {
  if (!study.envelope) return;
  const auto column = [](const Eigen::VectorXd& values) { return std::vector<double>(values.begin(), values.end()); };
  io::write_csv(file,
                {{"spindle_speed_rpm", study.chart_rpm},
                 {"low_modes_depth_m", column(study.envelope->low)},
                 {"high_modes_depth_m", column(study.envelope->high)},
                 {"envelope_depth_m", column(study.envelope->lower)},
                 {"all_modes_depth_m", column(study.envelope->together)}},
                {"Limiting depths at robot.at of the low and the high modes by themselves, the lesser of both, and "
                 "of all modes together"});
}

void write_next(const std::filesystem::path& file, const study::PostureStudy& study) {
  if (!study.next) return;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(study.next->reduction.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](Eigen::Index i) { return study.next->reduction(i); });
  Rows rows;
  for (const Eigen::Index i : order) {
    rows.place(study.over, study.candidates.row(i));
    rows.number("reduction", study.next->reduction(i));
  }
  rows.write(file, {"Candidates for the next posture, with the share of the variance along the path that a test there "
                    "is expected to take"});
}

}  // namespace

void write_posture_study(const std::filesystem::path& folder, const study::PostureStudy& study,
                         const std::string& title, const std::string& program) {
  std::filesystem::create_directories(folder);
  write_modes(folder / "modes.csv", study);
  write_errors(folder / "errors.csv", study);
  write_depths(folder / "depths.csv", study);
  write_curve(folder / "curve.csv", study);
  write_sharing(folder / "sharing.csv", study);
  write_map(folder / "map.csv", study);
  write_envelope(folder / "envelope.csv", study);
  write_next(folder / "next.csv", study);
  io::write_json(folder / "postures.json", json_of(summary_of(study)));
  core::write_file_atomically(folder / "postures.html", page(posture_document(study, title, program)));
}

}  // namespace thinwall::report
