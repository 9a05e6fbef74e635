// SPDX-License-Identifier: BSD-3-Clause
#include "formats/xdmf_writer.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/xml_escape.hpp"
#include "tessera/io/files.hpp"

#include "formats/hdf5_file.hpp"
#include "formats/shared_file.hpp"

namespace tessera::formats {
namespace {

constexpr const char* kPoints = "/geometry/vertices";
constexpr const char* kTets = "/viz/topology/cells";
constexpr const char* kMaterial = "/cells/material";
constexpr const char* kPiece = "/cells/piece";
constexpr const char* kTriangles = "/boundary/triangles";
constexpr const char* kPatch = "/boundary/patch";
// Of the partition: where the points, tets and triangles of each piece begin, shape
// (num_pieces + 1, 3), and rows of (piece, other piece, points that both have).
constexpr const char* kFirsts = "/pieces/first_point_tet_triangle";
constexpr const char* kNeighbours = "/pieces/neighbours";
// Of second order, where the nodes on edges of each piece begin; points are vertices there.
constexpr const char* kFirstNodes = "/pieces/first_node";

GlobalIndex num_neighbours(const Outline& outline)
{
  GlobalIndex sum = 0;
  for (const PieceCounts& piece : outline.pieces)
    sum += static_cast<GlobalIndex>(piece.neighbours.size());
  return sum;
}

Hdf5Layout layout_of(const Outline& outline)
{
  const GlobalIndex num_tets = outline.num_tets();
  const GlobalIndex num_triangles = outline.num_triangles();
  const auto per_tet = static_cast<int>(outline.points_per_tet());
  const auto per_triangle = static_cast<int>(outline.points_per_triangle());
  Hdf5Layout layout{.arrays = {{kPoints, Hdf5Type::float64, outline.num_points(), 3, {}},
                               {kTets,
                                Hdf5Type::int64,
                                num_tets,
                                per_tet,
                                {{"cell_dim", 3}, {"cell_corners", per_tet}}},
                               {kMaterial, Hdf5Type::int32, num_tets, 1, {}},
                               {kPiece, Hdf5Type::int32, num_tets, 1, {}},
                               {kTriangles, Hdf5Type::int64, num_triangles, per_triangle, {}},
                               {kPatch, Hdf5Type::int32, num_triangles, 1, {}},
                               {kFirsts, Hdf5Type::int64, outline.num_pieces() + 1, 3, {}},
                               {kNeighbours, Hdf5Type::int64, num_neighbours(outline), 3, {}}},
                    .texts = {{"/names/materials", outline.material_names},
                              {"/names/patches", outline.patch_names}}};
  if (outline.is_of_second_order())
    layout.arrays.push_back({kFirstNodes, Hdf5Type::int64, outline.num_pieces() + 1, 1, {}});
  return layout;
}

std::string data_item(const Hdf5Array& array)
{
  const bool is_real = array.type == Hdf5Type::float64;
  const int precision = array.type == Hdf5Type::int32 ? 4 : 8;
  return fmt::format(
      R"(<DataItem Dimensions="{} {}" NumberType="{}" Precision="{}" Format="HDF">mesh.h5:{}</DataItem>)",
      array.num_rows, array.num_columns, is_real ? "Float" : "Int", precision, array.name);
}

std::string attribute(const char* name, const Hdf5Array& array)
{
  return fmt::format(
      "      <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">{}"
      "</Attribute>\n",
      name, data_item(array));
}

std::string grid(const char* name, const char* kind, const Hdf5Array& points,
                 const Hdf5Array& cells)
{
  return fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
      "      <Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">{}"
      "</Topology>\n"
      "      <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      name, kind, cells.num_rows, cells.num_columns, data_item(cells), data_item(points));
}

// <Information Name="patch 1" Value="inlet"/>, one a tag.
std::string names(const char* kind, const std::vector<std::string>& names_of_tags)
{
  std::string lines;
  for (std::size_t i = 0; i < names_of_tags.size(); ++i) {
    lines += fmt::format("      <Information Name=\"{} {}\" Value=\"{}\"/>\n", kind, i + 1,
                         xml_escape(names_of_tags[i]));
  }
  return lines;
}

constexpr const char* kGridEnd = "    </Grid>\n";

std::string file_of(const std::string& grids)
{
  return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n" + grids
         + "  </Domain>\n</Xdmf>\n";
}

// The same as meshio has names: with the dimension of the cells.
std::string meshio_names(int dimension, const std::vector<std::string>& names_of_tags)
{
  std::string maps;
  for (std::size_t i = 0; i < names_of_tags.size(); ++i) {
    maps += fmt::format("<map key=\"{}\" dim=\"{}\">{}</map>", xml_escape(names_of_tags[i]),
                        dimension, i + 1);
  }
  return "      <Information Name=\"field_data\"><![CDATA[<main>" + maps
         + "</main>]]></Information>\n";
}

// Without its names and its end.
std::string tets_grid(const Hdf5Layout& layout)
{
  const auto& [points, tets, material, piece] =
      std::tie(layout.arrays[0], layout.arrays[1], layout.arrays[2], layout.arrays[3]);
  return grid("mesh", tets.num_columns == 4 ? "Tetrahedron" : "Tetrahedron_10", points, tets)
         + attribute("material", material) + attribute("piece", piece);
}

std::string boundary_grid(const Hdf5Layout& layout)
{
  const auto& [points, triangles, patch] =
      std::tie(layout.arrays[0], layout.arrays[4], layout.arrays[5]);
  return grid("boundary", triangles.num_columns == 3 ? "Triangle" : "Triangle_6", points, triangles)
         + attribute("patch", patch);
}

class XdmfWriter final : public Writer {
 public:
  explicit XdmfWriter(const WriterTarget& target)
      : outline_(target.outline),
        layout_(layout_of(target.outline)),
        folder_(target.folder),
        file_(target.folder / "mesh.h5")
  {
  }

  void begin() override
  {
    file_.create();
    make_hdf5_file(file_.temporary_path(), layout_);
    write_partition();
  }

  void write(const Piece& piece) override
  {
    const GlobalIndex tet = outline_.first_tet[at(piece.number)];
    const GlobalIndex triangle = outline_.first_triangle[at(piece.number)];
    for (const PointRun& run : outline_.own_points(piece.number)) {
      put<double>(kPoints, 3 * run.first_number,
                  std::span(piece.point_xyz).subspan(3 * at(run.first_row), 3 * at(run.count)));
    }
    put<GlobalIndex>(kTets, static_cast<GlobalIndex>(outline_.points_per_tet()) * tet,
                     numbers(piece, piece.tet_points));
    put<std::int32_t>(kMaterial, tet, piece.tet_material);
    put<std::int32_t>(kPiece, tet, std::vector(piece.tet_material.size(), piece.number));
    put<GlobalIndex>(kTriangles,
                     static_cast<GlobalIndex>(outline_.points_per_triangle()) * triangle,
                     numbers(piece, piece.triangle_points));
    put<std::int32_t>(kPatch, triangle, piece.triangle_patch);
  }

  void close() override { file_.close(); }

  void commit() override
  {
    file_.commit();
    const std::string tets = tets_grid(layout_);
    const std::string boundary = boundary_grid(layout_);
    const std::vector<std::string>& materials = outline_.material_names;
    const std::vector<std::string>& patches = outline_.patch_names;
    std::string both = tets + names("material", materials) + kGridEnd;
    if (outline_.num_triangles() > 0) {
      both += boundary + names("patch", patches) + kGridEnd;
      write_index("boundary.xdmf", boundary + meshio_names(2, patches) + kGridEnd);
    }
    write_index("tets.xdmf", tets + meshio_names(3, materials) + kGridEnd);
    write_index("mesh.xdmf", both);
  }

 private:
  void write_index(const std::string& name, const std::string& grids) const
  {
    io::write_text_atomically(folder_ / name, file_of(grids));
  }

  void write_partition()
  {
    std::vector<GlobalIndex> firsts;
    std::vector<GlobalIndex> neighbours;
    for (std::size_t p = 0; p < outline_.first_tet.size(); ++p) {
      firsts.insert(firsts.end(),
                    {outline_.first_point[p], outline_.first_tet[p], outline_.first_triangle[p]});
    }
    for (LocalIndex p = 0; p < outline_.num_pieces(); ++p) {
      for (const PieceNeighbour& other : outline_.pieces[at(p)].neighbours)
        neighbours.insert(neighbours.end(), {p, other.piece, other.num_shared_points});
    }
    put<GlobalIndex>(kFirsts, 0, firsts);
    put<GlobalIndex>(kFirstNodes, 0, outline_.first_node);
    put<GlobalIndex>(kNeighbours, 0, neighbours);
  }

  template <class Value>
  void put(const std::string& array, GlobalIndex first, std::span<const Value> values)
  {
    if (values.empty()) return;
    if (offsets_.empty()) offsets_ = hdf5_offsets(file_.temporary_path(), layout_);
    file_.write(offsets_.at(array) + first * static_cast<GlobalIndex>(sizeof(Value)),
                std::as_bytes(values));
  }

  static std::vector<GlobalIndex> numbers(const Piece& piece, const std::vector<LocalIndex>& rows)
  {
    std::vector<GlobalIndex> numbers;
    numbers.reserve(rows.size());
    for (const LocalIndex row : rows) numbers.push_back(piece.point_numbers[at(row)]);
    return numbers;
  }

  const Outline& outline_;
  Hdf5Layout layout_;
  const std::filesystem::path& folder_;
  SharedFile file_;
  std::map<std::string, GlobalIndex> offsets_{};
};

}  // namespace

std::unique_ptr<Writer> make_xdmf_writer(const WriterTarget& target)
{
  return std::make_unique<XdmfWriter>(target);
}

}  // namespace tessera::formats
