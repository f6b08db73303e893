// The keys of kept results: every field of every stage's input changes them.

#include "study/kept/input_key.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "setup/data_files.hpp"
#include "setup/imported_part.hpp"
#include "setup/measured.hpp"
#include "study/kept/stage_keys.hpp"
#include "tests/io/scratch_folder.hpp"

namespace thinwall::tests::input_key_test {
namespace {

template <class T>
constexpr bool is_number = std::is_arithmetic_v<T>;
template <class T, template <class...> class Template>
constexpr bool is_a = false;
template <template <class...> class Template, class... Arguments>
constexpr bool is_a<Template<Arguments...>, Template> = true;
template <class T>
concept DenseMatrix = std::derived_from<T, Eigen::MatrixBase<T>>;
template <class T>
constexpr bool is_sparse = std::is_same_v<T, Eigen::SparseMatrix<double>>;
template <class T>
constexpr bool is_frame = std::is_same_v<T, Eigen::Isometry3d>;
template <class T>
constexpr bool is_box = std::is_same_v<T, Eigen::AlignedBox3d>;

class InputKeyOfFiles : public io::test::ScratchFolder {
 protected:
  /// Writes the `count` files that a set-up reads, changes one after another, and expects other keys meanwhile.
  void expect_contents_in_keys(setup::Setup& source, std::size_t count);
};

/// Gives a value to everything below `value`: lists have one item, what may be absent is there.
template <class T>
void fill(T& value);

template <class... Alternatives>
void fill_alternative(std::variant<Alternatives...>& value) {
  std::visit([](auto& held) { fill(held); }, value);
}

template <class T>
void fill(T& value) {
  if constexpr (is_number<T>) {
    value = static_cast<T>(1);
  } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, std::monostate>) {
  } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::filesystem::path>) {
    value = "name";
  } else if constexpr (is_a<T, std::complex>) {
    value = {1.0, 2.0};
  } else if constexpr (is_a<T, std::optional>) {
    fill(value.emplace());
  } else if constexpr (is_a<T, std::shared_ptr>) {
    auto held = std::make_shared<std::remove_const_t<typename T::element_type>>();
    fill(*held);
    value = held;
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    value = {true};
  } else if constexpr (is_a<T, std::vector>) {
    value.resize(1);
    fill(value.front());
  } else if constexpr (is_a<T, std::map>) {
    typename T::key_type name{};
    fill(name);
    fill(value[name]);
  } else if constexpr (is_a<T, std::pair>) {
    fill(value.first);
    fill(value.second);
  } else if constexpr (is_a<T, std::variant>) {
    fill_alternative(value);
  } else if constexpr (DenseMatrix<T>) {
    if (value.size() == 0) value.resize(value.rows() > 0 ? value.rows() : 1, value.cols() > 0 ? value.cols() : 1);
    value.setOnes();
  } else if constexpr (is_sparse<T>) {
    value.resize(2, 2);
    value.insert(0, 0) = 1.0;
    value.makeCompressed();
  } else if constexpr (is_frame<T>) {
    value.setIdentity();
  } else if constexpr (is_box<T>) {
    value = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  } else if constexpr (requires { value.fill(value.front()); }) {
    for (auto& item : value) fill(item);
  } else {
    std::apply([](auto&... member) { (fill(member), ...); }, core::fields_of(value));
  }
}

/// Changes one thing after another below a value and calls `changed` while it is so.
struct Variation {
  std::function<void()> changed;
  int fields = 0;

  template <class T>
  void with(T& value, const T& other) {
    const T before = value;
    value = other;
    ++fields;
    changed();
    value = before;
  }

  template <class... Alternatives>
  void alternatives(std::variant<Alternatives...>& value) {
    const auto one = [&](auto alternative) {
      const std::variant<Alternatives...> before = value;
      fill(alternative);
      if (before.index() != std::variant<Alternatives...>(alternative).index()) with(value, {alternative});
      value = alternative;
      std::visit([this](auto& held) { this->vary(held); }, value);
      value = before;
    };
    (one(Alternatives{}), ...);
  }

  /// All members but some.
  template <class T>
  void vary_but(T& value, const std::vector<const void*>& left_out) {
    const auto one = [&](auto& member) {
      if (std::ranges::find(left_out, static_cast<const void*>(&member)) == left_out.end()) vary(member);
    };
    std::apply([&](auto&... member) { (one(member), ...); }, core::fields_of(value));
  }

  // The name of a file, and what is said about it, are in no key.
  void vary(io::MeasuredFrf& frf) { vary_but(frf, {&frf.source}); }
  void vary(setup::FrfContent& content) { vary_but(content, {&content.notes, &content.warnings}); }
  void vary(setup::ImportedPart& part) { vary_but(part, {&part.notes}); }
  void vary(mesh::NodeSet& set) { vary_but(set, {&set.fault}); }
  void vary(mesh::SolidMesh& solid) { vary_but(solid, {&solid.notices}); }

  template <class T>
  void vary(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      with(value, !value);
    } else if constexpr (std::is_floating_point_v<T>) {
      with(value, std::nextafter(value, std::numeric_limits<T>::infinity()));
    } else if constexpr (is_number<T>) {
      with(value, static_cast<T>(value + 1));
    } else if constexpr (std::is_enum_v<T>) {
      with(value, static_cast<T>(static_cast<int>(value) == 0 ? 1 : 0));
    } else if constexpr (std::is_same_v<T, std::monostate>) {
    } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::filesystem::path>) {
      with(value, T("nam"));
    } else if constexpr (is_a<T, std::complex>) {
      with(value, value + 1.0);
      with(value, value + T(0.0, 1.0));
    } else if constexpr (is_a<T, std::optional>) {
      with(value, T{});
      vary(*value);
    } else if constexpr (is_a<T, std::shared_ptr>) {
      with(value, T{});
      auto held = std::make_shared<std::remove_const_t<typename T::element_type>>(*value);
      const T before = value;
      value = held;
      vary(*held);
      value = before;
    } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
      with(value, {false});
    } else if constexpr (is_a<T, std::vector>) {
      with(value, T{});
      with(value, T{value.front(), value.front()});
      vary(value.front());
    } else if constexpr (is_a<T, std::map>) {
      with(value, T{});
      vary(value.begin()->second);
    } else if constexpr (is_a<T, std::pair>) {
      vary(value.first);
      vary(value.second);
    } else if constexpr (is_a<T, std::variant>) {
      alternatives(value);
    } else if constexpr (DenseMatrix<T>) {
      for (Eigen::Index i = 0; i < value.size(); ++i) vary(value.data()[i]);
    } else if constexpr (is_sparse<T>) {
      T other = value;
      other.coeffRef(0, 0) = 2.0;
      with(value, other);
    } else if constexpr (is_frame<T>) {
      with(value, T(Eigen::Translation3d(0.0, 0.0, 1e-9)));
    } else if constexpr (is_box<T>) {
      with(value, T(value.min(), 2.0 * value.max()));
      with(value, T(value.min() - value.max(), value.max()));
    } else if constexpr (requires { value.fill(value.front()); }) {
      for (auto& item : value) vary(item);
    } else {
      std::apply([this](auto&... member) { (this->vary(member), ...); }, core::fields_of(value));
    }
  }
};

/// The number of fields below `value`, after a check that `key` differs for each of them that is changed.
template <class T>
int expect_all_fields_count(T& value, const std::function<std::string()>& key, const char* what) {
  std::set<std::string> keys{key()};
  const std::string first = *keys.begin();
  int equal = 0;
  Variation variation{[&] { equal += key() == first ? 1 : 0; }};
  variation.vary(value);
  EXPECT_EQ(equal, 0) << what << ": fields whose change leaves the key";
  EXPECT_EQ(key(), first) << what << ": each change was taken back";
  return variation.fields;
}

template <class Base>
Base& base(setup::Setup& source) {
  return source;
}

/// A set-up in which everything is there but a path, whose stations follow from other fields.
setup::Setup full_setup() {
  setup::Setup source;
  fill(base<setup::PartSetup>(source));
  fill(base<setup::MeasuredPart>(source));
  fill(base<setup::SupportSetup>(source));
  fill(base<setup::CutSetup>(source));
  fill(source.updating);
  return source;
}

/// Puts each alternative of a variant into `value`, filled, and calls `there` meanwhile.
template <class... Alternatives>
void with_each(std::variant<Alternatives...>& value, const std::function<void()>& there) {
  const std::variant<Alternatives...> before = value;
  const auto one = [&](auto alternative) {
    fill(alternative);
    value = alternative;
    there();
  };
  (one(Alternatives{}), ...);
  value = before;
}

setup::TabledContact* tabled_contact(setup::Setup& source) {
  return std::get_if<setup::TabledContact>(&source.contacts.front().model);
}

setup::TabledRobot* tabled_robot(setup::Setup& source) {
  return std::get_if<setup::TabledRobot>(&source.robot->model);
}

/// Reads all files of a set-up, whether it holds what they say or not.
void read_anew(setup::Setup& source) {
  for (setup::MeasuredFrf* frf : setup::measured_frfs(source)) frf->content.reset();
  if (auto* contact = tabled_contact(source)) contact->rows.reset();
  if (auto* robot = tabled_robot(source)) {
    robot->table_modes.reset();
    robot->tapped.reset();
  }
  setup::read_data_files(source);
}

void InputKeyOfFiles::expect_contents_in_keys(setup::Setup& source, std::size_t count) {
  std::vector<std::pair<std::filesystem::path, std::string>> files;  // with "1e-6" in each, which is then changed
  const auto name_one = [&](std::filesystem::path& path, const std::string& text) {
    path = write("file_" + std::to_string(files.size()) + ".csv", text);
    files.emplace_back(path, text);
  };
  for (setup::MeasuredFrf* frf : setup::measured_frfs(source)) {
    name_one(frf->file, "1,1e-6,0\n2,2e-6,0\n");
    frf->quantity = io::FrfQuantity::receptance;
    frf->unit = "m/N";
    frf->frequency_unit = "Hz";
    frf->variable = frf->frequency_variable = "";  // of MAT files only
  }
  if (auto* contact = tabled_contact(source))
    name_one(contact->table, "preload_n,stiffness_n_per_m,damping_n_s_per_m\n1,1e-6,0\n2,2e-6,0\n");
  if (auto* robot = tabled_robot(source)) {
    robot->postures.reset();
    robot->sensors.clear();
    robot->left_unit = robot->right_unit = "sqrt(s/kg)";
    robot->table_point = "1";
    name_one(robot->table, "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im\n50,0.01,1e-6,1,1,1\n");
  }
  EXPECT_EQ(files.size(), count);
  const auto keys = [&] {
    read_anew(source);
    return study::structure_key(source) + study::charts_key(source);
  };
  const std::string first = keys();
  for (const auto& [file, text] : files) {
    std::string other = text;
    other.replace(other.find("1e-6"), 4, "3e-7");
    write(file.filename(), other);
    EXPECT_NE(keys(), first) << file.filename();
    write(file.filename(), text);
    EXPECT_EQ(keys(), first) << file.filename();
  }
}

/// The keys depend on the contents of a file, and not only on its name.
TEST_F(InputKeyOfFiles, AChangedFileChangesTheKeyWhereverItIsNamed) {
  setup::Setup source = full_setup();
  // FRFs of the part, of its damping and two of the tool; a robot and a contact have one file, or none.
  const auto files = [&]() -> std::size_t {
    const setup::ContactKind contact = setup::kind(source.contacts[0]);
    const bool read = contact == setup::ContactKind::springs || contact == setup::ContactKind::table;
    return 4U + (read ? 1U : 0U) + (setup::is_measured(*source.robot) ? 1U : 0U);
  };
  with_each(source.robot->model, [&] { expect_contents_in_keys(source, files()); });
  with_each(source.contacts[0].model, [&] { expect_contents_in_keys(source, files()); });
  source.contacts[0].model = setup::TabledContact{};
  source.robot->model = setup::TabledRobot{};
  fill(source.contacts[0].model);
  fill(source.robot->model);
  expect_contents_in_keys(source, 6);
}

TEST(InputKey, AFileKeepsItsKeyWhereItsFolderIsNamedOtherwise) {
  setup::Setup source = full_setup();
  setup::SurfaceShape shape;
  shape.file.path = "cases/wall/surface.stl";
  source.part->shape = shape;
  const std::string key = study::structure_key(source);
  shape.file.path = "/home/user/cases/wall/surface.stl";
  source.part->shape = shape;
  EXPECT_EQ(study::structure_key(source), key);
  shape.file.path = "cases/wall/surface.obj";
  source.part->shape = shape;
  EXPECT_NE(study::structure_key(source), key) << "another format";
}

/// Two FRFs of a part, and an Abaqus mesh of a set that names a missing node, of which its reader tells: files that the
/// case names by the path of a folder.
setup::Setup setup_of_files(const std::filesystem::path& folder) {
  setup::Setup source = full_setup();
  for (setup::MeasuredFrf* frf : setup::measured_frfs(source)) {
    frf->file = folder / "frf.csv";
    frf->quantity = io::FrfQuantity::receptance;
    frf->unit = "m/N";
    frf->frequency_unit = "Hz";
    frf->variable = frf->frequency_variable = "";
    frf->from_hz = frf->to_hz = std::nullopt;
  }
  setup::MeshShape shape;
  shape.file.path = folder / "part.inp";
  shape.file.unit = "mm";
  source.part->shape = shape;
  source.part->imported = setup::read_part_file(*source.part);
  read_anew(source);
  return source;
}

TEST_F(InputKeyOfFiles, ACaseKeepsItsKeysWhereItsFolderIsNamedOtherwiseOrCopied) {
  std::string frf;
  for (int i = 1; i <= 60; ++i) frf += std::to_string(i) + "," + std::to_string(i % 2 == 0 ? 1e-3 : -2e-3) + ",1e-6\n";
  const std::string mesh =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n*NSET,NSET=N\n1,9\n";
  const auto folder_with_files = [&](const std::string& name) {
    std::filesystem::create_directories(path(name));
    write(name + "/frf.csv", frf);
    return write(name + "/part.inp", mesh).parent_path();
  };
  const std::filesystem::path here = folder_with_files("here"), copy = folder_with_files("a_copy");
  const setup::Setup first = setup_of_files(here);
  ASSERT_NE(setup::receptance_of(first.tool->measured.front()).source,
            setup::receptance_of(setup_of_files(copy).tool->measured.front()).source);
  ASSERT_NE(first.part->imported->notes, setup_of_files(copy).part->imported->notes);
  for (const auto& folder : {std::filesystem::relative(here), copy}) {
    const setup::Setup other = setup_of_files(folder);
    EXPECT_EQ(study::structure_key(other), study::structure_key(first)) << folder;
    EXPECT_EQ(study::charts_key(other), study::charts_key(first)) << folder;
    EXPECT_EQ(study::tool_key(other), study::tool_key(first)) << folder;
  }
}

TEST(InputKey, ARobotThatFollowsThePathHasAnotherKeyThanOneThatStays) {
  setup::Setup source = full_setup();
  source.part.reset();
  source.path.emplace();
  const std::string stays = study::structure_key(source);
  source.path->robot_follows = true;
  EXPECT_NE(study::structure_key(source), stays);
}

TEST(InputKey, EveryFieldOfThePartsInputChangesThePartsKey) {
  study::PartInput input;
  std::vector<setup::Updating> fits;
  fill(static_cast<setup::PartSetup&>(input));
  fill(input.path);
  fill(fits);
  const auto key = [&] { return study::part_key(input, fits); };
  const int fields = expect_all_fields_count(static_cast<setup::PartSetup&>(input), key, "part") +
                     expect_all_fields_count(input.path, key, "path") + expect_all_fields_count(fits, key, "fits");
  EXPECT_GT(fields, 200) << "of all structs that the part's stage reads";
}

TEST(InputKey, EveryFieldOfPartRobotAndContactsChangesTheKeyOfTheStructure) {
  setup::Setup source = full_setup();
  const auto key = [&] { return study::structure_key(source); };
  const int fields = expect_all_fields_count(base<setup::PartSetup>(source), key, "part") +
                     expect_all_fields_count(base<setup::MeasuredPart>(source), key, "measured part") +
                     expect_all_fields_count(base<setup::SupportSetup>(source), key, "support") +
                     expect_all_fields_count(source.updating, key, "fits");
  EXPECT_GT(fields, 400);
}

TEST(InputKey, EveryFieldOfTheCutButTheMachineChangesTheKeyOfTheCharts) {
  setup::Setup source = full_setup();
  source.machine.reset();
  source.cutting->law = setup::ForceLawKind::power;  // its feed follows from the speed
  const auto key = [&] { return study::charts_key(source); };
  expect_all_fields_count(*source.tool, key, "tool");
  expect_all_fields_count(*source.lobes, key, "lobes");
  setup::Cutting& cutting = *source.cutting;
  Variation fields;
  const std::string first = key();
  int equal = 0;
  fields.changed = [&] { equal += key() == first ? 1 : 0; };
  fields.vary(cutting);
  EXPECT_EQ(equal, 0);
  expect_all_fields_count(base<setup::SupportSetup>(source), key, "support");
  const std::string without = key();
  source.machine.emplace();
  EXPECT_EQ(key(), without) << "the machine's limits are applied to finished charts";
}

}  // namespace
}  // namespace thinwall::tests::input_key_test
