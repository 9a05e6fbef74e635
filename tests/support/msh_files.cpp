// SPDX-License-Identifier: BSD-3-Clause
#include "support/msh_files.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <vector>

namespace tessera::testing {
namespace {

constexpr int kTriangle = 2;
constexpr int kTet = 4;
constexpr int kFirstPatchGroup = 101;

// Doubles with all of their digits.
template <class... Parts>
std::string joined(const Parts&... parts)
{
  std::ostringstream out;
  out << std::setprecision(17);
  ((out << parts), ...);
  return out.str();
}

// Numbers as words, or raw; text lines end themselves.
class Writer {
 public:
  explicit Writer(bool is_binary) : is_binary_(is_binary) {}

  template <class T>
  void number(T value)
  {
    if (is_raw_) {
      std::array<char, sizeof(T)> bytes{};
      std::memcpy(bytes.data(), &value, sizeof(T));
      out_.append(bytes.data(), bytes.size());
    } else {
      out_ += joined(value, " ");
    }
  }
  void ints(std::initializer_list<std::int32_t> values)
  {
    for (const std::int32_t value : values) number(value);
  }
  void sizes(std::initializer_list<std::uint64_t> values)
  {
    for (const std::uint64_t value : values) number(value);
  }
  void point(const Vec3& p)
  {
    for (const double x : p) number(x);
  }
  void end_line()
  {
    if (!is_raw_) out_ += '\n';
  }
  void line(std::string_view text) { out_ += joined(text, "\n"); }
  void begin_raw() { is_raw_ = is_binary_; }
  void end_raw()
  {
    if (is_raw_) out_ += '\n';
    is_raw_ = false;
  }
  [[nodiscard]] const std::string& text() const { return out_; }

 private:
  bool is_binary_;
  bool is_raw_ = false;
  std::string out_{};
};

struct Cell {
  int type = 0;
  std::int32_t group = 0;
  std::int32_t entity = 0;
  std::vector<LocalIndex> vertices{};
};

std::vector<Cell> cells_of(const mesh::CoarseMesh& mesh)
{
  std::vector<Cell> cells;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    const LocalIndex patch = mesh.face_patch[at(f)];
    cells.push_back({kTriangle, kFirstPatchGroup + patch, patch + 1, {v[0], v[1], v[2]}});
  }
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto v = mesh.tet(t);
    const LocalIndex material = mesh.tet_material[at(t)];
    cells.push_back({kTet, material, material, {v[0], v[1], v[2], v[3]}});
  }
  return cells;
}

void write_names(const mesh::CoarseMesh& mesh, Writer& out)
{
  out.line("$PhysicalNames");
  out.line(joined(mesh.num_patches() + mesh.num_materials()));
  for (LocalIndex p = 0; p < mesh.num_patches(); ++p) {
    out.line(joined("2 ", kFirstPatchGroup + p, " \"", mesh.patch_names[at(p)], "\""));
  }
  for (LocalIndex m = 0; m < mesh.num_materials(); ++m) {
    out.line(joined("3 ", m + 1, " \"", mesh.material_names[at(m)], "\""));
  }
  out.line("$EndPhysicalNames");
}

void write_old(const mesh::CoarseMesh& mesh, bool is_binary, Writer& out)
{
  out.line("$Nodes");
  out.line(joined(mesh.num_vertices()));
  out.begin_raw();
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    out.number<std::int32_t>(v + 1);
    out.point(mesh.position(v));
    out.end_line();
  }
  out.end_raw();
  out.line("$EndNodes\n$Elements");
  const std::vector<Cell> cells = cells_of(mesh);
  out.line(joined(cells.size()));
  out.begin_raw();
  std::int32_t number = 0;
  for (const Cell& cell : cells) {
    if (is_binary) out.ints({cell.type, 1, 2, ++number, cell.group, cell.entity});
    if (!is_binary) out.ints({++number, cell.type, 2, cell.group, cell.entity});
    for (const LocalIndex v : cell.vertices) out.number<std::int32_t>(v + 1);
    out.end_line();
  }
  out.end_raw();
  out.line("$EndElements");
}

void write_entities(const mesh::CoarseMesh& mesh, Writer& out)
{
  out.line("$Entities");
  out.begin_raw();
  out.sizes({1, 0, static_cast<std::uint64_t>(mesh.num_patches()),
             static_cast<std::uint64_t>(mesh.num_materials())});
  out.end_line();
  out.ints({1});
  out.point({});
  out.sizes({0});
  out.end_line();
  const auto write = [&](std::int32_t entity, std::int32_t group) {
    out.ints({entity});
    out.point({});
    out.point({1.0, 1.0, 1.0});
    out.sizes({1});
    out.ints({group});
    out.sizes({1});
    out.ints({-1});
    out.end_line();
  };
  for (LocalIndex p = 0; p < mesh.num_patches(); ++p) write(p + 1, kFirstPatchGroup + p);
  for (LocalIndex m = 1; m <= mesh.num_materials(); ++m) write(m, m);
  out.end_raw();
  out.line("$EndEntities");
}

void write_new(const mesh::CoarseMesh& mesh, Writer& out)
{
  write_entities(mesh, out);
  const auto num_vertices = static_cast<std::uint64_t>(mesh.num_vertices());
  out.line("$Nodes");
  out.begin_raw();
  out.sizes({1, num_vertices, 1, num_vertices});
  out.end_line();
  out.ints({3, 1, 0});
  out.sizes({num_vertices});
  out.end_line();
  for (std::uint64_t v = 1; v <= num_vertices; ++v) out.sizes({v});
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) out.point(mesh.position(v));
  out.end_line();
  out.end_raw();
  out.line("$EndNodes\n$Elements");
  const std::vector<Cell> cells = cells_of(mesh);
  out.begin_raw();
  out.sizes({cells.size(), cells.size(), 1, cells.size()});
  out.end_line();
  std::uint64_t number = 0;
  for (const Cell& cell : cells) {
    out.ints({cell.type == kTet ? 3 : 2, cell.entity, cell.type});
    out.sizes({1, ++number});
    for (const LocalIndex v : cell.vertices) out.sizes({static_cast<std::uint64_t>(v) + 1});
    out.end_line();
  }
  out.end_raw();
  out.line("$EndElements");
}

}  // namespace

std::string msh_text(const mesh::CoarseMesh& mesh, MshForm form)
{
  const bool is_binary = form == MshForm::binary22 || form == MshForm::binary41;
  const bool is_old = form == MshForm::text22 || form == MshForm::binary22;
  Writer out(is_binary);
  out.line("$MeshFormat");
  out.line(joined(is_old ? "2.2" : "4.1", " ", is_binary ? 1 : 0, " 8"));
  out.begin_raw();
  if (is_binary) out.ints({1});
  out.end_raw();
  out.line("$EndMeshFormat");
  write_names(mesh, out);
  if (is_old) write_old(mesh, is_binary, out);
  if (!is_old) write_new(mesh, out);
  return out.text();
}

std::string vol_text(const mesh::CoarseMesh& mesh)
{
  std::string text =
      "mesh3d\ndimension\n3\ngeomtype\n0\n\n# surfnr bcnr domin domout np p1 p2 p3\n";
  text += joined("surfaceelements\n", mesh.num_faces(), "\n");
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    const LocalIndex patch = mesh.face_patch[at(f)] + 1;
    text += joined(" ", patch, " ", patch, " 1 0 3 ", v[0] + 1, " ", v[1] + 1, " ", v[2] + 1, "\n");
  }
  text += joined("\n# matnr np p1 p2 p3 p4\nvolumeelements\n", mesh.num_tets(), "\n");
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto v = mesh.tet(t);
    text += joined(mesh.tet_material[at(t)], " 4 ", v[0] + 1, " ", v[1] + 1, " ", v[3] + 1, " ",
                   v[2] + 1, "\n");
  }
  text +=
      joined("\nedgesegmentsgi2\n1\n1 0 1 2 -1 -1 1 0 1 0\n\npoints\n", mesh.num_vertices(), "\n");
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const Vec3 p = mesh.position(v);
    text += joined(p[0], " ", p[1], " ", p[2], "\n");
  }
  text += joined("\nmaterials\n", mesh.num_materials(), "\n");
  for (LocalIndex m = 0; m < mesh.num_materials(); ++m) {
    text += joined(m + 1, " ", mesh.material_names[at(m)], "\n");
  }
  text += joined("\nbcnames\n", mesh.num_patches(), "\n");
  for (LocalIndex p = 0; p < mesh.num_patches(); ++p) {
    text += joined(p + 1, " ", mesh.patch_names[at(p)], "\n");
  }
  return text + "\nendmesh\n";
}

}  // namespace tessera::testing
