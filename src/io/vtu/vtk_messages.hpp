// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

class vtkObject;

namespace tessera::io {

/// @brief Collects the errors and warnings of one VTK object, which VTK would else print.
/// @pre The object outlives this.
class VtkMessages {
 public:
  explicit VtkMessages(vtkObject& object);
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// @brief What was said so far, in one line; empty if nothing was.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  vtkObject& object_;
  std::array<unsigned long, 2> observers_{};
  std::string text_{};
};

}  // namespace tessera::io
