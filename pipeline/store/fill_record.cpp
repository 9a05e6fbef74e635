// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/fill_record.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_whole(const fs::path& folder, const WrittenFile& file)
{
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(folder / file.path, error))) return false;
  if (fs::file_size(folder / file.path, error) != file.size || error) return false;
  return measure_file(folder, file.path).hash == file.hash;
}

}  // namespace

Bytes to_bytes(const FillRecord& record)
{
  ByteWriter out;
  out.put(record.plan);
  out.put(to_bytes(record.results));
  out.put(static_cast<std::uint64_t>(record.files.size()));
  for (const WrittenFile& file : record.files) {
    out.put(file.path);
    out.put(file.size);
    out.put(file.hash);
  }
  out.put(record.piece);
  return std::move(out).take();
}

FillRecord fill_record_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  FillRecord record;
  record.plan = in.get<Hash128>();
  record.results = subdomain::fill_results_from_bytes(in.get_vector<std::byte>());
  const auto num_files = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < num_files; ++i) {
    WrittenFile& file = record.files.emplace_back();
    file.path = in.get_string();
    file.size = in.get<std::uint64_t>();
    file.hash = in.get<Hash128>();
  }
  record.piece = in.get_vector<std::byte>();
  return record;
}

fs::path store_folder(const fs::path& output) { return output / "pieces"; }

std::string record_name(LocalIndex batch) { return fmt::format("piece_{:06}", batch); }

WrittenFile measure_file(const fs::path& folder, const fs::path& path)
{
  std::ifstream in(folder / path, std::ios::binary);
  std::error_code error;
  const auto size = fs::file_size(folder / path, error);
  Bytes bytes(error ? 0 : size);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (error || !in) throw OutputError("cannot read back " + (folder / path).string());
  return {path.string(), size, hash_bytes(bytes)};
}

std::optional<FillRecord> find_record(const fs::path& output, LocalIndex batch, const Hash128& plan)
{
  const auto bytes = io::RecordStore(store_folder(output)).find(record_name(batch));
  if (!bytes) return std::nullopt;
  FillRecord record = fill_record_from_bytes(*bytes);
  if (record.plan != plan) return std::nullopt;
  const bool all_whole = std::all_of(record.files.begin(), record.files.end(),
                                     [&](const auto& file) { return is_whole(output, file); });
  return all_whole ? std::optional(std::move(record)) : std::nullopt;
}

Hash128 cut_fingerprint(const subdomain::PartitionedMesh& cut)
{
  ByteWriter out;
  out.put(hash_bytes(mesh::to_bytes(cut.coarse)));
  out.put(hash_bytes(mesh::to_bytes(cut.decomposition)));
  return hash_bytes(std::move(out).take());
}

Hash128 plan_fingerprint(const Hash128& cut, const mesh::Skeleton& skeleton,
                         const mesh::ProjectionLimiter& limiter, LocalIndex first, LocalIndex last)
{
  if (limiter.entries().empty()) return cut;
  std::set<LocalIndex> edges;
  std::set<LocalIndex> triangles;
  for (LocalIndex s = first; s < last; ++s) {
    for (const LocalIndex t : skeleton.triangles_of(s)) {
      triangles.insert(t);
      for (std::size_t side = 0; side < 3; ++side) {
        edges.insert(skeleton.triangle_edges[3 * at(t) + side]);
      }
    }
  }
  ByteWriter out;
  out.put(cut);
  for (const mesh::PointLimit& entry : limiter.entries()) {
    const bool is_on_edge = entry.key.carrier == mesh::LatticeCarrier::edge;
    if ((is_on_edge ? edges : triangles).contains(entry.key.entity)) {
      out.put(entry.key);
      out.put(entry.factor);
    }
  }
  return hash_bytes(std::move(out).take());
}

}  // namespace tessera::pipeline
