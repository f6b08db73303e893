#pragma once
// The contacts of a case as the coupling joins them: springs as given, found from FRFs, or from the preload.

#include <filesystem>
#include <optional>
#include <vector>

#include "coupling/contact.hpp"
#include "coupling/contact_table.hpp"
#include "coupling/hertz_contact.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// A contact as it is joined, and what its stiffness comes from.
struct JoinedContact {
  std::string model;  ///< springs, table, hertz, caster, identified
  coupling::Contact contact;
  std::optional<double> preload_n;            ///< of table, hertz and caster
  std::optional<coupling::HertzState> hertz;  ///< where a ball touches the part
};

/// The preload (N) that the contact itself is given; none of given springs.
[[nodiscard]] std::optional<double> own_preload(const SupportContact& contact);

/// The force (N) that presses the contact together: its own, else |n·F| with its normal n (the first direction) and F
/// of robot.preload. A part only pushes, so the sign of n·F tells on which side the tip is, no more. None where that is
/// zero, or where several contacts share F.
[[nodiscard]] std::optional<double> preload_of(const SupportSetup& source, const SupportContact& contact);

/// Columns preload_n, stiffness_n_per_m and damping_n_s_per_m of a CSV, a row a preload. Throws DataError with the file
/// for a column that is absent, and for a table that coupling::require_valid() refuses.
[[nodiscard]] coupling::ContactTable read_contact_table(const std::filesystem::path& path);

/// The contact with its stiffness (coupling/contact_table.hpp, coupling/hertz_contact.hpp): of a ball k_n along the
/// first direction and k_t along the others, which are at right angles to it. The `identified` joint that was found
/// from FRFs stands as matrices in place of springs. Throws InputError for a preload that is missing or outside the
/// table, a table that was not read, a ball or material that is none. Cost: microseconds.
[[nodiscard]] JoinedContact joined_contact(const PartSetup& part, const SupportSetup& support,
                                           const SupportContact& contact,
                                           const std::optional<coupling::JointMatrices>& identified = {});

/// All contacts in their order, the first with the `identified` joint where one was found; errors name the contact.
[[nodiscard]] std::vector<JoinedContact> joined_contacts(const PartSetup& part, const SupportSetup& support,
                                                         const std::optional<coupling::JointMatrices>& identified = {});

}  // namespace thinwall::setup
