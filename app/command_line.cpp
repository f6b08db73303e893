#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>

#include "app/command_description.hpp"
#include "app/command_options.hpp"
#include "app/completion.hpp"
#include "app/doctor.hpp"
#include "app/forecast.hpp"
#include "app/inspect_command.hpp"
#include "app/lobes_input.hpp"
#include "app/log.hpp"
#include "app/manual_page.hpp"
#include "app/ranks_option.hpp"
#include "app/reduce_command.hpp"
#include "app/sweep/command_sweep.hpp"
#include "app/terminal.hpp"
#include "app/unknown_word.hpp"
#include "case/checks/doubts.hpp"
#include "case/reader.hpp"
#include "case/schema/json_schema.hpp"
#include "case/templates.hpp"
#include "core/atomic_file.hpp"
#include "core/message_line.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "report/compare.hpp"
#include "report/compared_answers.hpp"
#include "report/lobes/lobes_report.hpp"
#include "report/page/page.hpp"
#include "report/page/phases.hpp"
#include "report/postures/posture_summary.hpp"
#include "report/publish.hpp"
#include "report/result_folder.hpp"
#include "report/robot_report.hpp"
#include "report/summary/schema_of.hpp"
#include "report/summary/summary_schema.hpp"
#include "report/terminal_report.hpp"
#include "setup/identified/identify.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_geometry.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "study/support/robot_survey.hpp"

namespace thinwall::app {

namespace {

using core::ExitCode;

/// The points of --at, which the charts of the case reach.
std::vector<milling::OperatingPoint> operating_points(const Arguments& arguments, const cases::Case& source) {
  std::vector<milling::OperatingPoint> points;
  for (const auto& text : arguments.points) points.push_back(operating_point(text));
  try {
    study::require_chart_of(source, points);
  } catch (const core::InputError& error) {
    throw core::InputError(std::string("--at: ") + error.what());
  }
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

/// Calls `work`, whose complaints are about the value of the option.
template <typename Work>
auto with_option(const char* option, const Work& work) {
  try {
    return work();
  } catch (const core::UsageError& error) {
    throw core::UsageError(std::string(option) + ": " + error.what());
  }
}

/// Computes a case into its result folder; `report` makes the text for the terminal.
template <typename Report>
ExitCode compute(const Arguments& arguments, const cases::Case& source, const RunCase& run_case, std::ostream& out,
                 const Report& report) {
  const int verbosity = arguments.quiet ? -1 : arguments.verbose ? 1 : 0;
  const ProgressDisplay display = start_log(arguments);
  if (arguments.threads > 0) core::set_thread_count(arguments.threads);
  const std::vector<milling::OperatingPoint> points = operating_points(arguments, source);
  report::ResultFolder folder(arguments.out.empty() ? report::default_result_folder(source.name)
                                                    : std::filesystem::path(arguments.out));
  log_to_file(folder.path() / "run.log");
  messages_to_log();
  const auto ranks = start_ranks(arguments.ranks);
  const RunOptions options{folder.path(),
                           arguments.fresh,
                           verbosity,
                           display == ProgressDisplay::line,
                           points,
                           display == ProgressDisplay::lines,
                           {},
                           &folder};
  const RunResult result = report::unless_refused(folder, [&] { return run_case(source, options); });
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

ExitCode calibrate(const Arguments& arguments, const RunCase& run_case, std::ostream& out) {
  return compute(arguments, calibrated_case(arguments.case_path, arguments.overrides, arguments.calibrate), run_case,
                 out, report::lobes_report);
}

ExitCode validate(const Arguments& arguments, const RunCase& run_case, std::ostream& out) {
  start_log(arguments);
  if (arguments.threads > 0) core::set_thread_count(arguments.threads);
  const Validation validation = validate_cases(arguments.validate, run_case);
  out << validation.text;
  return validation.page_is_true ? ExitCode::done : ExitCode::expectation;
}

ExitCode robot(const Arguments& arguments, std::ostream& out) {
  cases::Case source = cases::read_case(arguments.case_path, arguments.overrides);
  setup::identify(source);
  const study::RobotSurvey found = study::survey(study::survey_input(source));
  const report::ResultFolder folder(arguments.out.empty() ? report::default_result_folder(source.name)
                                                          : std::filesystem::path(arguments.out));
  log_to_file(folder.path() / "run.log");  // marks the folder as ours
  const auto staging = core::partial_path(folder.path() / "survey");
  report::write_survey(staging, source, found);
  report::publish_folder(staging / "robot", folder.path() / "robot");
  std::filesystem::remove(staging);
  if (found.tips.empty())
    throw core::InputError("the robot reaches none of the places; at the first, " + found.out_of_reach.front().reason);
  if (!source.title.empty()) out << source.title << '\n';
  out << report::survey_text(found) << "  tables: " << (folder.path() / "robot").string() << '\n';
  return ExitCode::done;
}

ExitCode simulate(const Arguments& arguments, std::ostream& out) {
  SimulateRequest request = arguments.simulate;
  request.points = arguments.points;
  const ProgressDisplay display = start_log(arguments);
  if (arguments.threads > 0) core::set_thread_count(arguments.threads);
  out << simulate_case(simulated_case(arguments.case_path, arguments.overrides, request), arguments.out, display);
  return ExitCode::done;
}

ExitCode postures(const Arguments& arguments, std::ostream& out) {
  const ProgressDisplay display = start_log(arguments);
  if (arguments.threads > 0) core::set_thread_count(arguments.threads);
  out << study_postures(cases::read_case(arguments.case_path, arguments.overrides), arguments.postures, arguments.out,
                        display);
  return ExitCode::done;
}

ExitCode reduce(const Arguments& arguments, std::ostream& out) {
  ReduceRequest request = arguments.reduce;
  request.display = start_log(arguments);
  messages_to_log();
  require_options(request);
  const cases::Case source = cases::read_case(arguments.case_path, arguments.overrides);
  const auto ranks = start_ranks(arguments.ranks);
  out << reduce_part(source, request);
  return ExitCode::done;
}

ExitCode inspect(const Arguments& arguments, std::ostream& out) {
  const Inspection inspection = inspect(arguments.inspect);
  out << inspection.text;
  return inspection.trustworthy ? ExitCode::done : ExitCode::expectation;
}

void tell_size(const cases::Case& source, const setup::PartSize& size, std::ostream& out) {
  const auto rounded = [](double value) { return core::readable_text(value, core::kind::number); };
  if (size.elements > 0.0)
    out << "  elements  about " << rounded(size.elements) << " of order " << size.order << ", "
        << (setup::kind(*source.part) == setup::ShapeKind::mesh ? "as the file has them"
            : source.part->mesh.element_size
                ? "size " + core::readable_text(*source.part->mesh.element_size, core::kind::length)
                : "size and order from the tolerance of " + rounded(source.part->mesh.tolerance))
        << '\n';
  out << "  DOFs      about " << rounded(size.dofs) << '\n'
      << "  time      " << about(size.seconds, size.at_least) << " for mesh, modes and reduction on two cores\n";
  if (size.memory_bytes > 0.0)
    out << "  memory    up to about "
        << core::readable_text(std::ceil(size.memory_bytes / 1e8) * 1e8, core::kind::memory)
        << (setup::kind(*source.part) == setup::ShapeKind::surface ? ", more if a finer mesh is taken\n" : "\n");
}

void tell_simulation(const study::SimulationForecast& time, std::ostream& out) {
  const auto rounded = [](double value) { return core::readable_text(value, core::kind::number); };
  out << "  simulated " << rounded(time.points) << " points";
  if (time.map_points > 0.0) out << ", and a map of " << rounded(time.map_points);
  out << ", " << rounded(time.turns) << " turns together\n  time      " << about(time.seconds) << " on "
      << core::thread_count() << (core::thread_count() == 1 ? " thread\n" : " threads\n");
  if (time.memory_bytes > 0.0)
    out << "  memory    about " << core::readable_text(std::ceil(time.memory_bytes / 1e6) * 1e6, core::kind::memory)
        << " for the parts as regions\n";
}

void tell_lobes(const setup::LobesOptions& lobes, const Forecast& time, std::ostream& out) {
  out << "  lobes     " << lobes.count << " speeds, and up to " << setup::most_added(lobes)
      << " between them where the line needs them\n";
  if (!time.lobes) return;
  out << "  time      " << about(time.lobes_s(), time.lobes_at_least()) << " for some "
      << core::readable_text(time.lobes->rows.of_structure + time.lobes->rows.of_lines, core::kind::number)
      << " rows of all charts on " << core::thread_count() << (core::thread_count() == 1 ? " thread" : " threads");
  if (time.part || time.identification_s > 0.0) out << "; " << about(time.whole_s(), time.at_least()) << " in all";
  out << '\n';
}

ExitCode check(const Arguments& arguments, std::ostream& out) {
  const cases::Case source = cases::read_case(arguments.case_path, arguments.overrides);
  const auto expectations = cases::read_expectations(source.file);
  const Forecast time = forecast(source);
  out << source.file.string() << ": no errors\n";
  if (!source.title.empty()) out << "  " << source.title << '\n';
  if (source.part && source.part->imported) {
    out << "  part      " << source.part->imported->summary << '\n';
    for (const auto& note : source.part->imported->notes) out << "            " << note << '\n';
  }
  if (time.part) {
    tell_size(source, *time.part, out);
    for (const std::string& warning : setup::unreachable_tolerances(source)) out << "  warning   " << warning << '\n';
  }
  for (const std::string& doubt : cases::doubts_about(source)) out << "  warning   " << doubt << '\n';
  if (time.identification_s > 0.0)
    out << "  time      " << about(time.identification_s) << " to fit or learn what is identified, once: it is kept\n";
  if (source.lobes) tell_lobes(*source.lobes, time, out);
  if (time.simulation) tell_simulation(*time.simulation, out);
  if (!expectations.empty()) out << "  expected  " << expectations.size() << " figures\n";
  return ExitCode::done;
}

/// The answer of both results, the figures that matter most, and every difference where that is asked for.
ExitCode compare(const Arguments& arguments, std::ostream& out) {
  const report::Comparison comparison = with_option(
      "--tolerance", [&] { return report::compare_results(arguments.left, arguments.right, arguments.tolerance); });
  out << report::answers_text(arguments.left, arguments.right) << '\n';
  if (const std::string figures = report::main_figures_text(comparison); !figures.empty()) out << figures << '\n';
  if (arguments.all) {
    for (const report::Difference& difference : comparison.differences)
      out << difference.where << ": " << difference.left << " against " << difference.right << '\n';
  }
  out << comparison.numbers << " numbers compared, " << comparison.differences.size() << " differences";
  if (!comparison.differences.empty())
    out << ": " << report::differences_by_file(comparison) << (arguments.all ? "" : "; --all lists them");
  out << '\n';
  if (!arguments.html.empty()) {
    report::write_page(arguments.html, {{arguments.left, arguments.right}, program_name()});
    out << "wrote " << arguments.html << '\n';
    return ExitCode::done;
  }
  return comparison.differences.empty() ? ExitCode::done : ExitCode::expectation;
}

ExitCode print_schema(const std::string& file, std::ostream& out) {
  if (file == "summary") {
    out << report::summary_schema().dump(2) << '\n';
    return ExitCode::done;
  }
  if (file == "postures") {
    out << report::file_schema<report::LearnedRobotSummary>("postures.json of thinwall").dump(2) << '\n';
    return ExitCode::done;
  }
  if (file != "case" && file != "expected" && file != "joints")
    throw core::UsageError("there is no schema of \"" + file +
                           "\"; there are case, expected, joints, summary, postures");
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
  const auto file = with_option("--of", [&] { return report::write_phases(arguments.folder, arguments.phases); });
  out << "wrote " << file.string() << "; open it in ParaView and press play\n";
  return ExitCode::done;
}

ExitCode execute(const CLI::App& app, const Arguments& arguments, const RunCase& run_case, std::ostream& out) {
  if (app.got_subcommand("run")) return run(arguments, run_case, out);
  if (app.got_subcommand("lobes")) return lobes(arguments, run_case, out);
  if (app.got_subcommand("calibrate")) return calibrate(arguments, run_case, out);
  if (app.got_subcommand("coefficients")) {
    out << coefficients_of(arguments.coefficients);
    return ExitCode::done;
  }
  if (app.got_subcommand("validate")) return validate(arguments, run_case, out);
  if (app.got_subcommand("robot")) return robot(arguments, out);
  if (app.got_subcommand("postures")) return postures(arguments, out);
  if (app.got_subcommand("simulate")) return simulate(arguments, out);
  if (app.got_subcommand("fit")) {
    out << fit_files(arguments.fit);
    return ExitCode::done;
  }
  if (app.got_subcommand("reduce")) return reduce(arguments, out);
  if (app.got_subcommand("inspect")) return inspect(arguments, out);
  if (app.got_subcommand("check")) return check(arguments, out);
  if (app.got_subcommand("sweep")) return run_sweep(arguments.sweep, run_case, out);
  if (app.got_subcommand("merge")) return merge_sweeps(arguments.merge.folders, arguments.merge.out, out);
  if (app.got_subcommand("compare")) return compare(arguments, out);
  if (app.got_subcommand("animate")) return animate(arguments, out);
  if (app.got_subcommand("report")) return remake_report(arguments, out);
  if (app.got_subcommand("init")) {
    const auto& name = arguments.template_name;
    const auto folder = arguments.folder.empty() ? name : arguments.folder;
    const auto file = with_option("--template", [&] { return cases::write_template(name, folder); });
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

/// The message in one line behind "thinwall: ".
void report(std::ostream& err, const std::string& message) {
  err << style_for(err).bad("thinwall:") << " " << core::message_line(message) << '\n';
}

/// The answer to the program's name alone.
constexpr auto first_steps =
    "What a thin-walled part will do under the cutter, and which speeds and depths are stable. To begin:\n\n"
    "  thinwall init my-part             a commented case of a plate with a robot behind it\n"
    "  thinwall check my-part            every error of it, and how long it will take\n"
    "  thinwall run my-part              computes it; report.html in results/my-part has the answer in pictures\n"
    "  thinwall init my-tool --template lobes    a measured or known tool: only a stability chart\n\n"
    "\"thinwall init --help\" names all templates, \"thinwall --help\" all commands.\n";

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

/// A problem by the option that gave the value, where one did: its place is no file.
std::string line_of(const cases::CaseError& error, const cases::Problem& problem) {
  if (problem.line < 0) return "--set " + problem.text;
  if (problem.line == 0 && problem.text.starts_with("--")) return problem.text;  // an option of `lobes`
  return cases::problem_line(error.source.name, problem);
}

/// The problems of a case with what they point at beneath; of very many the first.
void report(std::ostream& err, const cases::CaseError& error) {
  for (std::size_t i = 0; i < std::min(error.problems.size(), cases::shown_problems); ++i) {
    report(err, line_of(error, error.problems[i]));
    err << cases::excerpt(error.source, error.problems[i]);
  }
  if (const std::string further = cases::further_problems(error.problems.size()); !further.empty())
    report(err, error.source.name + ": " + further);
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
    report(err, "cannot use \"" + error.path1().string() + "\": " + error.code().message() +
                    "; check that it is there and may be read and written");
    return static_cast<int>(ExitCode::unreadable_data);
  } catch (const std::exception& error) {
    report(err, std::string("internal error: ") + error.what());
    return static_cast<int>(ExitCode::internal);
  } catch (...) {
    report(err, "internal error of an unknown kind");
    return static_cast<int>(ExitCode::internal);
  }
}

}  // namespace

int run_command_line(int argc, const char* const* argv, const RunCase& run_case, std::ostream& out, std::ostream& err) {
  return guarded(
      [&] {
        if (argc < 2) {
          err << first_steps;
          return ExitCode::usage;
        }
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

}  // namespace thinwall::app
