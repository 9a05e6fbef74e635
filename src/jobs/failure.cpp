// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/failure.hpp"

#include <new>
#include <utility>

#include "tessera/base/error.hpp"

namespace tessera::jobs {

Failure current_failure()
{
  const auto failed = [](ErrorKind kind, const std::exception& error) {
    return Failure{.error = kind, .message = error.what()};
  };
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {.status = JobStatus::out_of_memory, .message = "an allocation failed"};
  } catch (const ConfigError& error) {
    return failed(ErrorKind::config, error);
  } catch (const GeometryError& error) {
    return failed(ErrorKind::geometry, error);
  } catch (const InputError& error) {
    return failed(ErrorKind::input, error);
  } catch (const NetgenError& error) {
    return failed(ErrorKind::netgen, error);
  } catch (const MeshError& error) {
    return failed(ErrorKind::mesh, error);
  } catch (const OutputError& error) {
    return failed(ErrorKind::output, error);
  } catch (const std::exception& error) {
    return failed(ErrorKind::other, error);
  } catch (...) {
    return {.message = "an exception of unknown type"};
  }
}

void throw_unless_ok(const JobOutcome& outcome, const std::string& what)
{
  if (outcome.status == JobStatus::ok) return;
  // Readers name the file themselves.
  const std::string text =
      outcome.message.starts_with(what) ? outcome.message : what + ": " + outcome.message;
  if (outcome.status == JobStatus::cancelled) throw Interrupted(text);
  if (outcome.status != JobStatus::failed) throw NetgenError(text);
  switch (outcome.error) {
    case ErrorKind::config:
      throw ConfigError(text);
    case ErrorKind::input:
      throw InputError(text);
    case ErrorKind::geometry:
      throw GeometryError(text);
    case ErrorKind::mesh:
      throw MeshError(text);
    case ErrorKind::netgen:
      throw NetgenError(text);
    case ErrorKind::output:
      throw OutputError(text);
    case ErrorKind::none:
    case ErrorKind::other:
      throw Error(text);
  }
}

}  // namespace tessera::jobs
