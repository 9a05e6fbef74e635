// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/model/tet_mesh_file.hpp"

#include "file_cursor.hpp"

namespace tessera::model {
namespace {

// A section is a word, a count and as many lines. Cells come before points.
class VolReader {
 public:
  VolReader(std::string_view bytes, const std::string& name) : in_(bytes, name) {}

  TetMeshFile read()
  {
    if (first_word() != "mesh3d") {
      in_.fail("is not a mesh file of NETGEN: it does not begin with mesh3d");
    }
    while (!has_ended_ && !in_.at_end()) read_section();
    if (mesh_.point_xyz.empty()) in_.fail("the file is truncated: it has no section points");
    require_points_of(mesh_.tets, "tet");
    require_points_of(mesh_.triangles, "triangle");
    return std::move(mesh_);
  }

 private:
  // Newer versions of NETGEN put a comment before it.
  std::string_view first_word()
  {
    while (!in_.at_end()) {
      const std::string_view word = in_.word("mesh3d");
      if (!word.starts_with('#')) return word;
      in_.line();
    }
    return {};
  }

  void read_section()
  {
    const std::string_view name = in_.word("a section");
    if (name == "dimension") {
      if (in_.number<int>("the dimension") != 3) in_.fail("the mesh is not of three dimensions");
    } else if (name.starts_with("surfaceelements")) {
      for_each_row([&](GlobalIndex number) { read_triangle(number); });
    } else if (name == "volumeelements") {
      for_each_row([&](GlobalIndex number) { read_tet(number); });
    } else if (name == "points") {
      for_each_row([&](GlobalIndex number) { read_point(number); });
    } else if (name == "materials") {
      for_each_row([&](GlobalIndex) { read_name(mesh_.tet_group_names); });
    } else if (name == "bcnames") {
      for_each_row([&](GlobalIndex) { read_name(mesh_.triangle_group_names); });
    } else if (name == "endmesh") {
      has_ended_ = true;
    } else {
      in_.line();  // Of a comment, or of a section that says nothing here.
    }
  }

  template <class Read>
  void for_each_row(const Read& read)
  {
    const std::size_t num = in_.count<std::int64_t>("the number of lines", 2);
    in_.line();
    for (std::size_t i = 0; i < num; ++i) {
      read(static_cast<GlobalIndex>(i) + 1);
      in_.line();  // Parameters of the corners.
    }
  }

  void read_triangle(GlobalIndex number)
  {
    mesh_.triangles.entity.push_back(in_.number<std::int32_t>("a surface"));
    mesh_.triangles.group.push_back(in_.number<std::int32_t>("a boundary condition"));
    in_.number<std::int32_t>("a domain");
    in_.number<std::int32_t>("a domain");
    read_points_of(mesh_.triangles, number, 3, "surface");
  }

  void read_tet(GlobalIndex number)
  {
    mesh_.tets.entity.push_back(0);
    mesh_.tets.group.push_back(in_.number<std::int32_t>("a domain"));
    read_points_of(mesh_.tets, number, 4, "volume");
  }

  void read_points_of(FileCells& cells, GlobalIndex number, std::int64_t num_points,
                      std::string_view kind)
  {
    if (const auto num = in_.number<std::int64_t>("a number of points"); num != num_points) {
      in_.fail(
          fmt::format("{} element {} has {} points; a coarse mesh has linear tets and triangles "
                      "only (NETGEN: second order off)",
                      kind, number, num));
    }
    cells.number.push_back(number);
    for (std::int64_t i = 0; i < num_points; ++i) {
      const auto point = in_.number<std::int64_t>("a point");
      if (point < 1 || point > std::numeric_limits<LocalIndex>::max()) {
        in_.fail(fmt::format("{} element {} has point {}, which the file does not have", kind,
                             number, point));
      }
      cells.points.push_back(static_cast<LocalIndex>(point - 1));
    }
  }

  void read_point(GlobalIndex number)
  {
    mesh_.point_number.push_back(number);
    for (int axis = 0; axis < 3; ++axis) mesh_.point_xyz.push_back(in_.coordinate());
  }

  void read_name(std::map<std::int32_t, std::string>& names)
  {
    const auto number = in_.number<std::int32_t>("a number");
    names[number] = in_.word("a name");
  }

  void require_points_of(const FileCells& cells, std::string_view kind) const
  {
    const auto num_points = static_cast<LocalIndex>(mesh_.point_number.size());
    const std::size_t corners = cells.size() == 0 ? 1 : cells.points.size() / cells.size();
    for (std::size_t i = 0; i < cells.points.size(); ++i) {
      if (cells.points[i] < num_points) continue;
      in_.fail(fmt::format("{} {} has point {}, which the file does not have", kind,
                           cells.number[i / corners], cells.points[i] + 1));
    }
  }

  FileCursor in_;
  bool has_ended_ = false;
  TetMeshFile mesh_{};
};

}  // namespace

TetMeshFile read_vol(const std::filesystem::path& file)
{
  const std::string name = file.string();
  const std::string bytes = read_bytes(file);
  return VolReader(bytes, name).read();
}

}  // namespace tessera::model
