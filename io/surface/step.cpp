#include "io/surface/step.hpp"

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_AsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/surface/step_triangles.hpp"

namespace thinwall::io {

namespace {

constexpr double reader_unit_m = 1e-3;  // Open CASCADE converts to millimetres
constexpr std::size_t longest_heading = 1000;

/// The result of the process that reads the file: a fault in words, or triangles (mm) with the volume of the solid
/// (mm³) and the unit of the file.
struct Found {
  std::string fault;
  std::string unit;
  mesh::TriangleSoup soup;
};

void validate(const StepOptions& options) {
  if (!(options.linear_deflection >= 1e-6 && options.linear_deflection <= 0.1)) {
    throw core::InputError("the linear deflection of a STEP file is " + core::number_text(options.linear_deflection) +
                           " of its diagonal; choose 1e-6 to 0.1");
  }
  if (!(options.angular_deflection_rad >= 0.01 && options.angular_deflection_rad <= 1.5)) {
    throw core::InputError("the angular deflection of a STEP file is " +
                           core::number_text(options.angular_deflection_rad) + " rad; choose 0.01 to 1.5");
  }
  if (!(options.metres_per_unit >= 0.0 && std::isfinite(options.metres_per_unit))) {
    throw core::InputError("the unit of a STEP file is " + core::number_text(options.metres_per_unit) +
                           " m; give a positive length, or 0 for the unit that the file states");
  }
}

/// Throws DataError for a file that is no STEP file or is truncated, before Open CASCADE reads it.
void require_whole(const std::string& bytes, const std::string& name) {
  if (bytes.find("ISO-10303-21;") > longest_heading)  // or nowhere
    throw core::DataError(name + ": line 1: no STEP file: it does not begin with \"ISO-10303-21;\"");
  if (bytes.find("END-ISO-10303-21;") == std::string::npos) {
    const auto lines = 1 + std::count(bytes.begin(), bytes.end(), '\n');
    throw core::DataError(name + ": line " + std::to_string(lines) +
                          ": the file ends without \"END-ISO-10303-21;\"; it was cut off, export it again");
  }
}

std::string place(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  if (box.IsVoid()) return "nowhere";
  double a[6];
  box.Get(a[0], a[1], a[2], a[3], a[4], a[5]);
  return mesh::place_text(reader_unit_m * 0.5 * Eigen::Vector3d(a[0] + a[3], a[1] + a[4], a[2] + a[5]));
}

std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum avoid) {
  std::vector<TopoDS_Shape> result;
  for (TopExp_Explorer at(shape, kind, avoid); at.More(); at.Next()) result.push_back(at.Current());
  return result;
}

/// The reason why the shapes of a file are not one solid; empty if they are.
std::string fault_of(const TopoDS_Shape& shape) {
  const auto solids = parts_of(shape, TopAbs_SOLID, TopAbs_SHAPE);
  const auto loose = parts_of(shape, TopAbs_FACE, TopAbs_SOLID);
  if (solids.size() > 1) {
    return "holds " + std::to_string(solids.size()) + " solids, the first two at " + place(solids[0]) + " and " +
           place(solids[1]) + "; export one part, or join them";
  }
  if (!loose.empty()) {
    return "holds " + std::to_string(loose.size()) + " faces that bound no solid, the first at " + place(loose[0]) +
           "; sew them to a solid, or leave them out";
  }
  return solids.empty() ? "holds no solid; export the part as one" : "";
}

/// Reads and triangulates the file; called in the process of its own.
Found found_in(const std::string& path, const StepOptions& options) {
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    return {"cannot be understood as STEP; export it again", {}, {}};
  TColStd_SequenceOfAsciiString lengths;
  TColStd_SequenceOfAsciiString angles;
  TColStd_SequenceOfAsciiString solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  Found result;
  for (const auto& unit : lengths) {
    if (!result.unit.empty() && result.unit != unit.ToCString())
      return {"states two units of length, " + result.unit + " and " + unit.ToCString() + "; export it in one", {}, {}};
    result.unit = unit.ToCString();
  }
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  result.fault = shape.IsNull() ? "holds no shape; export the part as a solid" : fault_of(shape);
  if (!result.fault.empty()) return result;
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  const double diagonal = std::sqrt(box.SquareExtent());
  BRepMesh_IncrementalMesh(shape, options.linear_deflection * diagonal, false, options.angular_deflection_rad, false);
  if (const auto bad = face_without_triangles(shape))
    result.fault = "has a face that cannot be triangulated, at " + place(*bad) + "; heal it in the CAD program";
  if (!result.fault.empty()) return result;
  result.soup = triangles_of(shape);
  try {
    GProp_GProps solid;
    BRepGProp::VolumeProperties(shape, solid);
    result.soup.solid_volume_m3 = solid.Mass();
  } catch (const Standard_Failure&) {  // the triangles serve without
  }
  return result;
}

template <class T>
void append(std::vector<char>& bytes, const T* data, std::size_t count) {
  const std::uint64_t size = count;
  const auto* length = reinterpret_cast<const char*>(&size);
  const auto* begin = reinterpret_cast<const char*>(data);
  bytes.insert(bytes.end(), length, length + sizeof size);
  bytes.insert(bytes.end(), begin, begin + count * sizeof(T));
}

template <class Container>
void take(const std::vector<char>& bytes, std::size_t& at, Container& into) {
  std::uint64_t size = 0;
  if (bytes.size() - at < sizeof size) throw core::NumericalError("it gave back too little");
  std::memcpy(&size, bytes.data() + at, sizeof size);
  at += sizeof size;
  const std::size_t each = sizeof(typename Container::value_type);
  if (size > (bytes.size() - at) / each) throw core::NumericalError("it gave back too little");
  into.resize(size);
  if (size > 0) std::memcpy(static_cast<void*>(into.data()), bytes.data() + at, size * each);
  at += size * each;
}

std::vector<char> serialised(const Found& found) {
  std::vector<char> bytes;
  append(bytes, found.fault.data(), found.fault.size());
  append(bytes, found.unit.data(), found.unit.size());
  append(bytes, found.soup.points.data(), found.soup.points.size());
  append(bytes, found.soup.triangles.data(), found.soup.triangles.size());
  append(bytes, &found.soup.solid_volume_m3, 1);
  return bytes;
}

Found found_confined(const std::string& path, const std::string& name, const StepOptions& options) {
  const auto work = [&] {
    try {
      return serialised(found_in(path, options));
    } catch (const Standard_Failure& failure) {
      return serialised({std::string("makes Open CASCADE fail (") + failure.DynamicType()->Name() + ")", {}, {}});
    }
  };
  try {
    const std::vector<char> bytes = mesh::run_confined(work, options.limits.time_s, options.limits.memory_bytes);
    Found found;
    std::size_t at = 0;
    take(bytes, at, found.fault);
    take(bytes, at, found.unit);
    take(bytes, at, found.soup.points);
    take(bytes, at, found.soup.triangles);
    std::vector<double> volume;
    take(bytes, at, volume);
    if (!volume.empty()) found.soup.solid_volume_m3 = volume.front();
    return found;
  } catch (const core::NumericalError& error) {
    throw core::DataError(name + ": Open CASCADE failed on the file: " + error.what() +
                          "; heal the part in the CAD program, or export it as STL");
  }
}

/// Metres in the unit that the file names, if it is one of the common units.
std::optional<double> metres_in(const std::string& unit) {
  const std::vector<std::pair<const char*, double>> known{
      {"metre", 1.0},        {"meter", 1.0},       {"m", 1.0},           {"millimetre", 1e-3}, {"millimeter", 1e-3},
      {"mm", 1e-3},          {"centimetre", 1e-2}, {"centimeter", 1e-2}, {"cm", 1e-2},         {"micrometre", 1e-6},
      {"kilometre", 1000.0}, {"inch", 0.0254},     {"in", 0.0254},       {"foot", 0.3048}};
  TCollection_AsciiString lower(unit.c_str());
  lower.LowerCase();
  for (const auto& [name, metres] : known)
    if (lower == name) return metres;
  return std::nullopt;
}

}  // namespace

bool reads_step() {
  return true;
}

StepSurface read_step(const std::filesystem::path& path, const StepOptions& options) {
  validate(options);
  const std::string name = path.string();
  require_whole(core::read_file(path), name);
  Found found = found_confined(name, "\"" + name + "\"", options);
  if (!found.fault.empty()) throw core::DataError("\"" + name + "\" " + found.fault);
  const auto stated = metres_in(found.unit);
  if (!stated) {
    throw core::DataError("\"" + name + "\" " +
                          (found.unit.empty() ? "states no unit of length"
                                              : "states its lengths in \"" + found.unit + "\", which is not known") +
                          "; export it in millimetres");
  }
  StepSurface result{std::move(found.soup), found.unit,
                     options.metres_per_unit > 0.0 ? options.metres_per_unit : *stated};
  const double scale = reader_unit_m * result.metres_per_unit / *stated;
  for (auto& x : result.soup.points) x *= scale;
  result.soup.solid_volume_m3 *= scale * scale * scale;
  return result;
}

}  // namespace thinwall::io
