// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_EIGEN_H
#define EEPA_EIGEN_H

// Eigen, without nvcc's warning of functions that Eigen both marks for the device and defaults.

#ifdef __CUDACC__
#pragma nv_diagnostic push
#pragma nv_diag_suppress 20012
#endif

#include <Eigen/Core>
#include <Eigen/Geometry>

#ifdef __CUDACC__
#pragma nv_diagnostic pop
#endif

#endif
