// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/session.hpp"

#include <cmath>
#include <iostream>
#include <span>
#include <sstream>
#include <string_view>
#include <typeinfo>

#include <Standard_Failure.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/jobs/this_process.hpp"

#include "netgen/surface/surface_messages.hpp"
#include "netgen/versions.hpp"

// Defined in a library of NETGEN and declared in no header of NETGEN.
namespace netgen {
extern DLL_HEADER MeshingParameters mparam;
}

namespace tessera::netgen {
namespace {

// Importance of NETGEN's messages.
constexpr int kMainSteps = 1;
constexpr int kEveryThousandTrials = 5;

// Swallows everything. NETGEN dereferences testout without a check, so it must be a stream.
class NullBuffer final : public std::streambuf {
  int_type overflow(int_type c) override { return traits_type::not_eof(c); }
  std::streamsize xsputn(const char*, std::streamsize n) override { return n; }
};

// Gives single characters to xsputn() too.
class UnbufferedStream : public std::streambuf {
  int_type overflow(int_type c) override
  {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char character = traits_type::to_char_type(c);
    xsputn(&character, 1);
    return c;
  }
};

// Passes everything on to standard error and keeps the end of it.
class KeepingBuffer final : public UnbufferedStream {
 public:
  [[nodiscard]] const std::string& kept() const { return kept_; }
  void clear() { kept_.clear(); }

 private:
  static constexpr std::size_t kMostKept =
      2000;  // Characters; a loop of warnings must not fill memory.

  std::streamsize xsputn(const char* text, std::streamsize n) override
  {
    std::cerr.write(text, n);
    kept_.append(text, static_cast<std::size_t>(n));
    if (kept_.size() > 2 * kMostKept) kept_.erase(0, kept_.size() - kMostKept);
    return n;
  }

  std::string kept_;
};

// Passes everything on to standard output and reads the lines. It asks NETGEN to stop if nothing
// will come of what it does: NETGEN looks at the flag in all loops of its surface meshers.
class ListeningBuffer final : public UnbufferedStream {
 public:
  [[nodiscard]] const std::string& verdict() const { return messages_.verdict(); }
  void forget() { messages_ = {}; }

 private:
  std::streamsize xsputn(const char* text, std::streamsize n) override
  {
    std::cout.write(text, n);
    for (const char c : std::string_view(text, static_cast<std::size_t>(n))) take(c);
    return n;
  }

  void take(char c)
  {
    if (c != '\n') {
      line_ += c;
      return;
    }
    if (messages_.read(line_)) jobs::report_progress();
    if (!verdict().empty()) ::netgen::multithread.terminate = 1;
    line_.clear();
  }

  SurfaceMessages messages_{};
  std::string line_{};
};

// Runs of white space, line ends among them, become one blank.
std::string on_one_line(const std::string& text)
{
  std::istringstream in(text);
  std::string line;
  for (std::string word; in >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::string message_of_current_exception()
{
  try {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  } catch (const Standard_Failure& failure) {
    return fmt::format("{}: {}", failure.DynamicType()->Name(), failure.GetMessageString());
  } catch (...) {
    return "an exception of unknown type";
  }
}

}  // namespace

::netgen::MeshingParameters coarse_parameters(const surface::CoarseOptions& options)
{
  ::netgen::MeshingParameters parameters;
  parameters.maxh = options.max_size;
  parameters.grading = options.grading;
  parameters.curvaturesafety = options.curvature;
  for (std::size_t i = 0; i < options.points.size.size(); ++i) {
    const Vec3 point = point_at(std::span(options.points.xyz), i);
    parameters.meshsize_points.Append(
        {::netgen::Point<3>(point[0], point[1], point[2]), options.points.size[i]});
  }
  return parameters;
}

double scale_for_netgen(double box_diagonal)
{
  constexpr double kDiagonal = 100.0;
  return std::exp2(std::round(std::log2(kDiagonal / box_diagonal)));
}

::netgen::MeshingParameters surface_parameters(const surface::CoarseOptions& options)
{
  ::netgen::MeshingParameters parameters = coarse_parameters(options);
  parameters.perfstepsend = ::netgen::MESHCONST_OPTSURFACE;
  return parameters;
}

struct NetgenSession::Saved {
  ::netgen::MeshingParameters parameters = ::netgen::mparam;
  int message_level = ::netgen::printmessage_importance;
  std::ostream* messages = ::netgen::mycout;
  std::ostream* errors = ::netgen::myerr;
  std::ostream* test = ngcore::testout;

  NullBuffer null_buffer{};
  KeepingBuffer keeping_buffer{};
  std::ostream null_stream{&null_buffer};
  std::ostream keeping_stream{&keeping_buffer};
  ListeningBuffer listening_buffer{};
  std::ostream listening_stream{&listening_buffer};
};

NetgenSession::NetgenSession(const ::netgen::MeshingParameters& parameters)
    : saved_(std::make_unique<Saved>())
{
  ::netgen::mparam = parameters;
  use_one_thread(::netgen::mparam);
  ::netgen::printmessage_importance = kMainSteps;
  ::netgen::mycout = &std::cout;
  ::netgen::myerr = &saved_->keeping_stream;
  ngcore::testout = &saved_->null_stream;
  ::netgen::multithread.terminate = 0;
}

NetgenSession::~NetgenSession()
{
  ::netgen::mparam = saved_->parameters;
  ::netgen::printmessage_importance = saved_->message_level;
  ::netgen::mycout = saved_->messages;
  ::netgen::myerr = saved_->errors;
  ngcore::testout = saved_->test;
}

::netgen::MeshingParameters& NetgenSession::parameters() { return ::netgen::mparam; }

std::string NetgenSession::words() const { return on_one_line(saved_->keeping_buffer.kept()); }

void NetgenSession::forget_words() { saved_->keeping_buffer.clear(); }

void NetgenSession::begin_listening()
{
  saved_->listening_buffer.forget();
  ::netgen::mycout = &saved_->listening_stream;
  ::netgen::printmessage_importance = kEveryThousandTrials;
}

// What NETGEN itself threw after it was asked to stop says less than why it was asked.
void NetgenSession::end_listening()
{
  ::netgen::mycout = &std::cout;
  ::netgen::printmessage_importance = kMainSteps;
  ::netgen::multithread.terminate = 0;
  const std::string& verdict = saved_->listening_buffer.verdict();
  if (!verdict.empty()) throw NetgenError(verdict);
}

void NetgenSession::throw_translated(const std::string& what) const
{
  try {
    throw;
  } catch (const Error&) {
    throw;
  } catch (...) {
    const std::string said = words();
    throw NetgenError(fmt::format("{}: {}{}", what, on_one_line(message_of_current_exception()),
                                  said.empty() ? "" : fmt::format(" ({})", said)));
  }
}

}  // namespace tessera::netgen
