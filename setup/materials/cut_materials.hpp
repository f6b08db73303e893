#pragma once
// Cutting coefficients of materials as they were published, with their spread.

#include <optional>
#include <span>
#include <string_view>

namespace thinwall::setup {

/// The coefficients of one material and one tool, N/m², with their source.
struct PublishedCut {
  std::string_view material;
  double K_t = 0.0, K_r = 0.0;
  std::string_view tool;
  std::string_view source;
};

/// The table, sorted by material. No entry's source prints the range of chip thickness that was measured.
[[nodiscard]] std::span<const PublishedCut> published_cuts();

/// The middle of what was published of a material: geometric means, and the larger of the standard deviations of
/// ln K_t and ln K_r between tools, as p₀ and s of an uncertain parameter p₀ e^{s z}
/// (milling/observed/uncertain_cut.hpp), which has one s for all coefficients.
struct MaterialCoefficients {
  double K_t = 0.0, K_r = 0.0;  ///< N/m²
  double spread = 0.0;
  int tools = 0;  ///< ≥ 2
};

/// The geometric mean of K_r/K_t over the table, for materials of which the tangential force alone is published. All
/// tools of the table cut aluminium, and their ratios go from 0.06 to 0.60.
[[nodiscard]] double usual_radial_share();

/// The standard deviation of ln(K_r/K_t) between the tools of the table.
[[nodiscard]] double radial_share_deviation();

/// The middle of a material's published coefficients; none of one that the table does not have.
[[nodiscard]] std::optional<MaterialCoefficients> coefficients_of(std::string_view material);

}  // namespace thinwall::setup
