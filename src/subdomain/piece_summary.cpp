// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_summary.hpp"

#include <utility>

namespace tessera::subdomain {

Bytes to_bytes(const std::vector<FailedTries>& failures)
{
  ByteWriter out;
  out.put(static_cast<std::uint64_t>(failures.size()));
  for (const FailedTries& failed : failures) {
    out.put(failed.subdomain);
    out.put(failed.messages);
  }
  return std::move(out).take();
}

std::vector<FailedTries> failed_tries_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  std::vector<FailedTries> failures;
  for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
    const auto subdomain = in.get<LocalIndex>();
    failures.push_back({subdomain, in.get_strings()});
  }
  return failures;
}

Bytes to_bytes(const FillResult& result)
{
  ByteWriter out;
  out.put(result.summary);
  out.put(result.failures);
  out.put(quality::to_bytes(result.histograms));
  out.put(result.seams);
  return std::move(out).take();
}

FillResult fill_result_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  FillResult result;
  result.summary = in.get<PieceSummary>();
  result.failures = in.get_strings();
  result.histograms = quality::quality_histograms_from_bytes(in.get_vector<std::byte>());
  result.seams = in.get_vector<verify::SeamHash>();
  return result;
}

Bytes to_bytes(const std::vector<FillResult>& results)
{
  ByteWriter out;
  out.put(static_cast<std::uint64_t>(results.size()));
  for (const FillResult& result : results) out.put(to_bytes(result));
  return std::move(out).take();
}

std::vector<FillResult> fill_results_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  const auto count = in.get<std::uint64_t>();
  std::vector<FillResult> results;
  for (std::uint64_t i = 0; i < count; ++i) {
    results.push_back(fill_result_from_bytes(in.get_vector<std::byte>()));
  }
  return results;
}

}  // namespace tessera::subdomain
