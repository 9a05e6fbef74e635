// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "support/temporary_folder.hpp"

#include "mesh_samples.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;
using testing::message_of;
using testing::TemporaryFolder;

/// @brief Reads what may be damaged: arrays that are consistent, or an InputError with the name.
[[nodiscard]] std::optional<MeshArrays> read_damaged(const std::filesystem::path& path)
{
  try {
    return read_vtu(path);
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    return std::nullopt;
  }
}

void expect_consistent(const MeshArrays& mesh)
{
  EXPECT_EQ(mesh.point_xyz.size() % 3, 0U);
  EXPECT_EQ(std::ssize(mesh.cell_points), mesh.num_cells() * mesh.vertices_per_cell);
  EXPECT_TRUE(std::ranges::all_of(mesh.cell_points, [&](GlobalIndex point) {
    return point >= 0 && point < mesh.num_points();
  }));
  EXPECT_TRUE(mesh.point_ids.empty() || std::ssize(mesh.point_ids) == mesh.num_points());
  EXPECT_TRUE(mesh.cell_ids.empty() || std::ssize(mesh.cell_ids) == mesh.num_cells());
  for (const auto& [name, values] : mesh.cell_ints) {
    EXPECT_EQ(std::ssize(values), mesh.num_cells()) << name;
  }
}

class WithCompression : public ::testing::TestWithParam<Compression> {
 protected:
  [[nodiscard]] std::string sample_bytes() const
  {
    write_vtu(testing::sample_tets(2), file(), GetParam());
    return testing::file_bytes(file());
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "a.vtu"; }

 private:
  TemporaryFolder folder_{};
};
INSTANTIATE_TEST_SUITE_P(All, WithCompression,
                         ::testing::Values(Compression::none, Compression::lz4, Compression::zlib));

TEST_P(WithCompression, AFileThatIsCutOffAnywhereIsAnInputError)
{
  const std::string bytes = sample_bytes();
  for (std::size_t size = 0; size + 1 < bytes.size(); size += 1 + size / 32) {
    testing::write_bytes(file(), bytes.substr(0, size));
    EXPECT_FALSE(read_damaged(file()).has_value()) << size << " of " << bytes.size();
  }
}

TEST_P(WithCompression, AHoleInTheDataIsAnInputErrorOrConsistent)
{
  const std::string bytes = sample_bytes();
  for (std::size_t at = 0; at + 50 < bytes.size(); at += 37) {
    std::string damaged = bytes;
    damaged.erase(at, 50);
    testing::write_bytes(file(), damaged);
    if (const auto mesh = read_damaged(file())) expect_consistent(*mesh);
  }
}

TEST_P(WithCompression, FlippedBytesAreAnInputErrorOrConsistent)
{
  const std::string bytes = sample_bytes();
  std::mt19937_64 random(17);
  std::size_t num_refused = 0;
  constexpr std::size_t kNumTrials = 800;
  for (std::size_t trial = 0; trial < kNumTrials; ++trial) {
    std::string damaged = bytes;
    for (std::size_t flip = 0; flip <= trial % 3; ++flip) {
      constexpr std::array kLikely{'\x00', '\xff', '\x01', '\x80', '0', '9', '<', '"'};
      const char byte =
          trial % 2 == 0 ? static_cast<char>(random() % 256) : kLikely[random() % kLikely.size()];
      damaged[random() % damaged.size()] = byte;
    }
    testing::write_bytes(file(), damaged);
    const auto mesh = read_damaged(file());
    if (mesh) {
      expect_consistent(*mesh);
    } else {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, kNumTrials / 20);
}

TEST_P(WithCompression, AFlippedByteInAHeaderOfDataIsAnInputErrorOrConsistent)
{
  const std::string bytes = sample_bytes();
  const std::size_t data = bytes.find('_', bytes.find("<AppendedData"));
  ASSERT_NE(data, std::string::npos);
  for (std::size_t at = data + 1; at < std::min(data + 80, bytes.size()); ++at) {
    for (const char byte : {'\x00', '\x01', '\x7f', '\x80', '\xff'}) {
      std::string damaged = bytes;
      damaged[at] = byte;
      testing::write_bytes(file(), damaged);
      if (const auto mesh = read_damaged(file())) expect_consistent(*mesh);
    }
  }
}

TEST(ReadVtu, FilesOfOtherKindsAreInputErrors)
{
  const TemporaryFolder folder;
  const std::vector<std::string> contents{
      "",
      " ",
      "solid cube\nendsolid\n",
      "<html></html>",
      std::string(10000, '<'),
      std::string(1000, '\0'),
      "<VTKFile type=\"PolyData\"></VTKFile>",
      "<VTKFile type=\"UnstructuredGrid\"></VTKFile>",
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>",
      "</VTKFile>",
      "<VTKFile",
      "<VTKFile></VTKFile></VTKFile>"};
  for (const std::string& content : contents) {
    testing::write_bytes(folder / "a.vtu", content);
    EXPECT_FALSE(read_damaged(folder / "a.vtu").has_value()) << content.substr(0, 80);
  }
}

TEST(ReadVtu, ElementsNestedWithoutEndAreAnInputError)
{
  const TemporaryFolder folder;
  std::string nested;
  for (int depth = 0; depth < 200'000; ++depth) nested += "<a>";
  testing::write_bytes(folder / "a.vtu", nested + "</VTKFile>");
  EXPECT_FALSE(read_damaged(folder / "a.vtu").has_value());
}

TEST(ReadVtu, SizesThatNoFileCanHoldAreInputErrors)
{
  const TemporaryFolder folder;
  write_vtu(testing::sample_tets(2), folder / "good.vtu", Compression::none);
  const std::string bytes = testing::file_bytes(folder / "good.vtu");
  for (const std::string attribute : {"NumberOfPoints=\"", "NumberOfCells=\"", "offset=\""}) {
    for (const std::string value :
         {"18446744073709551615", "99999999999999999999", "-1", "1e3", ""}) {
      std::string damaged = bytes;
      const std::size_t at = bytes.find(attribute) + attribute.size();
      damaged.replace(at, bytes.find('"', at) - at, value);
      testing::write_bytes(folder / "a.vtu", damaged);
      EXPECT_FALSE(read_damaged(folder / "a.vtu").has_value()) << attribute << value;
    }
  }
}

/// @brief A header of compressed data: 32-bit words, low byte first.
[[nodiscard]] std::string header_of(const std::vector<std::uint32_t>& words)
{
  std::string bytes;
  for (const std::uint32_t word : words) {
    for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift);
  }
  return bytes;
}

[[nodiscard]] long peak_memory_kib()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(ReadVtu, BlocksThatAreNotThereTakeNoMemory)
{
  const TemporaryFolder folder;
  constexpr std::uint32_t kNumBlocks = 200'000;
  for (const std::uint32_t block_size : {8191U, 65536U}) {  // 1.6 and 13 GB in all.
    std::vector<std::uint32_t> header(3 + kNumBlocks, 0);
    header[0] = kNumBlocks;
    header[1] = block_size;
    testing::write_bytes(
        folder / "a.vtu",
        "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"><UnstructuredGrid>"
        "<Piece NumberOfPoints=\"0\" NumberOfCells=\"1\"><Cells><DataArray Name=\"connectivity\" "
        "type=\"Int64\" format=\"appended\" offset=\"0\"/></Cells></Piece></UnstructuredGrid>"
        "<AppendedData encoding=\"raw\">_"
            + header_of(header) + "</AppendedData></VTKFile>");
    const long before = peak_memory_kib();
    EXPECT_FALSE(read_damaged(folder / "a.vtu").has_value());
    EXPECT_LT(peak_memory_kib() - before, 200 * 1024) << block_size;
  }
}

TEST(ReadVtu, RawDataThatNobodyAsksForStayInTheFile)
{
  constexpr std::size_t kNumBytes = std::size_t{1} << 30;  // A hole, which takes no disk.
  const TemporaryFolder folder;
  std::ofstream file(folder / "a.vtu", std::ios::binary);
  file << "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"><UnstructuredGrid>"
          "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><CellData><DataArray Name=\"velocity\" "
          "type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></CellData>"
          "</Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_";
  file.seekp(kNumBytes, std::ios::cur);
  file << "</AppendedData></VTKFile>";
  file.close();
  const long before = peak_memory_kib();
  EXPECT_TRUE(read_damaged(folder / "a.vtu").has_value());
  EXPECT_LT(peak_memory_kib() - before, 100 * 1024);
}

TEST(ReadVtu, AFileThatIsNotThereOrAFolderSaysSo)
{
  const TemporaryFolder folder;
  const auto message = [](const std::filesystem::path& path) {
    return message_of<InputError>([&] { (void)read_vtu(path); });
  };
  EXPECT_NE(message(folder / "no.vtu").find("no.vtu: No such file"), std::string::npos);
  EXPECT_NE(message(folder.path()).find("Is a directory"), std::string::npos);
}

TEST(PieceFiles, ADamagedIndexIsAnInputErrorOrAList)
{
  const TemporaryFolder folder;
  write_pvtu(folder / "good.pvtu", {"a.vtu", "b.vtu"}, testing::sample_tets(1));
  const std::string bytes = testing::file_bytes(folder / "good.pvtu");
  std::mt19937 random(5);
  for (int trial = 0; trial < 500; ++trial) {
    std::string damaged = bytes.substr(0, trial % 2 == 0 ? bytes.size() : random() % bytes.size());
    if (!damaged.empty()) damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    testing::write_bytes(folder / "mesh.pvtu", damaged);
    try {
      EXPECT_LE(piece_files(folder / "mesh.pvtu").size(), 2U);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("mesh.pvtu"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace tessera::io
