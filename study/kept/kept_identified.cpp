#include "study/kept/kept_identified.hpp"

#include <cereal/types/string.hpp>
#include <memory>
#include <utility>

#include "setup/identified/identify.hpp"
#include "study/kept/archive_models.hpp"
#include "study/kept/stage_keys.hpp"

namespace thinwall {

namespace dynamics {
template <class Archive>
void serialize(Archive& archive, ModalTableRow& r) {
  archive(r.mode, r.frequency_hz, r.damping_ratio, r.right, r.left, r.place_m);
}
template <class Archive>
void serialize(Archive& archive, ModalTable& t) {
  archive(t.dofs, t.rows);
}
}  // namespace dynamics

namespace setup {
template <class Archive>
void serialize(Archive& archive, FittedTip& t) {
  archive(t.model, t.drawn, t.notes, t.warnings);
}
template <class Archive>
void serialize(Archive& archive, LearnedPostures& l) {
  archive(l.summary, l.drawn);
}
}  // namespace setup

namespace study {

namespace {

constexpr const char* tool_piece = "fitted tool";
constexpr const char* robot_piece = "learned robot";

void take_tool(const Checkpoint& kept, setup::Setup& work) {
  const std::string* bytes = kept.find(tool_piece);
  if (bytes == nullptr || !setup::awaits_fit(work)) return;
  auto tip = std::make_shared<setup::FittedTip>();
  from_bytes(*bytes, *tip);
  work.tool->fitted = std::move(tip);
}

void take_robot(const Checkpoint& kept, setup::Setup& work) {
  const std::string* bytes = kept.find(robot_piece);
  if (bytes == nullptr || !setup::awaits_learning(work)) return;
  auto table = std::make_shared<dynamics::ModalTable>();
  auto learned = std::make_shared<setup::LearnedPostures>();
  from_bytes(*bytes, *table, *learned);
  setup::tabled_robot(work.robot)->table_modes = std::move(table);
  setup::tabled_robot(work.robot)->learned = std::move(learned);
}

/// Puts what was identified into the varied set-up, as far as it follows from the same.
void share_identified(setup::Setup& varied, const setup::Setup& identified) {
  if (setup::awaits_fit(varied) && tool_key(varied) == tool_key(identified))
    varied.tool->fitted = identified.tool->fitted;
  if (!setup::awaits_learning(varied) || robot_key(varied) != robot_key(identified)) return;
  const setup::TabledRobot& known = *setup::tabled_robot(identified.robot);
  setup::tabled_robot(varied.robot)->table_modes = known.table_modes;
  setup::tabled_robot(varied.robot)->learned = known.learned;
}

}  // namespace

void identify_or_take(Checkpoint& tool, Checkpoint& robot, setup::Setup& work) {
  take_tool(tool, work);
  take_robot(robot, work);
  const bool fits = setup::awaits_fit(work), learns = setup::awaits_learning(work);
  setup::identify(work);
  if (fits) tool.add(tool_piece, to_bytes(*work.tool->fitted));
  if (!learns) return;
  const setup::TabledRobot& learned = *setup::tabled_robot(work.robot);
  robot.add(robot_piece, to_bytes(*learned.table_modes, *learned.learned));
}

setup::Variation identified_variation(const setup::Variation& variation, const setup::Setup& identified) {
  return {variation.value, [variation, identified](const setup::NamedValues& values) {
            setup::Setup varied = variation.with(values);
            share_identified(varied, identified);
            setup::identify(varied);
            return varied;
          }};
}

}  // namespace study

}  // namespace thinwall
