#pragma once
// The headers of regression/ that other programs may include.

#include "core/eigen_alignment.hpp"
#include "regression/averaged_process.hpp"
#include "regression/cross_validation.hpp"
#include "regression/dense_process.hpp"
#include "regression/gaussian_process.hpp"
#include "regression/hyper_parameters.hpp"
#include "regression/kernel.hpp"
#include "regression/kronecker_process.hpp"
#include "regression/one_task.hpp"
#include "regression/process_results.hpp"
