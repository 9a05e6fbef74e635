// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_contacts.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <BRep_Builder.hxx>
#include <NCollection_DataMap.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Iterator.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/name_patterns.hpp"

#include "netgen/occ_fuse.hpp"
#include "netgen/occ_shape.hpp"

namespace tessera::netgen {
namespace {

using Rows = std::vector<std::size_t>;
using RowPairs = std::set<std::pair<std::size_t, std::size_t>>;  // Both orders.

std::vector<std::string> names_of(const Shapes& solids, const ShapeNames& names)
{
  std::vector<std::string> all;
  for (const TopoDS_Shape& solid : solids) {
    all.push_back(label_in(names, solid).name);
  }
  return all;
}

Rows rows_that_fit(const std::string& pattern, const std::vector<std::string>& names)
{
  Rows rows;
  std::vector<std::string> known;
  for (std::size_t row = 0; row < names.size(); ++row) {
    const std::string number = std::to_string(row + 1);
    if (matches_pattern(pattern, number) || matches_pattern(pattern, names[row])) {
      rows.push_back(row);
    }
    known.push_back(names[row].empty() ? number : names[row]);
  }
  if (rows.empty()) {
    throw ConfigError(
        fmt::format("[[geometry.contact]]: no solid is or fits \"{}\"; there are {}, numbered from "
                    "1 to {}",
                    pattern, nearest_first(pattern, known), names.size()));
  }
  return rows;
}

RowPairs pairs_of(const std::vector<model::Contact>& contacts,
                  const std::vector<std::string>& names)
{
  RowPairs pairs;
  for (const model::Contact& contact : contacts) {
    for (const std::size_t a : rows_that_fit(contact.body, names)) {
      for (const std::size_t b : rows_that_fit(contact.other, names)) {
        if (a != b) pairs.insert({{a, b}, {b, a}});
      }
    }
  }
  return pairs;
}

// Of a part that several solids have: the solids that keep one copy of it together.
class Sides {
 public:
  Sides(const Shapes& solids, const RowPairs& apart) : apart_(&apart)
  {
    for (const TopAbs_ShapeEnum kind : {TopAbs_FACE, TopAbs_EDGE, TopAbs_VERTEX}) {
      for (std::size_t row = 0; row < solids.size(); ++row) {
        for (const TopoDS_Shape& part : parts_of(solids[row], kind)) {
          if (!rows_.IsBound(part)) rows_.Bind(part, {});
          rows_.ChangeFind(part).push_back(row);
        }
      }
    }
  }

  /// The first solid of those with which `row` has the part in common; whoever has the lowest
  /// number of all keeps the part itself.
  [[nodiscard]] std::size_t first_beside(const TopoDS_Shape& part, std::size_t row) const
  {
    Rows left = rows_.Find(part);
    Rows side{row};
    std::erase(left, row);
    for (std::size_t i = 0; i < side.size(); ++i) {
      const auto touches = [&](std::size_t other) { return !apart_->contains({side[i], other}); };
      std::ranges::copy_if(left, std::back_inserter(side), touches);
      std::erase_if(left, touches);
    }
    return *std::ranges::min_element(side);
  }

  [[nodiscard]] bool is_shared(const TopoDS_Shape& part) const
  {
    return rows_.Find(part).size() > 1;
  }

  [[nodiscard]] std::size_t first_of_all(const TopoDS_Shape& part) const
  {
    return rows_.Find(part).front();
  }

 private:
  const RowPairs* apart_;
  NCollection_DataMap<TopoDS_Shape, Rows, TopTools_ShapeMapHasher> rows_{};
};

// Copies of what solids must not have in common.
class Copies {
 public:
  Copies(const Shapes& solids, const RowPairs& apart, ShapeNames& names)
      : sides_(solids, apart), names_(names)
  {
  }

  TopoDS_Shape for_solid(const TopoDS_Shape& part, std::size_t row)
  {
    const bool has_sides = part.ShapeType() == TopAbs_FACE || part.ShapeType() == TopAbs_EDGE
                           || part.ShapeType() == TopAbs_VERTEX;
    if (!has_sides) return with_copies_in_it(part, row, false);
    const std::size_t first = sides_.first_beside(part, row);
    auto& known = copies_[first];
    if (const TopoDS_Shape* const copy = known.Seek(part))
      return copy->Oriented(part.Orientation());
    const bool is_copied = first != sides_.first_of_all(part);
    const TopoDS_Shape copy = with_copies_in_it(part.Oriented(TopAbs_FORWARD), row, is_copied);
    known.Bind(part, copy);
    return copy.Oriented(part.Orientation());
  }

 private:
  // The part itself if neither it nor anything in it is copied.
  TopoDS_Shape with_copies_in_it(const TopoDS_Shape& part, std::size_t row, bool is_copied)
  {
    Shapes inner;
    bool has_changed = is_copied;
    for (TopoDS_Iterator each(part); each.More(); each.Next()) {
      inner.push_back(for_solid(each.Value(), row));
      has_changed = has_changed || !inner.back().IsSame(each.Value());
    }
    if (!has_changed) return part;
    TopoDS_Shape copy = part.EmptyCopied();
    for (const TopoDS_Shape& each : inner) BRep_Builder().Add(copy, each);
    copy.Closed(part.Closed());
    if (const ShapeLabel* const label = names_.Seek(part)) {
      const ShapeLabel same = *label;
      names_.Bind(copy, same);
    }
    return copy;
  }

  Sides sides_;
  ShapeNames& names_;
  // Of each first solid of a side.
  std::map<std::size_t, NCollection_DataMap<TopoDS_Shape, TopoDS_Shape, TopTools_ShapeMapHasher>>
      copies_{};
};

std::size_t count_common_faces(const Shapes& solids, const RowPairs& pairs)
{
  PartOwners owners;
  std::size_t number = 0;
  for (std::size_t row = 0; row < solids.size(); ++row) {
    for (const TopoDS_Shape& face : parts_of(solids[row], TopAbs_FACE)) {
      if (pairs.contains({owners.first_with(face, row), row})) ++number;
    }
  }
  return number;
}

}  // namespace

void keep_apart(const std::vector<model::Contact>& contacts, CadFile& cad)
{
  if (contacts.empty()) return;
  const Shapes solids = parts_of(cad.shape, TopAbs_SOLID);
  const RowPairs pairs = pairs_of(contacts, names_of(solids, cad.names));
  const std::size_t num_faces = count_common_faces(solids, pairs);
  Copies copies(solids, pairs, cad.names);
  Shapes apart;
  for (std::size_t row = 0; row < solids.size(); ++row) {
    apart.push_back(copies.for_solid(solids[row], row));
  }
  cad.shape = compound_of(apart);
  cad.repairs.push_back(
      num_faces == 0
          ? "solids of [[geometry.contact]] have no face in common, so that none was doubled"
          : fmt::format("solids in contact were kept apart: {} faces were doubled", num_faces));
}

}  // namespace tessera::netgen
