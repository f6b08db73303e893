#pragma once
// Singular exponents of the displacement at the edges of a part.

namespace thinwall::fem {

/// The exponent λ of a re-entrant edge of 270° between free faces, beside which the displacement varies as ρ^λ with the
/// distance ρ from the edge (Williams 1952).
inline constexpr double reentrant_edge_exponent = 0.544;

/// The exponent λ of the edge at which a clamped face meets a free one at a right angle: the root in 0.5 to 1 of
///
///     sin²(λπ/2) = ((κ + 1)² / 4 − λ²) / κ,   κ = 3 − 4ν        (Williams 1952, clamped-free, plane strain, α = π/2)
///
/// It is 0.71 for steel (ν = 0.3) and 0.59 for Poisson's ratio ν = 0.5. For ν ≤ 0 there is none below 1, which is
/// regular, and 1 is returned. ν must lie in −1 to 0.5.
[[nodiscard]] double clamped_edge_exponent(double poisson_ratio);

}  // namespace thinwall::fem
