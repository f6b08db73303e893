// Contacts whose stiffness comes with their preload: Hertz, Mindlin, a ball caster, and a measured table.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "coupling/contact_table.hpp"
#include "coupling/hertz_contact.hpp"

namespace thinwall::coupling::preloaded_contact_test {
namespace {

constexpr Elastic steel{210e9, 0.3}, aluminium{70e9, 0.33};
const HertzContact ball_on_plate{relative_radius(0.0127), steel, aluminium};

TEST(Hertz, HasItsClosedForms) {
  const double F = 80.0, R = 0.0127;
  const double E = 1.0 / ((1.0 - 0.09) / 210e9 + (1.0 - 0.33 * 0.33) / 70e9);
  const HertzState state = hertz(ball_on_plate, F);
  EXPECT_NEAR(state.approach / std::cbrt(9.0 * F * F / (16.0 * R * E * E)), 1.0, 1e-14);  // Johnson 1985, Eq. 4.23
  EXPECT_NEAR(state.peak_pressure / std::cbrt(6.0 * F * E * E / (std::pow(std::numbers::pi, 3) * R * R)), 1.0,
              1e-14);  // Eq. 4.24
  EXPECT_NEAR(state.normal / std::cbrt(6.0 * F * R * E * E), 1.0, 1e-14);
}

TEST(Hertz, StiffnessIsTheSlopeOfForceOverApproach) {
  for (const double F : {1.0, 50.0, 1000.0}) {
    const double h = 1e-4 * F;
    const auto delta = [&](double force) { return hertz(ball_on_plate, force).approach; };
    // fourth order: (8 (δ₊₁ − δ₋₁) − (δ₊₂ − δ₋₂)) / 12h
    const double slope = (8.0 * (delta(F + h) - delta(F - h)) - (delta(F + 2 * h) - delta(F - 2 * h))) / (12.0 * h);
    EXPECT_NEAR(slope * hertz(ball_on_plate, F).normal, 1.0, 1e-10) << F;
  }
}

TEST(Hertz, PressureCarriesTheForce) {
  // p = p_0 √(1 − r²/a²) over the contact's circle: F = ⅔ π a² p_0
  const HertzState state = hertz(ball_on_plate, 123.0);
  const double area = std::numbers::pi * state.contact_radius * state.contact_radius;
  EXPECT_NEAR(2.0 / 3.0 * area * state.peak_pressure, 123.0, 1e-11);
}

TEST(Hertz, TangentialStiffnessOfEqualMaterialsIsMindlinsRatio) {
  for (const double nu : {0.0, 0.3, 0.5}) {
    const Elastic material{100e9, nu};
    const HertzState state = hertz({0.01, material, material}, 30.0);
    EXPECT_NEAR(state.tangential / state.normal, 2.0 * (1.0 - nu) / (2.0 - nu), 1e-14) << nu;  // Johnson, Eq. 7.44
  }
}

TEST(Hertz, RadiiOfBallsAndHollows) {
  EXPECT_DOUBLE_EQ(relative_radius(0.01), 0.01);
  EXPECT_NEAR(relative_radius(0.01, 0.01), 0.005, 1e-17);
  EXPECT_NEAR(relative_radius(0.01, -0.02), 0.02, 1e-17);
  EXPECT_THROW((void)relative_radius(0.01, -0.01), core::InputError);
  EXPECT_THROW((void)relative_radius(0.01, 0.0), core::InputError);
  EXPECT_THROW((void)relative_radius(-0.01), core::InputError);
  EXPECT_THROW((void)relative_radius(std::nan("")), core::InputError);
}

/// The deflection of the caster under F: that of the part's contact, and that of the ring of balls along the axis.
double caster_travel(const BallCaster& caster, const Elastic& part, double F) {
  const double Q = F / (caster.balls * std::cos(caster.angle));
  const double cup = caster.ball_radius + 2.0 * caster.support_radius;
  const double ring =
      hertz({relative_radius(caster.ball_radius, caster.support_radius), caster.steel, caster.steel}, Q).approach +
      hertz({relative_radius(caster.support_radius, -cup), caster.steel, caster.steel}, Q).approach;
  return hertz({caster.ball_radius, caster.steel, part}, F).approach + ring / std::cos(caster.angle);
}

TEST(BallCaster, StiffnessIsTheSlopeOfItsTravel) {
  const BallCaster caster{0.0127, 0.002, 12, 0.6, steel};
  for (const double F : {10.0, 100.0}) {
    const double h = 1e-4 * F;
    const auto travel = [&](double force) { return caster_travel(caster, aluminium, force); };
    const double slope = (8.0 * (travel(F + h) - travel(F - h)) - (travel(F + 2 * h) - travel(F - 2 * h))) / (12 * h);
    EXPECT_NEAR(slope * caster_stiffness(caster, aluminium, F), 1.0, 1e-10) << F;
  }
  EXPECT_LT(caster_stiffness(caster, aluminium, 50.0), hertz({0.0127, steel, aluminium}, 50.0).normal);
}

TEST(BallCaster, FaultyOnesAndNoPreloadAreRefused) {
  const BallCaster caster{0.0127, 0.002, 12, 0.6, steel};
  for (const double F : {0.0, -5.0, std::nan("")}) {
    EXPECT_THROW((void)caster_stiffness(caster, aluminium, F), core::InputError);
    EXPECT_THROW((void)hertz(ball_on_plate, F), core::InputError);
  }
  EXPECT_THROW((void)caster_stiffness({0.0127, 0.002, 2, 0.6, steel}, aluminium, 1.0), core::InputError);
  EXPECT_THROW((void)caster_stiffness({0.0127, 0.002, 12, 1.6, steel}, aluminium, 1.0), core::InputError);
  EXPECT_THROW((void)caster_stiffness({0.0127, 0.0, 12, 0.6, steel}, aluminium, 1.0), core::InputError);
  EXPECT_THROW((void)hertz({0.01, {0.0, 0.3}, steel}, 1.0), core::InputError);
  EXPECT_THROW((void)hertz({0.01, {1e9, 0.6}, steel}, 1.0), core::InputError);
}

ContactTable table() {
  ContactTable rows{Eigen::VectorXd(5), Eigen::VectorXd(5), Eigen::VectorXd(5)};
  rows.preload << 10, 20, 50, 60, 150;
  rows.stiffness << 1e6, 1.5e6, 1.5e6, 4e6, 4.1e6;
  rows.damping << 80, 50, 40, 45, 30;
  return rows;
}

TEST(ContactTable, GoesThroughItsRowsAndStaysBetweenThem) {
  const ContactTable rows = table();
  for (Eigen::Index i = 0; i < 5; ++i) {
    const ContactSpring spring = spring_at(rows, rows.preload(i), Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(spring.stiffness / rows.stiffness(i), 1.0, 1e-15);
    EXPECT_NEAR(spring.damping / rows.damping(i), 1.0, 1e-15);
    EXPECT_EQ(spring.direction, Eigen::Vector3d(Eigen::Vector3d::UnitZ()));
  }
  for (Eigen::Index i = 0; i + 1 < 5; ++i) {
    double last = rows.stiffness(i), last_damping = rows.damping(i);
    for (int k = 1; k <= 200; ++k) {
      const double F = rows.preload(i) + (rows.preload(i + 1) - rows.preload(i)) * k / 200.0;
      const ContactSpring spring = spring_at(rows, std::min(F, rows.preload(i + 1)));
      const double rise = rows.damping(i + 1) - rows.damping(i);
      EXPECT_GE(spring.stiffness, last * (1.0 - 1e-14)) << F;  // the stiffness never falls in this table
      EXPECT_GE((spring.damping - last_damping) * rise, -1e-10) << F;
      last = spring.stiffness;
      last_damping = spring.damping;
    }
  }
}

TEST(ContactTable, ConvergesToHertzWithItsRows) {
  // a smooth law by more and more rows: the slopes are of second order, the values of third
  double previous = 0.0;
  for (const int rows : {21, 41, 81, 161}) {
    ContactTable hertzian{Eigen::VectorXd::LinSpaced(rows, 10.0, 100.0), Eigen::VectorXd(rows),
                          Eigen::VectorXd::Zero(rows)};
    for (Eigen::Index i = 0; i < rows; ++i) hertzian.stiffness(i) = hertz(ball_on_plate, hertzian.preload(i)).normal;
    double worst = 0.0;
    for (double F = 10.0; F <= 100.0; F += 0.37) {
      worst = std::max(worst, std::abs(spring_at(hertzian, F).stiffness / hertz(ball_on_plate, F).normal - 1.0));
    }
    if (previous > 0.0) {
      EXPECT_GT(previous / worst, 5.0) << rows;
    }
    previous = worst;
  }
  EXPECT_LT(previous, 1e-5);
}

TEST(ContactTable, TwoRowsAreAStraightLine) {
  const ContactTable two{Eigen::Vector2d(10, 20), Eigen::Vector2d(1e6, 2e6), Eigen::Vector2d(0, 10)};
  EXPECT_NEAR(spring_at(two, 12.5).stiffness, 1.25e6, 1e-6);
  EXPECT_NEAR(spring_at(two, 12.5).damping, 2.5, 1e-12);
}

TEST(ContactTable, RefusesPreloadsThatWereNotMeasuredAndFaultyRows) {
  for (const double F : {9.99, 150.01, std::nan("")}) {
    try {
      (void)spring_at(table(), F);
      ADD_FAILURE() << F << " N was accepted";
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("from 10 to 150 N"), std::string::npos) << error.what();
    }
  }
  ContactTable faulty = table();
  faulty.preload(2) = 20.0;
  faulty.stiffness(1) = 0.0;
  faulty.damping(4) = std::nan("");
  try {
    require_valid(faulty);
    FAIL() << "a faulty table was accepted";
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    for (const char* part : {"preload in row 3 is 20", "stiffness in row 2 is 0", "damping in row 5"}) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
    }
  }
  faulty.damping.resize(3);
  EXPECT_THROW(require_valid(faulty), core::InputError);
}

TEST(ContactTable, RefusesNumbersThatNoContactHas) {
  EXPECT_NO_THROW(require_valid(table()));
  ContactTable large = table();
  large.preload(4) = 1e300;
  EXPECT_THROW(require_valid(large), core::InputError);
  large = table();
  large.stiffness(4) = 1e300;
  EXPECT_THROW(require_valid(large), core::InputError);
  large = table();
  large.damping(4) = 1e300;
  EXPECT_THROW(require_valid(large), core::InputError);
}

}  // namespace
}  // namespace thinwall::coupling::preloaded_contact_test
