#include "linalg/supernodal_factor.hpp"

#include <cblas.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "linalg/large_array.hpp"
#include "linalg/library_threads.hpp"

extern "C" void dpotrf_(const char* uplo, const int* n, double* A, const int* stride, int* info, std::size_t);

namespace thinwall::linalg {

namespace {

using Place = std::ptrdiff_t;

constexpr Place tile = 128;  // columns of a tile of a front that threads share

/// A dense block of a column-major matrix.
struct DenseBlock {
  double* values = nullptr;
  Place stride = 0;

  [[nodiscard]] double* at(Place row, Place column) const { return values + column * stride + row; }
};

/// The shape of a supernode's front.
struct Front {
  Place columns = 0;  // number of columns J
  Place rows = 0;     // number of rows J ∪ I

  [[nodiscard]] Place below() const { return rows - columns; }
  [[nodiscard]] Place update_values() const { return below() * below(); }
};

Front front(const SymbolicFactor& L, int s) {
  return {L.columns(s), L.height(s)};
}

/// Factorises A₁₁ = L Lᵀ in place on the lower triangle. Returns the first column without a positive pivot, or −1.
Place cholesky(DenseBlock A, Place columns) {
  const int n = static_cast<int>(columns);
  const int stride = static_cast<int>(A.stride);
  int info = 0;
  dpotrf_("L", &n, A.values, &stride, &info, 1);
  if (info > 0) return info - 1;
  for (Place j = 0; j < columns; ++j) {
    if (!std::isfinite(*A.at(j, j))) return j;  // OpenBLAS does not report NaN
  }
  return -1;
}

/// B ← B L⁻ᵀ; L: columns × columns, B: rows × columns.
void divide(DenseBlock L, DenseBlock B, Place rows, Place columns) {
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, static_cast<int>(rows),
              static_cast<int>(columns), 1.0, L.values, static_cast<int>(L.stride), B.values,
              static_cast<int>(B.stride));
}

/// C ← s C − B Bᵀ on the lower triangle; B: rows × columns.
void subtract_square(DenseBlock B, DenseBlock C, Place rows, Place columns, double s) {
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, static_cast<int>(rows), static_cast<int>(columns), -1.0,
              B.values, static_cast<int>(B.stride), s, C.values, static_cast<int>(C.stride));
}

/// C ← s C − A Bᵀ; A: rows × inner, B: columns × inner.
void subtract_product(DenseBlock A, DenseBlock B, DenseBlock C, Place rows, Place columns, Place inner, double s) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(rows), static_cast<int>(columns),
              static_cast<int>(inner), -1.0, A.values, static_cast<int>(A.stride), B.values, static_cast<int>(B.stride),
              s, C.values, static_cast<int>(C.stride));
}

/// The dense algebra of a front on the calling thread alone, for the groups of subtrees, which run side by side.
struct Alone {
  /// Calls body(i) for i = 0 … count − 1.
  static void each(Place count, const auto& body) {
    for (Place i = 0; i < count; ++i) body(i);
  }
  /// Factorises the panel P, F_JJ = L_JJ L_JJᵀ, L_IJ = F_IJ L_JJ⁻ᵀ; returns a column without a positive pivot, or −1.
  static Place factor_panel(DenseBlock P, Front f) {
    const Place failed = cholesky(P, f.columns);
    if (failed < 0 && f.below() > 0) divide(P, {P.at(f.columns, 0), P.stride}, f.below(), f.columns);
    return failed;
  }
  /// U ← −L_IJ L_IJᵀ.
  static void update(DenseBlock P, Front f, DenseBlock U) {
    subtract_square({P.at(f.columns, 0), P.stride}, U, f.below(), f.columns, 0.0);
  }
};

/// C ← s C − B Bᵀ on the tiles on and below the diagonal of C, shared among all threads; C: rows × columns, B: rows ×
/// inner. Tiles on the diagonal are computed whole; what they hold above it is never read.
void subtract_tiles(DenseBlock B, DenseBlock C, Place rows, Place columns, Place inner, double s) {
  struct Tile {
    Place row, column;
  };
  std::vector<Tile> tiles;
  for (Place column = 0; column < columns; column += tile) {
    for (Place row = column; row < rows; row += 2 * tile) tiles.push_back({row, column});
  }
  core::parallel_for(tiles.size(), [&](std::size_t i) {
    const auto [row, column] = tiles[i];
    subtract_product({B.at(row, 0), B.stride}, {B.at(column, 0), B.stride}, {C.at(row, column), C.stride},
                     std::min(2 * tile, rows - row), std::min(tile, columns - column), inner, s);
  });
}

/// The dense algebra of a front cut into tiles that all threads share, for the top of the tree: its fronts are large
/// and follow each other, so that only work within one front can be shared. The functions do what those of Alone do.
struct Shared {
  static void each(Place count, const auto& body) {
    constexpr Place piece = 32;
    core::parallel_for(static_cast<std::size_t>((count + piece - 1) / piece), [&](std::size_t i) {
      const Place first = static_cast<Place>(i) * piece;
      for (Place k = first; k < std::min(first + piece, count); ++k) body(k);
    });
  }
  /// Goes through the panel by block columns of `tile` columns and subtracts each at once from all columns to its right
  /// (right-looking), because only that large update and the division by the diagonal tile can be shared among threads;
  /// the small diagonal tile is factorised by the calling thread.
  static Place factor_panel(DenseBlock P, Front f) {
    for (Place first = 0; first < f.columns; first += tile) {
      const Place columns = std::min(tile, f.columns - first);
      const DenseBlock diagonal{P.at(first, first), P.stride};
      const Place failed = cholesky(diagonal, columns);
      if (failed >= 0) return first + failed;
      const Place next = first + columns;
      const Place rows = f.rows - next;
      core::parallel_for(static_cast<std::size_t>((rows + 2 * tile - 1) / (2 * tile)), [&](std::size_t i) {
        const Place row = static_cast<Place>(i) * 2 * tile;
        divide(diagonal, {P.at(next + row, first), P.stride}, std::min(2 * tile, rows - row), columns);
      });
      subtract_tiles({P.at(next, first), P.stride}, {P.at(next, next), P.stride}, rows, f.columns - next, columns, 1.0);
    }
    return -1;
  }
  static void update(DenseBlock P, Front f, DenseBlock U) {
    subtract_tiles({P.at(f.columns, 0), P.stride}, U, f.below(), f.below(), f.columns, 0.0);
  }
};

/// The elimination tree of the supernodes, with one entry for each of them in every list.
struct Tree {
  std::vector<std::vector<int>> children;
  std::vector<char> odd;     // 1 if the depth is odd, which chooses the stack of the update matrix
  std::vector<char> shared;  // 1 if the supernode is in the top of the cut

  [[nodiscard]] const std::vector<int>& of(int s) const { return children[static_cast<std::size_t>(s)]; }
  [[nodiscard]] std::size_t parity(int s) const { return static_cast<std::size_t>(odd[static_cast<std::size_t>(s)]); }
  /// True if both belong to the same walk, so that the child's update matrix lies on the stack of that walk.
  [[nodiscard]] bool together(int child, int parent) const {
    return shared[static_cast<std::size_t>(child)] == shared[static_cast<std::size_t>(parent)];
  }
};

Tree tree(const SymbolicFactor& L, const TreeCut& cut) {
  const auto count = static_cast<std::size_t>(L.count());
  Tree result{std::vector<std::vector<int>>(count), std::vector<char>(count, 0), std::vector<char>(count, 0)};
  const std::vector<int> parent = parents(L);
  for (std::size_t s = count; s-- > 0;) {  // a parent comes after its children
    if (parent[s] >= 0) result.odd[s] = static_cast<char>(1 - result.odd[static_cast<std::size_t>(parent[s])]);
  }
  for (std::size_t s = 0; s < count; ++s) {
    if (parent[s] >= 0) result.children[static_cast<std::size_t>(parent[s])].push_back(static_cast<int>(s));
  }
  for (const int s : cut.top) result.shared[static_cast<std::size_t>(s)] = 1;
  return result;
}

/// Numbers of values on the two stacks of update matrices of a walk, one for even and one for odd depths in the tree. A
/// supernode reads its children's update matrices on one stack while it builds its own on the other; on a single stack
/// its own would have to be moved down over theirs afterwards.
struct Heights {
  std::array<Place, 2> values{};

  Place& operator[](std::size_t parity) { return values[parity]; }
  [[nodiscard]] Place sum() const { return values[0] + values[1]; }
  void raise_to(const Heights& other) {
    for (std::size_t parity : {0U, 1U}) values[parity] = std::max(values[parity], other.values[parity]);
  }
};

/// Heights of the stacks at the end of a walk over `supernodes`, and the largest on the way.
struct StackUse {
  Heights end;
  Heights most;
};

/// The heights that walk() reaches on `supernodes`, by its pushes and pops without the numbers.
StackUse stack_use(const SymbolicFactor& L, const Tree& tree, const std::vector<int>& supernodes) {
  StackUse use;
  for (const int s : supernodes) {
    const std::size_t parity = tree.parity(s);
    use.end[parity] += front(L, s).update_values();
    use.most.raise_to(use.end);
    for (const int child : tree.of(s)) {
      if (tree.together(child, s)) use.end[1 - parity] -= front(L, child).update_values();
    }
  }
  return use;
}

/// Heights that suffice for the walk over any one group.
Heights group_heights(const SymbolicFactor& L, const Tree& tree, const TreeCut& cut) {
  Heights most;
  for (const auto& group : cut.groups) most.raise_to(stack_use(L, tree, group).most);
  return most;
}

/// The memory that a walk over some supernodes, children first, works with.
struct Workspace {
  std::array<LargeArray<double>, 2> stack;  // update matrices, for even and odd depths
  LargeArray<int> place;                    // for each row of A (new position) its row in the current front
  Heights used{};
  std::vector<int> targets{};  // rows in the current front of the rows of all children's update matrices

  Workspace(Heights heights, Place rows)
      : stack{LargeArray<double>(heights[0]), LargeArray<double>(heights[1])}, place(rows) {}
};

/// The factorisation in progress. update[s] of a supernode points into a stack and is valid until its parent is
/// eliminated.
struct Multifrontal {
  const MatrixSum& sum;
  const SymbolicFactor& L;
  double* values;
  Tree tree;
  std::vector<int> position;    // old row → new position
  std::vector<double*> update;  // update matrix of each supernode that has been eliminated

  [[nodiscard]] DenseBlock panel(int s) const { return {values + L.value(s), L.height(s)}; }
  [[nodiscard]] DenseBlock update_matrix(int s) const {
    return {update[static_cast<std::size_t>(s)], front(L, s).below()};
  }

  /// Finds the place in the front of supernode s of each of its own rows, and then of the rows of its children's update
  /// matrices. These are a subset of its own rows, so that places left over from earlier fronts are never read.
  void locate(int s, Workspace& work) const {
    const int* rows = L.rows_of(s);
    for (int k = 0; k < L.height(s); ++k) work.place[rows[k]] = k;
    work.targets.clear();
    for (const int child : tree.of(s)) {
      const int* below = L.rows_of(child);
      for (Place k = L.columns(child); k < L.height(child); ++k) work.targets.push_back(work.place[below[k]]);
    }
  }

  /// Writes A(J ∪ I, J), lower triangle, to the panel of supernode s.
  template <class Threads>
  void gather(int s, const Workspace& work) const {
    const Place first = L.column(s);
    Threads::each(front(L, s).columns, [&](Place j) {
      double* column = panel(s).at(0, j);
      std::fill(column + j, column + L.height(s), 0.0);
      const auto add = [&](const SparseMatrix& term, double factor) {
        for (SparseMatrix::InnerIterator it(term, L.permutation[static_cast<std::size_t>(first + j)]); it; ++it) {
          const int row = position[static_cast<std::size_t>(it.row())];
          if (row >= first + j) column[work.place[row]] += factor * it.value();
        }
      };
      add(sum.A, 1.0);
      if (sum.B != nullptr) add(*sum.B, sum.b);
    });
  }

  /// Adds the update matrices of all children to F (extend-add): F ← F + U_child, only the columns that belong to
  /// columns [from, to) of the front. F starts in the front's column `from`. A child's rows are ascending in the front,
  /// so that its columns in [from, to) are found by bisection.
  template <class Threads>
  void extend_add(int s, Place from, Place to, DenseBlock F, const Workspace& work) const {
    const int* target = work.targets.data();
    for (const int child : tree.of(s)) {
      const DenseBlock U = update_matrix(child);
      const int* const end = target + U.stride;
      const Place first = std::lower_bound(target, end, from) - target;
      const Place last = std::lower_bound(target, end, to) - target;
      Threads::each(last - first, [&](Place k) {
        const Place j = first + k;
        double* column = F.at(0, target[j] - from);
        const double* term = U.at(0, j);
        for (Place i = j; i < U.stride; ++i) column[target[i]] += term[i];
      });
      target = end;
    }
  }

  /// Eliminates one supernode: its children's update matrices are consumed and its own is pushed on the stack. Returns
  /// the new position of a pivot that is not positive, or −1. The children's parts in the columns J are added to the
  /// panel before it is factorised, their parts in I to the update matrix after L_IJ L_IJᵀ has been written there, so
  /// that the stack need not be cleared first.
  template <class Threads>
  Place eliminate(int s, Workspace& work) {
    const Front f = front(L, s);
    locate(s, work);
    gather<Threads>(s, work);
    extend_add<Threads>(s, 0, f.columns, panel(s), work);
    const Place failed = Threads::factor_panel(panel(s), f);
    if (failed >= 0) return L.column(s) + failed;
    const std::size_t parity = tree.parity(s);
    const DenseBlock U{work.stack[parity].data() + work.used[parity], f.below()};
    if (f.below() > 0) Threads::update(panel(s), f, U);
    // Rows of a front are counted from its first row, those of U from the first row below the columns.
    extend_add<Threads>(s, f.columns, f.rows, {U.values - f.columns, U.stride}, work);
    update[static_cast<std::size_t>(s)] = U.values;
    work.used[parity] += f.update_values();
    for (const int child : tree.of(s)) {
      if (tree.together(child, s)) work.used[1 - parity] -= front(L, child).update_values();
    }
    return -1;
  }

  /// Eliminates the supernodes, which are listed children first; returns the first pivot that is not positive, or −1.
  template <class Threads>
  Place walk(const std::vector<int>& supernodes, Workspace& work) {
    work.used = {};
    for (const int s : supernodes) {
      core::check_interrupt();
      const Place failed = eliminate<Threads>(s, work);
      if (failed >= 0) return failed;
    }
    return -1;
  }

  /// A copy of the update matrices that a walk has left on its stacks for the top of the tree; the workspace is then
  /// free for the next walk.
  std::array<LargeArray<double>, 2> remains(Workspace& work, const std::vector<int>& supernodes) {
    std::array<LargeArray<double>, 2> kept;
    for (const std::size_t parity : {0U, 1U}) {
      kept[parity] = LargeArray<double>(work.used[parity]);
      std::copy_n(work.stack[parity].data(), work.used[parity], kept[parity].data());
    }
    for (const int s : supernodes) {
      double*& U = update[static_cast<std::size_t>(s)];
      U = kept[tree.parity(s)].data() + (U - work.stack[tree.parity(s)].data());
    }
    return kept;
  }
};

/// A pool of workspaces, which walks take and give back; it makes as many as there are threads at work.
class Pool {
 public:
  Pool(Heights heights, Place rows) : heights_(heights), rows_(rows) {}

  std::unique_ptr<Workspace> take() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) return std::make_unique<Workspace>(heights_, rows_);
    auto work = std::move(free_.back());
    free_.pop_back();
    return work;
  }
  void give(std::unique_ptr<Workspace> work) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(work));
  }

 private:
  Heights heights_;
  Place rows_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> free_;
};

}  // namespace

double update_bytes(const SymbolicFactor& L, const TreeCut& cut) {
  const Tree t = tree(L, cut);
  const auto at_once = std::min(cut.groups.size(), static_cast<std::size_t>(core::thread_count()));
  // The stacks of the groups are freed before that of the top is allocated; they are counted together nevertheless,
  // because an allocator need not be able to reuse their place.
  Place values = stack_use(L, t, cut.top).most.sum();
  values += static_cast<Place>(at_once) * group_heights(L, t, cut).sum();
  for (const auto& group : cut.groups) values += stack_use(L, t, group).end.sum();
  return 8.0 * static_cast<double>(values);
}

std::optional<int> supernodal_factor(const MatrixSum& sum, const SymbolicFactor& L, const TreeCut& cut,
                                     double* values) {
  const LibraryThreads one(1);
  const Eigen::Index rows = sum.A.rows();
  Multifrontal method{sum, L, values, tree(L, cut), {}, {}};
  method.position.resize(static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i)
    method.position[static_cast<std::size_t>(L.permutation[static_cast<std::size_t>(i)])] = i;
  method.update.resize(static_cast<std::size_t>(L.count()));
  std::vector<Place> failed(cut.groups.size());
  std::vector<std::array<LargeArray<double>, 2>> below_top(cut.groups.size());
  {
    // Groups are independent of each other. Each leaves the update matrices of its subtrees' roots, which the top of
    // the tree consumes afterwards; they are copied so that the workspace can serve the next group.
    Pool pool(group_heights(L, method.tree, cut), rows);
    core::parallel_for(cut.groups.size(), [&](std::size_t g) {
      std::unique_ptr<Workspace> work = pool.take();
      failed[g] = method.walk<Alone>(cut.groups[g], *work);
      if (failed[g] < 0) below_top[g] = method.remains(*work, cut.groups[g]);
      pool.give(std::move(work));
    });
  }
  // The smallest failing column is reported, so that the message does not depend on the order of the threads.
  std::erase(failed, -1);
  if (!failed.empty()) return static_cast<int>(*std::min_element(failed.begin(), failed.end()));
  Workspace work(stack_use(L, method.tree, cut.top).most, rows);
  const Place failed_on_top = method.walk<Shared>(cut.top, work);
  if (failed_on_top >= 0) return static_cast<int>(failed_on_top);
  return std::nullopt;
}

}  // namespace thinwall::linalg
