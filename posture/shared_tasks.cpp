#include "posture/shared_tasks.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "posture/mode_targets.hpp"
#include "regression/cross_validation.hpp"

namespace thinwall::posture {

namespace {

constexpr std::size_t fewest_postures = 8;

/// The mode of a label: the postures that have it, and its numbers at them.
struct SeenMode {
  int label = 0;
  std::vector<std::size_t> postures;
  Eigen::MatrixXd numbers;
};

std::vector<SeenMode> seen_modes(const std::vector<TappedPosture>& postures) {
  std::map<int, std::vector<std::pair<std::size_t, std::size_t>>> at;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    for (std::size_t k = 0; k < postures[i].label.size(); ++k) at[postures[i].label[k]].emplace_back(i, k);
  }
  std::vector<SeenMode> modes;
  for (const auto& [label, where] : at) {
    SeenMode mode{label, {}, {}};
    for (const auto& [i, k] : where) {
      const Eigen::VectorXd numbers = targets_of(postures[i].modes[k]);
      if (mode.numbers.cols() == 0) mode.numbers.resize(std::ssize(where), numbers.size());
      mode.numbers.row(std::ssize(mode.postures)) = numbers;
      mode.postures.push_back(i);
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

/// The number of a mode's postures outside of the fold that has most of them.
std::size_t fewest_beside_a_fold(const SeenMode& mode, const std::vector<int>& fold) {
  std::map<int, std::size_t> in;
  for (const std::size_t i : mode.postures) ++in[fold[i]];
  std::size_t most = 0;
  for (const auto& [number, postures] : in) most = std::max(most, postures);
  return mode.postures.size() - most;
}

/// The columns of one place each, for the places of a mode.
regression::TaskData data_of(const std::vector<TappedPosture>& postures, const SharedTasks& tasks) {
  regression::TaskData data{Eigen::MatrixXd(std::ssize(tasks.postures), postures.front().place.at.size()),
                            tasks.measured};
  for (Eigen::Index i = 0; i < data.places(); ++i)
    data.inputs.row(i) = postures[tasks.postures[static_cast<std::size_t>(i)]].place.at;
  return data;
}

/// The search of a fold begins at what all postures say, which is near its end.
regression::SearchOptions from(const regression::GaussianProcess& all, regression::SearchOptions options) {
  options.starts = 1;
  options.first = all.found().parameters;
  return options;
}

void learn(const regression::TaskData& data, const std::vector<int>& fold, const regression::SearchOptions& options,
           SharedTasks& tasks) {
  const Eigen::Index count = data.tasks();
  tasks.left_out.resize(data.places(), count);
  tasks.left_out_deviation = tasks.left_out;
  tasks.R2_alone.resize(count);
  for (Eigen::Index t = 0; t < count; ++t) {
    const regression::TaskData one{data.inputs, data.targets.col(t)};
    const regression::GaussianProcess process(one, options);
    const regression::LeaveOneOut left = process.leave_one_out();
    tasks.left_out.col(t) = left.mean;
    tasks.left_out_deviation.col(t) = left.variance.cwiseSqrt();
    tasks.ln_p_alone += process.found().log_likelihood;
    tasks.R2_alone(t) = regression::cross_validate(one, fold, from(process, options)).R2(0);
  }
  const regression::GaussianProcess together(data, options);
  tasks.ln_p_together = together.found().log_likelihood;
  tasks.R2_together = regression::cross_validate(data, fold, from(together, options)).R2;
}

}  // namespace

Sharing SharedTasks::sharing() const {
  constexpr double noticed = 0.005;
  const double gain = R2_together.mean() - R2_alone.mean();
  return gain > noticed ? Sharing::gains : gain < -noticed ? Sharing::loses : Sharing::none;
}

std::vector<Eigen::Index> numbers_of(NumberGroup group, Eigen::Index entries) {
  if (group == NumberGroup::frequency_and_damping) return {0, 1};
  std::vector<Eigen::Index> numbers;
  const Eigen::Index first = group == NumberGroup::real_parts ? 2 : 2 + entries;
  for (Eigen::Index e = 0; e < entries; ++e) numbers.push_back(first + e);
  return numbers;
}

std::vector<SharedTasks> alone_and_together(const std::vector<TappedPosture>& postures, const std::vector<int>& fold,
                                            const regression::SearchOptions& options) {
  if (fold.size() != postures.size())
    throw core::InputError("processes alone and together: " + std::to_string(fold.size()) + " numbers of folds for " +
                           std::to_string(postures.size()) + " postures; must be as many");
  std::vector<SharedTasks> all;
  for (const SeenMode& mode : seen_modes(postures)) {
    if (mode.postures.size() < fewest_postures || fewest_beside_a_fold(mode, fold) < 2) continue;
    for (const NumberGroup group :
         {NumberGroup::frequency_and_damping, NumberGroup::real_parts, NumberGroup::imaginary_parts}) {
      SharedTasks tasks{.label = mode.label, .group = group, .postures = mode.postures};
      tasks.measured = mode.numbers(Eigen::all, numbers_of(group, (mode.numbers.cols() - 2) / 2));
      all.push_back(std::move(tasks));
    }
  }
  core::Progress progress("groups of numbers", all.size());
  core::parallel_for(all.size(), [&](std::size_t i) {
    std::vector<int> of_mode;
    for (const std::size_t posture : all[i].postures) of_mode.push_back(fold[posture]);
    learn(data_of(postures, all[i]), of_mode, options, all[i]);
    progress.step();
  });
  return all;
}

}  // namespace thinwall::posture
