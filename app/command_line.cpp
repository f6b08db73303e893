#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <new>
#include <sstream>

#include "app/command_description.hpp"
#include "app/command_sweep.hpp"
#include "app/completion.hpp"
#include "app/doctor.hpp"
#include "app/inspect_command.hpp"
#include "app/lobes_input.hpp"
#include "app/log.hpp"
#include "app/manual_page.hpp"
#include "app/reduce_command.hpp"
#include "app/terminal.hpp"
#include "app/unknown_word.hpp"
#include "case/checks.hpp"
#include "case/json_schema.hpp"
#include "case/reader.hpp"
#include "case/templates.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "report/compare.hpp"
#include "report/lobes_report.hpp"
#include "report/page/page.hpp"
#include "report/page/phases.hpp"
#include "report/result_folder.hpp"
#include "report/robot_report.hpp"
#include "report/terminal_report.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_geometry.hpp"
#include "study/part/discretisation.hpp"
#include "study/support/robot_survey.hpp"

namespace thinwall::app {

namespace {

using core::ExitCode;

/// Everything that the words of the command line can carry.
struct Arguments {
  std::string case_path, out, template_name = "plate", folder, left, right, html;
  std::string progress = "auto", shell, schema = "case";
  std::vector<std::string> overrides, points;
  LobesInput lobes;
  ReduceRequest reduce;
  InspectRequest inspect;
  report::PhasesRequest phases;
  SweepRequest sweep;
  MergeRequest merge;
  bool fresh = false, quiet = false, verbose = false;
  int threads = 0;
  double tolerance = 1e-9;
};

std::vector<milling::OperatingPoint> operating_points(const Arguments& arguments) {
  std::vector<milling::OperatingPoint> points;
  for (const auto& text : arguments.points) points.push_back(operating_point(text));
  return points;
}

/// Sets the log up as -q, -v and --progress ask for it; returns how stages are shown.
ProgressDisplay start_log(const Arguments& arguments) {
  const ProgressDisplay display = progress_display(arguments.progress, arguments.quiet);
  const bool lines_in_spite_of_quiet = arguments.quiet && display == ProgressDisplay::lines;
  log_to_terminal(arguments.quiet && !lines_in_spite_of_quiet ? -1
                  : arguments.verbose                         ? 1
                                                              : 0,
                  display == ProgressDisplay::line);
  return display;
}

/// Computes a case into its result folder; `report` makes the text for the terminal.
template <typename Report>
ExitCode compute(const Arguments& arguments, const cases::Case& source, const RunCase& run_case, std::ostream& out,
                 const Report& report) {
  const int verbosity = arguments.quiet ? -1 : arguments.verbose ? 1 : 0;
  const ProgressDisplay display = start_log(arguments);
  if (arguments.threads > 0) core::set_thread_count(arguments.threads);
  const std::vector<milling::OperatingPoint> points = operating_points(arguments);
  const report::ResultFolder folder(arguments.out.empty() ? report::default_result_folder(source.name)
                                                          : std::filesystem::path(arguments.out));
  log_to_file(folder.path() / "run.log");
  const RunResult result =
      run_case(source, {folder.path(), arguments.fresh, verbosity, display == ProgressDisplay::line, points,
                        display == ProgressDisplay::lines});
  out << coloured(report(result.summary, folder.path().string()), style_for(out));
  return result.expectations_hold ? ExitCode::done : ExitCode::expectation;
}

ExitCode run(const Arguments& arguments, const RunCase& run_case, std::ostream& out) {
  return compute(arguments, cases::read_case(arguments.case_path, arguments.overrides), run_case, out,
                 report::terminal_report);
}

ExitCode lobes(const Arguments& arguments, const RunCase& run_case, std::ostream& out) {
  LobesInput input = arguments.lobes;
  input.overrides = arguments.overrides;
  return compute(arguments, lobes_case(input), run_case, out, report::lobes_report);
}

ExitCode robot(const Arguments& arguments, std::ostream& out) {
  const cases::Case source = cases::read_case(arguments.case_path, arguments.overrides);
  const study::RobotSurvey found = study::survey(study::survey_input(source));
  const report::ResultFolder folder(arguments.out.empty() ? report::default_result_folder(source.name)
                                                          : std::filesystem::path(arguments.out));
  log_to_file(folder.path() / "run.log");  // marks the folder as ours
  report::write_survey(folder.path(), source, found);
  if (found.tips.empty())
    throw core::InputError("the robot reaches none of the places; at the first, " + found.out_of_reach.front().reason);
  if (!source.title.empty()) out << source.title << '\n';
  out << report::survey_text(found) << "  tables: " << (folder.path() / "robot").string() << '\n';
  return ExitCode::done;
}

ExitCode reduce(const Arguments& arguments, std::ostream& out) {
  ReduceRequest request = arguments.reduce;
  request.display = start_log(arguments);
  out << reduce_part(cases::read_case(arguments.case_path, arguments.overrides), request);
  return ExitCode::done;
}

ExitCode inspect(const Arguments& arguments, std::ostream& out) {
  const Inspection inspection = inspect(arguments.inspect);
  out << inspection.text;
  return inspection.trustworthy ? ExitCode::done : ExitCode::expectation;
}

ExitCode check(const Arguments& arguments, std::ostream& out) {
  const cases::Case source = cases::read_case(arguments.case_path, arguments.overrides);
  const auto expectations = cases::read_expectations(source.file);
  out << source.file.string() << ": no errors\n";
  if (!source.title.empty()) out << "  " << source.title << '\n';
  if (source.part && source.part->imported) {
    out << "  part      " << source.part->imported->said << '\n';
    for (const auto& note : source.part->imported->notes) out << "            " << note << '\n';
  }
  if (source.part) {
    const cases::SizeEstimate size = cases::estimate_size(source);
    const auto rounded = [](double value) { return core::readable_text(value, core::kind::number); };
    if (size.elements > 0.0)
      out << "  elements  about " << rounded(size.elements) << " of order " << size.order << ", "
          << (source.part->shape == setup::PartShape::mesh ? "as the file has them"
              : source.part->mesh.element_size
                  ? "size " + core::readable_text(*source.part->mesh.element_size, core::kind::length)
                  : "size and order from the tolerance of " + rounded(source.part->mesh.tolerance))
          << '\n';
    out << "  DOFs      about " << rounded(size.dofs) << '\n'
        << "  time      about " << core::readable_text(std::max(1.0, size.seconds), core::kind::time)
        << " for mesh, modes and reduction on two cores\n";
    for (const std::string& warning : setup::unreachable_tolerances(source)) out << "  warning   " << warning << '\n';
  }
  if (source.lobes) out << "  lobes     " << source.lobes->count << " speeds\n";
  if (!expectations.empty()) out << "  expected  " << expectations.size() << " figures\n";
  return ExitCode::done;
}

ExitCode compare(const Arguments& arguments, std::ostream& out) {
  constexpr std::size_t shown = 20;
  const report::Comparison comparison = report::compare_results(arguments.left, arguments.right, arguments.tolerance);
  for (std::size_t i = 0; i < std::min(shown, comparison.differences.size()); ++i) {
    const auto& difference = comparison.differences[i];
    out << difference.where << ": " << difference.left << " against " << difference.right << '\n';
  }
  if (comparison.differences.size() > shown) out << "and " << comparison.differences.size() - shown << " more\n";
  out << comparison.numbers << " numbers compared, " << comparison.differences.size() << " differences\n";
  if (!arguments.html.empty()) {
    report::write_page(arguments.html, {{arguments.left, arguments.right}, program_name()});
    out << "wrote " << arguments.html << '\n';
    return ExitCode::done;
  }
  return comparison.differences.empty() ? ExitCode::done : ExitCode::expectation;
}

ExitCode print_schema(const std::string& file, std::ostream& out) {
  if (file != "case" && file != "expected" && file != "joints")
    throw core::UsageError("there is no schema of \"" + file + "\"; there are case, expected, joints");
  const cases::Schema& schema = file == "case"       ? cases::case_schema()
                                : file == "expected" ? cases::expectation_schema()
                                                     : cases::joints_schema();
  out << cases::json_schema(schema, file == "joints" ? "joints beside a URDF" : file + ".toml of thinwall").dump(2)
      << '\n';
  return ExitCode::done;
}

ExitCode remake_report(const Arguments& arguments, std::ostream& out) {
  const std::filesystem::path results = arguments.folder;
  const std::filesystem::path file =
      arguments.out.empty() ? results / "report.html" : std::filesystem::path(arguments.out);
  report::write_page(file, {{results}, program_name()});
  out << "wrote " << file.string() << '\n';
  return ExitCode::done;
}

ExitCode animate(const Arguments& arguments, std::ostream& out) {
  report::require_results(arguments.folder);
  const std::filesystem::path file = report::write_phases(arguments.folder, arguments.phases);
  out << "wrote " << file.string() << "; open it in ParaView and press play\n";
  return ExitCode::done;
}

/// "plate|wall": help, completion and the man page know the choices of an option by its type.
std::string alternatives(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : "|") + name;
  return list;
}

void add_overrides(CLI::App& command, Arguments& arguments) {
  command.add_option("--set", arguments.overrides, "a value put over the case: --set part.element_size=\"8 mm\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_case_arguments(CLI::App& command, Arguments& arguments) {
  command.add_option("CASE", arguments.case_path, "a folder with a case.toml, or the file")
      ->type_name("PATH")
      ->required();
  add_overrides(command, arguments);
}

void add_log_arguments(CLI::App& command, Arguments& arguments) {
  auto* quiet = command.add_flag("-q,--quiet", arguments.quiet, "log warnings only");
  command.add_flag("-v,--verbose", arguments.verbose, "log everything")->excludes(quiet);
  command.add_option("--progress", arguments.progress, "stage, count and time left (default: auto, not with -q)")
      ->type_name("auto|always|never");
}

/// Options that `run` and `lobes` have in common.
void add_run_arguments(CLI::App& command, Arguments& arguments) {
  command.add_flag("--fresh", arguments.fresh, "compute everything anew, whatever an earlier run left");
  command.add_option("--out", arguments.out, "result folder (default: results/<case>)")->type_name("DIR");
  command
      .add_option("--at", arguments.points,
                  "an operating point, several times: --at \"5000 rpm, 0.5 mm\"; stable or not, and the margins")
      ->type_name("\"SPEED, DEPTH\"")
      ->allow_extra_args(false);
  add_log_arguments(command, arguments);
  command.add_option("--threads", arguments.threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
}

void describe_lobes(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand("lobes", "stability lobes of a case, of measured tool-tip FRFs or of modes");
  command
      ->add_option("INPUT", arguments.lobes.sources,
                   "a case; or CSV files and --tool: a table of modes (frequency_hz, damping_ratio, stiffness or mass, "
                   "direction), or FRFs of the tool tip (frequency, real, imaginary), each FILE or ENTRY=FILE: x=FILE "
                   "y=FILE xy=FILE for response and force in the part's axes. FILE alone is x: "
                   "entries that are not given are zero, so that one file moves along x only")
      ->type_name("FILE")
      ->required();
  command->add_option("--tool", arguments.lobes.tool, "TOML with the tables [tool], [cutting], [lobes] of a case")
      ->type_name("FILE");
  command->add_option("--quantity", arguments.lobes.quantity, "what FRFs are")
      ->type_name("receptance|mobility|accelerance");
  command->add_option("--unit", arguments.lobes.unit, "of FRFs: m/N, um/N, m/s/N, m/s^2/N …")->type_name("UNIT");
  command->add_option("--frequency-unit", arguments.lobes.frequency_unit, "of FRFs (default: Hz)")
      ->type_name("Hz|rad/s");
  add_overrides(*command, arguments);
  add_run_arguments(*command, arguments);
}

void describe_reduce(CLI::App& app, Arguments& arguments) {
  ReduceRequest& reduce = arguments.reduce;
  auto* command = app.add_subcommand("reduce", "the part of a case as a small model, its error and a report on it");
  add_case_arguments(*command, arguments);
  command->add_option("-o,--out", reduce.out, "folder for the model (default: model)")->type_name("DIR");
  command->add_option("--method", reduce.method, "how it is reduced (default: craig_bampton)")
      ->type_name("guyan|craig_bampton|characteristic_constraint_modes|rubin|macneal|craig_chang|dual_craig_bampton");
  auto* modes = command->add_option("--modes", reduce.modes, "elastic modes kept")->check(CLI::Range(0, 2000));
  command
      ->add_option("--tolerance", reduce.tolerance,
                   "as many modes as the receptance of the points needs, relative, over the band (default: 0.01)")
      ->excludes(modes);
  command->add_option("--from", reduce.from_hz, "lower end of the band, Hz (default: response.from)");
  command->add_option("--to", reduce.to_hz, "upper end of the band, Hz (default: response.to)");
  command->add_option("--characteristic", reduce.characteristic, "amplitudes of a reduced interface")
      ->check(CLI::Range(1, 2000));
  command->add_flag("--compare", reduce.compare, "a table of all methods at this size");
  add_log_arguments(*command, arguments);
}

void describe_inspect(CLI::App& app, Arguments& arguments) {
  InspectRequest& inspect = arguments.inspect;
  io::MatrixFiles& files = inspect.files;
  auto* command = app.add_subcommand("inspect", "may a reduced or imported model be trusted? (exit 6: it may not)");
  auto* model = command->add_option("MODEL", inspect.model, "a folder of \"thinwall reduce\", or a MAT file in SI")
                    ->type_name("FILE");
  command
      ->add_option("--stiffness", files.stiffness,
                   "K in place of MODEL: Matrix Market, .sti of CalculiX, Abaqus, DMIG, MAT (docs/matrices.md)")
      ->type_name("FILE")
      ->excludes(model);
  command->add_option("--mass", files.mass, "M, where it is in a file of its own")->type_name("FILE");
  command->add_option("--damping", files.damping, "C, likewise")->type_name("FILE");
  command->add_option("--dofs", files.dofs, "which row is which: .dof of CalculiX, or CSV")->type_name("FILE");
  command->add_option("--positions", files.positions, "where the nodes are: .inp, or CSV")->type_name("FILE");
  command->add_option("--unit", files.length_unit, "unit of length of the files: mm, m")->type_name("UNIT");
  command->add_option("--mass-unit", files.mass_unit, "unit of mass of the files: t, kg")->type_name("UNIT");
  command->add_option("--rigid-motions", inspect.rigid_motions, "how many must be free: 0 held, 6 free")
      ->check(CLI::Range(0, 6));
  command->add_option("--json", inspect.json, "the report as JSON")->type_name("FILE");
}

void describe_for_the_shell(CLI::App& app, Arguments& arguments) {
  auto* completion = app.add_subcommand("completion", "print a script that completes thinwall's words in a shell");
  completion->add_option("SHELL", arguments.shell, "the shell")
      ->type_name(alternatives(completed_shells()))
      ->required();
  app.add_subcommand("man", "print the manual page: thinwall man | man -l -");
  auto* schema = app.add_subcommand("schema", "print the JSON Schema of a case, for editors that check TOML by one");
  schema->add_option("FILE", arguments.schema, "of which file (default: case)")->type_name("case|expected|joints");
}

void describe(CLI::App& app, Arguments& arguments) {
  app.require_subcommand(1);
  app.set_version_flag("--version", program_name());
  auto* run_command = app.add_subcommand("run", "compute a case");
  add_case_arguments(*run_command, arguments);
  add_run_arguments(*run_command, arguments);
  describe_lobes(app, arguments);
  auto* robot_command = app.add_subcommand(
      "robot", "modes and stiffness of the robot's tip in its posture, along a path, over a workspace");
  add_case_arguments(*robot_command, arguments);
  robot_command->add_option("--out", arguments.out, "result folder (default: results/<case>)")->type_name("DIR");
  add_case_arguments(*app.add_subcommand("check", "report every error of a case, and sizes to expect"), arguments);
  describe_reduce(app, arguments);
  describe_inspect(app, arguments);
  describe_sweep(app, arguments.sweep, arguments.merge);
  auto* init = app.add_subcommand("init", "write a commented case to start from");
  init->add_option("--template", arguments.template_name, "what to start from (default: plate)")
      ->type_name(alternatives(cases::template_names()));
  init->add_option("DIR", arguments.folder, "folder for the case (default: the template's name)")->type_name("DIR");
  auto* compare_command = app.add_subcommand("compare", "compare two result folders, number by number");
  compare_command->add_option("A", arguments.left, "result folder")->type_name("DIR")->required();
  compare_command->add_option("B", arguments.right, "result folder")->type_name("DIR")->required();
  compare_command->add_option("--tolerance", arguments.tolerance, "relative tolerance, from 0 on (default: 1e-9)");
  compare_command->add_option("--html", arguments.html, "both on one page, in this file; the exit code is 0 then")
      ->type_name("FILE");
  auto* report_command = app.add_subcommand("report", "make report.html of a result folder anew");
  report_command->add_option("RESULTS", arguments.folder, "result folder")->type_name("DIR")->required();
  report_command->add_option("--out", arguments.out, "the page (default: RESULTS/report.html)")->type_name("FILE");
  auto* animate_command = app.add_subcommand("animate", "a mode shape in sixteen phases, which ParaView plays at once");
  animate_command->add_option("RESULTS", arguments.folder, "result folder")->type_name("DIR")->required();
  animate_command->add_option("--mode", arguments.phases.mode, "its number (default: 1)");
  animate_command->add_option("--of", arguments.phases.of, "part (default) or coupled: with the robot")
      ->type_name("part|coupled");
  animate_command->add_option("--amplitude", arguments.phases.amplitude,
                              "largest displacement over the part's diagonal (default: 0.1)");
  describe_for_the_shell(app, arguments);
  app.add_subcommand("doctor", "versions, libraries, threads, optional parts, and a self-test (exit 5: it fails)");
}

ExitCode execute(const CLI::App& app, const Arguments& arguments, const RunCase& run_case, std::ostream& out) {
  if (app.got_subcommand("run")) return run(arguments, run_case, out);
  if (app.got_subcommand("lobes")) return lobes(arguments, run_case, out);
  if (app.got_subcommand("robot")) return robot(arguments, out);
  if (app.got_subcommand("reduce")) return reduce(arguments, out);
  if (app.got_subcommand("inspect")) return inspect(arguments, out);
  if (app.got_subcommand("check")) return check(arguments, out);
  if (app.got_subcommand("sweep")) return run_sweep(arguments.sweep, run_case, out);
  if (app.got_subcommand("merge")) return merge_sweeps(arguments.merge.folders, arguments.merge.out, out);
  if (app.got_subcommand("compare")) return compare(arguments, out);
  if (app.got_subcommand("animate")) return animate(arguments, out);
  if (app.got_subcommand("report")) return remake_report(arguments, out);
  if (app.got_subcommand("init")) {
    const auto folder = arguments.folder.empty() ? arguments.template_name : arguments.folder;
    const auto file = cases::write_template(arguments.template_name, folder);
    out << "wrote " << file.string() << "; compute it with: thinwall run " << file.parent_path().string() << '\n';
    return ExitCode::done;
  }
  if (app.got_subcommand("completion")) {
    out << completion_script(description_of(app), arguments.shell);
    return ExitCode::done;
  }
  if (app.got_subcommand("man")) {
    out << manual_page(description_of(app));
    return ExitCode::done;
  }
  if (app.got_subcommand("schema")) return print_schema(arguments.schema, out);
  const Diagnosis found = diagnosis();
  out << found.text;
  return found.works ? ExitCode::done : ExitCode::numerical;
}

/// Every line of the message behind "thinwall: ".
void report(std::ostream& err, const std::string& message) {
  const Style style = style_for(err);
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) err << style.bad("thinwall:") << " " << line << '\n';
}

/// CLI11 has exit codes of its own (105, 106, …): help and version are 0, all else is a usage error.
ExitCode parse(CLI::App& app, int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  try {
    app.parse(argc, argv);
    return ExitCode::done;
  } catch (const CLI::Success& success) {
    app.exit(success, out, err);
    throw;
  } catch (const CLI::ParseError& error) {
    const std::string unknown = unknown_word(description_of(app), {argv + 1, argv + argc});
    report(err, unknown.empty() ? std::string(error.what()) + "; \"thinwall --help\" lists the commands" : unknown);
    return ExitCode::usage;
  }
}

/// Every problem of a case with what it points at beneath.
void report(std::ostream& err, const cases::CaseError& error) {
  for (const cases::Problem& problem : error.problems) {
    report(err, cases::problem_line(error.source.name, problem));
    err << cases::excerpt(error.source, problem);
  }
}

int guarded(const std::function<ExitCode()>& command, std::ostream& err) {
  try {
    return static_cast<int>(command());
  } catch (const cases::CaseError& error) {
    report(err, error);
    return static_cast<int>(error.code());
  } catch (const core::Error& error) {
    report(err, error.what());
    return static_cast<int>(error.code());
  } catch (const CLI::Success&) {
    return static_cast<int>(ExitCode::done);
  } catch (const std::bad_alloc&) {
    report(err, "out of memory; take larger elements or fewer modes");
    return static_cast<int>(ExitCode::numerical);
  } catch (const std::filesystem::filesystem_error& error) {
    report(err, std::string(error.what()) + "; check that the folder is there and may be read and written");
    return static_cast<int>(ExitCode::unreadable_data);
  } catch (const std::exception& error) {
    report(err, std::string("internal error: ") + error.what());
    return static_cast<int>(ExitCode::internal);
  } catch (...) {
    report(err, "internal error of an unknown kind");
    return static_cast<int>(ExitCode::internal);
  }
}

extern "C" void on_signal(int signal) {
  core::request_interrupt();
  std::signal(signal, SIG_DFL);
}

}  // namespace

int run_command_line(int argc, const char* const* argv, const RunCase& run_case, std::ostream& out, std::ostream& err) {
  return guarded(
      [&] {
        Arguments arguments;
        CLI::App app("What a thin-walled part will do under the cutter, and which speeds and depths are stable.",
                     "thinwall");
        describe(app, arguments);
        if (const ExitCode code = parse(app, argc, argv, out, err); code != ExitCode::done) return code;
        const ExitCode code = execute(app, arguments, run_case, out);
        out.flush();
        if (!out) throw core::DataError("cannot write to the standard output; free space or write elsewhere");
        return code;
      },
      err);
}

void install_signal_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

}  // namespace thinwall::app
