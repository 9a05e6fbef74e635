// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/serial_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"

#include "formats/files/record_file.hpp"
#include "formats/files/whole_file.hpp"
#include "formats/foam/case.hpp"
#include "formats/foam/faces.hpp"
#include "formats/foam/text.hpp"

namespace tessera::formats {
namespace {

FoamLayout layout_of(const Outline& outline)
{
  FoamLayout layout = foam_layout(outline);
  if (layout.num_corners() <= kMaxFoamCorners) return layout;
  throw ConfigError(
      fmt::format("the mesh has {} faces with {} corners, but OpenFOAM with labels of 32 bits can "
                  "have {} corners in one process; take openfoam, with output.parts",
                  layout.num_faces(), layout.num_corners(), kMaxFoamCorners));
}

// Cells of each material, from 0.
std::vector<Places> zones_of(const Outline& outline)
{
  std::vector<Places> zones;
  for (std::size_t m = 0; m < outline.material_names.size(); ++m) {
    zones.emplace_back(outline, 0, [&](LocalIndex piece) {
      return foam_zone_count(outline, piece, static_cast<std::int32_t>(m) + 1);
    });
  }
  return zones;
}

constexpr GlobalIndex kLabelSize = sizeof(std::int32_t);
constexpr GlobalIndex kPointSize = 3 * sizeof(double);

// A file of one list.
std::vector<RecordSection> list_section(const FoamKind& kind, const char* name, GlobalIndex length,
                                        GlobalIndex size)
{
  return {{foam_header(kind, name) + foam_list_head(length), length, size}};
}

std::string list_end(GlobalIndex length) { return std::string(foam_list_tail(length)) + "\n"; }

std::vector<RecordSection> face_sections(const FoamLayout& layout)
{
  const GlobalIndex num_begins = layout.num_faces() + 1;
  const GlobalIndex num_corners = layout.num_corners();
  return {{foam_header({.kind = "faceCompactList"}, "faces") + foam_list_head(num_begins),
           num_begins, kLabelSize},
          {list_end(num_begins) + foam_list_head(num_corners), num_corners, kLabelSize}};
}

// The file cellZones: one list a zone.
struct ZoneFile {
  std::vector<RecordSection> sections{};
  std::string tail{};
};

ZoneFile zone_file(const std::vector<std::string>& names, const std::vector<Places>& zones)
{
  ZoneFile file;
  std::string between =
      foam_header({.kind = "regIOobject"}, "cellZones") + fmt::format("{}\n(\n", zones.size());
  for (std::size_t m = 0; m < zones.size(); ++m) {
    const GlobalIndex length = zones[m].size();
    file.sections.push_back(
        {between + foam_zone_head(names[m]) + foam_list_head(length), length, kLabelSize});
    between = std::string(foam_list_tail(length)) + std::string(kFoamZoneTail);
  }
  file.tail = between + ")\n";
  return file;
}

std::int32_t label(GlobalIndex number) { return static_cast<std::int32_t>(number); }

class OpenfoamSerialWriter final : public Writer {
 public:
  explicit OpenfoamSerialWriter(const WriterTarget& target)
      : outline_(target.outline),
        folder_(target.folder),
        mesh_(target.folder / "constant" / "polyMesh"),
        layout_(layout_of(target.outline)),
        zone_places_(zones_of(target.outline)),
        points_(mesh_ / "points",
                list_section({.kind = "vectorField"}, "points", outline_.num_points(), kPointSize),
                list_end(outline_.num_points())),
        faces_(mesh_ / "faces", face_sections(layout_), list_end(layout_.num_corners())),
        owner_(mesh_ / "owner",
               list_section({.kind = "labelList", .note = note()}, "owner", layout_.num_faces(),
                            kLabelSize),
               list_end(layout_.num_faces())),
        neighbour_(mesh_ / "neighbour",
                   list_section({.kind = "labelList", .note = note()}, "neighbour",
                                layout_.inner.faces.size(), kLabelSize),
                   list_end(layout_.inner.faces.size())),
        zones_(mesh_ / "cellZones", zone_file(layout_.names.zones, zone_places_).sections,
               zone_file(layout_.names.zones, zone_places_).tail)
  {
  }

  void begin() override
  {
    io::make_own_folder(mesh_);
    write_foam_system(folder_);
    for (RecordFile* file : files_) file->begin();
    const std::int32_t end = label(layout_.num_corners());
    faces_.write(0, layout_.num_faces(), foam_bytes(std::span(&end, 1)));
  }

  void write(const Piece& piece) override
  {
    points_.write(0, outline_.first_point[at(piece.number)],
                  foam_bytes(std::span(piece.point_xyz).first(3 * at(piece.num_own_points))));
    write_inner_faces(piece);
    for (std::size_t k = 0; k < layout_.patches.size(); ++k) write_patch(piece, k);
    write_zones(piece);
  }

  void close() override
  {
    for (RecordFile* file : files_) file->close();
  }

  void commit() override
  {
    for (RecordFile* file : files_) file->commit();
    std::vector<FoamBoundary> patches;
    for (std::size_t k = 0; k < layout_.patches.size(); ++k) {
      patches.push_back(foam_patch_entry(outline_, layout_.names, k));
      patches.back().num_faces = layout_.patches[k].faces.size();
      patches.back().first_face = layout_.patches[k].faces.begin();
    }
    write_whole_file(mesh_ / "boundary", foam_boundary(patches));
  }

 private:
  [[nodiscard]] std::string note() const
  {
    return fmt::format("nPoints:{} nCells:{} nFaces:{} nInternalFaces:{}", outline_.num_points(),
                       outline_.num_cells(), layout_.num_faces(), layout_.inner.faces.size());
  }

  void write_inner_faces(const Piece& piece)
  {
    const std::vector<FoamFace> inner =
        foam_inner_faces(piece, outline_.first_cell[at(piece.number)]);
    std::vector<std::int32_t> neighbours;
    for (const FoamFace& face : inner) neighbours.push_back(label(face.neighbour));
    write_faces(piece, start_of(piece, layout_.inner), inner);
    neighbour_.write(0, layout_.inner.faces.of(piece.number),
                     foam_bytes(std::span(std::as_const(neighbours))));
  }

  // Where a run of faces begins, and its corners.
  struct Start {
    GlobalIndex face = 0;
    GlobalIndex corner = 0;
  };

  static Start start_of(const Piece& piece, const FacePlaces& places)
  {
    return {places.faces.of(piece.number), places.corners.of(piece.number)};
  }

  // Faces of four corners follow all triangles.
  static Start start_of_cyclic(const FacePlaces& places, GlobalIndex number)
  {
    const FaceCount all{.num_faces = places.faces.size(), .num_corners = places.corners.size()};
    const GlobalIndex num_corners =
        3 * number + std::max<GlobalIndex>(0, number - all.num_triangles());
    return {places.faces.begin() + number, places.corners.begin() + num_corners};
  }

  // Those of a periodic patch stand in the order of the originals.
  void write_patch(const Piece& piece, std::size_t k)
  {
    const FacePlaces& places = layout_.patches[k];
    const std::int32_t tag = layout_.names.patches[k].tag;
    auto cyclic = cyclic_faces_of(piece, tag);
    if (cyclic.empty())
      return write_faces(piece, start_of(piece, places), foam_patch_faces(piece, tag));
    const std::vector<FoamFace> faces = foam_cyclic_faces(piece, cyclic);
    for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
      for (end = i + 1; end < faces.size() && cyclic[end].number == cyclic[end - 1].number + 1;)
        ++end;
      write_faces(piece, start_of_cyclic(places, cyclic[i].number),
                  std::span(faces).subspan(i, end - i));
    }
  }

  void write_faces(const Piece& piece, const Start& start, std::span<const FoamFace> faces)
  {
    std::vector<std::int32_t> begins;
    std::vector<std::int32_t> corners;
    std::vector<std::int32_t> owners;
    const GlobalIndex first_cell = outline_.first_cell[at(piece.number)];
    for (const FoamFace& face : faces) {
      begins.push_back(label(start.corner + static_cast<GlobalIndex>(corners.size())));
      for (const LocalIndex row : face.corners())
        corners.push_back(label(piece.point_numbers[at(row)]));
      owners.push_back(label(first_cell + face.owner));
    }
    faces_.write(0, start.face, foam_bytes(std::span(std::as_const(begins))));
    faces_.write(1, start.corner, foam_bytes(std::span(std::as_const(corners))));
    owner_.write(0, start.face, foam_bytes(std::span(std::as_const(owners))));
  }

  void write_zones(const Piece& piece)
  {
    const std::vector<std::vector<std::int32_t>> cells =
        foam_zone_cells(piece, zone_places_.size(), outline_.first_cell[at(piece.number)]);
    for (std::size_t m = 0; m < cells.size(); ++m)
      zones_.write(m, zone_places_[m].of(piece.number), foam_bytes(std::span(cells[m])));
  }

  const Outline& outline_;
  const std::filesystem::path& folder_;
  std::filesystem::path mesh_;
  FoamLayout layout_;
  std::vector<Places> zone_places_;
  RecordFile points_;
  RecordFile faces_;
  RecordFile owner_;
  RecordFile neighbour_;
  RecordFile zones_;
  std::array<RecordFile*, 5> files_{&points_, &faces_, &owner_, &neighbour_, &zones_};
};

}  // namespace

std::unique_ptr<Writer> make_openfoam_serial_writer(const WriterTarget& target)
{
  return std::make_unique<OpenfoamSerialWriter>(target);
}

}  // namespace tessera::formats
