// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/piece_summary.hpp"

namespace tessera::pipeline {

Bytes to_bytes(const FillResult& result)
{
  ByteWriter out;
  out.put(result.summary);
  out.put(quality::to_bytes(result.histograms));
  out.put(result.seams);
  return std::move(out).take();
}

FillResult fill_result_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  FillResult result;
  result.summary = in.get<PieceSummary>();
  result.histograms = quality::quality_histograms_from_bytes(in.get_vector<std::byte>());
  result.seams = in.get_vector<verify::SeamHash>();
  return result;
}

}  // namespace tessera::pipeline
