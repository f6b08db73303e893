#include "setup/measured_layout.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace thinwall::setup {

namespace {

using Eigen::Index;

Index number_of(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) - names.begin();
}

std::string entry_text(const std::string& response, const std::string& force) {
  return "the response of " + response + " to a force at " + force;
}

std::string fault_of_dofs(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const dynamics::Dof a = dof_of(names[j]), b = dof_of(names[i]);
      if (a.point != b.point || std::abs(a.direction.dot(b.direction)) < 0.5) continue;
      return names[j] + " and " + names[i] +
             " are along one line; name it one way, and turn the sign in the other file";
    }
  }
  return "";
}

std::string fault_of_gaps(const MeasuredLayout& layout) {
  std::string first;
  int gaps = 0;
  for (Index a = 0; a < layout.file.rows(); ++a) {
    for (Index b = a; b < layout.file.rows(); ++b) {  // what is absent is absent both ways
      if (layout.file(a, b) >= 0) continue;
      if (++gaps > 1) continue;
      first = entry_text(layout.dofs[static_cast<std::size_t>(a)], layout.dofs[static_cast<std::size_t>(b)]);
    }
  }
  if (gaps == 0) return "";
  return "no file gives " + first + ", nor the reverse" +
         (gaps > 1 ? " (and so for " + std::to_string(gaps - 1) + " more)" : "") + ": add one, or leave the others out";
}

}  // namespace

dynamics::Dof dof_of(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) {
    throw core::InputError("\"" + name + "\" names no degree of freedom; write it as POINT.x, POINT.y or POINT.z");
  }
  return {name.substr(0, dot), dynamics::axis(name.substr(dot + 1)), dynamics::DofKind::translation};
}

MeasuredLayout measured_layout(const std::vector<MeasuredFrf>& files) {
  MeasuredLayout layout;
  for (const MeasuredFrf& file : files) {
    for (const auto* name : {&file.response, &file.force}) {
      if (std::ranges::find(layout.dofs, *name) == layout.dofs.end()) layout.dofs.push_back(*name);
    }
  }
  const auto n = static_cast<Index>(layout.dofs.size());
  layout.file.setConstant(n, n, -1);
  for (const bool transposed : {false, true}) {
    for (std::size_t k = 0; k < files.size(); ++k) {
      const Index response = number_of(layout.dofs, files[k].response), force = number_of(layout.dofs, files[k].force);
      int& place = transposed ? layout.file(force, response) : layout.file(response, force);
      if (place < 0) place = static_cast<int>(k);
    }
  }
  return layout;
}

LayoutFault fault_of_layout(const std::vector<MeasuredFrf>& files) {
  for (std::size_t k = 0; k < files.size(); ++k) {
    for (std::size_t earlier = 0; earlier < k; ++earlier) {
      if (files[earlier].response != files[k].response || files[earlier].force != files[k].force) continue;
      return {entry_text(files[k].response, files[k].force) + " is there twice; keep one file", k};
    }
  }
  const MeasuredLayout layout = measured_layout(files);
  const std::string fault = fault_of_dofs(layout.dofs);
  return {fault.empty() ? fault_of_gaps(layout) : fault, {}};
}

std::string point_of(const std::string& dof) {
  return dof.substr(0, dof.find('.'));
}

}  // namespace thinwall::setup
