#pragma once
// A modal model from a measured matrix of receptances, with what speaks against it.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/words.hpp"
#include "dynamics/response_model.hpp"
#include "identification/identify.hpp"
#include "identification/passive_fit.hpp"

namespace thinwall::identification {

/// A range of frequencies, Hz.
struct Band {
  double from_hz = 0.0;
  double to_hz = std::numeric_limits<double>::infinity();
};

/// The lines that are used, and what is known of their noise.
struct ResponseFitOptions {
  Band band;
  std::vector<Band> left_out;  ///< within the band, such as the mains
  OfEntries averages;          ///< that the coherence belongs to
  OfEntries noise;             ///< deviation of real and imaginary part alike, relative to |H|; before coherence
  IdentifyOptions identify;    ///< rank one where nothing else is said
  bool passive = false;        ///< residues are moved until the fit gives no energy (made_passive())
};

/// The source of the weights of the lines.
enum class Weights {
  scatter,    ///< from line to line
  coherence,  ///< and the number of averages
  noise,      ///< as it was stated
};

/// The fit, and the lines that it was made from.
struct ResponseFit {
  MeasuredLines lines;
  Identification found;
  Weights weights = Weights::scatter;
  Eigen::MatrixXd misfit;                ///< √(Σ |H − fit|² / Σ |H|²) over the lines, responses × references
  std::optional<PassiveChange> passive;  ///< where it was asked for
};

/// Which lines of a measured matrix a fit uses: those in the band and not left out, above 0 Hz, ascending. Throws
/// InputError for fewer than ten. Cost O(lines).
[[nodiscard]] std::vector<std::size_t> used_lines(const dynamics::ResponseModel& measured,
                                                  const ResponseFitOptions& options);

/// identify() of a measured matrix. Variances of the lines follow from the stated noise; else from the coherence (one
/// matrix a line, or none), if its number of averages is known; else from the scatter from line to line. They are taken
/// once of the lines themselves and twice more by what was fitted before, so that neither small values nor resonances
/// mislead. Lines at 0 Hz are not used. Throws InputError for a band with fewer than ten lines, noise that is not
/// between 0 and 1, and as identify(). Cost: three of its fits.
[[nodiscard]] ResponseFit fit_response(const dynamics::ResponseModel& measured,
                                       const std::vector<Eigen::MatrixXd>& coherence,
                                       const ResponseFitOptions& options = {});

/// fit_response() with residues of rank one, or with free ones where a pole is double to 5 % of its second singular
/// value, as that of a round tool in both directions, and χ² is lower with them by more than chance; `options` then
/// tell which. Errors as fit_response(). Cost: two fits at most.
[[nodiscard]] ResponseFit fit_of_any_rank(const dynamics::ResponseModel& measured,
                                          const std::vector<Eigen::MatrixXd>& coherence, ResponseFitOptions& options);

/// The poles of the orders 1 to `options.identify.highest_order` in the band, its lines weighed by their scatter:
/// plscf(). A fit whose poles are named has no diagram of its own. Errors as fit_response().
[[nodiscard]] std::vector<OrderPoles> stabilisation_diagram(const dynamics::ResponseModel& measured,
                                                            const ResponseFitOptions& options = {});

/// Sentences that a user should read before the model is used: χ² that is too large, with the frequency and the entry
/// where it is and the terms that would help; residues that are not symmetric where symmetric ones were asked for, or
/// not of rank one; driving points whose phase is that of a mobility or an accelerance, or that are turned; modes of
/// uncertain damping, or without an interval; a model that gives energy. Cost: two fits at most.
[[nodiscard]] std::vector<std::string> doubts_about(const ResponseFit& fit, const dynamics::DofTable& responses,
                                                    const dynamics::DofTable& forces,
                                                    const ResponseFitOptions& options);

/// The fitted receptances on an axis.
[[nodiscard]] dynamics::ResponseModel fitted_response(const ModalFit& fit, const dynamics::FrequencyAxis& axis,
                                                      const dynamics::DofTable& responses,
                                                      const dynamics::DofTable& forces);

}  // namespace thinwall::identification

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<identification::Weights>{"scatter", "coherence", "noise"};
template <>
inline constexpr std::array<std::string_view, 3> words<identification::Residues>{"free", "rank_one", "symmetric"};

}  // namespace thinwall::core
