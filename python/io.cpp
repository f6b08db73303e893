// Bindings of io: measured receptances from files.

#include "io/frf/frf_csv.hpp"
#include "io/frf/response_csv.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

dynamics::ResponseModel read_frf(const std::filesystem::path& path, const std::string& dof, const std::string& quantity,
                                 const std::string& unit, const std::string& frequency_unit) {
  const io::MeasuredFrf frf = io::read_frf(path, io::frf_format(quantity, unit, frequency_unit));
  dynamics::ResponseModel model{frf.axis, {dof_from_name(dof)}, {dof_from_name(dof)}, {}};
  for (const auto& value : frf.H) model.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, value));
  return model;
}

}  // namespace

void bind_io(py::module_& module) {
  module.def(
      "read_frf", read_frf, "path"_a, "dof"_a, py::kw_only(), "quantity"_a, "unit"_a, "frequency_unit"_a = "Hz",
      LongCallGuard(),
      "A measured driving point from CSV (frequency, real, imaginary part) as a Response of one entry.\n\n"
      "quantity: receptance, mobility or accelerance; unit: that of the values, such as \"um/N\"; both are required.");
  module.def("read_response", io::read_response, "path"_a, LongCallGuard(),
             "A receptance matrix from a file frf/<name>.csv of the program, as a Response.");
}

}  // namespace thinwall::python
