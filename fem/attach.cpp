#include "fem/attach.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "fem/elastic_clamps.hpp"
#include "fem/free_motions.hpp"

namespace thinwall::fem {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A connected point on the mesh, with the matrices of the springs and masses attached to it.
struct FoundPoint {
  std::string name;
  PatchAverage average;
  int rigid = -1;  // index of its rigid patch, −1 for an averaging point
  Matrix6 K = Matrix6::Zero();
  Matrix6 M = Matrix6::Zero();
};

std::vector<FoundPoint> found_points(Model& model, const Attachments& attachments) {
  std::vector<FoundPoint> found;
  for (const ConnectedPoint& point : attachments.points) {
    FoundPoint here;
    here.name = point.name;
    here.average = patch_average(model.mesh, model.nodes, point.patch, point.name);
    for (const PointMass& mass : attachments.masses) {
      if (mass.point == point.name) here.M += matrix_at_point(mass);
    }
    for (const GroundSpring& spring : attachments.springs) {
      if (spring.point == point.name) here.K += matrix_at_point(spring);
    }
    if (point.connection == Connection::rigid) {
      here.rigid = static_cast<int>(model.rigid.size());
      model.rigid.push_back(rigid_patch(model.mesh, model.nodes, point.patch, here.average, point.name));
    }
    found.push_back(std::move(here));
  }
  return found;
}

/// The columns W (rows × 6) of an averaging point, [u θ] = Wᵀ q. The rotation's columns are zero unless a spring or
/// mass acts on it.
linalg::SparseMatrix averaging_columns(const Model& model, const FoundPoint& point) {
  constexpr std::size_t most_nodes = 1500;
  const PatchAverage& average = point.average;
  if (average.nodes.size() > most_nodes) {
    throw core::InputError("point \"" + point.name + "\" averages over " + std::to_string(average.nodes.size()) +
                           " nodes, more than the " + std::to_string(most_nodes) +
                           " whose dense block is stored: make the patch smaller, or connect it rigidly");
  }
  const bool turns = !point.K.bottomRows<3>().isZero(0.0) || !point.M.bottomRows<3>().isZero(0.0);
  const Eigen::Matrix3d J_inverse = turns ? inverse_spread(average, point.name) : Eigen::Matrix3d::Zero();
  const RowMap rows = row_map(model.nodes.positions.rows(), model.free_rows, model.rigid);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t a = 0; a < average.nodes.size(); ++a) {
    const Eigen::Matrix<double, 6, 3> motion = motion_of_node(average, static_cast<Eigen::Index>(a), J_inverse);
    for (int i = 0; i < 6; ++i)
      add_entries(rows, model.nodes, model.rigid, average.nodes[a], motion.row(i).transpose(), i, entries);
  }
  linalg::SparseMatrix W(model.K.rows(), 6);
  W.setFromTriplets(entries.begin(), entries.end());
  if (W.leftCols(3).norm() < 1e-9)
    throw core::InputError("point \"" + point.name + "\" lies on a support, where nothing moves: move it off");
  return W;
}

/// The columns W (rows × 6) of a rigid point, which pick its own six rows; the rows of the rotation hold s θ, with s
/// the size of the patch.
linalg::SparseMatrix rigid_columns(const Model& model, const FoundPoint& point) {
  const int first = static_cast<int>(model.K.rows()) - 6 * static_cast<int>(model.rigid.size()) + 6 * point.rigid;
  const double size = model.rigid[static_cast<std::size_t>(point.rigid)].size_m;
  linalg::SparseMatrix W(model.K.rows(), 6);
  for (int i = 0; i < 6; ++i) W.insert(first + i, i) = i < 3 ? 1.0 : 1.0 / size;
  W.makeCompressed();
  return W;
}

/// The matrix A + W B Wᵀ.
linalg::SparseMatrix with_point(const linalg::SparseMatrix& A, const linalg::SparseMatrix& W, const Matrix6& B) {
  const linalg::SparseMatrix WB = W * linalg::SparseMatrix(B.sparseView());
  const linalg::SparseMatrix Wt = W.transpose();
  return linalg::combine(1.0, A, 1.0, linalg::SparseMatrix(WB * Wt));
}

void add_points(Model& model, const std::vector<FoundPoint>& points) {
  for (const FoundPoint& point : points) {
    if (point.K.isZero(0.0) && point.M.isZero(0.0)) continue;
    const linalg::SparseMatrix W = point.rigid < 0 ? averaging_columns(model, point) : rigid_columns(model, point);
    if (!point.K.isZero(0.0)) model.K = with_point(model.K, W, point.K);
    if (!point.M.isZero(0.0)) model.M = with_point(model.M, W, point.M);
  }
}

void eliminate_rigid_patches(Model& model) {
  if (model.rigid.empty()) return;
  std::vector<int> rows = rows_with_patches(model.nodes, model.free_rows, model.rigid);
  model.K = with_patches(model.K, model.nodes, model.free_rows, model.rigid);
  model.M = with_patches(model.M, model.nodes, model.free_rows, model.rigid);
  model.free_rows = std::move(rows);
}

/// Adds one restraint for each principal stiffness of a spring, so that each is compared with round-off at its own
/// scale.
void add_restraints(const GroundSpring& spring, const PatchAverage& average, std::vector<Restraint>& restraints) {
  const Eigen::Vector3d place = average.centre_m + spring.offset_m;
  for (const bool turn : {false, true}) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(turn ? spring.rotation_N_m : spring.translation_N_m);
    const double negligible = 1e-12 * eigen.eigenvalues()(2);
    for (int i = 0; i < 3; ++i) {
      if (!(eigen.eigenvalues()(i) > negligible)) continue;
      Eigen::Matrix<double, 6, 1> direction = Eigen::Matrix<double, 6, 1>::Zero();
      direction.segment<3>(turn ? 3 : 0) = eigen.eigenvectors().col(i);
      restraints.push_back({average.nodes.front(), place, eigen.eigenvalues()(i), direction * direction.transpose()});
    }
  }
}

void require_one_piece(const FoundPoint& point, const std::vector<int>& piece) {
  const int first = piece[static_cast<std::size_t>(point.average.nodes.front())];
  for (const int node : point.average.nodes) {
    if (piece[static_cast<std::size_t>(node)] == first) continue;
    throw core::InputError("point \"" + point.name +
                           "\" with a spring averages over pieces that do not hang together: give each its own point");
  }
}

std::vector<Restraint> spring_restraints(const std::vector<FoundPoint>& points, const Attachments& attachments,
                                         const std::vector<int>& piece) {
  std::vector<Restraint> restraints;
  for (const GroundSpring& spring : attachments.springs) {
    const auto point =
        std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.name == spring.point; });
    require_one_piece(*point, piece);
    add_restraints(spring, point->average, restraints);
  }
  return restraints;
}

}  // namespace

void attach(Model& model, const std::vector<int>& fixed, const Attachments& attachments) {
  validate(attachments);
  const std::vector<FoundPoint> points = found_points(model, attachments);
  Holding holding;
  holding.fixed = fixed;
  for (const RigidPatch& patch : model.rigid) holding.ties.push_back(patch.nodes);
  const std::vector<int> piece = tied_pieces(model.nodes, holding.ties);
  if (!attachments.clamps.empty()) {
    ClampStiffness clamps = clamp_stiffness(model.mesh, model.nodes, piece, attachments.clamps);
    model.K = linalg::combine(1.0, model.K, 1.0, linalg::restrict_to(clamps.K, model.free_rows));
    holding.restraints = std::move(clamps.restraints);
  }
  const std::vector<Restraint> springs = spring_restraints(points, attachments, piece);
  holding.restraints.insert(holding.restraints.end(), springs.begin(), springs.end());
  eliminate_rigid_patches(model);
  add_points(model, points);
  // The bound is twice that above which modes() takes a mode for elastic, so that a motion cannot count as held here
  // and as rigid there.
  holding.negligible_N_m = 20.0 * std::numeric_limits<double>::epsilon() * model.spectrum_rad2_s2 * model.mass.mass_kg;
  model.free_motions = free_motions(model.nodes, holding);
}

}  // namespace thinwall::fem
