// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include <sys/types.h>

#include "tessera/base/file_descriptor.hpp"

#include "jobs/packet.hpp"

namespace tessera::jobs {

/// @brief The rank's end of the line to its worker processes, and what it knows of them.
struct ZygoteLink {
  pid_t zygote = 0;
  FileDescriptor control{};
  FileDescriptor data{};
  FileDescriptor own_data{};      ///< That of this rank, while `data` leads to a joined one.
  FileDescriptor joined_model{};  ///< The model zygote of another rank that this one has joined.
  Incoming control_packets{};
  Incoming data_packets{};
  bool zygote_is_gone = false;
  bool is_open = false;            ///< Other ranks may use the model zygote of this one.
  bool model_was_started = false;  ///< And its end was not reported yet.
  pid_t model = 0;                 ///< 0 until the zygote has told.
  std::uint32_t num_calls = 0;
  ClientSettings settings{};
  bool settings_are_told = false;  ///< The model zygote knows them.

  std::size_t peak_bytes = 0;    ///< Of all worker processes together, since it was last zeroed.
  std::size_t loaded_bytes = 0;  ///< Of the zygotes together after the last load.
  std::size_t model_bytes = 0;   ///< Of the model zygote after the last load.

  /// @brief Whether jobs are forks of the model zygote of another rank.
  [[nodiscard]] bool has_joined() const noexcept { return joined_model.get() >= 0; }

  /// @brief Whether other ranks need the model zygote too.
  [[nodiscard]] bool is_shared() const noexcept { return is_open || has_joined(); }

  /// @brief Asks for a model zygote that answers this and later calls.
  void start_model()
  {
    send_signal(control.get(), PacketKind::start_model, num_calls);
    model_was_started = true;
    model = 0;
    settings_are_told = false;
    loaded_bytes = 0;
    model_bytes = 0;
  }

  /// @brief Ends the model zygote of this rank; the next call starts another one.
  /// @throws Error if its end is not reported; then this rank can run no more jobs.
  void end_model();

  /// @brief From now on jobs are forks of the model zygote that listens at `name`.
  /// @pre has_joined() is false. @throws Error that says why not; then nothing has changed, but for
  /// what end_model() says.
  void join(const std::string& name);

  /// @brief Undoes join().
  void leave();

  /// @brief Kills the model zygote that runs the calls.
  void kill_model();
};

}  // namespace tessera::jobs
