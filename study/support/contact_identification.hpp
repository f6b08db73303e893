#pragma once
// Stiffness and damping of a case's contact from FRFs of the part while the robot holds it.

#include <vector>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// FRFs of an assembly on those lines of `axis` that all files cover, as a matrix of the responses that the files name
/// by their forces; where both are of one point, an entry that only its transpose gives is taken from there. Throws
/// InputError where the files cover no line, with both ranges, and for an entry that no file gives; else as
/// read_measured().
[[nodiscard]] dynamics::ResponseModel assembly_response(const std::vector<setup::MeasuredFrf>& files,
                                                        const dynamics::FrequencyAxis& axis);

/// The joint of the case's only contact (coupling/joint_identification.hpp, docs/theory/coupling.md, Eq. 16) from both
/// components' responses on the axis of the run and the assembly's FRFs. Components that are modelled are held for as
/// noisy as the case says, not for exact. Throws NumericalError where the lines hold too little of the contact or K is
/// not positive definite, InputError as assembly_response() and coupling::identify_joint(). Cost lines · n⁴ times some
/// passes.
[[nodiscard]] ContactIdentification identify_contact(const setup::SupportContact& contact, const Component& part,
                                                     const Component& robot);

/// Warns where the residuals are far larger than the noise (chi_squared above 4) or damping was raised to none.
void warn_of_misfit(const setup::SupportContact& contact, const ContactIdentification& identification);

}  // namespace thinwall::study
