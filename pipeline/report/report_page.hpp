// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/drawing/mesh_scene.hpp"

namespace tessera::pipeline {

/// @brief All that a report for people is made from.
struct ReportSource {
  std::string json{};                             ///< report.json.
  std::map<std::string, std::string> pictures{};  ///< PNG files in base64, by MeshPicture::name.
  std::string view{};                             ///< Of view_html(); empty: nothing to turn.
  std::filesystem::path folder{};                 ///< The output folder, as the user calls it.
};

/// @brief What a run has just made. Local.
[[nodiscard]] ReportSource report_source(std::string json, const std::vector<MeshPicture>& pictures,
                                         std::string view, std::filesystem::path folder);

/// @brief What is in an output folder: report.json, and the pictures of report.html if it has any.
/// Local.
/// @throws InputError if it is not the output folder of a run.
[[nodiscard]] ReportSource read_report_source(const std::filesystem::path& folder);

/// @brief report.html: one page that needs nothing from outside. The same source gives the same
/// bytes. Local.
/// @throws InputError if the JSON is not that of a report.
[[nodiscard]] std::string report_page(const ReportSource& source);

/// @brief The page of two runs side by side. Local. @throws InputError as report_page().
[[nodiscard]] std::string compare_page(const ReportSource& a, const ReportSource& b);

/// @brief The same in short, as text for a terminal. Local. @throws InputError as report_page().
[[nodiscard]] std::string compare_text(const ReportSource& a, const ReportSource& b);

}  // namespace tessera::pipeline
