#pragma once
// The cheapest pairing of rows with columns.

#include <Eigen/Core>
#include <vector>

namespace thinwall::identification {

/// For each row the column that it is paired with, −1 for none: every row and every column is in one pair at most, as
/// many pairs as the smaller side has, and their costs sum to the least (the Hungarian method: Kuhn 1955, with the
/// potentials and shortest paths of Jonker & Volgenant 1987). `cost` is finite. Cost O(rows² columns).
[[nodiscard]] std::vector<int> cheapest_pairing(const Eigen::MatrixXd& cost);

}  // namespace thinwall::identification
