// Parts at the edge of what double precision solves: each is refused or told with its cause.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "case/reader.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_stage.hpp"

namespace thinwall::tests::hazards_test {
namespace {

/// A plate that is held at its foot, with what follows.
cases::Case plate(const std::string& length, const std::string& height, const std::string& thickness,
                  const std::string& modulus, const std::string& rest = "") {
  return cases::parse_case("[part]\nlength = \"" + length + "\"\nheight = \"" + height + "\"\nthickness = \"" +
                               thickness + "\"\n[part.material]\nyoungs_modulus = \"" + modulus +
                               "\"\npoisson_ratio = 0.3\ndensity = \"2800 kg/m^3\"\n[[part.supports]]\non = \"z_min\"\n"
                               "[modes]\ncount = 1\n[part.mesh]\ntolerance = 0.05\n[damping]\nratio = 0.01\n" +
                               rest,
                           ".");
}

/// The warnings of the part's stage; an error of it is the last.
std::vector<std::string> told(const cases::Case& source) {
  std::vector<std::string> texts;
  const auto before = core::set_message_listener([&](core::MessageLevel level, const std::string& text) {
    if (level == core::MessageLevel::warning) texts.push_back(text);
  });
  try {
    study::Stages stages;
    (void)study::compute_part(study::part_input(source), study::discretise(study::part_input(source)), stages);
  } catch (const core::Error& error) {
    texts.emplace_back(error.what());
  }
  core::set_message_listener(before);
  return texts;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + '\n';
  return all;
}

TEST(Hazards, AFoilOfAspect6000IsRefusedWithItsCause) {
  const std::string texts = joined(told(plate("600 mm", "300 mm", "0.1 mm", "71 GPa")));
  EXPECT_NE(texts.find("too thin"), std::string::npos) << texts;
}

TEST(Hazards, RoundOffOfUnlikeMaterialsIsToldAsTheirs) {
  const std::string texts = joined(told(plate("60 mm", "60 mm", "1.2 mm", "2000 GPa",
                                              "[[part.materials]]\non = \"top\"\nyoungs_modulus = \"1 MPa\"\n"
                                              "poisson_ratio = 0.3\ndensity = \"1000 kg/m^3\"\n[selections.top.box]\n"
                                              "min = [\"0 mm\", \"0 mm\", \"30 mm\"]\n"
                                              "max = [\"60 mm\", \"60 mm\", \"60 mm\"]\n")));
  EXPECT_NE(texts.find("materials are of very unlike stiffness, 1 MPa and 2000 GPa"), std::string::npos) << texts;
  EXPECT_EQ(texts.find("very thin"), std::string::npos) << texts;
}

TEST(Hazards, RoundOffOfAThinWallIsToldAsItsOwn) {
  const std::string texts = joined(told(plate("600 mm", "300 mm", "0.3 mm", "71 GPa")));
  EXPECT_NE(texts.find("very thin"), std::string::npos) << texts;
}

}  // namespace
}  // namespace thinwall::tests::hazards_test
