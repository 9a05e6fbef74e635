// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "tessera/fill/options.hpp"
#include "tessera/io/options.hpp"

namespace tessera::pipeline {

/// @brief What a tet of one kernel costs.
struct KernelRates {
  double tets_per_expected = 1.0;  ///< Tets made for one that the outline expects.
  double interior_vertices_per_tet = 0.0;
  double fill_cpu_s_per_tet = 0.0;  ///< All tries; with the file in one pass.
  double plan_cpu_s_per_tet = 0.0;
  double write_cpu_s_per_tet = 0.0;  ///< From the store to the file; unused in one pass.
  double job_bytes_per_tet = 0.0;    ///< Memory of a fill job beyond kJobBytes.
  double file_bytes_per_tet = 0.0;   ///< In mesh/, beyond the header.
  double store_bytes_per_tet = 0.0;  ///< While a piece waits for its id; unused in one pass.
};

/// @brief What a run costs, measured by samples or built in.
struct Rates {
  KernelRates netgen{};
  KernelRates subdivide{};
  KernelRates optimize{};
  double file_bytes_per_boundary_triangle = 0.0;  ///< In boundary/, beyond the header.
  double file_header_bytes = 0.0;                 ///< Of each file, whatever it holds.

  [[nodiscard]] const KernelRates& of(fill::KernelKind kernel) const
  {
    switch (kernel) {
      case fill::KernelKind::subdivide:
        return subdivide;
      case fill::KernelKind::optimize:
        return optimize;
      case fill::KernelKind::netgen:
        break;
    }
    return netgen;
  }
  [[nodiscard]] KernelRates& of(fill::KernelKind kernel)
  {
    return const_cast<KernelRates&>(std::as_const(*this).of(kernel));
  }
};

/// @brief Private memory of a fill job that fills next to nothing, bytes. Measured on torus: 1 MB
/// with NETGEN, about 9 MB where the job writes its file. It matters where a sample is much smaller
/// than the jobs of the run.
inline constexpr double kJobBytes = 5e6;

/// @brief Memory of a rank that writes a file from the store, bytes a tet of the file. It is for
/// the record, the piece, arrays with 64-bit ids, VTK's copy of them and the compressed text.
/// Measured on torus, 1.2 M tets in one file against twelve: 111.
inline constexpr double kWriterBytesPerTet = 111.0;

/// @brief Splitting pieces further, with the smoothing and the file. Measured on shaft, 27 M tets:
/// 0.6e-6 s and 220 bytes; on a STEP file with many small faces, whose points are dear, 10e-6 s.
inline constexpr double kRefineCpuPerTet_s = 1e-6;
inline constexpr double kRefineBytesPerTet = 220.0;

/// @brief Rates of no machine in particular, for what must be known without a sample: which samples
/// are affordable, whether the disk will do.
[[nodiscard]] Rates built_in_rates(const io::OutputOptions& options);

}  // namespace tessera::pipeline
