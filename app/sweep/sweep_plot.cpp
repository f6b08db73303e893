#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/sweep/sweep_table.hpp"
#include "core/units.hpp"
#include "io/xml_text.hpp"

namespace thinwall::app {

namespace {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

struct Interval {
  double lower = 0.0, upper = 1.0;
};

/// Frame of a panel, in pixels.
constexpr double panel_left = 70.0, panel_width = 480.0, panel_height = 220.0, panel_pitch = 290.0;
constexpr std::size_t most_curves = 8;
/// Colours that colour-blind people tell apart (Okabe and Ito 2008).
constexpr std::array<const char*, most_curves> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                       "#e69f00", "#56b4e9", "#000000", "#f0e442"};

std::string pixel(double value) {
  return core::number_text(std::round(value * 10.0) / 10.0);
}

/// The axis along which curves run: the first that has numbers.
std::optional<std::size_t> running_axis(const std::vector<SweepAxis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].numbers.size() > 1) return i;
  }
  return std::nullopt;
}

/// Values of a column over the running axis, one curve for each combination of the others.
void add_curves(std::vector<Curve>& curves, const SweepTable& table, std::size_t along, const std::string& column) {
  for (const SweepRow& row : table.rows) {
    const auto found = std::ranges::find(row.figures, column, &std::pair<std::string, double>::first);
    if (found == row.figures.end()) continue;
    std::string name = column;
    for (std::size_t i = 0; i < table.axes.size(); ++i) {
      if (i != along) name += ", " + table.axes[i].key + " " + table.axes[i].values[row.point[i]];
    }
    auto curve = std::ranges::find(curves, name, &Curve::name);
    if (curve == curves.end()) curve = curves.insert(curve, Curve{name, {}});
    curve->points.emplace_back(table.axes[along].numbers[row.point[along]], found->second);
  }
}

/// A step of 1, 2 or 5 times a power of ten that gives about five ticks.
double tick_step(const Interval& range) {
  const double raw = (range.upper - range.lower) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  return power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
}

std::string svg_line(double x1, double y1, double x2, double y2) {
  return "<line x1=\"" + pixel(x1) + "\" y1=\"" + pixel(y1) + "\" x2=\"" + pixel(x2) + "\" y2=\"" + pixel(y2) +
         "\" stroke=\"#ccc\"/>\n";
}

std::string svg_text(double x, double y, const std::string& anchor, const std::string& content) {
  return "<text x=\"" + pixel(x) + "\" y=\"" + pixel(y) + "\" text-anchor=\"" + anchor + "\">" +
         io::xml_escaped(content) + "</text>\n";
}

/// One panel with its grid, its curves and their names to the right; y starts at zero.
std::string panel(double top, const std::string& title, const std::string& x_title, const std::vector<Curve>& curves) {
  Interval xs{INFINITY, -INFINITY}, ys{0.0, 0.0};
  for (const Curve& curve : curves) {
    for (const auto& [x, y] : curve.points) {
      xs = {std::min(xs.lower, x), std::max(xs.upper, x)};
      ys.upper = std::max(ys.upper, 1.05 * y);
    }
  }
  if (!(xs.upper > xs.lower) || !(ys.upper > 0.0)) return "";
  const auto across = [&](double x) { return panel_left + panel_width * (x - xs.lower) / (xs.upper - xs.lower); };
  const auto up = [&](double y) { return top + panel_height * (1.0 - y / ys.upper); };
  std::string svg = svg_text(panel_left, top - 10.0, "start", title);
  const double x_step = tick_step(xs), y_step = tick_step(ys);
  for (double x = std::ceil(xs.lower / x_step - 1e-9) * x_step; x <= xs.upper + 1e-9 * x_step; x += x_step) {
    svg += svg_line(across(x), top, across(x), top + panel_height) +
           svg_text(across(x), top + panel_height + 16.0, "middle", core::number_text(x, 6));
  }
  for (double y = 0.0; y <= ys.upper; y += y_step)
    svg += svg_line(panel_left, up(y), panel_left + panel_width, up(y)) +
           svg_text(panel_left - 6.0, up(y) + 4.0, "end", core::number_text(y, 6));
  svg += svg_text(panel_left + panel_width / 2.0, top + panel_height + 34.0, "middle", x_title);
  for (std::size_t i = 0; i < std::min(curves.size(), most_curves); ++i) {
    const std::string colour = colours[i];
    std::string places, dots;
    for (const auto& [x, y] : curves[i].points) {
      places += fmt::format("{},{} ", pixel(across(x)), pixel(up(y)));
      dots +=
          fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"2.5\" fill=\"{}\"/>\n", pixel(across(x)), pixel(up(y)), colour);
    }
    const double y = top + 14.0 + 18.0 * static_cast<double>(i);
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n{}", places, colour,
                       dots);
    svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/>\n", pixel(panel_left + panel_width + 14.0),
                       pixel(y - 4.0), colour);
    svg += svg_text(panel_left + panel_width + 24.0, y, "start", curves[i].name);
  }
  return svg;
}

}  // namespace

std::string sweep_svg(const SweepTable& table) {
  const auto along = running_axis(table.axes);
  if (!along) return "";
  const auto columns = table.columns();
  std::vector<Curve> depths, modes;
  const bool at_speed =
      std::ranges::any_of(columns, [](const auto& column) { return column.ends_with("_depth_at_speed_mm"); });
  for (const auto& column : columns) {
    if (column.ends_with(at_speed ? "_depth_at_speed_mm" : "_least_depth_mm"))
      add_curves(depths, table, *along, column);
    if (column.ends_with("_mode_1_hz")) add_curves(modes, table, *along, column);
  }
  const std::string x_title = table.axes[*along].title();
  std::string panels;
  double top = 40.0;
  const std::string depth_title =
      at_speed ? "stable depth at the case's spindle speed [mm]" : "least stable depth [mm]";
  for (const auto& [title, curves] :
       {std::pair(depth_title, depths), std::pair(std::string("first mode [Hz]"), modes)}) {
    const std::string drawn = panel(top, title, x_title, curves);
    if (!drawn.empty()) top += panel_pitch;
    panels += drawn;
  }
  if (panels.empty()) return "";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"" + pixel(top) + "\" viewBox=\"0 0 900 " +
         pixel(top) +
         "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         panels + "</svg>\n";
}

}  // namespace thinwall::app
