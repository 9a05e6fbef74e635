// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <iosfwd>
#include <memory>
#include <string>
#include <utility>

#include <meshing.hpp>

#include "tessera/surface/options.hpp"

namespace tessera::netgen {

/// @brief NETGEN's settings for a coarse mesh; every format uses these.
[[nodiscard]] ::netgen::MeshingParameters coarse_parameters(const surface::CoarseOptions& options);

/// @brief The same, for NETGEN to end with the surface.
[[nodiscard]] ::netgen::MeshingParameters surface_parameters(const surface::CoarseOptions& options);

/// @brief What NETGEN's meshers get lengths multiplied by: some have absolute lengths in them
/// (segments below 1e-10, boxes grown by 10), so they always see a model of about one size. It is a
/// power of two: no bit of a position is lost on the way there and back.
[[nodiscard]] double scale_for_netgen(double box_diagonal);

/// @brief Holds NETGEN's global state while this process works with it; restores it at its end.
///
/// Some of NETGEN's meshers read the global `::netgen::mparam` and not their argument. All write to
/// global streams, and the reason for a failure is often only in what they wrote. This class is the
/// one place that touches these globals. One session at a time; not thread-safe, as NETGEN is not.
class NetgenSession {
 public:
  /// @brief Sets the global parameters, a quiet message level and the streams.
  explicit NetgenSession(const ::netgen::MeshingParameters& parameters = {});
  ~NetgenSession();
  NetgenSession(const NetgenSession&) = delete;
  NetgenSession& operator=(const NetgenSession&) = delete;

  /// @brief The global parameters: what is to be passed where NETGEN wants them as an argument.
  [[nodiscard]] ::netgen::MeshingParameters& parameters();

  /// @brief Runs one call into NETGEN (or OpenCASCADE) and returns what it returns.
  /// @param[in] what Put before the message: which step on which input.
  /// @throws NetgenError with the message of whatever the call threw, and what NETGEN wrote to its
  /// error stream meanwhile; Tessera's own errors pass unchanged.
  template <class Call>
  decltype(auto) run(const std::string& what, Call&& call)
  {
    forget_words();
    try {
      return std::forward<Call>(call)();
    } catch (...) {
      throw_translated(what);
    }
  }

  /// @brief Runs a step of NETGEN's surface mesher, within run(). Tells the rank of its progress,
  /// and ends it as soon as its own messages say that no surface will come.
  /// @throws NetgenError with that message.
  template <class Call>
  void run_surface(Call&& call)
  {
    begin_listening();
    try {
      std::forward<Call>(call)();
    } catch (...) {
      end_listening();
      throw;
    }
    end_listening();
  }

  /// @brief What NETGEN wrote to its error stream since the last run() began, on one line.
  [[nodiscard]] std::string words() const;

 private:
  void forget_words();
  void begin_listening();
  void end_listening();
  [[noreturn]] void throw_translated(const std::string& what) const;

  struct Saved;
  std::unique_ptr<Saved> saved_;
};

}  // namespace tessera::netgen
