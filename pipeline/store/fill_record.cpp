// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/fill_record.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/io/read_back.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

// What some subdomains are made from.
struct LimitedCut {
  Hash128 cut{};
  std::vector<mesh::PointLimit> limits{};

  static auto fields(auto& self) { return std::tie(self.cut, self.limits); }
};

bool is_whole(const fs::path& folder, const WrittenFile& file)
{
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(folder / file.path, error))) return false;
  if (fs::file_size(folder / file.path, error) != file.size || error) return false;
  return measure_file(folder, file.path).hash == file.hash;
}

}  // namespace

fs::path store_folder(const fs::path& output) { return output / "pieces"; }

std::string record_name(LocalIndex batch) { return fmt::format("piece_{:06}", batch); }

std::string refined_name(LocalIndex batch) { return fmt::format("refined_{:06}", batch); }

mesh::Piece piece_of_record(const fs::path& output, const std::string& name)
{
  const io::RecordStore store(store_folder(output));
  return from_bytes<mesh::Piece>(store.get(name, static_cast<LocalIndex>(PieceSegment::piece)));
}

WrittenFile measure_file(const fs::path& folder, const fs::path& path)
{
  const Bytes bytes = io::read_back(folder / path);
  return {path.string(), bytes.size(), hash_bytes(bytes)};
}

std::optional<FillRecord> find_record(const fs::path& output, const std::string& name,
                                      const Hash128& plan)
{
  const auto bytes = io::RecordStore(store_folder(output)).find(name);
  if (!bytes) return std::nullopt;
  auto record = from_bytes<FillRecord>(*bytes);
  if (record.plan != plan) return std::nullopt;
  const bool all_whole = std::all_of(record.files.begin(), record.files.end(),
                                     [&](const auto& file) { return is_whole(output, file); });
  return all_whole ? std::optional(std::move(record)) : std::nullopt;
}

Hash128 cut_fingerprint(const subdomain::PartitionedMesh& cut)
{
  const std::array<Hash128, 3> parts{hash_bytes(to_bytes(cut.coarse)),
                                     hash_bytes(to_bytes(cut.decomposition)),
                                     hash_bytes(to_bytes(cut.levels))};
  return hash_bytes(to_bytes(parts));
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
  LimitedCut limited{.cut = cut};
  std::ranges::copy_if(limiter.entries(), std::back_inserter(limited.limits),
                       [&](const mesh::PointLimit& entry) {
                         const bool is_on_edge = entry.key.carrier == mesh::LatticeCarrier::edge;
                         return (is_on_edge ? edges : triangles).contains(entry.key.entity);
                       });
  return limited.limits.empty() ? cut : hash_bytes(to_bytes(limited));
}

}  // namespace tessera::pipeline
