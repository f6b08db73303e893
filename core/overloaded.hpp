#pragma once
// Lambdas as one function with an overload for each alternative of a std::variant.

namespace thinwall::core {

/// A function object with the overloads of all given: std::visit(overloaded{[](const A&) {…}, [](const B&) {…}}, value)
/// does not compile while an alternative is left out.
template <class... Functions>
struct overloaded : Functions... {
  using Functions::operator()...;
};

/// The type of a set of functions from the functions themselves.
template <class... Functions>
overloaded(Functions...) -> overloaded<Functions...>;

}  // namespace thinwall::core
