#include "io/frf/modal_table_csv.hpp"

#include "core/error.hpp"
#include "scratch_folder.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::test::modal_table_csv_test {

namespace {

using core::DataError;
using core::InputError;

class ModalTableFile : public ScratchFolder {
 protected:
  [[nodiscard]] std::string refusal(const std::string& content) const {
    const auto file = write("modes.csv", content);
    return message_of<DataError>([&] { (void)read_modal_table(file, {1.0, 1e-7, {{"1", {0.0}}}}); });
  }
};

const std::string head = "mode,frequency_hz,damping_percent,L_1X_re,L_1X_im,R_1X_re,R_1X_im\n";

TEST_F(ModalTableFile, IsReadByTheNamesOfItsColumns) {
  const auto file =
      write("modes.csv",
            "# in the order of nobody\nR_tipY_im;R_tipY_re;L_tipY_im;L_tipY_re;damping_ratio;frequency_hz\n"
            "4;3;2;1;0.02;15.5\n8;7;6;5;0.5;800\n");
  const dynamics::ModalTable table = read_modal_table(file, {2.0, 1e-7, {{"tip", {0.01, 0.02}}}});
  ASSERT_EQ(table.dofs.size(), 1U);
  EXPECT_EQ(dynamics::name(table.dofs[0]), "tip.y");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].frequency_hz, 15.5);
  EXPECT_EQ(table.rows[1].damping_ratio, 0.5);
  EXPECT_EQ(table.rows[0].left(0), std::complex<double>(2.0, 4.0));
  EXPECT_EQ(table.rows[1].right(0), std::complex<double>(1e-7 * 7.0, 1e-7 * 8.0));
  EXPECT_EQ(table.rows[1].place_m(0), 0.02);
  EXPECT_EQ(table.rows[1].mode, "2");
}

TEST_F(ModalTableFile, NamesAllColumnsThatAreMissing) {
  const std::string text = refusal("mode,L_1X_re,L_1X_im,R_1X_im\n1,2,3,4\n");
  for (const char* name : {"frequency_hz", "damping_percent or damping_ratio", "R_1X_re"})
    EXPECT_NE(text.find(name), std::string::npos) << text;
  EXPECT_NE(refusal("frequency_hz,damping_ratio\n1,0.1\n").find("the vectors"), std::string::npos);
  EXPECT_NE(refusal("1,2,3\n4,5,6\n").find("no header"), std::string::npos);
  EXPECT_NE(refusal("frequency,damping_ratio\n1,0.1\n").find("did you mean \"frequency_hz\""), std::string::npos);
  EXPECT_NE(refusal("frequency_hz,frequency_hz\n1,1\n").find("stands twice"), std::string::npos);
  EXPECT_NE(refusal("frequency_hz,damping_ratio,damping_percent,L_1X_re,L_1X_im,R_1X_re,R_1X_im\n1,.1,10,1,1,1,1\n")
                .find("keep one"),
            std::string::npos);
  EXPECT_NE(refusal("frequency_hz,damping_ratio,L_1W_re\n1,.1,10\n").find("L_1W_re"), std::string::npos);
}

// Found by fuzzing: every name was searched in the whole header, and the message named them all.
TEST_F(ModalTableFile, OfManyColumnsIsReadInTimeAndItsMessageStaysShort) {
  std::string header = "frequency_hz,damping_ratio";
  std::string line = "10,0.1";
  std::string half = header;
  for (int dof = 0; dof < 25000; ++dof) {
    const std::string name = "_" + std::to_string(dof) + "X_";
    header += ",L" + name + "re,L" + name + "im,R" + name + "re,R" + name + "im";
    line += ",1,2,3,4";
    half += ",L" + name + "re";
  }
  const double start = tests::processor_seconds();
  const auto file = write("wide.csv", header + "\n" + line + "\n");
  EXPECT_EQ(read_modal_table(file, {1.0, 1.0, {}}).dofs.size(), 25000U);
  const std::string text = refusal(half + "\n" + line + "\n");
  EXPECT_LT(tests::processor_seconds() - start, 20.0);
  EXPECT_NE(text.find(" and 74990 more"), std::string::npos) << text;
  EXPECT_LT(text.size(), 400U);
}

TEST_F(ModalTableFile, RefusesNumbersThatNoModeHas) {
  EXPECT_NE(refusal(head + "1,10,2,1,1,1,1\n2,-5,2,1,1,1,1\n").find("modes.csv:3: frequency_hz is -5"),
            std::string::npos);
  EXPECT_NE(refusal(head + "1,10,0,1,1,1,1\n").find("between 0 and 100 %"), std::string::npos);
  EXPECT_NE(refusal(head + "1,10,100,1,1,1,1\n").find("between 0 and 100 %"), std::string::npos);
  EXPECT_NE(refusal(head + "1,10,2,nan,1,1,1\n").find("not finite"), std::string::npos);
  EXPECT_NE(refusal(head + "1,10,2,one,1,1,1\n").find("not a number"), std::string::npos);
  EXPECT_NE(refusal(head + "1,10,2,1,1,1\n").find("6 columns"), std::string::npos);
  EXPECT_NE(refusal("frequency_hz,damping_ratio,L_1X_re,L_1X_im,R_1X_re,R_1X_im\n10,1.16,1,1,1,1\n")
                .find("if it is in percent, name its column damping_percent"),
            std::string::npos);
}

TEST_F(ModalTableFile, MustBeToldItsUnitsAndPlaces) {
  const auto file = write("modes.csv", head + "1,10,2,1,1,1,1\n2,20,2,1,1,1,1\n");
  const auto refused = [&](const ModalTableFormat& format) {
    return message_of<InputError>([&] { (void)read_modal_table(file, format); });
  };
  EXPECT_NE(refused({1.0, 0.0, {{"1", {0.0}}}}).find("must be positive"), std::string::npos);
  EXPECT_TRUE(std::isnan(read_modal_table(file, {1.0, 1.0, {}}).rows[0].place_m(0))) << "not told";
  EXPECT_NE(refused({1.0, 1.0, {{"1", {0.0, 0.1, 0.2}}}}).find("3 places for 2 modes"), std::string::npos);
  EXPECT_NE(refused({1.0, 1.0, {{"1", {std::nan("")}}}}).find("not a number"), std::string::npos);
  EXPECT_NE(refused({1.0, 1.0, {{"1", {0.0}}, {"a", {0.02}}}}).find("\"a\""), std::string::npos);
}

TEST(ModalUnit, IsARootOfSecondsPerKilogram) {
  EXPECT_EQ(modal_unit("sqrt(s/kg)"), 1.0);
  EXPECT_EQ(modal_unit("1e-7 sqrt(s/kg)"), 1e-7);
  for (const char* text : {"", "m/N", "1e-7", "-1 sqrt(s/kg)", "1,5 sqrt(s/kg)", "sqrt(kg/s)", "nan sqrt(s/kg)"})
    EXPECT_THROW((void)modal_unit(text), InputError) << text;
}

}  // namespace

}  // namespace thinwall::io::test::modal_table_csv_test
