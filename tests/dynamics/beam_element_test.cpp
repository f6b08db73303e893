#include "dynamics/beam_element.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace thinwall::dynamics::beam_element_test {
namespace {

using Vector12 = Eigen::Vector<double, 12>;

constexpr Tube steel_tube{0.2, 0.15, 210e9, 0.3, 7850.0};

/// A section in which no two numbers are equal, so that no exchange of them goes unnoticed.
BeamSection unequal_section() {
  return {.youngs_modulus_Pa = 70e9,
          .shear_modulus_Pa = 26e9,
          .density_kg_m3 = 2700.0,
          .area_m2 = 4e-3,
          .I_y_m4 = 7e-6,
          .I_z_m4 = 2e-6,
          .J_m4 = 1.3e-6,
          .shear_y = 0.8,
          .shear_z = 0.4};
}

// Cowper 1966, table 1: 0.886 of a circle, 0.531 of a thin round tube at ν = 0.3.
TEST(Tube, HasCowpersShearFactors) {
  EXPECT_NEAR(section({0.1, 0.0, 210e9, 0.3, 7850.0}).shear_y, 0.886, 5e-4);
  EXPECT_NEAR(section({0.1, 0.0999, 210e9, 0.3, 7850.0}).shear_y, 0.531, 5e-4);
  EXPECT_NEAR(section({0.1, 0.0, 210e9, 0.0, 7850.0}).shear_y, 6.0 / 7.0, 1e-15);
}

TEST(Tube, ThatCannotBeIsRefusedWithAllItsFaults) {
  const double nan = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Tube& tube :
       {Tube{0.1, 0.1, 1e9, 0.3, 1.0}, Tube{0.1, 0.2, 1e9, 0.3, 1.0}, Tube{0.1, -0.01, 1e9, 0.3, 1.0},
        Tube{0.1, nan, 1e9, 0.3, 1.0}, Tube{infinite, 0.0, 1e9, 0.3, 1.0}, Tube{0.1, 0.0, 1e9, 0.5, 1.0},
        Tube{0.1, 0.0, 1e9, -0.1, 1.0}, Tube{0.1, 0.0, 1e9, nan, 1.0}, Tube{0.1, 0.0, 0.0, 0.3, 1.0},
        Tube{0.1, 0.0, 1e9, 0.3, 0.0}})
    EXPECT_THROW((void)section(tube), core::InputError);
  try {
    (void)section({0.1, 0.2, 1e9, 0.7, -1.0});
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* word : {"inner diameter", "Poisson", "density"}) EXPECT_NE(text.find(word), std::string::npos);
  }
}

TEST(BeamElement, TipStiffnessIsTheInverseOfTipCompliance) {
  const BeamSection s = unequal_section();
  const Matrix6 product = tip_stiffness(s, 0.7) * tip_compliance(s, 0.7);
  EXPECT_LT((product - Matrix6::Identity()).cwiseAbs().maxCoeff(), 1e-13);
}

// End 1 clamped, a force on end 2: K's lower right block must give the compliance; rigid motions cost nothing.
TEST(BeamElement, StiffnessBearsForcesOnItsEndsAndNoRigidMotion) {
  const BeamSection s = unequal_section();
  const double L = 0.7;
  const Matrix12 K = beam_stiffness(s, L);
  EXPECT_LT((K.bottomRightCorner<6, 6>() * tip_compliance(s, L) - Matrix6::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  Eigen::Matrix<double, 12, 6> rigid;
  rigid << Matrix6::Identity(), transport({L, 0.0, 0.0});
  EXPECT_LT((K * rigid).cwiseAbs().maxCoeff(), 1e-13 * K.cwiseAbs().maxCoeff());
}

// A force F and a torque M on the end of a cantilever: M(x) = F (L − x) + M integrated twice, and the shear's F x/κGA.
TEST(BeamElement, SectionsMoveAsThoseOfATipLoadedCantilever) {
  const BeamSection s = unequal_section();
  const double L = 0.7;
  const double F = 900.0, M = 350.0;
  Eigen::Vector<double, 6> load;
  load << 100.0, F, 2.0 * F, 10.0, 3.0 * M, M;
  Vector12 ends = Vector12::Zero();
  ends.tail<6>() = tip_compliance(s, L) * load;
  for (const double share : {0.0, 0.3, 0.8, 1.0}) {
    const double x = share * L;
    const Eigen::Vector<double, 6> q = section_motion(s, L, share) * ends;
    const double EI_z = s.youngs_modulus_Pa * s.I_z_m4, EI_y = s.youngs_modulus_Pa * s.I_y_m4;
    const double GA = s.shear_modulus_Pa * s.area_m2;
    const double force_bends = (3.0 * L - x) * x * x / 6.0, torque_bends = x * x / 2.0, force_turns = (L - x / 2.0) * x;
    const double expected[] = {100.0 * x / (s.youngs_modulus_Pa * s.area_m2),
                               (F * force_bends + M * torque_bends) / EI_z + F * x / (s.shear_y * GA),
                               (2.0 * F * force_bends - 3.0 * M * torque_bends) / EI_y + 2.0 * F * x / (s.shear_z * GA),
                               10.0 * x / (s.shear_modulus_Pa * s.J_m4),
                               (-2.0 * F * force_turns + 3.0 * M * x) / EI_y,
                               (F * force_turns + M * x) / EI_z};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(q(i), expected[i], 1e-13 * ends.cwiseAbs().maxCoeff()) << i << " at " << x;
  }
}

TEST(BeamElement, MovesAsOneRigidBodyWithItsEnds) {
  const BeamSection s = unequal_section();
  const double L = 0.7;
  Eigen::Matrix<double, 12, 6> rigid;
  rigid << Matrix6::Identity(), transport({L, 0.0, 0.0});
  for (const double share : {0.0, 0.25, 1.0}) {
    const Matrix6 expected = transport({share * L, 0.0, 0.0});
    EXPECT_LT((section_motion(s, L, share) * rigid - expected).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(BeamElement, HasTheMassAndInertiaOfTheRod) {
  const BeamSection s = unequal_section();
  const double L = 0.7;
  Eigen::Matrix<double, 12, 6> rigid;
  rigid << Matrix6::Identity(), transport({L, 0.0, 0.0});
  const Matrix6 found = rigid.transpose() * beam_mass(s, L) * rigid;
  const double per_length = s.density_kg_m3 * s.area_m2;
  const double rod = per_length * L * L * L / 12.0;
  const Eigen::Vector3d inertia(s.density_kg_m3 * (s.I_y_m4 + s.I_z_m4) * L, rod + s.density_kg_m3 * s.I_y_m4 * L,
                                rod + s.density_kg_m3 * s.I_z_m4 * L);
  const Matrix6 expected = mass_matrix({per_length * L, {L / 2.0, 0.0, 0.0}, inertia.asDiagonal()});
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-14 * expected.cwiseAbs().maxCoeff());
}

// Without shear and rotary inertia the matrix is the consistent one of Archer 1963, mL/420 [156 22L 54 −13L ...].
TEST(BeamElement, MassOfASlenderBeamIsArchers) {
  BeamSection s = unequal_section();
  s.shear_y = s.shear_z = std::numeric_limits<double>::infinity();
  s.I_z_m4 = 1e-22;
  s.I_y_m4 = 1e-22;
  const double L = 0.7;
  Eigen::Matrix4d expected;
  expected << 156.0, 22.0 * L, 54.0, -13.0 * L,       //
      22.0 * L, 4.0 * L * L, 13.0 * L, -3.0 * L * L,  //
      54.0, 13.0 * L, 156.0, -22.0 * L,               //
      -13.0 * L, -3.0 * L * L, -22.0 * L, 4.0 * L * L;
  expected *= s.density_kg_m3 * s.area_m2 * L / 420.0;
  const Matrix12 M = beam_mass(s, L);
  EXPECT_LT((M({1, 5, 7, 11}, {1, 5, 7, 11}) - expected).cwiseAbs().maxCoeff(), 1e-14 * expected(0, 0));
  const Eigen::Vector4d sign(1.0, -1.0, 1.0, -1.0);
  const Eigen::Matrix4d xz = sign.asDiagonal() * expected * sign.asDiagonal();
  EXPECT_LT((M({2, 4, 8, 10}, {2, 4, 8, 10}) - xz).cwiseAbs().maxCoeff(), 1e-14 * expected(0, 0));
  EXPECT_NEAR(M(0, 0) / M(0, 6), 2.0, 1e-13);
}

TEST(BeamElement, SectionsWithoutANumberAreNoted) {
  BeamSection broken = unequal_section();
  broken.J_m4 = 0.0;
  broken.area_m2 = std::nan("");
  broken.shear_y = std::nan("");
  core::Faults faults;
  check(broken, "link 2", faults);
  try {
    faults.raise("arm");
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* word : {"arm: link 2", "torsion", "area", "shear"}) EXPECT_NE(text.find(word), std::string::npos);
  }
  core::Faults none;
  check(section(steel_tube), "tube", none);
  EXPECT_NO_THROW(none.raise("arm"));
}

TEST(RigidBody, MovesAboutAnotherPointByItsParallelAxes) {
  const RigidBody body{2.0, {0.3, -0.2, 0.5}, Eigen::Vector3d(0.1, 0.2, 0.25).asDiagonal()};
  const Matrix6 M = mass_matrix(body);
  EXPECT_NEAR(M(3, 3), 0.1 + 2.0 * (0.04 + 0.25), 1e-15);
  EXPECT_NEAR(M(3, 4), -2.0 * 0.3 * -0.2, 1e-15);
  EXPECT_NEAR(M(0, 4), 2.0 * 0.5, 1e-15);  // turning about y moves the centre along x by z
  EXPECT_NEAR(M(0, 5), 2.0 * 0.2, 1e-15);  // and about z by −y
}

}  // namespace
}  // namespace thinwall::dynamics::beam_element_test
