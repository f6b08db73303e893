#include "core/dense_products.hpp"

namespace Eigen::internal {
THINWALL_PRODUCT_KERNELS(template)
}  // namespace Eigen::internal
