#include "milling/pockets.hpp"

#include <algorithm>

namespace thinwall::milling {

namespace {

double rate(const LobeRow& row) {
  return row.spindle_speed_rpm * row.limiting_depth_m;
}

}  // namespace

std::vector<Pocket> best_pockets(const std::vector<LobeRow>& rows, std::size_t most) {
  std::vector<const LobeRow*> tops;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool rises = i == 0 || rate(rows[i]) > rate(rows[i - 1]);
    const bool falls = i + 1 == rows.size() || rate(rows[i]) >= rate(rows[i + 1]);
    if (rises && falls) tops.push_back(&rows[i]);
  }
  std::stable_sort(tops.begin(), tops.end(), [](const LobeRow* a, const LobeRow* b) { return rate(*a) > rate(*b); });
  tops.resize(std::min(tops.size(), most));
  std::vector<Pocket> pockets;
  pockets.reserve(tops.size());
  for (const LobeRow* row : tops) pockets.push_back({row->spindle_speed_rpm, row->limiting_depth_m, row->at_limit});
  return pockets;
}

}  // namespace thinwall::milling
