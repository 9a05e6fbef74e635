// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/cli.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/version.hpp"

namespace tessera::pipeline {
namespace {

constexpr const char* kPurpose = "Tessera turns a CAD model into a partitioned tetrahedral mesh.";

// What CLI11 writes into; becomes a Command when all went well.
struct Parsed {
  MeshCommand mesh{};
  std::string progress{word_of(MeshCommand{}.progress)};
  bool quiet = false;
  bool verbose = false;
  CheckCommand check{};
  RepartitionCommand repartition{};
  ConvertCommand convert{};
  InfoCommand info{};
  CompareCommand compare{};
  ReplayCommand replay{};
};

// CLI11's own conversion takes 010 for eight.
template <class Integer>
std::optional<Integer> whole_number(std::string_view text, Integer low, Integer high)
{
  Integer number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || number < low || number > high) {
    return std::nullopt;
  }
  return number;
}

int read_count(const std::string& option, const std::string& text, int low, int high)
{
  const auto count = whole_number(text, low, high);
  if (count) return *count;
  throw CLI::ValidationError(fmt::format("{} {}", option, text),
                             fmt::format("must be a whole number from {} to {}", low, high));
}

double read_size(const std::string& option, const std::string& text)
{
  constexpr double kLargest = 1e30;  // As size.target.
  double size = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, size);
  if (read.ec == std::errc() && read.ptr == end && size > 0.0 && size <= kLargest) return size;
  throw CLI::ValidationError(fmt::format("{} {}", option, text),
                             fmt::format("must be a number > 0 and <= {:g}", kLargest));
}

std::vector<LocalIndex> read_subdomains(const std::string& text)
{
  const auto fail = [&](const std::string& what) {
    throw CLI::ValidationError("--only-subdomains " + text, what);
  };
  std::vector<LocalIndex> subdomains;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto subdomain = whole_number(std::string_view(text).substr(begin, end - begin),
                                        LocalIndex{0}, std::numeric_limits<LocalIndex>::max());
    if (!subdomain) fail("must be whole numbers >= 0 with commas between, such as 0,7,8");
    subdomains.push_back(*subdomain);
    begin = end + 1;
  }
  std::ranges::sort(subdomains);
  const auto repeated = std::ranges::adjacent_find(subdomains);
  if (repeated != subdomains.end()) fail(fmt::format("names {} twice", *repeated));
  return subdomains;
}

CLI::Option* add_dry_run(CLI::App& mesh, MeshCommand& command)
{
  CLI::Option* dry_run = mesh.add_flag("--dry-run", command.dry_run,
                                       "Predict size, time and memory; mesh nothing finely");
  const auto take_ranks = [&command](const std::string& text) {
    constexpr int kMost = 1'000'000;
    command.predicted_ranks = read_count("--ranks", text, 1, kMost);
  };
  mesh.add_option_function<std::string>("--ranks", take_ranks,
                                        "With --dry-run: predict for so many ranks")
      ->type_name("N")
      ->needs(dry_run);
  return dry_run;
}

CLI::Validator not_empty()
{
  return {[](const std::string& text) {
            return text.empty() ? std::string("the name is empty") : std::string();
          },
          ""};
}

void add_folder_options(CLI::App& mesh, MeshCommand& command, CLI::Option* dry_run)
{
  mesh.add_option("--output", command.output, "Folder of the results, instead of output.directory")
      ->type_name("DIR")
      ->check(not_empty());
  CLI::Option* overwrite = mesh.add_flag("--overwrite", command.overwrite,
                                         "Use the output folder even if it is not empty");
  mesh.add_flag("--resume", command.resume,
                "Go on with the stopped run of this case in the output folder")
      ->excludes(overwrite)
      ->excludes(dry_run);
}

// In place of a case file.
void add_model_options(CLI::App& mesh, MeshCommand& command)
{
  const auto model = [&command]() -> ModelCase& {
    return command.model ? *command.model : command.model.emplace();
  };
  const auto take_size = [model](const std::string& text) {
    model().size = read_size("--size", text);
  };
  CLI::Option* size = mesh.add_option_function<std::string>(
      "--size", take_size, "With a model: the wanted edge length (size.target)");
  size->type_name("H");
  const auto take_parts = [model](const std::string& text) {
    constexpr int kMost = 1'000'000;
    model().parts = read_count("--parts", text, 1, kMost);
  };
  mesh.add_option_function<std::string>(
          "--parts", take_parts, "With a model: parts for a solver, a file each (output.parts)")
      ->type_name("P")
      ->needs(size);
  const auto take_kernel = [model](const std::string& word) {
    model().kernel = value_of<fill::KernelKind>(word);
  };
  const std::vector<std::string> words(kWords<fill::KernelKind>.begin(),
                                       kWords<fill::KernelKind>.end());
  mesh.add_option_function<std::string>("--kernel", take_kernel,
                                        "With a model: what fills subdomains (fill.kernel)")
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->check(CLI::IsMember(words).description(""))
      ->needs(size);
}

void add_progress(CLI::App& mesh, Parsed& parsed)
{
  const std::vector<std::string> words(kWords<ProgressMode>.begin(), kWords<ProgressMode>.end());
  mesh.add_option("--progress", parsed.progress, "Progress bars: on a terminal, always or never")
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->check(CLI::IsMember(words).description(""))
      ->capture_default_str();
}

void add_mesh(CLI::App& app, Parsed& parsed)
{
  CLI::App* mesh = app.add_subcommand("mesh", "Make a mesh from a case file or a CAD model");
  mesh->add_option("CASE.toml|MODEL", parsed.mesh.file,
                   "The case; configs/reference.toml has all keys. Or a CAD model, with --size")
      ->required();
  add_model_options(*mesh, parsed.mesh);
  // One value an occurrence: otherwise `--set a.b=1 case.toml` would swallow the case file.
  mesh->add_option("--set", parsed.mesh.overrides, "Override a key of the case; may be repeated")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
  mesh->add_flag("--dump-config", parsed.mesh.dump_config, "Print the resolved case and stop");
  CLI::Option* dry_run = add_dry_run(*mesh, parsed.mesh);
  add_folder_options(*mesh, parsed.mesh, dry_run);
  const auto take_subdomains = [&parsed](const std::string& text) {
    parsed.mesh.only_subdomains = read_subdomains(text);
  };
  mesh->add_option_function<std::string>(
          "--only-subdomains", take_subdomains,
          "Make and write these subdomains only; for fill.kernel=subdivide")
      ->type_name("I,J,...");
  add_progress(*mesh, parsed);
  CLI::Option* quiet = mesh->add_flag("-q,--quiet", parsed.quiet, "Print warnings and errors only");
  mesh->add_flag("-v,--verbose", parsed.verbose, "Print more")->excludes(quiet);
}

void add_check(CLI::App& app, Parsed& parsed)
{
  CLI::App* check = app.add_subcommand("check", "Verify a mesh from its files alone");
  check->add_option("MESH.pvtu", parsed.check.mesh_file, "A .pvtu or .vtu file of tets")
      ->required();
  check->add_flag("--partial", parsed.check.is_partial,
                  "Only some pieces of the mesh were made: open seams and holes in the ids are no "
                  "defects");
  check->add_flag("--json", parsed.check.json, "Print the findings as JSON");
}

void add_repartition(CLI::App& app, RepartitionCommand& command)
{
  CLI::App* repartition =
      app.add_subcommand("repartition", "Cut a mesh anew into balanced, connected pieces");
  repartition->add_option("MESH.pvtu", command.mesh_file, "A .pvtu or .vtu file of tets")
      ->required();
  const auto take_parts = [&command](const std::string& text) {
    constexpr int kMost = 10'000'000;
    command.num_parts = read_count("--parts", text, 1, kMost);
  };
  repartition->add_option_function<std::string>("--parts", take_parts, "Number of pieces")
      ->type_name("P")
      ->required();
  repartition->add_option("--output", command.output, "Folder of the new mesh")
      ->type_name("DIR")
      ->check(not_empty())
      ->required();
  const auto take_layers = [&command](const std::string& text) {
    constexpr int kMost = 100;
    command.num_ghost_layers = read_count("--ghost-layers", text, 0, kMost);
  };
  repartition
      ->add_option_function<std::string>(
          "--ghost-layers", take_layers,
          "Layers of copies of the neighbours' tets in each piece (vtkGhostType)")
      ->type_name("N");
  repartition->add_flag("--overwrite", command.overwrite,
                        "Use the output folder even if it is not empty");
}

void add_convert(CLI::App& app, ConvertCommand& command)
{
  CLI::App* convert = app.add_subcommand("convert", "Write a mesh in formats of solvers");
  convert->add_option("MESH.pvtu", command.mesh_file, "A .pvtu or .vtu file of tets")->required();
  const auto take_format = [&command](const std::string& word) {
    const io::Format format = *value_of<io::Format>(word);
    if (std::ranges::find(command.formats, format) != command.formats.end())
      throw CLI::ValidationError("--format " + word, "is given twice");
    command.formats.push_back(format);
  };
  std::vector<std::string> words(kWords<io::Format>.begin(), kWords<io::Format>.end());
  std::erase(words, word_of(io::Format::pvtu));
  convert
      ->add_option_function<std::string>("--format", take_format, "What to write; may be repeated")
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->check(CLI::IsMember(words).description(""))
      ->trigger_on_parse()
      ->take_all()
      ->required();
  const auto take_layers = [&command](const std::string& word) {
    command.layers = *value_of<io::LayerCells>(word);
  };
  const std::vector<std::string> layers(kWords<io::LayerCells>.begin(),
                                        kWords<io::LayerCells>.end());
  convert
      ->add_option_function<std::string>("--layers", take_layers,
                                         "What layers on walls are made of; prisms if not given")
      ->type_name(fmt::format("{}", fmt::join(layers, "|")))
      ->check(CLI::IsMember(layers).description(""))
      ->trigger_on_parse();
  convert->add_option("--output", command.output, "Folder of the files")
      ->type_name("DIR")
      ->check(not_empty())
      ->required();
  convert->add_flag("--overwrite", command.overwrite,
                    "Use the output folder even if it is not empty");
}

void add_info(CLI::App& app, Parsed& parsed)
{
  CLI::App* info = app.add_subcommand("info", "Say what a file holds");
  info->add_option("FILE", parsed.info.file, "A CAD model, case or mesh")->required();
  info->add_flag("--edges", parsed.info.edges, "Of a model: list its edges as well");
  info->add_flag("--json", parsed.info.json, "Of a model: print JSON, with all edges");
  info->add_option("--picture", parsed.info.picture,
                   "Of a model: draw it from two sides, with the numbers of its faces")
      ->type_name("FILE.png")
      ->check(not_empty());
  info->add_option("--html", parsed.info.html,
                   "Of a model or mesh: write a page to turn it and to point at it")
      ->type_name("FILE.html")
      ->check(not_empty());
}

void add_compare(CLI::App& app, CompareCommand& command)
{
  CLI::App* compare = app.add_subcommand("compare", "Show two runs side by side");
  compare->add_option("DIR_A", command.folder_a, "Output folder of a run")->required();
  compare->add_option("DIR_B", command.folder_b, "Output folder of another run")->required();
  compare
      ->add_option("--output", command.output,
                   "The page that is written; compare.html if not given")
      ->type_name("FILE.html")
      ->check(not_empty());
}

void add_replay(CLI::App& app, Parsed& parsed)
{
  CLI::App* replay = app.add_subcommand(
      "replay", "Run a job that failed once more, in this process, for a debugger");
  replay->add_option("DIR/failure/JOB", parsed.replay.folder, "What the run has kept of the job")
      ->required();
}

void set_up(CLI::App& app, Parsed& parsed)
{
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", "tessera " + std::string(version()), "Print the version");
  app.require_subcommand(1);
  app.footer(
      "Every command runs alone or under `mpirun -np N`, with the same result;\n"
      "that of repartition depends on N.\n"
      "`tessera COMMAND --help` says more.");
  add_mesh(app, parsed);
  add_check(app, parsed);
  add_repartition(app, parsed.repartition);
  add_convert(app, parsed.convert);
  add_info(app, parsed);
  add_compare(app, parsed.compare);
  add_replay(app, parsed);
  for (CLI::App* command : app.get_subcommands({})) command->footer("");
}

Command to_command(const CLI::App& app, Parsed parsed)
{
  if (app.got_subcommand("check")) return parsed.check;
  if (app.got_subcommand("repartition")) return parsed.repartition;
  if (app.got_subcommand("convert")) return parsed.convert;
  if (app.got_subcommand("info")) return parsed.info;
  if (app.got_subcommand("compare")) return parsed.compare;
  if (app.got_subcommand("replay")) return parsed.replay;
  parsed.mesh.progress = value_of<ProgressMode>(parsed.progress).value();
  if (parsed.quiet) parsed.mesh.verbosity = Verbosity::quiet;
  if (parsed.verbose) parsed.mesh.verbosity = Verbosity::verbose;
  return parsed.mesh;
}

std::string joined_names(const std::set<CLI::Option*>& options)
{
  std::set<std::string> names;  // By name: the pointers have another order in every process.
  for (const CLI::Option* option : options) names.insert(option->get_name());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

OptionHelp describe(const CLI::Option& option)
{
  OptionHelp help{.meaning = option.get_description()};
  for (const std::string& name : option.get_snames()) help.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) help.names.push_back("--" + name);
  const bool takes_value = option.get_items_expected_max() > 0;
  if (takes_value)
    help.value = option.get_positional() ? option.get_name(true) : option.get_type_name();
  const std::string needed = joined_names(option.get_needs());
  const std::string excluded = joined_names(option.get_excludes());
  if (!needed.empty()) help.meaning += "; needs " + needed;
  if (!excluded.empty()) help.meaning += "; excludes " + excluded;
  return help;
}

CommandHelp describe(const CLI::App& app)
{
  CommandHelp help{.name = app.get_parent() == nullptr ? "" : app.get_name(),
                   .meaning = app.get_description()};
  for (const CLI::Option* option : app.get_options()) {
    (option->get_positional() ? help.arguments : help.options).push_back(describe(*option));
  }
  return help;
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error)
{
  const auto commands = app.get_subcommands();
  const std::vector<std::string> strangers = app.remaining();
  std::string text = error.what();
  if (commands.empty() && !strangers.empty()) {
    text = "there is no command or option " + strangers.front();
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::string command = commands.empty() ? "" : " " + commands.front()->get_name();
  return fmt::format("wrong command line: {} (see `tessera{} --help`)", text, command);
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv)
{
  CLI::App app(kPurpose, "tessera");
  Parsed parsed;
  set_up(app, parsed);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return PrintCommand{app.help()};
  } catch (const CLI::CallForVersion& version) {
    return PrintCommand{version.what() + std::string("\n")};
  } catch (const CLI::ParseError& error) {
    throw ConfigError(usage_message(app, error));
  }
  return to_command(app, std::move(parsed));
}

std::vector<CommandHelp> describe_command_line()
{
  CLI::App app(kPurpose, "tessera");
  Parsed parsed;
  set_up(app, parsed);
  std::vector<CommandHelp> all{describe(app)};
  all.front().meaning += "\n" + app.get_footer();
  for (const CLI::App* command : app.get_subcommands({})) all.push_back(describe(*command));
  return all;
}

}  // namespace tessera::pipeline
