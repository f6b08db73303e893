#pragma once
// The modes of a structure at any posture, learned from those at some.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "posture/arm_modes.hpp"
#include "posture/tapped_posture.hpp"
#include "regression/averaged_process.hpp"

namespace thinwall::posture {

/// A mode's numbers (targets_of()) at a posture, independent of each other.
struct PredictedMode {
  int label = -1;  ///< −1: a mode of the arm's model that no posture has shown
  Eigen::VectorXd mean;
  Eigen::VectorXd deviation;    ///< of the function, without the noise of a test
  Turn turn{};                  ///< into the frame of the residue's numbers; empty: the world's
  Eigen::MatrixXd residuals{};  ///< numbers × postures: errors over their deviations where a posture is left out,
                                ///< scaled to a root mean square of 1 if it is less; 0 where the mode was not seen;
                                ///< empty: not known
};

/// The modes to be expected at a posture.
struct PosturePrediction {
  Eigen::Index responses = 0;
  std::vector<PredictedMode> modes;
  Eigen::MatrixXd rest{};            ///< static compliance that the modes leave out, m/N; empty: not known
  Eigen::MatrixXd rest_deviation{};  ///< of its entries
  double from_hull = 0.0;  ///< distance from the hull of the postures, scaled coordinates: > 0 is extrapolation
};

/// The mode of a prediction whose numbers are moved by so many deviations each, in the world's axes.
[[nodiscard]] identification::FittedMode moved(const PosturePrediction& prediction, const PredictedMode& mode,
                                               const Eigen::VectorXd& deviations);

/// The way to learn.
struct PredictorOptions {
  std::optional<TappedArm> mean;  ///< the model whose modes are the mean (calibrate() it first); none: plain processes
  /// By default functions of the place with two derivatives. Under the squared exponential, whose functions have all,
  /// deviations are too small away from the tapped postures: of 28 postures of a robot in three coordinates 86 % of the
  /// limiting depths lay within their bands of 95 %, where these hold 93 %.
  regression::AveragingOptions averaging{.kernel = regression::Kernel::matern_5_2};
  int fewest_postures = 4;  ///< ≥ 2, of a mode; those seen at fewer are left out and named
  double sd_unseen_ln_frequency = 0.03, sd_unseen_ln_damping = 0.3;  ///< of the model's modes that no posture has shown
  double sd_unseen_residue = 0.2;                                    ///< of their largest entry
};

/// Processes of every number of every mode over the places, of what was identified less what the model has (residual
/// learning) for modes that the model has, of the numbers themselves for the others. Residues are seen in that of the
/// two frames, the world's or the tip's, in which they vary less over the postures, where all places have a turn. What
/// the modes leave out is the mean of the postures where it is known, in the tip's frame likewise.
class Predictor {
 public:
  /// Learns. Throws InputError for no posture, places, turns or rests of different size, modes without a label, with
  /// residues of different size or no damping, two postures at one place, and as arm_modes() does; NumericalError as
  /// AveragedProcess. Cost: an AveragedProcess for each number of each mode, shared
  /// out among core::thread_count() threads.
  Predictor(std::vector<TappedPosture> postures, PredictorOptions options);

  /// The modes at a place: labelled ones first. The arm's modes there are those that continue the ones of the nearest
  /// posture (followed()). Cost O(modes numbers samples postures²).
  [[nodiscard]] PosturePrediction predict(const Place& place) const;

  /// Covariances of the function between places, of each number of each label, and the variances of its noise.
  struct Covariances {
    std::vector<std::vector<Eigen::MatrixXd>> of;  ///< places × places
    std::vector<std::vector<double>> noise;
  };
  /// The covariances between the rows of `places`, which do not depend on the means. Cost O(places² postures) for each
  /// number and sample.
  [[nodiscard]] Covariances covariances(const Eigen::MatrixXd& places) const;

  /// The labels that are predicted.
  [[nodiscard]] std::vector<int> labels() const;
  /// The labels with too few postures.
  [[nodiscard]] const std::vector<int>& left_out() const { return left_out_; }
  /// The places of the postures, one a row.
  [[nodiscard]] const Eigen::MatrixXd& places() const { return places_; }

 private:
  struct Learned {
    int label = 0;
    bool on_model = false;
    bool in_tip_frame = false;
    std::vector<regression::AveragedProcess> processes;
    Eigen::MatrixXd residuals{};  ///< as of PredictedMode
  };
  [[nodiscard]] std::vector<int> model_numbers(const Place& place) const;
  void predict_rest(const Place& place, PosturePrediction& at) const;
  void learn(int label, const std::vector<std::vector<identification::FittedMode>>& of_model);
  [[nodiscard]] PredictedMode predicted(const Learned& learned, const Place& place,
                                        const identification::FittedMode* model) const;

  std::vector<TappedPosture> postures_;
  PredictorOptions options_;
  Eigen::MatrixXd places_;
  std::vector<std::vector<int>> model_;  ///< of each posture and mode the number of the model's
  std::vector<Learned> learned_;
  std::vector<int> left_out_;
  Eigen::Index responses_ = 0;
};

}  // namespace thinwall::posture
