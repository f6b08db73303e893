#include "milling/simulation/part_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <polyclipping/clipper.hpp>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

using ClipperLib::cInt;
using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

constexpr double unit_m = 1e-10;
constexpr double thinnest = 10.0;  ///< units: what rounding leaves between two sweeps is thinner

IntPoint to_units(const Eigen::Vector2d& p) {
  return {static_cast<cInt>(std::llround(p.x() / unit_m)), static_cast<cInt>(std::llround(p.y() / unit_m))};
}

Path to_units(const Outline& outline) {
  Path path;
  path.reserve(outline.size());
  for (const Eigen::Vector2d& p : outline) path.push_back(to_units(p));
  return path;
}

Path square(cInt x, cInt y, cInt side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

double perimeter(const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const IntPoint& a = path[i];
    const IntPoint& b = path[(i + 1) % path.size()];
    sum += std::hypot(static_cast<double>(b.X - a.X), static_cast<double>(b.Y - a.Y));
  }
  return sum;
}

/// A polygon of area A and perimeter p is about 2A/p wide if it is thin.
bool is_sliver(const Path& path) {
  return 2.0 * std::abs(ClipperLib::Area(path)) < thinnest * perimeter(path);
}

Paths combined(ClipperLib::ClipType how, const Paths& a, const Path& b) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(a, ClipperLib::ptSubject, true);
  clipper.AddPath(b, ClipperLib::ptClip, true);
  Paths result;
  clipper.Execute(how, result, ClipperLib::pftEvenOdd, ClipperLib::pftNonZero);
  return result;
}

struct Range {
  cInt low = std::numeric_limits<cInt>::max();
  cInt high = std::numeric_limits<cInt>::min();

  void take(cInt v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

/// The x of a polygon's part between two heights.
Range x_between(const Path& path, cInt low, cInt high) {
  Range x;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const IntPoint& a = path[i];
    const IntPoint& b = path[(i + 1) % path.size()];
    if (std::max(a.Y, b.Y) < low || std::min(a.Y, b.Y) > high) continue;
    for (const IntPoint& p : {a, b}) {
      if (p.Y >= low && p.Y <= high) x.take(p.X);
    }
    for (const cInt y : {low, high}) {
      if ((a.Y < y) == (b.Y < y)) continue;
      const double s = static_cast<double>(y - a.Y) / static_cast<double>(b.Y - a.Y);
      const double at = static_cast<double>(a.X) + s * static_cast<double>(b.X - a.X);
      x.take(static_cast<cInt>(std::floor(at)));
      x.take(static_cast<cInt>(std::ceil(at)));
    }
  }
  return x;
}

}  // namespace

struct PartRegion::Cells {
  cInt x = 0, y = 0, side = 1;  ///< corner of the first cell, and the side of each, units
  cInt columns = 0, rows = 0;
  std::vector<Paths> material;  ///< of each cell, row by row

  Paths& at(cInt column, cInt row) { return material[static_cast<std::size_t>(row * columns + column)]; }
  [[nodiscard]] const Paths& at(cInt column, cInt row) const {
    return material[static_cast<std::size_t>(row * columns + column)];
  }
  [[nodiscard]] cInt column_of(cInt px) const { return std::clamp<cInt>((px - x) / side, 0, columns - 1); }
  [[nodiscard]] cInt row_of(cInt py) const { return std::clamp<cInt>((py - y) / side, 0, rows - 1); }
};

namespace {

/// A ray from the centre of a tool, units.
struct Ray {
  Eigen::Vector2d from, direction;
  double radius = 0.0, reach = 0.0;
};

/// The distances at which a ray's line crosses the edges of polygons, ascending.
void find_crossings(const Paths& material, const Ray& ray, std::vector<double>& crossings) {
  crossings.clear();
  const auto from_centre = [&ray](const IntPoint& p) {
    return Eigen::Vector2d(static_cast<double>(p.X) - ray.from.x(), static_cast<double>(p.Y) - ray.from.y());
  };
  for (const Path& path : material) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Eigen::Vector2d a = from_centre(path[i]), b = from_centre(path[i + 1 < path.size() ? i + 1 : 0]);
      const double beside_a = ray.direction.x() * a.y() - ray.direction.y() * a.x();
      const double beside_b = ray.direction.x() * b.y() - ray.direction.y() * b.x();
      if ((beside_a < 0.0) == (beside_b < 0.0)) continue;
      const double s = beside_a / (beside_a - beside_b);
      crossings.push_back(ray.direction.dot(a + s * (b - a)));
    }
  }
  std::sort(crossings.begin(), crossings.end());
}

/// Takes the spans between crossings in, units.
void take_spans(const std::vector<double>& crossings, double radius, RayMaterial& met) {
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const double begin = std::max(crossings[i], 0.0), end = crossings[i + 1];
    if (end <= 0.0) continue;
    met.within_m += std::max(0.0, std::min(end, radius) - begin);
    if (begin < radius && end >= radius) met.tip_within = true;
    if (end > radius) met.beyond_m = std::min(met.beyond_m, std::max(begin, radius));
  }
}

/// The lines of cells that a ray crosses along one axis.
struct CellLines {
  cInt cell = 0;
  int step = 1;
  double next = std::numeric_limits<double>::infinity();  ///< distance to the next line
  double every = 0.0;                                     ///< and from line to line

  CellLines(double from, double direction, cInt origin, cInt side)
      : cell(static_cast<cInt>(std::floor((from - static_cast<double>(origin)) / static_cast<double>(side)))),
        step(direction < 0.0 ? -1 : 1) {
    if (direction == 0.0) return;
    const cInt line = origin + (cell + (step > 0 ? 1 : 0)) * side;
    next = (static_cast<double>(line) - from) / direction;
    every = static_cast<double>(side) / std::abs(direction);
  }
  double pass() {
    const double at = next;
    cell += step;
    next += every;
    return at;
  }
};

/// Calls look(material) with each cell on a ray that has any, from cell to cell (Amanatides & Woo 1987).
template <class Cells, class Look>
void each_cell_on(const Ray& ray, const Cells& c, const Look& look) {
  CellLines x(ray.from.x(), ray.direction.x(), c.x, c.side), y(ray.from.y(), ray.direction.y(), c.y, c.side);
  for (double t = 0.0; t <= ray.reach; t = x.next < y.next ? x.pass() : y.pass()) {
    const bool within = x.cell >= 0 && x.cell < c.columns && y.cell >= 0 && y.cell < c.rows;
    if (within && !c.at(x.cell, y.cell).empty()) look(c.at(x.cell, y.cell));
  }
}

}  // namespace

PartRegion::PartRegion(const std::vector<Outline>& outlines, double cell_m) : cells_(std::make_unique<Cells>()) {
  constexpr double most_cells = 1e7;
  constexpr double largest_m = 1e3;  // where products of units still fit
  if (!(cell_m >= 1e-6) || !std::isfinite(cell_m))
    throw core::InputError("part region: cells of " + std::to_string(cell_m) + " m, must be at least a micrometre");
  Range xs, ys;
  Paths paths;
  for (const Outline& outline : outlines) {
    for (const Eigen::Vector2d& p : outline) {
      if (!(p.cwiseAbs().maxCoeff() <= largest_m))
        throw core::InputError("part region: a corner of an outline lies beyond 1 km or is not finite; correct it");
    }
    paths.push_back(to_units(outline));
    for (const IntPoint& p : paths.back()) {
      xs.take(p.X);
      ys.take(p.Y);
    }
  }
  if (xs.low >= xs.high || ys.low >= ys.high)
    throw core::InputError("part region: no outline with an area; give one of at least three corners");
  Cells& c = *cells_;
  c.side = static_cast<cInt>(std::llround(cell_m / unit_m));
  c.x = xs.low;
  c.y = ys.low;
  c.columns = (xs.high - xs.low) / c.side + 1;
  c.rows = (ys.high - ys.low) / c.side + 1;
  if (static_cast<double>(c.columns) * static_cast<double>(c.rows) > most_cells) {
    std::ostringstream text;
    text << "part region: " << c.columns << " x " << c.rows << " cells of " << cell_m
         << " m, must be at most 10 million; take larger cells";
    throw core::InputError(text.str());
  }
  c.material.resize(static_cast<std::size_t>(c.columns * c.rows));
  for (cInt row = 0; row < c.rows; ++row) {
    // A row first, so that an outline of many corners is not looked at whole in every cell.
    const Path band{{xs.low, c.y + row * c.side},
                    {xs.high + 1, c.y + row * c.side},
                    {xs.high + 1, c.y + (row + 1) * c.side},
                    {xs.low, c.y + (row + 1) * c.side}};
    const Paths in_row = combined(ClipperLib::ctIntersection, paths, band);
    if (in_row.empty()) continue;
    for (cInt column = 0; column < c.columns; ++column)
      c.at(column, row) =
          combined(ClipperLib::ctIntersection, in_row, square(c.x + column * c.side, c.y + row * c.side, c.side));
  }
}

PartRegion::~PartRegion() = default;
PartRegion::PartRegion(PartRegion&&) noexcept = default;
PartRegion& PartRegion::operator=(PartRegion&&) noexcept = default;

void PartRegion::erase(const Outline& polygon) {
  Cells& c = *cells_;
  const Path path = to_units(polygon);
  Range ys;
  for (const IntPoint& p : path) ys.take(p.Y);
  if (ys.high < c.y || ys.low > c.y + c.rows * c.side) return;
  for (cInt row = c.row_of(ys.low); row <= c.row_of(ys.high); ++row) {
    const cInt low = c.y + row * c.side;
    const Range xs = x_between(path, low, low + c.side);
    if (xs.low > xs.high || xs.high < c.x || xs.low > c.x + c.columns * c.side) continue;
    for (cInt column = c.column_of(xs.low); column <= c.column_of(xs.high); ++column) {
      Paths& material = c.at(column, row);
      if (material.empty()) continue;
      material = combined(ClipperLib::ctDifference, material, path);
      material.erase(std::remove_if(material.begin(), material.end(), is_sliver), material.end());
    }
  }
}

RayMaterial PartRegion::on_ray(const Eigen::Vector2d& centre, const Eigen::Vector2d& direction, double radius_m,
                               double reach_m) const {
  const Ray ray{centre / unit_m, direction, radius_m / unit_m, reach_m / unit_m};
  RayMaterial met{0.0, false, ray.reach};
  std::vector<double> crossings;
  each_cell_on(ray, *cells_, [&](const Paths& material) {
    find_crossings(material, ray, crossings);
    take_spans(crossings, ray.radius, met);
  });
  return {met.within_m * unit_m, met.tip_within, met.beyond_m * unit_m};
}

double PartRegion::area_m2() const {
  double sum = 0.0;
  for (const Paths& material : cells_->material) {
    for (const Path& path : material) sum += ClipperLib::Area(path);
  }
  return sum * unit_m * unit_m;
}

std::vector<Outline> PartRegion::outlines() const {
  ClipperLib::Clipper clipper;
  for (const Paths& material : cells_->material) clipper.AddPaths(material, ClipperLib::ptSubject, true);
  Paths joined;
  clipper.Execute(ClipperLib::ctUnion, joined, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
  std::vector<Outline> result;
  for (const Path& path : joined) {
    Outline outline;
    for (const IntPoint& p : path)
      outline.emplace_back(static_cast<double>(p.X) * unit_m, static_cast<double>(p.Y) * unit_m);
    result.push_back(std::move(outline));
  }
  return result;
}

}  // namespace thinwall::milling
