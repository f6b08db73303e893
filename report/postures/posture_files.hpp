#pragma once
// The tables of a study of postures.

#include <filesystem>
#include <string>

#include "study/postures/posture_study.hpp"

namespace thinwall::report {

/// Writes into a folder, which is made if need be, what was asked for:
///
///   modes.csv      a row a posture and mode: place, frequency, damping, numbers of the residue
///   errors.csv     a row a posture, mode and number: measured, predicted by the other folds, its deviation; alone from
///                  all other postures in closed form, its deviation
///   depths.csv     a row a posture: limiting depth with measured modes, predicted by the other folds, its band
///   curve.csv      a row a number of postures: median errors of plain processes, and with an arm as the mean
///   sharing.csv    a row a mode and group of numbers: R² of each number alone and together, likelihoods
///   map.csv        a row a place: first frequency and depth with their bands
///   envelope.csv   a row a speed: depths of the low, of the high, and of all modes
///   next.csv       a row a candidate: the share of the variance that a test there takes
///   postures.json  the figures of LearnedRobotSummary
///   postures.html  the page under a title, made by `program` ("thinwall 0.1.0")
///
/// Throws DataError for a folder that cannot be made or written.
void write_posture_study(const std::filesystem::path& folder, const study::PostureStudy& study,
                         const std::string& title, const std::string& program);

}  // namespace thinwall::report
