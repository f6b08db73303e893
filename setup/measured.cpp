#include "setup/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "dynamics/conversion.hpp"
#include "dynamics/frf_checks.hpp"
#include "io/csv_text.hpp"
#include "io/frf/frf_csv.hpp"
#include "io/frf/frf_cutpro.hpp"
#include "io/frf/frf_lvm.hpp"
#include "io/frf/mat_response.hpp"
#include "io/frf/resample.hpp"
#include "io/frf/response_csv.hpp"
#include "io/frf/uff.hpp"
#include "io/matrices/mat_version.hpp"
#include "reduction/damping.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::setup {

namespace {

bool holds_one_frf(FrfFileKind kind) {
  return kind == FrfFileKind::csv || kind == FrfFileKind::lvm || kind == FrfFileKind::cutpro;
}

std::optional<io::FrfFormat> stated_format(const MeasuredFrf& measured) {
  if (!measured.quantity && measured.unit.empty()) return std::nullopt;
  if (!measured.quantity)
    throw core::InputError("the unit \"" + measured.unit + "\" is stated without a quantity; give both or neither");
  return io::frf_format(*measured.quantity, measured.unit, measured.frequency_unit);
}

/// Turns the sign of an FRF for a sensor or hammer along −x. One along another axis than the case names is doubted, for
/// the axes of a test need not be the part's.
void turn_to_named_axes(const io::MeasuredEntry& entry, const MeasuredFrf& measured, FrfContent& content) {
  for (const auto& [dof, name] : {std::pair{&entry.response, &measured.response}, {&entry.force, &measured.force}}) {
    if (dof->kind == dynamics::DofKind::rotation) {
      throw core::InputError("\"" + measured.file.string() + "\" says " + dynamics::name(*dof) +
                             ", a turn, where the case says " + *name + ": choose another record");
    }
    if (!(dof->direction.cwiseAbs().maxCoeff() > 0.999)) continue;  // zero or slanted: the case knows better
    const double along = dof->direction.dot(dof_of(*name).direction);
    if (along < -0.999) {
      content.frf.H = -content.frf.H;
      content.notes.push_back(fmt::format("{}: {} points against {}: the FRF is turned", measured.file.string(),
                                          dynamics::name(*dof), *name));
    } else if (along < 0.999) {
      content.warnings.push_back(fmt::format("{}: the file says {}, the case {}; check record and axes",
                                             measured.file.string(), dynamics::name(*dof), *name));
    }
  }
}

/// The FRF of a file that the case names.
const io::MeasuredEntry& record_of(const io::MeasuredEntries& file, const MeasuredFrf& measured) {
  const bool only_one = holds_one_frf(frf_file_kind(measured.file));
  if (only_one && measured.record.value_or(1) != 1)
    throw core::InputError("\"" + measured.file.string() + "\" holds one FRF, and record asks for number " +
                           std::to_string(*measured.record) + ": remove record, or name another file");
  if (only_one || !measured.variable.empty()) return file.entries.front();
  const std::size_t count = file.entries.size();
  const auto wanted = static_cast<std::size_t>(measured.record.value_or(1));
  if (wanted <= count && (measured.record || count == 1)) return file.entries[wanted - 1];
  std::string list;
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(count, most); ++i) {
    const io::MeasuredEntry& entry = file.entries[i];
    list += (i == 0 ? "" : ", ") + std::to_string(i + 1) + " " + dynamics::name(entry.response) + "/" +
            dynamics::name(entry.force);
  }
  if (count > most) list += ", …";
  throw core::InputError("\"" + measured.file.string() + "\" holds " + std::to_string(count) + " FRFs (" + list +
                         "): say which one by record");
}

/// The FRF of another program's MAT file, in the variable that the case names.
io::MeasuredEntries entry_of_variable(const MeasuredFrf& measured, const std::optional<io::FrfFormat>& stated) {
  const std::string what = "\"" + measured.file.string() + "\": ";
  if (measured.variable.empty() || measured.frequency_variable.empty())
    throw core::InputError(what + "variable and frequency_variable belong together; give both or neither");
  if (frf_file_kind(measured.file) != FrfFileKind::mat)
    throw core::InputError(what + "variable is of a MAT file, which this is not; remove it");
  if (!stated) throw core::InputError(what + "a variable does not say what it holds: give quantity and unit");
  if (measured.record)
    throw core::InputError(what + "record is of the FRFs of a file; the entry of an array is told by variable");
  return io::read_mat_entry(measured.file, {measured.frequency_variable, measured.variable}, *stated);
}

/// Throws DataError for a line that no structure has: a slip of the pen or of a unit, by which fits fail or squares
/// become infinite.
void require_possible(const io::MeasuredEntries& file, const std::filesystem::path& path) {
  constexpr double largest_m_per_n = 1e6;  // far above the resonance of a spring of 1 N/m
  for (const io::MeasuredEntry& entry : file.entries) {
    Eigen::Index line = 0;
    if (entry.frf.H.size() == 0 || entry.frf.H.cwiseAbs().maxCoeff(&line) <= largest_m_per_n) continue;
    throw core::DataError(
        fmt::format("{}: at {:g} Hz a force of 1 N moves it by {:g} m, as no structure does: look at "
                    "this line, at quantity and unit",
                    path.string(), entry.frf.axis.hz(line), std::abs(entry.frf.H(line))));
  }
}

/// All FRFs that the file holds; of a file that tells no DOFs, one without directions.
io::MeasuredEntries entries_of_file(const MeasuredFrf& measured) {
  const std::optional<io::FrfFormat> stated = stated_format(measured);
  if (!measured.variable.empty() || !measured.frequency_variable.empty()) return entry_of_variable(measured, stated);
  const FrfFileKind kind = frf_file_kind(measured.file);
  const dynamics::Dof untold{"", Eigen::Vector3d::Zero(), dynamics::DofKind::translation};
  if (kind == FrfFileKind::cutpro) return {{{untold, untold, io::read_cutpro_frf(measured.file, stated)}}, {}};
  if (kind == FrfFileKind::universal) return io::read_uff_entries(measured.file, {stated});
  if (kind == FrfFileKind::mat && stated &&
      (stated->quantity != io::FrfQuantity::receptance || stated->unit_in_si != 1.0))
    throw core::InputError("\"" + measured.file.string() + "\" holds receptances in m/N: leave out quantity and unit");
  if (kind == FrfFileKind::mat) return io::entries_of(io::read_mat_response(measured.file), measured.file.string());
  if (!stated)
    throw core::InputError("\"" + measured.file.string() + "\" does not say what it holds: give quantity and unit");
  if (kind == FrfFileKind::lvm) return {{{untold, untold, io::read_lvm_frf(measured.file, *stated)}}, {}};
  return {{{untold, untold, io::read_frf(measured.file, *stated)}}, {}};
}

/// entries_of_file(), each of which a structure can have.
io::MeasuredEntries read_file(const MeasuredFrf& measured) {
  io::MeasuredEntries all = entries_of_file(measured);
  require_possible(all, measured.file);
  return all;
}

/// True of a CSV that io::write_response() wrote: its header names entries.
bool is_response_table(const std::filesystem::path& file) {
  if (frf_file_kind(file) != FrfFileKind::csv) return false;
  const io::CsvText text = io::read_csv_text(file);
  return text.header.size() > 2 && text.header[1].starts_with("re ") && text.header[1].find('/') != std::string::npos;
}

}  // namespace

FrfFileKind frf_file_kind(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".frf") return FrfFileKind::cutpro;
  if (extension == ".lvm") return FrfFileKind::lvm;
  if (extension == ".uff" || extension == ".unv") return FrfFileKind::universal;
  if (extension == ".mat") return FrfFileKind::mat;
  // A file is opened only where its ending tells nothing.
  const bool is_mat = extension != ".csv" && io::mat_version_of_file(file) != io::MatVersion::none;
  return is_mat ? FrfFileKind::mat : FrfFileKind::csv;
}

FrfContent read_measured(const MeasuredFrf& measured, FrfFiles& files) {
  const std::string key = fmt::format("{}\n{}\n{}\n{}\n{}\n{}", measured.file.string(),
                                      measured.quantity ? core::word_of(*measured.quantity) : "", measured.unit,
                                      measured.frequency_unit, measured.variable, measured.frequency_variable);
  auto file = files.find(key);
  if (file == files.end()) file = files.emplace(key, read_file(measured)).first;
  const io::MeasuredEntry& entry = record_of(file->second, measured);
  FrfContent content{entry.frf, {}, {}};
  for (const std::string& note : file->second.notes)
    content.notes.push_back(fmt::format("{}: {}", measured.file.string(), note));
  turn_to_named_axes(entry, measured, content);
  return content;
}

FrfContent read_measured(const MeasuredFrf& measured) {
  FrfFiles files;
  return read_measured(measured, files);
}

io::MeasuredEntries read_all_measured(const MeasuredFrf& measured) {
  io::MeasuredEntries all = is_response_table(measured.file)
                                ? io::entries_of({io::read_response(measured.file), {}, {}}, measured.file.string())
                                : read_file(measured);
  for (io::MeasuredEntry& entry : all.entries) {
    if (entry.response.direction.isZero(0.0)) entry.response = dof_of(measured.response);
    if (entry.force.direction.isZero(0.0)) entry.force = dof_of(measured.force);
    for (dynamics::Dof* dof : {&entry.response, &entry.force}) {
      Eigen::Index largest = 0;
      dof->direction.cwiseAbs().maxCoeff(&largest);
      if (dof->direction(largest) > 0.0) continue;
      dof->direction = -dof->direction;
      entry.frf.H = -entry.frf.H;
    }
  }
  return all;
}

const io::MeasuredFrf& receptance_of(const MeasuredFrf& measured) {
  if (measured.content) return measured.content->frf;
  throw core::InputError("\"" + measured.file.string() + "\" was not read; call setup::read_data_files()");
}

dynamics::ResponseModel measured_response(const std::vector<MeasuredFrf>& files, const dynamics::FrequencyAxis& axis) {
  if (const LayoutFault fault = fault_of_layout(files); !fault.text.empty()) throw core::InputError(fault.text);
  const MeasuredLayout layout = measured_layout(files);
  std::vector<Eigen::VectorXcd> values;
  values.reserve(files.size());
  for (const MeasuredFrf& file : files) values.push_back(io::resample(receptance_of(file), axis));
  dynamics::ResponseModel model;
  model.axis = axis;
  for (const auto& name : layout.dofs) model.responses.push_back(dof_of(name));
  model.forces = model.responses;
  const Eigen::Index n = layout.file.rows();
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    model.H.emplace_back(Eigen::MatrixXcd::NullaryExpr(n, n, [&](Eigen::Index a, Eigen::Index b) {
      return values[static_cast<std::size_t>(layout.file(a, b))](line);
    }));
  }
  return model;
}

void warn_if_implausible(const dynamics::ResponseModel& measured, const std::string& whose) {
  for (const dynamics::DrivingPointSign& sign : dynamics::driving_point_signs(measured)) {
    if (sign.verdict == dynamics::SignVerdict::passive) continue;
    const char* cause = sign.verdict == dynamics::SignVerdict::turned
                            ? "a sensor or a force counts in the other direction"
                        : sign.verdict == dynamics::SignVerdict::conjugated ? "its phase is that of e^(-iwt)"
                                                                            : "noise, or points that are not one";
    core::warn(fmt::format("{} FRF at {}: its imaginary part is not that of a passive structure ({})", whose,
                           dynamics::name(measured.responses[static_cast<std::size_t>(sign.entry.row)]), cause));
  }
  if (const auto check = dynamics::reciprocity(measured); check && !check->holds) {
    core::warn(fmt::format("{} FRFs are not reciprocal: they differ by {:.0f} % of the largest at {:.1f} Hz", whose,
                           check->figure * 100.0, check->frequency_hz));
  }
  if (const auto check = dynamics::passivity(measured); check && !check->holds) {
    core::warn(fmt::format("{} FRFs are not passive: they give energy at {:.1f} Hz, by {:.0f} % of their size", whose,
                           check->frequency_hz, check->figure * 100.0));
  }
  if (measured.axis.size() < 26) return;
  for (const dynamics::Collocated& at : dynamics::driving_points(measured)) {
    Eigen::VectorXcd H(measured.axis.size());
    for (Eigen::Index line = 0; line < H.size(); ++line)
      H(line) = measured.H[static_cast<std::size_t>(line)](at.row, at.column);
    const auto limit = dynamics::low_frequency_limit(measured.axis, H);
    if (limit.cause == dynamics::LowFrequencyCause::none) continue;
    core::warn(fmt::format(
        "{} FRF at {} is worth little below {:.1f} Hz: its lines scatter as an integrated accelerometer's do", whose,
        dynamics::name(measured.responses[static_cast<std::size_t>(at.row)]), limit.from_hz));
  }
}

std::vector<double> matched_ratios(const dynamics::SpatialModel& reduced,
                                   const std::vector<reduction::IdentifiedMode>& identified, double rest) {
  const Eigen::VectorXd all_hz = dynamics::undamped_modes(reduced).omega_rad_s / (2.0 * std::numbers::pi);
  const Eigen::VectorXd hz = all_hz.tail(all_hz.size() - reduction::rigid_motions(all_hz));
  std::vector<double> ratios(static_cast<std::size_t>(hz.size()), rest);
  for (const auto& mode : identified) {
    Eigen::Index nearest = 0;
    (hz.array() - mode.frequency_hz).abs().minCoeff(&nearest);
    if (std::abs(hz(nearest) - mode.frequency_hz) > 0.1 * mode.frequency_hz) {
      throw core::InputError(
          "the measured resonance at " + std::to_string(mode.frequency_hz) +
          " Hz has no mode of the part within 10 %: fit the part first (updating), or give damping.ratios");
    }
    ratios[static_cast<std::size_t>(nearest)] = mode.damping_ratio;
  }
  return ratios;
}

}  // namespace thinwall::setup
