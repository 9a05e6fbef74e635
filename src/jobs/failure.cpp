// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/failure.hpp"

#include <exception>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::jobs {

JobEnd current_failure()
{
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {.status = JobStatus::out_of_memory, .message = "an allocation failed"};
  } catch (const std::exception& error) {
    return {.status = JobStatus::failed, .error = kind_of(error), .message = error.what()};
  } catch (...) {
    return {.status = JobStatus::failed,
            .error = ErrorKind::other,
            .message = "an exception of unknown type"};
  }
}

void throw_unless_ok(const JobEnd& end, const std::string& what)
{
  if (end.status == JobStatus::ok) return;
  // Readers name the file themselves.
  const std::string text =
      end.message.starts_with(what) ? end.message : fmt::format("{}: {}", what, end.message);
  if (end.status == JobStatus::cancelled) throw Interrupted(text);
  if (end.status != JobStatus::failed) throw NetgenError(text);
  throw_error(end.error.value_or(ErrorKind::other), text);
}

}  // namespace tessera::jobs
