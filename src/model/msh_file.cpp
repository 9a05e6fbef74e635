// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/model/tet_mesh_file.hpp"

#include "file_cursor.hpp"

namespace tessera::model {
namespace {

constexpr int kTriangle = 2;
constexpr int kTet = 4;

// What Gmsh calls a kind of element, by its number.
struct ElementKind {
  int type = 0;
  std::size_t num_nodes = 0;
  int dimension = 0;
  std::string_view name{};
};

constexpr std::array kKinds{
    ElementKind{1, 2, 1, "lines"},
    ElementKind{2, 3, 2, "triangles"},
    ElementKind{3, 4, 2, "quadrangles"},
    ElementKind{4, 4, 3, "tets"},
    ElementKind{5, 8, 3, "hexahedra"},
    ElementKind{6, 6, 3, "prisms"},
    ElementKind{7, 5, 3, "pyramids"},
    ElementKind{8, 3, 1, "lines of second order"},
    ElementKind{9, 6, 2, "triangles of second order"},
    ElementKind{10, 9, 2, "quadrangles of second order"},
    ElementKind{11, 10, 3, "tets of second order"},
    ElementKind{12, 27, 3, "hexahedra of second order"},
    ElementKind{13, 18, 3, "prisms of second order"},
    ElementKind{14, 14, 3, "pyramids of second order"},
    ElementKind{15, 1, 0, "points"},
    ElementKind{16, 8, 2, "quadrangles of second order"},
    ElementKind{17, 20, 3, "hexahedra of second order"},
    ElementKind{18, 15, 3, "prisms of second order"},
    ElementKind{19, 13, 3, "pyramids of second order"},
};

// Reads a file section by section; each needs the ones before it.
class MshReader {
 public:
  MshReader(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  TetMeshFile read()
  {
    read_format();
    while (!in_.at_end()) read_section(std::string(in_.word("a section")));
    if (!has_elements_) in_.fail("the file has no section $Elements");
    return std::move(mesh_);
  }

 private:
  void read_format()
  {
    if (in_.at_end() || in_.word("$MeshFormat") != "$MeshFormat") {
      in_.fail("is not a mesh file of Gmsh: it does not begin with $MeshFormat");
    }
    const std::string version(in_.word("the version"));
    is_old_ = version == "2.2" || version == "2";
    if (!is_old_ && version != "4.1") {
      in_.fail(
          fmt::format("is of version {} of the format; save it as 4.1 or 2.2 "
                      "(Gmsh: -format msh41)",
                      printable(version)));
    }
    const auto kind = in_.number<int>("0 (text) or 1 (binary)");
    const auto word_size = in_.number<int>("the size of a number");
    if (kind < 0 || kind > 1) in_.fail("is neither text (0) nor binary (1)");
    if (word_size != 8) in_.fail(fmt::format("has numbers of {} bytes, not 8", word_size));
    is_binary_ = kind == 1;
    if (is_binary_) {
      in_.skip_line_end();
      in_.set_binary(true);
      if (in_.number<std::int32_t>("the byte order") != 1) {
        in_.fail("has the byte order of another kind of machine; save it as text");
      }
      in_.set_binary(false);
    }
    in_.expect("$EndMeshFormat");
  }

  void read_section(const std::string& name)
  {
    if (!name.starts_with('$')) {
      in_.fail(fmt::format("expected a section, found '{}'", printable(name)));
    }
    const std::string end = "$End" + name.substr(1);
    if (name == "$PhysicalNames") {
      read_names();
    } else if (name == "$Entities" && !is_old_) {
      with_raw_numbers([&] { read_entities(); });
    } else if (name == "$PartitionedEntities") {
      in_.fail("the mesh is partitioned; save it in one piece, unpartitioned");
    } else if (name == "$Nodes") {
      with_raw_numbers([&] { is_old_ ? read_old_nodes() : read_nodes(); });
    } else if (name == "$Elements") {
      with_raw_numbers([&] { is_old_ ? read_old_elements() : read_elements(); });
      has_elements_ = true;
    } else {
      in_.skip_behind(end);
      return;
    }
    in_.expect(end);
  }

  template <class Read>
  void with_raw_numbers(const Read& read)
  {
    if (is_binary_ && !is_old_) in_.skip_line_end();
    in_.set_binary(is_binary_ && !is_old_);
    read();
    in_.set_binary(false);
  }

  void read_names()
  {
    const std::size_t num = in_.count<std::int64_t>("the number of names", 1);
    for (std::size_t i = 0; i < num; ++i) {
      const auto dimension = in_.number<int>("a dimension");
      const auto group = in_.number<std::int32_t>("a physical group");
      std::string_view name = in_.line();
      if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
        name = name.substr(1, name.size() - 2);
      }
      if (dimension == 2) mesh_.triangle_group_names[group] = name;
      if (dimension == 3) mesh_.tet_group_names[group] = name;
    }
  }

  // Which physical group each entity of two or three dimensions is in: the first, if in several.
  void read_entities()
  {
    std::array<std::size_t, 4> num{};
    for (std::size_t& n : num) n = in_.count<std::uint64_t>("the number of entities", 1);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < num[dimension]; ++i) read_entity(dimension);
    }
  }

  void read_entity(std::size_t dimension)
  {
    const auto tag = in_.number<std::int32_t>("an entity");
    const int num_bounds = dimension == 0 ? 3 : 6;
    for (int i = 0; i < num_bounds; ++i) in_.number<double>("a coordinate");
    const auto num_groups = in_.count<std::uint64_t>("the number of physical groups", 1);
    for (std::size_t i = 0; i < num_groups; ++i) {
      const auto group = in_.number<std::int32_t>("a physical group");
      if (i == 0) groups_[dimension][tag] = group;
    }
    if (dimension == 0) return;
    const auto num_sides = in_.count<std::uint64_t>("the number of bounding entities", 1);
    for (std::size_t i = 0; i < num_sides; ++i) in_.number<std::int32_t>("an entity");
  }

  void read_nodes()
  {
    const std::size_t num_blocks = in_.count<std::uint64_t>("the number of blocks", 1);
    for (int i = 0; i < 3; ++i) in_.number<std::uint64_t>("a number of nodes");
    std::vector<std::int64_t> numbers;
    for (std::size_t b = 0; b < num_blocks; ++b) {
      const auto dimension = in_.number<std::int32_t>("a dimension");
      in_.number<std::int32_t>("an entity");
      const bool is_parametric = in_.number<std::int32_t>("0 or 1 (parametric)") != 0;
      numbers.resize(in_.count<std::uint64_t>("the number of nodes", 8));
      for (auto& number : numbers) number = in_.number<std::int64_t>("the number of a node");
      for (const auto number : numbers) {
        read_point(number);
        for (int i = 0; is_parametric && i < dimension; ++i) in_.number<double>("a parameter");
      }
    }
  }

  void read_old_nodes()
  {
    const std::size_t num = in_.count<std::int64_t>("the number of nodes", 8);
    begin_raw_rows();
    for (std::size_t i = 0; i < num; ++i) {
      read_point(in_.number<std::int32_t>("the number of a node"));
    }
  }

  // In files of version 2.2 counts are text, and raw numbers begin on the next line.
  void begin_raw_rows()
  {
    if (!is_binary_) return;
    in_.skip_line_end();
    in_.set_binary(true);
  }

  void read_point(std::int64_t number)
  {
    if (!rows_.emplace(number, static_cast<LocalIndex>(mesh_.point_number.size())).second) {
      in_.fail(fmt::format("node {} stands twice", number));
    }
    mesh_.point_number.push_back(number);
    for (int axis = 0; axis < 3; ++axis) mesh_.point_xyz.push_back(in_.coordinate());
  }

  void read_elements()
  {
    const std::size_t num_blocks = in_.count<std::uint64_t>("the number of blocks", 1);
    for (int i = 0; i < 3; ++i) in_.number<std::uint64_t>("a number of elements");
    for (std::size_t b = 0; b < num_blocks; ++b) {
      const auto dimension = in_.number<std::int32_t>("a dimension");
      const auto entity = in_.number<std::int32_t>("an entity");
      const ElementKind& kind = kind_of(in_.number<std::int32_t>("a kind of elements"));
      if (dimension != kind.dimension)
        in_.fail("elements have another dimension than their entity");
      const auto num = in_.count<std::uint64_t>("the number of elements", 2);
      const auto found = groups_[static_cast<std::size_t>(dimension)].find(entity);
      const std::int32_t group =
          found == groups_[static_cast<std::size_t>(dimension)].end() ? 0 : found->second;
      for (std::size_t i = 0; i < num; ++i) {
        const auto number = in_.number<std::int64_t>("the number of an element");
        read_element<std::int64_t>(kind, number, group, entity);
      }
    }
  }

  void read_old_elements()
  {
    const std::size_t num = in_.count<std::int64_t>("the number of elements", 8);
    begin_raw_rows();
    for (std::size_t done = 0; done < num;) {
      if (!is_binary_) {
        const auto number = in_.number<std::int64_t>("the number of an element");
        const ElementKind& kind = kind_of(in_.number<std::int32_t>("a kind of elements"));
        read_old_element(kind, number, in_.count<std::int32_t>("the number of tags", 2));
        ++done;
        continue;
      }
      const ElementKind& kind = kind_of(in_.number<std::int32_t>("a kind of elements"));
      const auto in_block = in_.count<std::int32_t>("the number of elements", 8);
      const auto num_tags = in_.count<std::int32_t>("the number of tags", 4);
      if (in_block == 0) in_.fail("a block has no elements");
      for (std::size_t i = 0; i < in_block; ++i) {
        read_old_element(kind, in_.number<std::int32_t>("the number of an element"), num_tags);
      }
      done += in_block;
    }
  }

  void read_old_element(const ElementKind& kind, std::int64_t number, std::size_t num_tags)
  {
    std::array<std::int32_t, 2>
        tags{};  // Physical group, entity, and others that say nothing here.
    for (std::size_t i = 0; i < num_tags; ++i) {
      const auto tag = in_.number<std::int32_t>("a tag");
      if (i < tags.size()) tags[i] = tag;
    }
    read_element<std::int32_t>(kind, number, tags[0], tags[1]);
  }

  template <class Number>
  void read_element(const ElementKind& kind, std::int64_t number, std::int32_t group,
                    std::int32_t entity)
  {
    if (kind.dimension >= 2 && kind.type != kTriangle && kind.type != kTet) refuse(kind, number);
    FileCells& cells = kind.dimension == 3 ? mesh_.tets : mesh_.triangles;
    for (std::size_t i = 0; i < kind.num_nodes; ++i) {
      const std::int64_t node = in_.number<Number>("a node");
      if (kind.dimension < 2) continue;
      const auto row = rows_.find(node);
      if (row == rows_.end()) {
        in_.fail(fmt::format("element {} has node {}, which the file does not have", number, node));
      }
      cells.points.push_back(row->second);
    }
    if (kind.dimension < 2) return;
    cells.number.push_back(number);
    cells.group.push_back(group);
    cells.entity.push_back(entity);
  }

  [[nodiscard]] const ElementKind& kind_of(int type) const
  {
    const auto* const kind = std::ranges::find(kKinds, type, &ElementKind::type);
    if (kind == kKinds.end()) {
      in_.fail(
          fmt::format("has elements of type {}; a coarse mesh has linear tets and triangles "
                      "(Gmsh: -order 1)",
                      type));
    }
    return *kind;
  }

  [[noreturn]] void refuse(const ElementKind& kind, std::int64_t number) const
  {
    const bool is_linear = kind.type <= 7;
    in_.fail(
        fmt::format("element {}: the mesh has {}; a coarse mesh has linear tets and triangles "
                    "only; {}",
                    number, kind.name,
                    is_linear ? "mesh the model without recombination and extruded layers"
                              : "save it with elements of first order (Gmsh: -order 1)"));
  }

  FileCursor in_;
  bool is_old_ = false;
  bool is_binary_ = false;
  bool has_elements_ = false;
  std::unordered_map<std::int64_t, LocalIndex> rows_{};                     // Of points, by number.
  std::array<std::unordered_map<std::int32_t, std::int32_t>, 4> groups_{};  // By dimension, entity.
  TetMeshFile mesh_{};
};

}  // namespace

TetMeshFile read_msh(const std::filesystem::path& file)
{
  const std::string name = file.string();
  const std::string bytes = read_bytes(file);
  return MshReader(bytes, name).read();
}

}  // namespace tessera::model
