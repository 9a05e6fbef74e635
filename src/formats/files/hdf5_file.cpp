// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>

#include "tessera/base/error.hpp"

namespace tessera::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are");

// An object of HDF5 that ends with this one.
class Handle {
 public:
  Handle(hid_t id, herr_t (*end)(hid_t), const std::filesystem::path& file) : id_(id), end_(end)
  {
    if (id_ < 0) throw OutputError(fmt::format("cannot write {}: HDF5 refuses", file.string()));
  }
  ~Handle()
  {
    if (id_ >= 0) end_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  [[nodiscard]] hid_t id() const noexcept { return id_; }

  // What can fail late is asked for its end.
  void close(const std::filesystem::path& file)
  {
    if (end_(std::exchange(id_, -1)) < 0)
      throw OutputError(fmt::format("cannot write {}: HDF5 cannot close it", file.string()));
  }

 private:
  hid_t id_;
  herr_t (*end_)(hid_t);
};

// HDF5 tells standard error of every error, which has its message already. At the end of the
// program it closes files again that it could not close on a full disk, and crashes.
class Silence {
 public:
  Silence()
  {
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

hid_t type_of(Hdf5Type type)
{
  switch (type) {
    case Hdf5Type::float64:
      return H5T_IEEE_F64LE;
    case Hdf5Type::int64:
      return H5T_STD_I64LE;
    case Hdf5Type::int32:
      return H5T_STD_I32LE;
  }
  return H5T_STD_I32LE;
}

class Hdf5Maker {
 public:
  explicit Hdf5Maker(const std::filesystem::path& path)
      : path_(path),
        file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), &H5Fclose, path),
        groups_(H5Pcreate(H5P_LINK_CREATE), &H5Pclose, path),
        in_one_piece_(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose, path)
  {
    H5Pset_create_intermediate_group(groups_.id(), 1);
    H5Pset_layout(in_one_piece_.id(), H5D_CONTIGUOUS);
    H5Pset_alloc_time(in_one_piece_.id(), H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(in_one_piece_.id(), H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(in_one_piece_.id(), false);  // The same bytes every time.
  }

  void add(const Hdf5Array& array)
  {
    const std::array<hsize_t, 2> shape{static_cast<hsize_t>(array.num_rows),
                                       static_cast<hsize_t>(array.num_columns)};
    const int num_dimensions = array.num_columns == 0 ? 1 : 2;
    const Handle space(H5Screate_simple(num_dimensions, shape.data(), nullptr), &H5Sclose, path_);
    const Handle made = dataset(array.name, type_of(array.type), space);
    for (const auto& [name, value] : array.attributes) {
      const Handle scalar(H5Screate(H5S_SCALAR), &H5Sclose, path_);
      const Handle attribute(
          H5Acreate2(made.id(), name.c_str(), H5T_STD_I32LE, scalar.id(), H5P_DEFAULT, H5P_DEFAULT),
          &H5Aclose, path_);
      H5Awrite(attribute.id(), H5T_NATIVE_INT, &value);
    }
  }

  void add(const std::string& name, const std::vector<std::string>& texts)
  {
    std::size_t width = 1;
    for (const std::string& text : texts) width = std::max(width, text.size());
    std::string characters;
    for (const std::string& text : texts)
      characters += text + std::string(width - text.size(), '\0');
    const Handle type(H5Tcopy(H5T_C_S1), &H5Tclose, path_);
    H5Tset_size(type.id(), width);
    H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
    H5Tset_cset(type.id(), H5T_CSET_UTF8);
    const hsize_t length = texts.size();
    const Handle space(H5Screate_simple(1, &length, nullptr), &H5Sclose, path_);
    const Handle made = dataset(name, type.id(), space);
    if (length > 0)
      H5Dwrite(made.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data());
  }

  void close() { file_.close(path_); }

 private:
  Handle dataset(const std::string& name, hid_t type, const Handle& space)
  {
    return {H5Dcreate2(file_.id(), name.c_str(), type, space.id(), groups_.id(), in_one_piece_.id(),
                       H5P_DEFAULT),
            &H5Dclose, path_};
  }

  const std::filesystem::path& path_;
  Handle file_;
  Handle groups_;
  Handle in_one_piece_;
};

}  // namespace

void make_hdf5_file(const std::filesystem::path& file, const Hdf5Layout& layout)
{
  const Silence silence;
  Hdf5Maker maker(file);
  for (const Hdf5Array& array : layout.arrays) maker.add(array);
  for (const auto& [name, texts] : layout.texts) maker.add(name, texts);
  maker.close();
}

std::map<std::string, GlobalIndex> hdf5_offsets(const std::filesystem::path& path,
                                                const Hdf5Layout& layout)
{
  const Silence silence;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose, path);
  std::map<std::string, GlobalIndex> offsets;
  for (const Hdf5Array& array : layout.arrays) {
    const Handle dataset(H5Dopen2(file.id(), array.name.c_str(), H5P_DEFAULT), &H5Dclose, path);
    offsets[array.name] =
        array.num_rows == 0 ? 0 : static_cast<GlobalIndex>(H5Dget_offset(dataset.id()));
  }
  return offsets;
}

}  // namespace tessera::formats
