#include "report/postures/posture_page.hpp"

#include <cstdint>

#include "report/page/arrays.hpp"
#include "report/postures/posture_summary.hpp"
#include "report/summary/write_json.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

/// A matrix, row-major.
json packed_rows(const Eigen::MatrixXd& rows) {
  std::vector<double> values;
  for (const auto& row : rows.rowwise()) values.insert(values.end(), row.begin(), row.end());
  return packed(values, {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())});
}

json packed_list(const std::vector<double>& values) {
  return packed(values, {values.size()});
}

json packed_list(const Eigen::VectorXd& values) {
  return packed_list(std::vector<double>(values.begin(), values.end()));
}

/// ln f and ln ζ of each mode at each posture that was held out.
json held_out_modes(const std::vector<posture::HeldOutMode>& modes) {
  std::vector<std::uint32_t> at, number;
  Eigen::MatrixXd measured(std::ssize(modes), 2), predicted(std::ssize(modes), 2), deviation(std::ssize(modes), 2);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    at.push_back(static_cast<std::uint32_t>(modes[i].posture));
    number.push_back(static_cast<std::uint32_t>(modes[i].label + 1));
    const auto row = static_cast<Eigen::Index>(i);
    measured.row(row) = modes[i].measured.head<2>();
    predicted.row(row) = modes[i].predicted.head<2>();
    deviation.row(row) = modes[i].deviation.head<2>();
  }
  return {{"posture", packed(at, {at.size()})},
          {"mode", packed(number, {number.size()})},
          {"measured", packed_rows(measured)},
          {"predicted", packed_rows(predicted)},
          {"deviation", packed_rows(deviation)}};
}

json held_out_depths(const std::vector<posture::HeldOutDepths>& depths) {
  std::vector<std::uint32_t> at;
  std::vector<double> measured, predicted, low, high;
  for (const posture::HeldOutDepths& depth : depths) {
    at.push_back(static_cast<std::uint32_t>(depth.posture));
    measured.push_back(depth.measured(0));
    predicted.push_back(depth.predicted(0));
    low.push_back(depth.low(0));
    high.push_back(depth.high(0));
  }
  return {{"posture", packed(at, {at.size()})},
          {"measured_m", packed_list(measured)},
          {"predicted_m", packed_list(predicted)},
          {"low_m", packed_list(low)},
          {"high_m", packed_list(high)}};
}

/// Values with the ends of their bands, a row a place.
json map_of(const study::PostureStudy& study) {
  Eigen::MatrixXd first_hz(std::ssize(study.map), 3), depth_m(std::ssize(study.map), 3);
  std::vector<double> rpm;
  for (std::size_t i = 0; i < study.map.size(); ++i) {
    const posture::MappedPlace& at = study.map[i];
    const auto row = static_cast<Eigen::Index>(i);
    first_hz.row(row) << at.first_hz.value, at.first_hz.low, at.first_hz.high;
    if (!at.depth) continue;
    depth_m.row(row) << at.depth->depth_m.value, at.depth->depth_m.low, at.depth->depth_m.high;
    rpm.push_back(at.depth->spindle_speed_rpm);
  }
  json map = {{"places", packed_rows(study.mapped_at)}, {"first_hz", packed_rows(first_hz)}};
  if (rpm.size() < study.map.size()) return map;
  map["rpm"] = packed_list(rpm);
  map["depth_m"] = packed_rows(depth_m);
  return map;
}

json envelope_of(const study::PostureStudy& study) {
  return {{"rpm", packed_list(study.chart_rpm)},
          {"low_m", packed_list(study.envelope->low)},
          {"high_m", packed_list(study.envelope->high)},
          {"together_m", packed_list(study.envelope->together)}};
}

}  // namespace

json posture_document(const study::PostureStudy& study, const std::string& title, const std::string& program) {
  json found = {{"figures", json_of(summary_of(study))},
                {"names", study.names},
                {"places", packed_rows(study.places)},
                {"asked", std::vector<double>(study.asked.begin(), study.asked.end())}};
  if (study.held_out) found["modes"] = held_out_modes(study.held_out->modes);
  if (study.held_out && !study.held_out->depths.empty()) found["depths"] = held_out_depths(study.held_out->depths);
  if (!study.map.empty()) found["map"] = map_of(study);
  if (study.envelope) found["envelope"] = envelope_of(study);
  if (study.next)
    found["next"] = {{"candidates", packed_rows(study.candidates)},
                     {"reduction", packed_list(study.next->reduction)},
                     {"path", packed_rows(study.path)}};
  return {{"schema", 1},
          {"program", program},
          {"title", title.empty() ? "A robot over its postures" : title},
          {"runs", json::array()},
          {"postures", found}};
}

}  // namespace thinwall::report
