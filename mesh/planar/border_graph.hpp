#pragma once
// The lines in the plane where a prism's height changes, as a graph; and its cells.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "mesh/planar/prism.hpp"

namespace thinwall::mesh {

/// A straight border between two points of the graph; what lies to its left and right differs.
struct Border {
  int from = 0;
  int to = 0;
  std::optional<Extent> left;
  std::optional<Extent> right;
};

/// Borders meet in their end points only.
struct BorderGraph {
  std::vector<Eigen::Vector2d> points;
  std::vector<Border> borders;
};

/// Both ends of a border, m.
[[nodiscard]] Segment segment(const BorderGraph& graph, const Border& border);

/// All edges of the outline, holes and zones, split where they cross or touch (within 1e-9 of the diagonal); without
/// those that part equal heights, and with straight runs joined. For a cleaned prism. Cost O(edges²).
[[nodiscard]] BorderGraph border_graph(const Prism& prism);

/// The graph with its borders cut into pieces that follow a wanted size (m) at each point; see divide().
[[nodiscard]] BorderGraph divided(const BorderGraph& graph,
                                  const std::function<double(const Eigen::Vector2d&)>& size_at);

/// Parameters 0 = t₀ < t₁ < … < t_n = 1 that cut a line of length L so that every piece is 1/n of ∫ L dt / h(t), with
/// n the integral rounded up: even pieces no longer than h where h is constant.
[[nodiscard]] std::vector<double> divide(double length, const std::function<double(double)>& size_at);

/// A cell of the vertical decomposition: between x₀ and x₁, from the line low to the line high.
struct Trapezoid {
  std::array<double, 2> x{};
  std::array<double, 2> low{};   ///< at x₀ and x₁
  std::array<double, 2> high{};  ///< at x₀ and x₁
  Extent extent;
};

/// The material as trapezoids between vertical lines through all points of the graph, from left to right and from low
/// to high. Cost O(points · borders).
[[nodiscard]] std::vector<Trapezoid> trapezoids(const Prism& prism, const BorderGraph& graph);

}  // namespace thinwall::mesh
