// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"

#include "pipeline/drawing/canvas.hpp"

/// Parts of a page that needs nothing from outside. All functions are Local.
namespace tessera::pipeline {

/// @brief A text as it may stand in HTML, also in quotes. Control characters, which HTML does not
/// allow, become the replacement character.
[[nodiscard]] std::string escaped(std::string_view text);

/// @brief As a shell takes it for one word.
[[nodiscard]] std::string shell_word(const std::string& text);

[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// @brief "#rrggbb".
[[nodiscard]] std::string css_colour(const Colour& colour);

/// @brief A number with commas between thousands.
[[nodiscard]] std::string grouped(GlobalIndex number);

/// @brief "0.25 s", "12.3 s", "4 min 05 s" or "2 h 10 min".
[[nodiscard]] std::string duration_text(double seconds);

/// @brief "1.5 GB" and the like, by powers of ten.
[[nodiscard]] std::string bytes_text(double bytes);

/// @brief Counts over one axis.
struct HistogramSeries {
  std::string name{};
  std::vector<GlobalIndex> counts{};  ///< Of equal bins.
  std::vector<Colour> colours{};      ///< One, or one a bin.
};

/// @brief What is on the axis of a histogram.
struct HistogramAxis {
  std::string title{};
  std::string unit{};
  double low = 0.0;
  double high = 1.0;
  int num_ticks = 5;  ///< Steps between the marks.
};

/// @brief A drawing (inline SVG) of series of as many bins over one axis. A bin that is not empty
/// is seen, however few it has. Each bar says its count to the pointer.
[[nodiscard]] std::string histogram_svg(const HistogramAxis& axis,
                                        const std::vector<HistogramSeries>& series);

/// @brief A part of a bar.
struct BarPart {
  double value = 0.0;
  std::string colour{};  ///< CSS.
  std::string meaning{};
};

/// @brief A row of a chart of bars.
struct Bar {
  std::string name{};
  std::vector<BarPart> parts{};  ///< From the left.
  std::string note{};            ///< Behind the bar.
};

/// @brief What a chart of bars is drawn on.
struct BarAxis {
  std::string title{};
  double full = 1.0;      ///< The value of a full bar.
  double width = 1040.0;  ///< Of the drawing, about as many pixels as it will have.
};

/// @brief A drawing (inline SVG) of horizontal bars.
[[nodiscard]] std::string bars_svg(const BarAxis& axis, const std::vector<Bar>& bars);

/// @brief A table; cells are HTML already. The first column holds text, the others numbers.
[[nodiscard]] std::string table_html(const std::vector<std::string>& head,
                                     const std::vector<std::vector<std::string>>& rows);

/// @brief A list of sentences, text; empty if there are none.
[[nodiscard]] std::string notes_html(const std::vector<std::string>& notes);

/// @brief A section with a heading; empty if it has no content.
[[nodiscard]] std::string section_html(std::string_view heading, const std::string& content);

/// @brief The whole page with its styles. @param[in] body HTML.
[[nodiscard]] std::string page_html(std::string_view title, const std::string& body);

}  // namespace tessera::pipeline
