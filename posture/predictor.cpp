#include "posture/predictor.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "posture/calibration.hpp"
#include "posture/hull.hpp"
#include "posture/mode_targets.hpp"

namespace thinwall::posture {

namespace {

using identification::FittedMode;

[[noreturn]] void refuse(const std::string& what) {
  throw core::InputError("posture regression: " + what);
}

void require_alike(const TappedPosture& posture, const TappedPosture& first, std::size_t number) {
  const std::string where = "posture " + std::to_string(number + 1);
  if (posture.place.at.size() != first.place.at.size())
    refuse(where + " has " + std::to_string(posture.place.at.size()) + " coordinates, must be " +
           std::to_string(first.place.at.size()) + " as the first has");
  if (posture.label.size() != posture.modes.size())
    refuse(where + " has " + std::to_string(posture.label.size()) + " labels for " +
           std::to_string(posture.modes.size()) + " modes, must be as many; track the modes first");
  if (posture.place.turn.responses.size() != first.place.turn.responses.size() ||
      posture.place.turn.references.size() != first.place.turn.references.size())
    refuse(where + " has another turn into the tip's frame than the first, must be of the same size; give all or none");
  if (posture.rest.size() > 0 && !posture.modes.empty() && posture.rest.size() != posture.modes.front().residue.size())
    refuse(where + " has " + std::to_string(posture.rest.size()) + " entries of the rest, must be " +
           std::to_string(posture.modes.front().residue.size()) + " as of a residue");
}

Eigen::MatrixXd places_of(const std::vector<TappedPosture>& postures) {
  if (postures.empty()) refuse("no posture, must be at least one");
  Eigen::MatrixXd places(static_cast<Eigen::Index>(postures.size()), postures.front().place.at.size());
  for (std::size_t i = 0; i < postures.size(); ++i) {
    require_alike(postures[i], postures.front(), i);
    const auto row = static_cast<Eigen::Index>(i);
    places.row(row) = postures[i].place.at;
    for (Eigen::Index j = 0; j < row; ++j) {
      if ((places.row(j) - places.row(row)).norm() < 1e-9)
        refuse("postures " + std::to_string(j + 1) + " and " + std::to_string(i + 1) +
               " have the same place, must be different; average them or leave one out");
    }
  }
  return places;
}

/// Number of the posture's mode of that label, −1 for none.
int mode_of_label(const TappedPosture& posture, int label) {
  const auto at = std::ranges::find(posture.label, label);
  return at == posture.label.end() ? -1 : static_cast<int>(at - posture.label.begin());
}

/// The modes of one label over the postures, and those of the model that they are paired with.
struct Seen {
  std::vector<std::size_t> posture;
  std::vector<const FittedMode*> modes;
  std::vector<const FittedMode*> model;  ///< none: not paired
};

Seen modes_of_label(const std::vector<TappedPosture>& postures, const std::vector<std::vector<int>>& pair,
                    const std::vector<std::vector<FittedMode>>& of_model, int label) {
  Seen seen;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    const int k = mode_of_label(postures[i], label);
    if (k < 0) continue;
    const auto mode = static_cast<std::size_t>(k);
    seen.posture.push_back(i);
    seen.modes.push_back(&postures[i].modes[mode]);
    seen.model.push_back(pair[i][mode] < 0 ? nullptr : &of_model[i][static_cast<std::size_t>(pair[i][mode])]);
    if (seen.modes.back()->residue.rows() != seen.modes.front()->residue.rows() ||
        seen.modes.back()->residue.cols() != seen.modes.front()->residue.cols())
      refuse("a mode of posture " + std::to_string(i + 1) +
             " has a residue of another size than at the first; measure the same points at all postures");
  }
  return seen;
}

/// The numbers that processes of a label learn from: a row for each posture.
struct NumbersOverPlaces {
  std::vector<Eigen::Index> rows;
  Eigen::MatrixXd values;
};

NumbersOverPlaces numbers_of(const Seen& seen, const std::vector<TappedPosture>& postures, bool on_model,
                             bool in_tip_frame) {
  NumbersOverPlaces numbers;
  numbers.values.resize(std::ssize(seen.modes), 2 + 2 * seen.modes.front()->residue.size());
  for (std::size_t i = 0; i < seen.modes.size(); ++i) {
    if (on_model && seen.model[i] == nullptr) continue;
    const Turn turn = in_tip_frame ? postures[seen.posture[i]].place.turn : Turn{};
    Eigen::VectorXd value = targets_of(turned(*seen.modes[i], turn));
    if (on_model) value -= targets_of(turned(*seen.model[i], turn));
    numbers.values.row(std::ssize(numbers.rows)) = value;
    numbers.rows.push_back(static_cast<Eigen::Index>(seen.posture[i]));
  }
  numbers.values.conservativeResize(std::ssize(numbers.rows), Eigen::NoChange);
  return numbers;
}

double spread_of_residues(const Eigen::MatrixXd& values) {
  const Eigen::MatrixXd residues = values.rightCols(values.cols() - 2);
  return (residues.rowwise() - residues.colwise().mean()).squaredNorm();
}

/// The residuals with a root mean square of 1 at least. Hyper-parameters have seen every posture, so that each is
/// predicted too well by the others, the more so the fewer there are: of 14 postures the root mean squares were 0.6 to
/// 0.9 where the deviations themselves held 94 % of the truth. More than 1 tells of deviations that are too small.
Eigen::VectorXd at_least_one(Eigen::VectorXd residuals) {
  const double rms = std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
  if (rms > 0.0 && rms < 1.0) residuals /= rms;
  return residuals;
}

PredictedMode unseen(const FittedMode& mode, const PredictorOptions& options) {
  PredictedMode result{-1, targets_of(mode), {}};
  const double largest = result.mean.tail(result.mean.size() - 2).cwiseAbs().maxCoeff();
  result.deviation.setConstant(result.mean.size(), options.sd_unseen_residue * largest);
  result.deviation.head(2) << options.sd_unseen_ln_frequency, options.sd_unseen_ln_damping;
  return result;
}

}  // namespace

FittedMode moved(const PosturePrediction& prediction, const PredictedMode& mode, const Eigen::VectorXd& deviations) {
  return turned(mode_of(mode.mean + deviations.cwiseProduct(mode.deviation), prediction.responses),
                mode.turn.responses.size() == 0 ? Turn{} : back(mode.turn));
}

Predictor::Predictor(std::vector<TappedPosture> postures, PredictorOptions options)
    : postures_(std::move(postures)), options_(std::move(options)), places_(places_of(postures_)) {
  std::vector<std::vector<FittedMode>> of_model(postures_.size());
  std::map<int, int> seen;
  for (std::size_t i = 0; i < postures_.size(); ++i) {
    if (options_.mean) of_model[i] = as_identified(arm_modes(options_.mean->arm, postures_[i].place.q), *options_.mean);
    model_.push_back(paired(postures_[i].modes, of_model[i]));
    for (const int label : postures_[i].label) ++seen[label];
  }
  core::Progress progress("modes learned", seen.size());
  for (const auto& [label, count] : seen) {
    if (count < std::max(2, options_.fewest_postures)) {
      left_out_.push_back(label);
    } else {
      learn(label, of_model);
    }
    progress.step();
  }
}

void Predictor::learn(int label, const std::vector<std::vector<FittedMode>>& of_model) {
  const Seen seen = modes_of_label(postures_, model_, of_model, label);
  const Eigen::Index with_model =
      std::ranges::count_if(seen.model, [](const FittedMode* mode) { return mode != nullptr; });
  Learned learned{label, with_model > 1 && 2 * with_model > std::ssize(seen.modes), false, {}};
  NumbersOverPlaces numbers = numbers_of(seen, postures_, learned.on_model, false);
  responses_ = seen.modes.front()->residue.rows();
  if (std::ranges::all_of(postures_, [](const TappedPosture& p) { return p.place.turn.responses.size() > 0; })) {
    NumbersOverPlaces in_tip_frame = numbers_of(seen, postures_, learned.on_model, true);
    learned.in_tip_frame = spread_of_residues(in_tip_frame.values) < spread_of_residues(numbers.values);
    if (learned.in_tip_frame) numbers = std::move(in_tip_frame);
  }
  const Eigen::MatrixXd places = places_(numbers.rows, Eigen::all);
  std::vector<std::optional<regression::AveragedProcess>> processes(static_cast<std::size_t>(numbers.values.cols()));
  core::parallel_for(processes.size(), [&](std::size_t t) {
    processes[t].emplace(regression::TaskData{places, numbers.values.col(static_cast<Eigen::Index>(t))},
                         options_.averaging);
  });
  for (std::optional<regression::AveragedProcess>& process : processes)
    learned.processes.push_back(std::move(*process));
  learned.residuals = Eigen::MatrixXd::Zero(numbers.values.cols(), places_.rows());
  for (std::size_t t = 0; t < learned.processes.size(); ++t)
    learned.residuals(static_cast<Eigen::Index>(t), numbers.rows) =
        at_least_one(learned.processes[t].standardised_residuals()).transpose();
  learned_.push_back(std::move(learned));
}

std::vector<int> Predictor::model_numbers(const Place& place) const {
  std::vector<std::size_t> nearest(postures_.size());
  std::iota(nearest.begin(), nearest.end(), std::size_t{0});
  const Eigen::VectorXd distance = (places_.rowwise() - place.at.transpose()).rowwise().norm();
  std::ranges::stable_sort(nearest, {}, [&](std::size_t i) { return distance(static_cast<Eigen::Index>(i)); });
  std::map<std::size_t, std::vector<int>> continuation;
  std::vector<int> result;
  for (const Learned& learned : learned_) {
    int number = -1;
    for (const std::size_t i : nearest) {
      const int mode = learned.on_model ? mode_of_label(postures_[i], learned.label) : -1;
      if (mode < 0 || model_[i][static_cast<std::size_t>(mode)] < 0) continue;
      if (!continuation.contains(i)) continuation[i] = followed(options_.mean->arm, postures_[i].place.q, place.q);
      number = continuation[i][static_cast<std::size_t>(model_[i][static_cast<std::size_t>(mode)])];
      if (number >= 0) break;
    }
    result.push_back(number);
  }
  return result;
}

PredictedMode Predictor::predicted(const Learned& learned, const Place& place, const FittedMode* model) const {
  const auto numbers = std::ssize(learned.processes);
  PredictedMode mode{learned.label, Eigen::VectorXd(numbers), Eigen::VectorXd(numbers)};
  if (learned.in_tip_frame) mode.turn = place.turn;
  mode.residuals = learned.residuals;
  for (Eigen::Index t = 0; t < numbers; ++t) {
    const regression::AveragedPrediction at =
        learned.processes[static_cast<std::size_t>(t)].predict(place.at.transpose());
    mode.mean(t) = at.mean(0);
    mode.deviation(t) = std::sqrt(std::max(0.0, at.covariance(0, 0)));
  }
  if (model != nullptr) mode.mean += targets_of(turned(*model, mode.turn));
  return mode;
}

PosturePrediction Predictor::predict(const Place& place) const {
  if (place.turn.responses.size() == 0 && std::ranges::any_of(learned_, &Learned::in_tip_frame))
    refuse("a place without a turn, must have one as the postures have; take tip_turn()");
  PosturePrediction result{responses_, {}, {}, {}, distance_from_hull(places_, place.at)};
  predict_rest(place, result);
  std::vector<FittedMode> model;
  if (options_.mean) model = as_identified(arm_modes(options_.mean->arm, place.q), *options_.mean);
  const std::vector<int> number = model_numbers(place);
  for (std::size_t l = 0; l < learned_.size(); ++l) {
    const Learned& learned = learned_[l];
    if (learned.on_model && number[l] < 0) continue;
    result.modes.push_back(
        predicted(learned, place, learned.on_model ? &model[static_cast<std::size_t>(number[l])] : nullptr));
  }
  for (std::size_t m = 0; m < model.size(); ++m) {
    if (std::ranges::find(number, static_cast<int>(m)) == number.end())
      result.modes.push_back(unseen(model[m], options_));
  }
  return result;
}

void Predictor::predict_rest(const Place& place, PosturePrediction& at) const {
  std::vector<Eigen::MatrixXd> known;
  const auto matrix = [](const Eigen::MatrixXd& turn, Eigen::Index n) {
    return turn.size() > 0 ? turn : Eigen::MatrixXd::Identity(n, n);
  };
  for (const TappedPosture& p : postures_) {
    if (p.rest.size() == 0) continue;
    const Turn& turn = place.turn.responses.size() > 0 ? p.place.turn : place.turn;
    known.push_back(matrix(turn.responses, p.rest.rows()) * p.rest *
                    matrix(turn.references, p.rest.cols()).transpose());
  }
  if (known.empty()) return;
  const double n = static_cast<double>(known.size());
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(known.front().rows(), known.front().cols()), square = mean;
  for (const Eigen::MatrixXd& rest : known) mean += rest / n;
  for (const Eigen::MatrixXd& rest : known) square += (rest - mean).cwiseAbs2();
  // One posture tells nothing of how much it varies: half of it then.
  const Eigen::MatrixXd variance = known.size() > 1 ? Eigen::MatrixXd(square * ((1.0 + 1.0 / n) / (n - 1.0)))
                                                    : Eigen::MatrixXd(0.25 * mean.cwiseAbs2());
  const Eigen::MatrixXd rows = matrix(place.turn.responses, mean.rows()).transpose();
  const Eigen::MatrixXd columns = matrix(place.turn.references, mean.cols());
  at.rest = rows * mean * columns;
  at.rest_deviation = (rows.cwiseAbs2() * variance * columns.cwiseAbs2()).cwiseSqrt();
}

Predictor::Covariances Predictor::covariances(const Eigen::MatrixXd& places) const {
  Covariances result;
  for (const Learned& learned : learned_) {
    std::vector<Eigen::MatrixXd> of;
    std::vector<double> noise;
    for (const regression::AveragedProcess& process : learned.processes) {
      const regression::AveragedPrediction at = process.predict(places);
      of.push_back(at.covariance);
      noise.push_back(at.noise_variance);
    }
    result.of.push_back(std::move(of));
    result.noise.push_back(std::move(noise));
  }
  return result;
}

std::vector<int> Predictor::labels() const {
  std::vector<int> result;
  for (const Learned& learned : learned_) result.push_back(learned.label);
  return result;
}

}  // namespace thinwall::posture
