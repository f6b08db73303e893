#pragma once
// Errors of PETSc as exceptions.

#include <petscsys.h>

#include <stdexcept>
#include <string>

namespace thinwall::distributed {

/// Throws std::runtime_error with PETSc's message for a code that is not zero.
inline void require(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  char* detail = nullptr;
  PetscErrorMessage(code, &text, &detail);
  throw std::runtime_error("PETSc: " + std::string(text != nullptr ? text : "unknown error") +
                           (detail != nullptr && *detail != '\0' ? ", " + std::string(detail) : ""));
}

}  // namespace thinwall::distributed
