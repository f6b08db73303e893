#include "app/command_options.hpp"

#include <CLI/CLI.hpp>

#include "app/completion.hpp"
#include "app/doctor.hpp"
#include "app/memory_option.hpp"
#include "app/output_name.hpp"
#include "app/ranks_option.hpp"
#include "case/templates.hpp"

namespace thinwall::app {

namespace {

/// "plate|wall": help, completion and the man page know the choices of an option by its type.
std::string alternatives(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : "|") + name;
  return list;
}

/// An empty word would stand for the default, as where a variable of a script is not set.
std::string names_a_file(const std::string& file) {
  return file.empty() ? "the name is empty; name a file, or leave the option out" : "";
}

std::string has_a_value(const std::string& word) {
  return word.empty() ? "the value is empty; give one, or leave the option out" : "";
}

void add_overrides(CLI::App& command, Arguments& arguments) {
  command.add_option("--set", arguments.overrides, "a value put over the case: --set part.element_size=\"8 mm\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_result_folder(CLI::App& command, Arguments& arguments) {
  command.add_option("--out", arguments.out, "result folder (default: results/<case>)")
      ->type_name("DIR")
      ->check(has_a_name);
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
  add_result_folder(command, arguments);
  command
      .add_option("--at", arguments.points,
                  "an operating point, several times: --at \"5000 rpm, 0.5 mm\"; stable or not, and the margins")
      ->type_name("\"SPEED, DEPTH\"")
      ->allow_extra_args(false);
  add_log_arguments(command, arguments);
  command.add_option("--threads", arguments.threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
  add_memory_option(command);
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

/// The files of a fit, and what they do not tell themselves.
void add_fit_input(CLI::App* command, FitInput& input) {
  command
      ->add_option(
          "INPUT", input.sources,
          "files of FRFs (UFF 58, CSV, MAT, LVM, .frf), which make a matrix together. A file that tells no DOFs "
          "is P.x/Q.y=FILE (response and force), or x=FILE, xy=FILE at a tool's tip; FILE alone is x")
      ->type_name("FILE")
      ->required();
  command->add_option("--quantity", input.quantity, "what FRFs are, where files do not say")
      ->type_name("receptance|mobility|accelerance");
  command->add_option("--unit", input.unit, "of FRFs: m/N, um/N, m/s/N, m/s^2/N …")->type_name("UNIT");
  command->add_option("--frequency-unit", input.frequency_unit, "of FRFs (default: Hz)")->type_name("Hz|rad/s");
  command
      ->add_option("--variable", input.variable, "of another program's MAT file: the FRF, H00 or H(2,1,:), or an array")
      ->type_name("NAME");
  command->add_option("--frequency-variable", input.frequency_variable, "beside it: the frequencies")
      ->type_name("NAME");
  command->add_option("--coherence-variable", input.coherence_variable, "beside it: the coherence of an array")
      ->type_name("NAME");
  command
      ->add_option("--responses", input.responses,
                   "DOFs of an array: \"1.x, 2.x\"; responses x forces x lines, or lines first")
      ->type_name("DOFS");
  command->add_option("--forces", input.forces, "DOFs of an array: \"1.x\"")->type_name("DOFS");
  command
      ->add_option("--geometry", input.geometry,
                   "places of the points, for the page: UFF, or CSV with point, x_m, y_m, z_m")
      ->type_name("FILE")
      ->check(names_a_file);
}

void describe_fit(CLI::App& app, FitRequest& fit) {
  auto* command =
      app.add_subcommand("fit", "modes with their uncertainty from measured FRFs, as tables that a case reads");
  add_fit_input(command, fit.input);
  command
      ->add_option("--sensor", fit.sensors,
                   "rigid mass at a point while all was measured, taken off before the fit, several times: \"1=30 g\"")
      ->type_name("POINT=MASS")
      ->allow_extra_args(false);
  command
      ->add_option("--swap", fit.swap,
                   "[tool.swap] with the tool that was measured and another, for which it is exchanged before the fit")
      ->type_name("FILE")
      ->check(names_a_file);
  command->add_option("--from", fit.from, "first frequency: \"20 Hz\" (default: all)")->type_name("FREQUENCY");
  command->add_option("--to", fit.to, "last frequency")->type_name("FREQUENCY");
  command
      ->add_option("--exclude", fit.left_out,
                   "lines within 1 % of a frequency, or in a band, several times: \"49 Hz:51 Hz\"")
      ->type_name("FREQUENCY")
      ->allow_extra_args(false);
  command->add_option("--poles", fit.poles, "frequencies of the modes: \"10.4 Hz, 27 Hz\" (default: found)")
      ->type_name("FREQUENCIES");
  command->add_option("--order", fit.order, "highest order of the stabilisation diagram (default: 30)")
      ->check(CLI::Range(1, 200));
  command
      ->add_option(
          "--terms", fit.terms,
          "terms beside the modes: LR/s^2 and powers of s up to 0 … 6, a constant alone, or none (default: as needed)")
      ->type_name("none|constant|POWER");
  command
      ->add_option("--residues", fit.residues,
                   "form of the residues (default: rank_one, or free where a pole is double)")
      ->type_name("free|rank_one|symmetric");
  command->add_option("--averages", fit.averages, "number of averages, by which coherence weighs the lines")
      ->check(CLI::Range(1, 100000));
  command->add_option("--noise", fit.noise, "noise of real and imaginary part, relative: 0.01 (default: by scatter)");
  command->add_flag("--passive", fit.passive,
                    "residues are moved, as little as needed, until the model gives no energy");
  for (const char* option : {"--from", "--to", "--poles", "--terms", "--residues"})
    command->get_option(option)->check(has_a_value);
  command->add_option("-o,--out", fit.out, "folder for the tables and the page (default: fit)")
      ->type_name("DIR")
      ->check(has_a_name);
}

void describe_reduce(CLI::App& app, Arguments& arguments) {
  ReduceRequest& reduce = arguments.reduce;
  auto* command = app.add_subcommand("reduce", "the part of a case as a small model, its error and a report on it");
  add_case_arguments(*command, arguments);
  command->add_option("-o,--out", reduce.out, "folder for the model (default: model)")
      ->type_name("DIR")
      ->check(has_a_name);
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
  add_ranks_option(*command, arguments.ranks);
  add_memory_option(*command);
  add_log_arguments(*command, arguments);
}

void describe_inspect(CLI::App& app, Arguments& arguments) {
  InspectRequest& inspect = arguments.inspect;
  io::MatrixFiles& files = inspect.files;
  auto* command = app.add_subcommand("inspect",
                                     "may a reduced or imported model be trusted, and what does a universal file hold? "
                                     "(exit 6: it may not, or not all of "
                                     "it can be read)");
  auto* model = command
                    ->add_option("MODEL", inspect.model,
                                 "a folder of \"thinwall reduce\", a MAT file in SI, or a universal file (.uff, .unv)")
                    ->type_name("FILE");
  command
      ->add_option("--stiffness", files.stiffness,
                   "K in place of MODEL: Matrix Market, .sti of CalculiX, Abaqus, DMIG, OP2, OP4, MAT, NetCDF "
                   "(docs/matrices.md)")
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

void describe_simulate(CLI::App& app, Arguments& arguments) {
  SimulateRequest& simulate = arguments.simulate;
  auto* command = app.add_subcommand("simulate",
                                     "operating points of a case in the time domain: how large the vibration becomes, "
                                     "where teeth leave the cut, and the wall; options take the place of what "
                                     "[simulation] of the case says");
  add_case_arguments(*command, arguments);
  add_result_folder(*command, arguments);
  command
      ->add_option("--at", arguments.points,
                   "an operating point, several times: --at \"5000 rpm, 0.5 mm\" (default: simulation.at, else both "
                   "sides of the boundary at the case's own speed)")
      ->type_name("\"SPEED, DEPTH\"")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--paths", simulate.paths,
          "how teeth move: on circles between fixed angles of entry and exit (default), exactly, with contact by "
          "geometry, or through a part that is kept as a region")
      ->type_name("circular|exact|region")
      ->check(CLI::IsMember({"circular", "exact", "region"}));
  command->add_option("--settle", simulate.settling_turns, "turns before anything is recorded (default: 400)")
      ->check(CLI::Range(0, 10000000));
  command->add_option("--turns", simulate.turns, "turns that are recorded (default: 200)")
      ->check(CLI::Range(1, 10000000));
  command
      ->add_option("--trace", simulate.traced_turns,
                   "of them, those written sample by sample, and of whose lines the text tells (default: 50)")
      ->check(CLI::Range(0, 100000));
  command->add_option("--steps", simulate.steps, "steps of a tooth from entry to exit, on circles (default: 200)")
      ->check(CLI::Range(4, 100000));
  add_log_arguments(*command, arguments);
  command->add_option("--threads", arguments.threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
}

void describe_postures(CLI::App& app, Arguments& arguments) {
  PosturesRequest& postures = arguments.postures;
  auto* command = app.add_subcommand(
      "postures",
      "a robot that was tapped at many postures (robot.postures): errors of what is learned at postures held out, "
      "modes "
      "over the postures, first frequency and depth over the workspace, and the posture to tap next");
  add_case_arguments(*command, arguments);
  add_result_folder(*command, arguments);
  command->add_option("--parts", postures.parts, "what is answered (default: errors,curve,sharing,map,envelope,next)")
      ->type_name("PARTS");
  command
      ->add_option("--speed", postures.speed,
                   "spindle speed of the depths: \"9000 rpm\", or best, of each place of the map (default: the case's)")
      ->type_name("SPEED");
  command->add_option("--grid", postures.grid, "places of the map along each column (default: 5)")
      ->check(CLI::Range(2, 1000));
  command->add_option("--folds", postures.folds, "parts of the postures that are held out in turn (default: 5)")
      ->check(CLI::Range(2, 1000));
  command
      ->add_option("--path", postures.path,
                   "CSV of places that matter for the next posture, with the columns of robot.over (default: robot.at)")
      ->type_name("FILE");
  command->add_option("--candidates", postures.candidates, "CSV of places that can be tapped (default: the map's grid)")
      ->type_name("FILE");
  command->add_option("--split", postures.split, "between low and high modes (default: in the widest gap)")
      ->type_name("FREQUENCY");
  add_log_arguments(*command, arguments);
  command->add_option("--threads", arguments.threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
}

void describe_calibrate(CLI::App& app, Arguments& arguments) {
  CalibrateRequest& calibrate = arguments.calibrate;
  auto* command = app.add_subcommand(
      "calibrate",
      "what cuts that were made ([[observed]]) teach of a case's frequencies, damping and coefficients, the chart that "
      "follows, and the cut to make next");
  add_case_arguments(*command, arguments);
  command->add_option("--draws", calibrate.draws, "draws of each of four chains (default: 200)")
      ->check(CLI::Range(40, 100000));
  command->add_option("--seed", calibrate.seed, "seed of the draws (default: 1)")->check(CLI::Range(0, 1000000000));
  command->add_option("--folds", calibrate.folds, "parts of the cuts that are predicted by the others in turn")
      ->check(CLI::Range(2, 100));
  command
      ->add_option("--speed", calibrate.speed,
                   "speed whose limit the next cut is to narrow: \"9000 rpm\" (default: the case's)")
      ->type_name("SPEED");
  command
      ->add_option("--risk", calibrate.risk,
                   "also propose the cut of the highest removal rate that chatters with at most this probability: 0.1")
      ->check(CLI::Range(1e-3, 0.999));
  add_run_arguments(*command, arguments);
}

void describe_coefficients(CLI::App& app, Arguments& arguments) {
  CoefficientsRequest& coefficients = arguments.coefficients;
  auto* command = app.add_subcommand("coefficients",
                                     "cutting coefficients with their intervals from mean forces at several feeds per "
                                     "tooth, or, with the runout, from "
                                     "forces over the angle");
  command
      ->add_option(
          "FORCES", coefficients.forces,
          "CSV, a line a cut: feed_per_tooth_mm, depth_mm, force_feed_n, force_normal_n, force_axis_n; where "
          "cuts are no slots radial_depth_mm and milling (up, down); angle_deg of the first tooth where a line "
          "is an angle")
      ->type_name("FILE")
      ->required();
  auto* tool =
      command
          ->add_option("--tool", coefficients.tool, "TOML with [tool] as in a case: teeth, diameter, helices, pitches")
          ->type_name("FILE");
  command->add_option("--teeth", coefficients.teeth, "teeth of the tool, where there is no --tool")
      ->check(CLI::Range(1, 1000))
      ->excludes(tool);
  command->add_option("--diameter", coefficients.diameter, "of the tool, \"10 mm\"; for radial depths")
      ->type_name("LENGTH");
  command->add_option("--on", coefficients.on, "on what the forces act (default: tool)")->type_name("tool|part");
}

void describe_validate(CLI::App& app, Arguments& arguments) {
  ValidateRequest& validate = arguments.validate;
  auto* command = app.add_subcommand(
      "validate",
      "run all cases of a folder that have cuts that were made, and write how often their charts are right");
  command->add_option("CASES", validate.cases, "folder of cases (default: cases)")->type_name("DIR");
  command->add_option("--page", validate.page, "the page (default: docs/validation.md)")->type_name("FILE");
  command->add_flag("--check", validate.check,
                    "compare with the page in place of writing it; exit code 6 if it differs");
  add_log_arguments(*command, arguments);
  command->add_option("--threads", arguments.threads, "threads to use (default: all)")->check(CLI::Range(1, 1024));
}

void describe_for_the_shell(CLI::App& app, Arguments& arguments) {
  auto* completion = app.add_subcommand("completion", "print a script that completes thinwall's words in a shell");
  completion->add_option("SHELL", arguments.shell, "the shell")
      ->type_name(alternatives(completed_shells()))
      ->required();
  app.add_subcommand("man", "print the manual page: thinwall man | man -l -");
  auto* schema = app.add_subcommand("schema",
                                    "print the JSON Schema of a case, for editors that check TOML by one, or of "
                                    "summary.json or postures.json, for scripts that read it");
  auto* file = schema->add_option("FILE", arguments.schema, "of which file (default: case)")
                   ->type_name("case|expected|joints|summary|postures");
  schema
      ->add_flag_callback(
          "--summary", [&arguments] { arguments.schema = "summary"; },
          "of summary.json: every key with its type, meaning, kind and unit; as FILE summary")
      ->excludes(file);
}

}  // namespace

void describe(CLI::App& app, Arguments& arguments) {
  app.require_subcommand(1);
  app.set_version_flag("--version", program_name());
  auto* run_command = app.add_subcommand("run", "compute a case");
  add_case_arguments(*run_command, arguments);
  add_run_arguments(*run_command, arguments);
  add_ranks_option(*run_command, arguments.ranks);
  describe_lobes(app, arguments);
  auto* robot_command = app.add_subcommand(
      "robot", "modes and stiffness of the robot's tip in its posture, along a path, over a workspace");
  add_case_arguments(*robot_command, arguments);
  add_result_folder(*robot_command, arguments);
  describe_postures(app, arguments);
  describe_calibrate(app, arguments);
  describe_validate(app, arguments);
  describe_coefficients(app, arguments);
  describe_simulate(app, arguments);
  add_case_arguments(*app.add_subcommand("check", "report every error of a case, and sizes to expect"), arguments);
  describe_fit(app, arguments.fit);
  describe_reduce(app, arguments);
  describe_inspect(app, arguments);
  describe_sweep(app, arguments.sweep, arguments.merge);
  auto* init = app.add_subcommand("init", "write a commented case to start from");
  init->add_option("--template", arguments.template_name, "what to start from (default: plate)")
      ->type_name(alternatives(cases::template_names()));
  init->add_option("DIR", arguments.folder, "folder for the case (default: the template's name)")->type_name("DIR");
  auto* compare_command = app.add_subcommand(
      "compare", "two result folders: the answers of both, the figures that matter most, and how many numbers differ");
  compare_command->add_option("A", arguments.left, "result folder")->type_name("DIR")->required();
  compare_command->add_option("B", arguments.right, "result folder")->type_name("DIR")->required();
  compare_command->add_option("--tolerance", arguments.tolerance, "relative tolerance, from 0 on (default: 1e-9)");
  compare_command->add_flag("--all", arguments.all, "every difference, a line each");
  compare_command->add_option("--html", arguments.html, "both on one page, in this file; the exit code is 0 then")
      ->type_name("FILE");
  auto* report_command = app.add_subcommand("report", "make report.html of a result folder anew");
  report_command->add_option("RESULTS", arguments.folder, "result folder")->type_name("DIR")->required();
  report_command->add_option("--out", arguments.out, "the page (default: RESULTS/report.html)")
      ->type_name("FILE")
      ->check(has_a_name);
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

}  // namespace thinwall::app
