// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/estimate/rates.hpp"

#include "tessera/formats/export_mesh.hpp"

namespace tessera::pipeline {
namespace {

// Measured on torus, subdivided and re-meshed: lz4 23 to 28, with small pieces 31. The other two
// are older measurements on shaft, less the boundary files that they included.
double vtu_bytes_per_tet(io::Compression compression)
{
  switch (compression) {
    case io::Compression::none:
      return 48.0;
    case io::Compression::zlib:
      return 13.0;
    case io::Compression::lz4:
      return 27.0;
  }
  return 48.0;
}

constexpr double kQualityBytes = 8.0;

// Files of second order over those of first: 3.2 for a subdivided ball of 137 k tets, lz4. In other
// formats 2.7 to 4.0, for core with 76 k tets.
constexpr double kSecondOrderBytes = 3.2;
constexpr double kSecondOrderBytesOfOthers = 4.0;

// In all formats together.
double file_bytes_per_tet(const io::OutputOptions& options)
{
  const bool is_second_order = options.order == 2;
  double others = 0.0;
  for (const io::Format format : options.formats) others += formats::bytes_per_tet(format);
  return vtu_bytes_per_tet(options.compression) * (is_second_order ? kSecondOrderBytes : 1.0)
         + others * (is_second_order ? kSecondOrderBytesOfOthers : 1.0)
         + (options.cell_quality ? kQualityBytes : 0.0);
}

}  // namespace

// Measured on torus and core with pieces of 1e4 to 3e5 tets. NETGEN's fills from the children took
// 4e-6 to 8e-6 s a tet on linkrods.step, screw.step and shaft; from the skin alone 80e-6.
// Our optimiser: fills of the eleven cases took 1.3e-6 to 4e-6 s a tet. Its memory is that of the
// children and the 250 bytes that optimize() states; neither was measured in a job.
Rates built_in_rates(const io::OutputOptions& options)
{
  const double file_bytes = file_bytes_per_tet(options);
  Rates rates;
  rates.netgen = {.interior_vertices_per_tet = 0.11,
                  .fill_cpu_s_per_tet = 1e-5,
                  .plan_cpu_s_per_tet = 1e-6,
                  .write_cpu_s_per_tet = 1e-6,
                  .job_bytes_per_tet = 1000.0,
                  .file_bytes_per_tet = file_bytes,
                  .store_bytes_per_tet = 28.0};
  rates.subdivide = {.interior_vertices_per_tet = 0.15,
                     .fill_cpu_s_per_tet = 1e-6,
                     .plan_cpu_s_per_tet = 1e-7,
                     .write_cpu_s_per_tet = 1e-6,
                     .job_bytes_per_tet = 160.0,
                     .file_bytes_per_tet = file_bytes,
                     .store_bytes_per_tet = 28.0};
  rates.optimize = {.interior_vertices_per_tet = 0.15,
                    .fill_cpu_s_per_tet = 3e-6,
                    .plan_cpu_s_per_tet = 1e-6,
                    .write_cpu_s_per_tet = 1e-6,
                    .job_bytes_per_tet = 400.0,
                    .file_bytes_per_tet = file_bytes,
                    .store_bytes_per_tet = 28.0};
  rates.file_bytes_per_boundary_triangle = 36.0;
  rates.file_header_bytes = 3e3;
  return rates;
}

}  // namespace tessera::pipeline
