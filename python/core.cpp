// Bindings of errors, interruption and threads, and conversions that the other files share.

#include <thread>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

const std::thread::id main_thread = std::this_thread::get_id();  // Python normally imports the module on this thread

extern "C" void ask_to_stop(int /*signal*/) {
  core::request_interrupt();
}

/// The Python classes, made once in a process; they are never freed.
struct Errors {
  PyObject* error = nullptr;
  PyObject* input = nullptr;
  PyObject* data = nullptr;
  PyObject* numerical = nullptr;
};

Errors& errors() {
  static Errors classes;
  return classes;
}

PyObject* new_error(py::module_& module, const char* name, const char* doc, PyObject* builtin) {
  const py::object bases = errors().error == nullptr ? py::reinterpret_borrow<py::object>(builtin)
                                                     : py::make_tuple(py::handle(errors().error), py::handle(builtin));
  const std::string full = std::string("thinwall.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.add_object(name, type);
  return type;
}

void set_thread_count(int threads) {
  if (threads < 1) throw core::InputError("threads: " + std::to_string(threads) + " is below 1, the least");
  core::set_thread_count(threads);
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const core::InputError& error) {
    PyErr_SetString(errors().input, error.what());
  } catch (const core::DataError& error) {
    PyErr_SetString(errors().data, error.what());
  } catch (const core::NumericalError& error) {
    PyErr_SetString(errors().numerical, error.what());
  } catch (const core::Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } catch (const core::Error& error) {
    PyErr_SetString(errors().error, error.what());
  }
}

}  // namespace

LongCall::LongCall() {
  if (std::this_thread::get_id() != main_thread) return;
  sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler == SIG_IGN) return;
  core::clear_interrupt();
  struct sigaction ours {};
  ours.sa_handler = ask_to_stop;
  sigemptyset(&ours.sa_mask);
  installed_ = sigaction(SIGINT, &ours, nullptr) == 0;
}

LongCall::~LongCall() {
  if (!installed_) return;
  sigaction(SIGINT, &before_, nullptr);
  if (!core::interrupt_requested()) return;
  core::clear_interrupt();
  if (std::uncaught_exceptions() == 0) PyErr_SetInterrupt();
}

void bind_core(py::module_& module) {
  errors().error = new_error(module, "Error", "Base of every error of thinwall.", PyExc_Exception);
  errors().input = new_error(module, "InputError",
                             "An argument or a case is impossible; the message contains the remedy.", PyExc_ValueError);
  errors().data = new_error(module, "DataError", "A file cannot be read.", PyExc_OSError);
  errors().numerical = new_error(
      module, "NumericalError", "A computation does not reach the accuracy that was asked for.", PyExc_ArithmeticError);
  py::register_exception_translator(translate);
  module.attr("__version__") = THINWALL_VERSION;
  module.def("thread_count", core::thread_count, "The number of threads that long calls use.");
  module.def("set_thread_count", set_thread_count, "threads"_a,
             "Sets the number of threads that long calls use, 1 or more.");
}

}  // namespace thinwall::python
