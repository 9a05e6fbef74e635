// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/writer.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"

#include "formats/files/whole_file.hpp"
#include "formats/foam/case.hpp"
#include "formats/foam/faces.hpp"
#include "formats/foam/text.hpp"
#include "formats/link/number_faces.hpp"

namespace tessera::formats {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_processor(const fs::path& folder, LocalIndex number)
{
  return folder / fmt::format("processor{}", number);
}

// OpenFOAM runs on as many ranks as there are such folders.
void require_no_more_processors(const fs::path& folder, LocalIndex num_pieces)
{
  const fs::path next = folder_of_processor(folder, num_pieces);
  if (!fs::exists(next)) return;
  throw OutputError(fmt::format("{} is there from a mesh of more than {} pieces; remove it",
                                next.string(), num_pieces));
}

void require_labels_suffice(const Outline& outline)
{
  for (LocalIndex number = 0; number < outline.num_pieces(); ++number) {
    const PieceCounts& piece = outline.pieces[at(number)];
    const GlobalIndex num_corners = 3 * (4 * piece.num_tets - num_inner_faces(piece));
    if (num_corners <= kMaxFoamCorners) continue;
    throw ConfigError(fmt::format(
        "piece {} has faces with {} corners, but OpenFOAM with labels of 32 bits can have {} in "
        "a processor; make the mesh with a higher output.parts, or take xdmf",
        number, num_corners, kMaxFoamCorners));
  }
}

// The faces of a processor and how they fall into patches.
struct FaceList {
  std::vector<std::int32_t> begins{0};
  std::vector<std::int32_t> corners{};
  std::vector<std::int32_t> owner{};
  std::vector<std::int32_t> neighbour{};
  std::vector<FoamBoundary> patches{};
  /// Of faceProcAddressing: 1 + the number in the serial mesh, negative if seen from the other
  /// side.
  std::vector<GlobalIndex> serial{};

  [[nodiscard]] GlobalIndex size() const { return static_cast<GlobalIndex>(owner.size()); }
};

class ProcessorFaces {
 public:
  ProcessorFaces(const Piece& piece, const Outline& outline, const FoamLayout& layout)
      : piece_(piece), first_cell_(outline.first_cell[at(piece.number)])
  {
    add_inner_faces(layout.inner.faces.of(piece.number));
    for (std::size_t k = 0; k < layout.patches.size(); ++k)
      add_outer_patch(layout, k, foam_patch_entry(outline, layout.names, k));
    std::set<LocalIndex> others;
    for (const SeamFace& seam : piece.seams) others.insert(seam.other_piece);
    for (const CyclicFace& face : piece.cyclic_faces) others.insert(face.other_piece);
    others.erase(piece.number);
    for (const LocalIndex other : others) {
      add_seam(other);
      for (const std::size_t k : seam_order(outline, layout, other))
        add_cyclic_seam(layout, k, other);
    }
  }

  [[nodiscard]] FaceList take() { return std::move(list_); }

 private:
  // Those to later pieces are no inner faces here, but have their places among them in the whole.
  void add_inner_faces(GlobalIndex first_face)
  {
    GlobalIndex number = first_face;
    for (const FoamFace& face : foam_inner_faces(piece_, first_cell_)) {
      ++number;
      if (face.neighbour >= first_cell_ + piece_.num_cells()) continue;
      add(face);
      list_.neighbour.push_back(static_cast<std::int32_t>(face.neighbour - first_cell_));
      list_.serial.push_back(number);
    }
  }

  // Of a periodic patch the faces whose partners are here too.
  void add_outer_patch(const FoamLayout& layout, std::size_t k, FoamBoundary patch)
  {
    if (patch.cyclic) return add_cyclic_faces(layout, k, piece_.number, std::move(patch));
    add_patch(std::move(patch), foam_patch_faces(piece_, layout.names.patches[k].tag));
    for (GlobalIndex i = 0; i < list_.patches.back().num_faces; ++i)
      list_.serial.push_back(layout.patches[k].faces.of(piece_.number) + i + 1);
  }

  // OpenFOAM's processors pair their patches by the order in which they have them. So the later of
  // two pieces has, in the place of each periodic patch, the partner of it.
  [[nodiscard]] std::vector<std::size_t> seam_order(const Outline& outline,
                                                    const FoamLayout& layout,
                                                    LocalIndex other) const
  {
    const auto& patches = layout.names.patches;
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const auto cyclic = foam_patch_entry(outline, layout.names, k).cyclic;
      if (!cyclic) continue;
      const auto partner = std::ranges::find(patches, cyclic->neighbour, &FoamPatch::name);
      order.push_back(piece_.number < other ? k
                                            : static_cast<std::size_t>(partner - patches.begin()));
    }
    return order;
  }

  // And those whose partners are in another piece.
  void add_cyclic_seam(const FoamLayout& layout, std::size_t k, LocalIndex other)
  {
    const auto& [name, tag] = layout.names.patches[k];
    const auto is_there = [&](const CyclicFace& face) { return face.other_piece == other; };
    if (std::ranges::none_of(cyclic_faces_of(piece_, tag), is_there)) return;
    add_cyclic_faces(layout, k, other,
                     {.name = fmt::format("{}through{}", seam_name(other), name),
                      .processor = piece_.number,
                      .other_processor = other,
                      .through = name});
  }

  void add_cyclic_faces(const FoamLayout& layout, std::size_t k, LocalIndex other,
                        FoamBoundary patch)
  {
    std::vector<CyclicFace> faces;
    std::ranges::copy_if(cyclic_faces_of(piece_, layout.names.patches[k].tag),
                         std::back_inserter(faces),
                         [&](const CyclicFace& face) { return face.other_piece == other; });
    add_patch(std::move(patch), foam_cyclic_faces(piece_, faces));
    for (const CyclicFace& face : faces)
      list_.serial.push_back(layout.patches[k].faces.begin() + face.number + 1);
  }

  [[nodiscard]] std::string seam_name(LocalIndex other) const
  {
    return fmt::format("procBoundary{}to{}", piece_.number, other);
  }

  void add_seam(LocalIndex other)
  {
    const std::vector<FoamFace> faces = foam_seam_faces(piece_, first_cell_, other);
    if (faces.empty()) return;
    add_patch({.name = seam_name(other), .processor = piece_.number, .other_processor = other},
              faces);
    for (const FoamFace& face : faces) {
      const auto seam = std::ranges::lower_bound(piece_.seams, face.side, {}, &SeamFace::side);
      const GlobalIndex number = seam->face_number + 1;
      list_.serial.push_back(other > piece_.number ? number : -number);
    }
  }

  void add_patch(FoamBoundary patch, const std::vector<FoamFace>& faces)
  {
    patch.first_face = list_.size();
    patch.num_faces = static_cast<GlobalIndex>(faces.size());
    for (const FoamFace& face : faces) add(face);
    list_.patches.push_back(std::move(patch));
  }

  void add(const FoamFace& face)
  {
    const auto corners = face.corners();
    list_.corners.insert(list_.corners.end(), corners.begin(), corners.end());
    list_.begins.push_back(static_cast<std::int32_t>(list_.corners.size()));
    list_.owner.push_back(face.owner);
  }

  const Piece& piece_;
  GlobalIndex first_cell_;
  FaceList list_{};
};

std::vector<std::int32_t> labels_of(const std::vector<GlobalIndex>& numbers)
{
  std::vector<std::int32_t> labels;
  labels.reserve(numbers.size());
  for (const GlobalIndex number : numbers) labels.push_back(static_cast<std::int32_t>(number));
  return labels;
}

std::string faces_text(const FaceList& faces)
{
  return foam_header({.kind = "faceCompactList"}, "faces") + foam_labels(faces.begins) + "\n"
         + foam_labels(faces.corners) + "\n";
}

std::string zones_text(const Piece& piece, const std::vector<std::string>& names)
{
  const auto cells = foam_zone_cells(piece, names.size(), 0);
  std::string text =
      foam_header({.kind = "regIOobject"}, "cellZones") + fmt::format("{}\n(\n", names.size());
  for (std::size_t m = 0; m < names.size(); ++m)
    text.append(foam_zone_head(names[m])).append(foam_labels(cells[m])).append(kFoamZoneTail);
  return text + ")\n";
}

class OpenfoamWriter final : public Writer {
 public:
  explicit OpenfoamWriter(const WriterTarget& target)
      : outline_(target.outline), folder_(target.folder), layout_(foam_layout(target.outline))
  {
    require_labels_suffice(outline_);
  }

  void begin() override
  {
    require_no_more_processors(folder_, outline_.num_pieces());
    write_foam_system(folder_);
    write_foam_decomposition(folder_, outline_.num_pieces());
  }

  void write(const Piece& piece) override
  {
    const fs::path mesh = folder_of_processor(folder_, piece.number) / "constant" / "polyMesh";
    io::make_own_folder(mesh);
    const FaceList faces = ProcessorFaces(piece, outline_, layout_).take();
    write_whole_file(mesh / "points",
                     foam_header({.kind = "vectorField"}, "points")
                         + foam_list(std::span(piece.point_xyz), piece.num_points()) + "\n");
    write_whole_file(mesh / "faces", faces_text(faces));
    write_labels(mesh, {.kind = "labelList", .note = note(piece, faces)}, "owner", faces.owner);
    write_labels(mesh, {.kind = "labelList", .note = note(piece, faces)}, "neighbour",
                 faces.neighbour);
    write_whole_file(mesh / "cellZones", zones_text(piece, layout_.names.zones));
    // Nobody has numbered the faces between pieces with prisms.
    if (layout_.num_faces() < INT32_MAX && !outline_.has_prisms()) {
      write_addressing(mesh, piece, faces);
    } else {
      remove_addressing(mesh);
    }
    write_whole_file(mesh / "boundary", foam_boundary(faces.patches));
  }

 private:
  static std::string note(const Piece& piece, const FaceList& faces)
  {
    return fmt::format("nPoints:{} nCells:{} nFaces:{} nInternalFaces:{}", piece.num_points(),
                       piece.num_cells(), faces.size(), faces.neighbour.size());
  }

  // What a processor's entities are in the serial mesh, for reconstructPar and decomposePar.
  void write_addressing(const fs::path& mesh, const Piece& piece, const FaceList& faces) const
  {
    std::vector<std::int32_t> cells(piece.tet_material.size());
    std::iota(cells.begin(), cells.end(),
              static_cast<std::int32_t>(outline_.first_tet[at(piece.number)]));
    std::vector<std::int32_t> patches(faces.patches.size(), -1);
    std::iota(patches.begin(),
              patches.begin() + static_cast<std::ptrdiff_t>(layout_.patches.size()), 0);
    const FoamKind kind{.kind = "labelList"};
    write_labels(mesh, kind, "cellProcAddressing", cells);
    write_labels(mesh, kind, "faceProcAddressing", labels_of(faces.serial));
    write_labels(mesh, kind, "pointProcAddressing", labels_of(piece.point_numbers));
    write_labels(mesh, kind, "boundaryProcAddressing", patches);
  }

  // Those of another mesh that was there before.
  static void remove_addressing(const fs::path& mesh)
  {
    for (const char* of : {"cell", "face", "point", "boundary"}) {
      fs::remove(mesh / fmt::format("{}ProcAddressing", of));
    }
  }

  static void write_labels(const fs::path& mesh, const FoamKind& kind, const std::string& name,
                           const std::vector<std::int32_t>& labels)
  {
    write_whole_file(mesh / name, foam_header(kind, name) + foam_labels(labels) + "\n");
  }

  const Outline& outline_;
  const fs::path& folder_;
  FoamLayout layout_;
};

}  // namespace

std::unique_ptr<Writer> make_openfoam_writer(const WriterTarget& target)
{
  return std::make_unique<OpenfoamWriter>(target);
}

}  // namespace tessera::formats
