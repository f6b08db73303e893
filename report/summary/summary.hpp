#pragma once
// summary.json as a type: everything that a person or a script wants first.

#include <map>
#include <string>
#include <vector>

#include "report/summary/contacts.hpp"
#include "report/summary/coupling.hpp"
#include "report/summary/errors.hpp"
#include "report/summary/lobes.hpp"
#include "report/summary/operating_point.hpp"
#include "report/summary/part.hpp"
#include "report/summary/path.hpp"
#include "report/summary/robot.hpp"
#include "report/summary/simulation.hpp"
#include "report/summary/updating.hpp"

namespace thinwall::report {

/// The summary of a run; sections of what its case does not hold are absent.
struct Summary {
  int schema = 1;
  std::string case_name, title, status = "ok";
  std::vector<UpdatingSummary> updating;
  std::optional<GeometrySummary> geometry;
  std::optional<MeshSummary> mesh;
  std::optional<PartSummary> part;
  std::optional<ReductionSummary> reduction;
  std::vector<PointSummary> points;
  std::optional<RobotSummary> robot;
  std::vector<ContactSummary> contacts;
  std::optional<CouplingSummary> coupling;
  ErrorBudgetSummary error_budget;
  std::optional<CuttingSummary> cutting;
  std::vector<LobesSummary> lobes;
  std::vector<PathSummary> path;
  std::vector<OperatingPointSummary> operating_points;
  std::optional<SimulationSummary> simulation;
  std::vector<std::string> sentences;
  std::vector<CheckSummary> checks;
  std::map<std::string, double> timings_s;
};

template <class Visitor, Either<Summary> Section>
void fields(Visitor& visit, Section& summary) {
  visit(Field{"schema", Kind::count, "version of this schema"}, summary.schema);
  visit(Field{"case", Kind::text, "name of the case"}, summary.case_name);
  visit(Field{"title", Kind::text, "title of the case"}, summary.title);
  visit(Field{"status", Kind::text, "\"ok\" or \"expectation_not_met\""}, summary.status);
  visit(Field{"updating", Kind::section, "fits of model updating"}, summary.updating);
  visit(Field{"geometry", Kind::section, "file that the part's shape comes from"}, summary.geometry);
  visit(Field{"mesh", Kind::section, "mesh of the part"}, summary.mesh);
  visit(Field{"part", Kind::section, "the part and its modes"}, summary.part);
  visit(Field{"reduction", Kind::section, "reduced model of the part"}, summary.reduction);
  visit(Field{"points", Kind::section, "named points of a part whose shape is known"}, summary.points);
  visit(Field{"robot", Kind::section, "the robot"}, summary.robot);
  visit(Field{"contacts", Kind::section, "contacts in the order of the case"}, summary.contacts);
  visit(Field{"coupling", Kind::section, "part and robot joined"}, summary.coupling);
  visit(Field{"error_budget", Kind::section, "largest errors of the receptances"}, summary.error_budget);
  visit(Field{"cutting", Kind::section, "the cut; absent without charts"}, summary.cutting);
  visit(Field{"lobes", Kind::section, "stability charts"}, summary.lobes);
  visit(Field{"path", Kind::section, "charts along the path of the cut", Presence::if_any}, summary.path);
  visit(Field{"operating_points", Kind::section, "operating points that were asked about"}, summary.operating_points);
  visit(Field{"simulation", Kind::section, "operating points in the time domain; absent without [simulation]"},
        summary.simulation);
  visit(Field{"sentences", Kind::sentence, "remarks on the charts in words"}, summary.sentences);
  visit(Field{"checks", Kind::section, "expectations of the case"}, summary.checks);
  visit(Field{"timings_s", Kind::run_time, "time of every stage, and \"total\""}, summary.timings_s);
}

}  // namespace thinwall::report
