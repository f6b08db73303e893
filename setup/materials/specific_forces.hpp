#pragma once
// Specific cutting forces of classes of materials as they were published, and the power law of an alloy from them.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace thinwall::setup {

/// The specific cutting force of one class of materials in one publication, over the chip thickness: Kienzle's
/// constants, or forces at several feeds per tooth.
struct PublishedSpecificForce {
  std::string_view material_class;   ///< as printed, with strength or hardness
  double k_1 = 0.0, exponent = 0.0;  ///< N/m² at 1 mm, m_c; 0 where forces are printed
  std::span<const double> chips;     ///< m, ascending
  std::span<const double> forces;    ///< N/m², one a chip
  std::string_view source;
};

/// An alloy and the classes to which it belongs.
struct AlloyClasses {
  std::string_view material;
  std::vector<const PublishedSpecificForce*> classes;  ///< not empty, one a source
};

/// The table of alloys.
[[nodiscard]] std::span<const AlloyClasses> alloy_classes();

/// Kienzle's law k_c = k_1 (h/1 mm)^(−m) (Kienzle 1952).
struct KienzleConstants {
  double k_1 = 0.0, exponent = 0.0;  ///< N/m² at 1 mm, 1
};

/// The printed constants, or those of the straight line through ln k_c over ln h by least squares.
[[nodiscard]] KienzleConstants kienzle_constants(const PublishedSpecificForce& published);

/// The chip, m, at which sources are compared: the thinnest at which forces are printed.
inline constexpr double compared_chip_m = 0.1e-3;

/// The middle of what was published of an alloy's classes: the mean of ln k_c over the sources at every chip, that is
/// geometric means of k_1 and means of m.
struct PowerLawCoefficients {
  double K_t = 0.0, exponent = 0.0;  ///< N/m² at 1 mm, 1
  double K_r = 0.0;                  ///< N/m², K_t times usual_radial_share(), for no source prints it
  double spread =
      0.0;  ///< of ln k_c at compared_chip_m: the larger of the sources' standard deviation and pooled_spread()
  double spread_with_radial = 0.0;  ///< the larger of those of ln K_t and ln K_r = ln K_t + ln(K_r/K_t), independent
                                    ///< of each other: √(spread² + radial_share_deviation()²), that of ln K_r
  int sources = 0;                  ///< ≥ 1
  double thinnest_chip_m = 0.0;     ///< of the printed forces; 0: printed by none of the sources
};

/// The middle of an alloy's classes; none of an alloy that the table does not have.
[[nodiscard]] std::optional<PowerLawCoefficients> power_law_of(std::string_view material);

/// The standard deviation of ln k_c at compared_chip_m between sources of one alloy, pooled over the distinct lists of
/// classes, since alloys of the same classes tell the same. It stands for alloys with one source, and is the least for
/// the others: two or three catalogues, which may go back to common tests, tell little of a tool that none of them
/// used.
[[nodiscard]] double pooled_spread();

}  // namespace thinwall::setup
