// SPDX-License-Identifier: BSD-3-Clause
// Writes the man page or the completion for bash from the command line that the program parses.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/version.hpp"
#include "tessera/config/case.hpp"

#include "pipeline/commands/cli.hpp"
#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {
namespace {

// ---- man page: troff with the macros of man(7) ----

struct ExitMeaning {
  ExitCode code;
  std::string_view meaning;
};

constexpr std::array<ExitMeaning, 7> kExitMeanings{
    {{ExitCode::ok, "All went well."},
     {ExitCode::failed, "There is no valid mesh. Of check: the mesh does not conform."},
     {ExitCode::degraded,
      "A valid mesh is saved, but it misses something that was asked for; report.json says what."},
     {ExitCode::wrong_input, "The command line, the case file or an input file is wrong."},
     {ExitCode::internal, "Internal error, please report it."},
     {ExitCode::cannot_write, "Cannot write: permission, disk full, folder in use."},
     {ExitCode::stopped, "Stopped by a signal; of mesh, --resume goes on."}}};

// Every hyphen may be one that somebody wants to copy, and no option is cut in two.
std::string troff(std::string_view text)
{
  std::string escaped;
  char previous = ' ';
  for (const char character : text) {
    if (character == '\\') {
      escaped += "\\e";
    } else if (character == '-') {
      escaped += previous == ' ' ? "\\%\\-" : "\\-";
    } else if (character == '|') {
      escaped += "|\\:";  // A line may break here.
    } else if (character == '`') {
      escaped += "\\(aq";
    } else {
      escaped += character;
    }
    previous = character;
  }
  return escaped;
}

// A line of text; one that begins with a dot or a quote is none.
void put_text(std::ostream& out, std::string_view text)
{
  if (text.starts_with('.') || text.starts_with('\'')) out << "\\&";
  out << troff(text) << '\n';
}

void put_sentence(std::ostream& out, std::string text)
{
  if (!text.ends_with('.')) text += '.';
  put_text(out, text);
}

void put_option(std::ostream& out, const OptionHelp& option)
{
  out << ".TP\n";
  std::string_view between;
  for (const std::string& name : option.names) {
    out << between << "\\fB" << troff(name) << "\\fR";
    between = ", ";
  }
  if (!option.names.empty() && !option.value.empty()) out << ' ';
  if (!option.value.empty()) out << "\\fI" << troff(option.value) << "\\fR";
  out << '\n';
  put_sentence(out, option.meaning);
}

std::string call_of(const CommandHelp& command)
{
  std::string call = "tessera " + command.name;
  for (const OptionHelp& argument : command.arguments) call += " " + argument.value;
  return call;
}

void put_synopsis(std::ostream& out, const std::vector<CommandHelp>& all)
{
  out << ".SH SYNOPSIS\n.nf\n";
  for (std::size_t i = 1; i < all.size(); ++i) {
    out << "\\fBtessera " << troff(all[i].name) << "\\fR [\\fIOPTION\\fR]...";
    for (const OptionHelp& argument : all[i].arguments) {
      out << " \\fI" << troff(argument.value) << "\\fR";
    }
    out << '\n';
  }
  out << "\\fBtessera\\fR \\-\\-help | \\-\\-version\n.fi\n";
}

void put_lines(std::ostream& out, const std::string& text)
{
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) put_text(out, line);
  }
}

std::string man_page(const std::vector<CommandHelp>& all)
{
  std::ostringstream out;
  out << ".TH TESSERA 1 \"\" \"tessera " << version() << "\" \"User Commands\"\n"
      << ".SH NAME\ntessera \\- parallel tetrahedral mesh generator\n";
  put_synopsis(out, all);
  out << ".SH DESCRIPTION\n";
  put_lines(out, all.front().meaning);
  out << ".SH OPTIONS\n";
  for (const OptionHelp& option : all.front().options) put_option(out, option);
  out << ".SH COMMANDS\n";
  for (std::size_t i = 1; i < all.size(); ++i) {
    out << ".SS " << troff(call_of(all[i])) << '\n';
    put_sentence(out, all[i].meaning);
    for (const OptionHelp& argument : all[i].arguments) put_option(out, argument);
    for (const OptionHelp& option : all[i].options) put_option(out, option);
  }
  out << ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : kExitMeanings) {
    out << ".TP\n" << static_cast<int>(exit.code) << '\n';
    put_text(out, exit.meaning);
  }
  out << ".SH FILES\n";
  put_text(out, "Below the prefix of the installation, share/doc/tessera has the user guide,");
  put_text(out, "and share/tessera has examples of cases and reference.toml with every key.");
  out << ".SH SEE ALSO\n.BR mpirun (1)\n";
  return out.str();
}

// ---- completion for bash ----

// What does not depend on the commands. `value` is what stands before the cursor.
constexpr std::string_view kBashHead = R"(# Completion for bash: source this file, or install it as
# share/bash-completion/completions/tessera.

_tessera_words()
{
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$value")
}

# Folders, and files whose names end with one of the arguments.
_tessera_files()
{
  local ending
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    {
      compgen -d -- "$value"
      for ending in "$@"; do compgen -f -X "!*$ending" -- "$value"; done
    } | sort -u
  )
}

# KEY=VALUE
_tessera_set()
{
  local key=${value%%=*}
  if [[ $value != *=* ]]; then
    compopt -o nospace 2>/dev/null
    _tessera_words "$_tessera_keys"
    COMPREPLY=("${COMPREPLY[@]/%/=}")
    return
  fi
  value=${value#*=}
)";

constexpr std::string_view kBashMiddle = R"(
_tessera()
{
  local value word option='' command='' i
  local -a words=()
  COMPREPLY=()
  # Bash cuts words at "=": put them together again.
  for ((i = 1; i <= COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if ((${#words[@]} > 0)) && [[ $word == = || ${words[-1]} == *= ]]; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
  done
  value=${words[-1]}
  for word in "${words[@]::${#words[@]}-1}"; do
    [[ -n $command || $word == -* ]] || command=$word
    option=$word
  done
  if [[ $value == --*=* ]]; then
    option=${value%%=*}
    value=${value#*=}
  fi
)";

constexpr std::string_view kBashEnd = "}\n\ncomplete -F _tessera tessera\n";

std::string joined(const std::vector<std::string>& words, std::string_view between)
{
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : std::string(between)) + word;
  return text;
}

std::string names_of(const std::vector<OptionHelp>& options)
{
  std::vector<std::string> names;
  for (const OptionHelp& option : options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return joined(names, " ");
}

// What completes a value, as its placeholder says: words "a|b", a folder "DIR", a file with an
// ending "MESH.pvtu", "CASE.toml|MODEL", any "FILE"; nothing for others.
std::string completion_of(const std::string& value)
{
  if (value == "TABLE.KEY=VALUE") return "_tessera_set";
  if (value == "FILE") return "_tessera_files ''";
  if (value.starts_with("DIR")) return "_tessera_files";
  if (value.ends_with(".png")) return "_tessera_files .png";
  if (value.ends_with(".html")) return "_tessera_files .html";
  if (value.ends_with(".pvtu")) return "_tessera_files .pvtu .vtu";
  if (value == "CASE.toml|MODEL")
    return "_tessera_files .toml .step .stp .iges .igs .brep .stl .geo";
  if (value.find('|') == std::string::npos) return ":";
  std::string words = value;
  std::ranges::replace(words, '|', ' ');
  return "_tessera_words '" + words + "'";
}

void put_values(std::ostream& out, const std::vector<OptionHelp>& options)
{
  out << "      case $option in\n";
  for (const OptionHelp& option : options) {
    if (option.value.empty()) continue;
    out << "        " << joined(option.names, " | ") << ") " << completion_of(option.value)
        << "; return ;;\n";
  }
  out << "      esac\n";
}

void put_command(std::ostream& out, const CommandHelp& command)
{
  out << "    " << (command.name.empty() ? "''" : command.name) << ")\n";
  const auto takes_value = [](const OptionHelp& option) { return !option.value.empty(); };
  if (std::ranges::any_of(command.options, takes_value)) put_values(out, command.options);
  out << "      if [[ $value == -* ]]; then\n"
      << "        _tessera_words '" << names_of(command.options) << "'\n"
      << "        return\n"
      << "      fi\n";
  for (const OptionHelp& argument : command.arguments) {
    out << "      " << completion_of(argument.value) << '\n';
  }
}

void put_keys(std::ostream& out)
{
  out << "  case $key in\n";
  std::vector<std::string> names;
  for (const config::KnownKey& key : config::known_keys()) {
    names.emplace_back(key.name);
    const std::vector<std::string> words(key.words.begin(), key.words.end());
    if (!words.empty())
      out << "    " << key.name << ") _tessera_words '" << joined(words, " ") << "' ;;\n";
    if (key.is_path) out << "    " << key.name << ") _tessera_files '' ;;\n";
  }
  out << "  esac\n}\n_tessera_keys='" << joined(names, " ") << "'\n";
}

std::string bash_completion(const std::vector<CommandHelp>& all)
{
  std::ostringstream out;
  out << kBashHead;
  put_keys(out);
  out << kBashMiddle << "  case $command in\n";
  std::vector<std::string> commands;
  for (const CommandHelp& command : all) {
    put_command(out, command);
    if (!command.name.empty()) commands.push_back(command.name);
    out << "      ;;\n";
  }
  out << "  esac\n"
      << "  [[ -n $command ]] || _tessera_words '" << joined(commands, " ") << "'\n"
      << kBashEnd;
  return out.str();
}

int write(const std::string& file, const std::string& text)
{
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (stream) return EXIT_SUCCESS;
  std::cerr << file << ": cannot be written\n";
  return EXIT_FAILURE;
}

}  // namespace
}  // namespace tessera::pipeline

int main(int argc, char** argv)
{
  using namespace tessera::pipeline;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool is_man = arguments.size() == 2 && arguments.front() == "man";
  const bool is_bash = arguments.size() == 2 && arguments.front() == "bash";
  if (!is_man && !is_bash) {
    std::cerr << "usage: make_command_help man|bash FILE\n";
    return EXIT_FAILURE;
  }
  const std::vector<CommandHelp> all = describe_command_line();
  return write(arguments.back(), is_man ? man_page(all) : bash_completion(all));
}
