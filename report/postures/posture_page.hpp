#pragma once
// Everything that the page of a study of postures shows, as one JSON document.

#include <nlohmann/json.hpp>
#include <string>

#include "study/postures/posture_study.hpp"

namespace thinwall::report {

/// The document of web/document.md with "postures" in the place of runs, for page(), under a title; `program` makes it
/// ("thinwall 0.1.0"). Cost O(postures · modes + places of the map).
[[nodiscard]] nlohmann::json posture_document(const study::PostureStudy& study, const std::string& title,
                                              const std::string& program);

}  // namespace thinwall::report
