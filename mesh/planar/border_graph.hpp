#pragma once
// The lines in the plane at which a prism's height changes, as a graph, and the cells between them.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "mesh/planar/prism.hpp"

namespace thinwall::mesh {

/// A straight border between two points of the graph, with the extents of the material to its left and right (none
/// outside of the part), which differ.
struct Border {
  int from = 0;
  int to = 0;
  std::optional<Extent> left;
  std::optional<Extent> right;
};

/// The borders of a prism and their end points, which are the only places where borders meet.
struct BorderGraph {
  std::vector<Eigen::Vector2d> points;
  std::vector<Border> borders;
};

/// The segment between the ends of a border, m.
[[nodiscard]] Segment segment(const BorderGraph& graph, const Border& border);

/// The graph of a cleaned() prism: all edges of the outline, holes and zones, split where they cross or touch (within
/// 1e-9 of the diagonal). Edges with the same extent on both sides are left out, and straight runs are joined. Cost
/// O(edges²).
[[nodiscard]] BorderGraph border_graph(const Prism& prism);

/// The graph with its borders cut into pieces that follow a wanted size (m) at each point; see divide().
[[nodiscard]] BorderGraph divided(const BorderGraph& graph,
                                  const std::function<double(const Eigen::Vector2d&)>& size_at);

/// Parameters 0 = t₀ < t₁ < … < t_n = 1 that cut a line of length L so that every piece has the share 1/n of ∫ L dt /
/// h(t), with n the integral rounded up. If h is constant, the pieces are equal and no longer than h.
[[nodiscard]] std::vector<double> divide(double length, const std::function<double(double)>& size_at);

/// A cell of the vertical decomposition: between x₀ and x₁, from the line low to the line high.
struct Trapezoid {
  std::array<double, 2> x{};
  std::array<double, 2> low{};   ///< at x₀ and x₁
  std::array<double, 2> high{};  ///< at x₀ and x₁
  Extent extent;
};

/// The material as trapezoids between vertical lines through all points of the graph (the vertical decomposition), from
/// left to right and from low to high. Cost O(points · borders).
[[nodiscard]] std::vector<Trapezoid> trapezoids(const Prism& prism, const BorderGraph& graph);

}  // namespace thinwall::mesh
