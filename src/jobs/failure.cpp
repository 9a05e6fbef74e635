// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/failure.hpp"

#include <exception>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::jobs {

Failure current_failure()
{
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {.status = JobStatus::out_of_memory, .message = "an allocation failed"};
  } catch (const std::exception& error) {
    return {.error = kind_of(error), .message = error.what()};
  } catch (...) {
    return {.message = "an exception of unknown type"};
  }
}

void throw_unless_ok(const JobOutcome& outcome, const std::string& what)
{
  if (outcome.status == JobStatus::ok) return;
  // Readers name the file themselves.
  const std::string text = outcome.message.starts_with(what)
                               ? outcome.message
                               : fmt::format("{}: {}", what, outcome.message);
  if (outcome.status == JobStatus::cancelled) throw Interrupted(text);
  if (outcome.status != JobStatus::failed) throw NetgenError(text);
  throw_error(outcome.error.value_or(ErrorKind::other), text);
}

}  // namespace tessera::jobs
