// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/report/report_page.hpp"

/// What the page of one run and that of two have in common. All functions are Local.
namespace tessera::pipeline {

using Json = nlohmann::ordered_json;

/// @brief A report that was read. Whatever a run did not come to is missing in it.
struct Report {
  Json json{};
  const ReportSource& source;

  /// @throws InputError if it is not a report.
  explicit Report(const ReportSource& from);

  [[nodiscard]] const Json* find(const char* pointer) const;  ///< nullptr: not there.
  [[nodiscard]] std::optional<double> number(const char* pointer) const;
  [[nodiscard]] std::string text(const char* pointer) const;  ///< Empty if not there.
  [[nodiscard]] std::vector<std::string> texts(const char* pointer) const;
  [[nodiscard]] std::vector<GlobalIndex> counts(const char* pointer) const;
};

/// @brief How a figure is written.
enum class FigureForm { count, plain, seconds, bytes, degrees };

/// @brief Which of two values is the better one.
enum class BetterValue { neither, higher, lower };

/// @brief A figure that is worth a look.
struct KeyFigure {
  const char* name = "";
  const char* pointer = "";  ///< Into report.json.
  FigureForm form = FigureForm::plain;
  BetterValue better = BetterValue::neither;
};

[[nodiscard]] const std::vector<KeyFigure>& key_figures();

/// @brief "–" if the report does not have it.
[[nodiscard]] std::string figure_text(const Report& report, const KeyFigure& figure);

/// @brief Verdict with every reason, and the way out of a failure.
[[nodiscard]] std::string verdict_html(const Report& report);

/// @brief The pictures with what they show; empty without pictures.
[[nodiscard]] std::vector<std::string> picture_figures(const Report& report);

/// @brief Mean ratio, then dihedral angles, each with its caption; empty without them.
[[nodiscard]] std::vector<std::string> quality_figures(const Report& report);

/// @brief Bars of the stages.
/// @param[in] full Seconds of a full bar.
/// @param[in] width Of the drawing, pixels.
[[nodiscard]] std::string stages_html(const Report& report, double full, double width);
[[nodiscard]] double longest_stage_s(const Report& report);
[[nodiscard]] std::string stages_legend();

[[nodiscard]] std::string worst_tets_html(const Report& report);

/// @brief The coarse tets with small angles that the model does not force; empty if there are none.
[[nodiscard]] std::string sharp_tets_html(const Report& report);

/// @brief Warnings and what else is worth to know, each with what to do.
[[nodiscard]] std::vector<std::string> advice_of(const Report& report);

}  // namespace tessera::pipeline
