// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/xdmf.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/xml_escape.hpp"
#include "tessera/io/files.hpp"
#include "tessera/mesh/periodic_pairs.hpp"

#include "formats/cells.hpp"
#include "formats/files/hdf5_file.hpp"
#include "formats/files/shared_file.hpp"
#include "formats/periodic_nodes.hpp"

namespace tessera::formats {
namespace {

constexpr const char* kPoints = "/geometry/vertices";
constexpr const char* kTets = "/viz/topology/cells";
constexpr const char* kMixedCells = "/viz/topology/mixed_cells";
constexpr const char* kMaterial = "/cells/material";
constexpr const char* kPiece = "/cells/piece";
constexpr const char* kTriangles = "/boundary/triangles";
constexpr const char* kMixedFaces = "/boundary/mixed_faces";
constexpr const char* kPatch = "/boundary/patch";
// Of the partition: where the points, tets and triangles of each piece begin, shape
// (num_pieces + 1, 3), and rows of (piece, other piece, points that both have).
constexpr const char* kFirsts = "/pieces/first_point_tet_triangle";
constexpr const char* kNeighbours = "/pieces/neighbours";
// Of second order, where the nodes on edges of each piece begin; points are vertices there.
constexpr const char* kFirstNodes = "/pieces/first_node";
// With prisms, as in kFirsts.
constexpr const char* kFirstsOfShapes = "/pieces/first_pyramid_prism_quad";

// Of a pair of periodic patches: rows of (image, the point whose image it is), and the transform
// that leads to the images, by rows, the shift last.
std::string periodic_points_name(std::size_t row)
{
  return fmt::format("/periodic/{}/points", row + 1);
}
std::string periodic_transform_name(std::size_t row)
{
  return fmt::format("/periodic/{}/transform", row + 1);
}

// XDMF's number of a shape in a mixed topology: there each element has its own before its points.
constexpr ByShape<GlobalIndex> kMixedTypes{{6, 7, 8, 4, 5}};

// Numbers of an element in a mixed topology.
constexpr GlobalIndex mixed_size(Shape shape)
{
  return 1 + static_cast<GlobalIndex>(num_corners(shape));
}

bool has_mixed(const Outline& outline, Shape shape)
{
  return is_cell(shape) ? outline.has_prisms() : outline.num_of(Shape::quad) > 0;
}

Hdf5Array mixed_array(const Outline& outline, const char* name, std::span<const Shape> shapes)
{
  GlobalIndex size = 0;
  for (const Shape shape : shapes) size += mixed_size(shape) * outline.num_of(shape);
  return {name, Hdf5Type::int64, size, 0, {}};
}

Hdf5Array cells_array(const Outline& outline)
{
  if (outline.has_prisms()) return mixed_array(outline, kMixedCells, kCellShapes);
  const auto width = static_cast<int>(outline.points_per_tet());
  return {kTets,
          Hdf5Type::int64,
          outline.num_tets(),
          width,
          {{"cell_dim", 3}, {"cell_corners", width}}};
}

Hdf5Array faces_array(const Outline& outline)
{
  if (has_mixed(outline, Shape::triangle)) return mixed_array(outline, kMixedFaces, kFaceShapes);
  return {kTriangles,
          Hdf5Type::int64,
          outline.num_faces(),
          static_cast<int>(outline.points_per_triangle()),
          {}};
}

GlobalIndex num_neighbours(const Outline& outline)
{
  GlobalIndex sum = 0;
  for (const PieceCounts& piece : outline.pieces)
    sum += static_cast<GlobalIndex>(piece.neighbours.size());
  return sum;
}

Hdf5Layout layout_of(const Outline& outline)
{
  const GlobalIndex num_cells = outline.num_cells();
  Hdf5Layout layout{.arrays = {{kPoints, Hdf5Type::float64, outline.num_points(), 3, {}},
                               cells_array(outline),
                               {kMaterial, Hdf5Type::int32, num_cells, 1, {}},
                               {kPiece, Hdf5Type::int32, num_cells, 1, {}},
                               faces_array(outline),
                               {kPatch, Hdf5Type::int32, outline.num_faces(), 1, {}},
                               {kFirsts, Hdf5Type::int64, outline.num_pieces() + 1, 3, {}},
                               {kNeighbours, Hdf5Type::int64, num_neighbours(outline), 3, {}}},
                    .texts = {{"/names/materials", outline.material_names},
                              {"/names/patches", outline.patch_names}}};
  if (outline.is_of_second_order())
    layout.arrays.push_back({kFirstNodes, Hdf5Type::int64, outline.num_pieces() + 1, 1, {}});
  if (outline.has_prisms())
    layout.arrays.push_back({kFirstsOfShapes, Hdf5Type::int64, outline.num_pieces() + 1, 3, {}});
  for (std::size_t p = 0; p < outline.periodic.size(); ++p) {
    const PeriodicPatch& pair = outline.periodic[p];
    layout.arrays.push_back({periodic_points_name(p),
                             Hdf5Type::int64,
                             pair.first_point.back(),
                             2,
                             {{"from_patch", pair.from}, {"to_patch", pair.to}}});
    layout.arrays.push_back({periodic_transform_name(p), Hdf5Type::float64, 3, 4, {}});
  }
  return layout;
}

std::string data_item(const Hdf5Array& array)
{
  const bool is_real = array.type == Hdf5Type::float64;
  const int precision = array.type == Hdf5Type::int32 ? 4 : 8;
  const std::string columns = array.num_columns == 0 ? "" : fmt::format(" {}", array.num_columns);
  return fmt::format(
      R"(<DataItem Dimensions="{}{}" NumberType="{}" Precision="{}" Format="HDF">mesh.h5:{}</DataItem>)",
      array.num_rows, columns, is_real ? "Float" : "Int", precision, array.name);
}

std::string attribute(const char* name, const Hdf5Array& array)
{
  return fmt::format(
      "      <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">{}"
      "</Attribute>\n",
      name, data_item(array));
}

// @param[in] tags Of the cells, one a row.
std::string grid(const char* name, const char* kind, const Hdf5Array& points,
                 const Hdf5Array& cells, const Hdf5Array& tags)
{
  const bool is_mixed = cells.num_columns == 0;
  return fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
      "      <Topology TopologyType=\"{}\" NumberOfElements=\"{}\"{}>{}</Topology>\n"
      "      <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      name, is_mixed ? "Mixed" : kind, tags.num_rows,
      is_mixed ? "" : fmt::format(" NodesPerElement=\"{}\"", cells.num_columns), data_item(cells),
      data_item(points));
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
std::string cells_grid(const Hdf5Layout& layout)
{
  const auto& [points, cells, material, piece] =
      std::tie(layout.arrays[0], layout.arrays[1], layout.arrays[2], layout.arrays[3]);
  const char* const kind = cells.num_columns == 4 ? "Tetrahedron" : "Tetrahedron_10";
  return grid("mesh", kind, points, cells, material) + attribute("material", material)
         + attribute("piece", piece);
}

std::string boundary_grid(const Hdf5Layout& layout)
{
  const auto& [points, faces, patch] =
      std::tie(layout.arrays[0], layout.arrays[4], layout.arrays[5]);
  const char* const kind = faces.num_columns == 3 ? "Triangle" : "Triangle_6";
  return grid("boundary", kind, points, faces, patch) + attribute("patch", patch);
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
    for (const PointRun& run : outline_.own_points(piece.number)) {
      put<double>(kPoints, 3 * run.first_number,
                  std::span(piece.point_xyz).subspan(3 * at(run.first_row), 3 * at(run.count)));
    }
    const PieceCells cells(piece);
    for (const Shape shape : kShapes) {
      const ElementList list = cells[shape];
      const GlobalIndex first = outline_.first_number(shape, piece.number);
      if (is_cell(shape)) {
        put<std::int32_t>(kMaterial, first, list.tags);
        put<std::int32_t>(kPiece, first, std::vector(list.size(), piece.number));
      } else {
        put<std::int32_t>(kPatch, first - outline_.num_cells(), list.tags);
      }
      write_points_of(piece, shape, list);
    }
    write_periodic(piece);
  }

  void close() override { file_.close(); }

  void commit() override
  {
    file_.commit();
    const std::string tets = cells_grid(layout_);
    const std::string boundary = boundary_grid(layout_);
    const std::vector<std::string>& materials = outline_.material_names;
    const std::vector<std::string>& patches = outline_.patch_names;
    std::string both = tets + names("material", materials) + kGridEnd;
    if (outline_.num_faces() > 0) {
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
      firsts.insert(firsts.end(), {outline_.first_point[p], outline_.first_of[Shape::tet][p],
                                   outline_.first_of[Shape::triangle][p]});
    }
    for (LocalIndex p = 0; p < outline_.num_pieces(); ++p) {
      for (const PieceNeighbour& other : outline_.pieces[at(p)].neighbours)
        neighbours.insert(neighbours.end(), {p, other.piece, other.num_shared_points});
    }
    put<GlobalIndex>(kFirsts, 0, firsts);
    put<GlobalIndex>(kFirstNodes, 0, outline_.first_node);
    put<GlobalIndex>(kNeighbours, 0, neighbours);
    if (outline_.has_prisms()) put<GlobalIndex>(kFirstsOfShapes, 0, firsts_of_shapes());
    for (std::size_t p = 0; p < outline_.periodic.size(); ++p)
      put<double>(periodic_transform_name(p), 0, mesh::matrix_of(outline_.periodic[p].there));
  }

  void write_periodic(const Piece& piece)
  {
    for_each_periodic(
        outline_, piece,
        [&](std::size_t row, GlobalIndex first, std::span<const PeriodicPoint> points) {
          std::vector<GlobalIndex> pairs;
          for (const PeriodicPoint& one : points)
            pairs.insert(pairs.end(), {piece.point_numbers[at(one.point)], one.of_number});
          put<GlobalIndex>(periodic_points_name(row), 2 * first, pairs);
        });
  }

  [[nodiscard]] std::vector<GlobalIndex> firsts_of_shapes() const
  {
    std::vector<GlobalIndex> firsts;
    for (std::size_t p = 0; p < outline_.first_tet.size(); ++p)
      for (const Shape shape : {Shape::pyramid, Shape::prism, Shape::quad})
        firsts.push_back(outline_.first_of[shape][p]);
    return firsts;
  }

  // Of a mixed topology all elements of one shape stand together.
  void write_points_of(const Piece& piece, Shape shape, const ElementList& list)
  {
    const GlobalIndex first = outline_.first_of[shape][at(piece.number)];
    if (!has_mixed(outline_, shape)) {
      put<GlobalIndex>(is_cell(shape) ? kTets : kTriangles,
                       static_cast<GlobalIndex>(outline_.points_per(shape)) * first,
                       point_numbers(piece, list));
      return;
    }
    GlobalIndex place = mixed_size(shape) * first;
    for (const Shape before : kShapes) {
      if (is_cell(before) == is_cell(shape) && before < shape)
        place += mixed_size(before) * outline_.num_of(before);
    }
    const std::vector<GlobalIndex> numbers = point_numbers(piece, list);
    std::vector<GlobalIndex> mixed;
    for (std::size_t i = 0; i < list.size(); ++i) {
      mixed.push_back(kMixedTypes[shape]);
      append_vtk_points(shape, std::span(numbers).subspan(list.width * i, list.width), mixed);
    }
    put<GlobalIndex>(is_cell(shape) ? kMixedCells : kMixedFaces, place, mixed);
  }

  template <class Value>
  void put(const std::string& array, GlobalIndex first, std::span<const Value> values)
  {
    if (values.empty()) return;
    if (offsets_.empty()) offsets_ = hdf5_offsets(file_.temporary_path(), layout_);
    file_.write(offsets_.at(array) + first * static_cast<GlobalIndex>(sizeof(Value)),
                std::as_bytes(values));
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
