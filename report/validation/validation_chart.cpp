#include "report/validation/validation_chart.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/results/csv_table.hpp"

namespace thinwall::report {

namespace {

constexpr double width = 760.0, height = 420.0, left = 60.0, right = 20.0, top = 20.0, bottom = 50.0;
constexpr auto right_colour = "#3a6ea5", wrong_colour = "#c0392b", line_colour = "#444";

/// From speed and depth to the drawing.
struct Axes {
  double from_rpm = 0.0, to_rpm = 1.0, deepest_m = 1.0;
  [[nodiscard]] double x(double rpm) const {
    return left + (width - left - right) * (rpm - from_rpm) / (to_rpm - from_rpm);
  }
  [[nodiscard]] double y(double depth_m) const {
    return height - bottom - (height - top - bottom) * std::min(1.0, depth_m / deepest_m);
  }
};

/// 1, 2 or 5 times a power of ten, so that a span has four to ten of them.
double tick_of(double span) {
  const double power = std::pow(10.0, std::floor(std::log10(span / 4.0)));
  const double share = span / 4.0 / power;
  return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

std::string label(double x, double y, const std::string& anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

std::string ticks(const Axes& axes) {
  std::string text;
  const double step = tick_of(axes.to_rpm - axes.from_rpm), deep = tick_of(axes.deepest_m * 1e3);
  for (double rpm = std::ceil(axes.from_rpm / step) * step; rpm <= axes.to_rpm; rpm += step)
    text += label(axes.x(rpm), height - bottom + 18.0, "middle", fmt::format("{:.0f}", rpm));
  for (double mm = 0.0; mm <= axes.deepest_m * 1e3 * (1.0 + 1e-9); mm += deep)
    text += label(left - 8.0, axes.y(mm * 1e-3) + 4.0, "end", fmt::format("{:g}", mm));
  return text + label(0.5 * (left + width - right), height - 8.0, "middle", "spindle speed, rpm") +
         fmt::format("<text transform=\"translate(16 {:.0f}) rotate(-90)\" text-anchor=\"middle\">depth, mm</text>\n",
                     0.5 * (height - bottom + top)) +
         fmt::format("<path d=\"M{0:.0f} {1:.0f}V{2:.0f}H{3:.0f}\" fill=\"none\" stroke=\"{4}\"/>\n", left, top,
                     height - bottom, width - right, line_colour);
}

std::string limit_line(const Axes& axes, const std::vector<double>& speeds, const std::vector<double>& depths) {
  std::string points;
  for (std::size_t i = 0; i < speeds.size(); ++i)
    points += fmt::format("{:.1f},{:.1f} ", axes.x(speeds[i]), axes.y(depths[i]));
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", points,
                     line_colour);
}

std::string mark(const Axes& axes, const ObservedCutSummary& cut) {
  const double x = axes.x(cut.spindle_speed_rpm), y = axes.y(cut.depth_m);
  const bool wrong = cut.right && !*cut.right;
  const std::string style = fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"",
                                        wrong ? wrong_colour : right_colour, wrong ? 2.5 : 1.3);
  if (cut.observed == milling::CutOutcome::stable)
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" {}/>\n", x, y, style);
  const std::string path = cut.observed == milling::CutOutcome::chatter
                               ? fmt::format("M{:.1f} {:.1f}l8 8m0 -8l-8 8", x - 4.0, y - 4.0)
                               : fmt::format("M{:.1f} {:.1f}l4 4l-4 4l-4 -4z", x, y - 4.0);
  return fmt::format("<path d=\"{}\" {}/>\n", path, style);
}

}  // namespace

std::string validation_chart(const ValidatedCase& one) {
  const ObservedSummary* observed = observed_of(one);
  if (observed == nullptr) return "";
  const auto file = one.results / "lobes" / (core::word_of(one.summary.lobes.back().name) + ".csv");
  const io::Table table = io::read_csv(file);
  const std::vector<double>& speeds = io::numbers(table, "spindle_speed_rpm", file);
  const std::vector<double>& depths = io::numbers(table, "limiting_depth_m", file);
  double deepest = 0.0;
  for (const ObservedCutSummary& cut : observed->cuts) deepest = std::max(deepest, 1.15 * cut.depth_m);
  const Axes axes{speeds.front(), speeds.back(), deepest};
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
      width, height);
  text += ticks(axes) + limit_line(axes, speeds, depths);
  for (const ObservedCutSummary& cut : observed->cuts) text += mark(axes, cut);
  return text + "</svg>\n";
}

}  // namespace thinwall::report
