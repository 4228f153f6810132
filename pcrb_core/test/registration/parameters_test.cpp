#include "pcrb_core/registration/parameters.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pcrb_core/registration/registration.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using ::testing::Test;

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void expectIn(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(ParameterReader, ReadsWhatIsGivenAndDefaultsElse) {
  ParameterReader reader(
      {{"a", "0.25"}, {"b", "-3"}, {"c", "true"}, {"d", "18446744073709551615"}});
  EXPECT_EQ(reader.number("a", 1.0), 0.25);
  EXPECT_EQ(reader.integer("b", 1), -3);
  EXPECT_TRUE(reader.boolean("c", false));
  EXPECT_EQ(reader.seed("d", 0), 18446744073709551615U);
  EXPECT_EQ(reader.positive("e", 7.5), 7.5);
  EXPECT_GE(reader.threads(), 1);
  EXPECT_NO_THROW(reader.check("m"));
  EXPECT_EQ(reader.defaults().at("e"), "7.5");
  EXPECT_EQ(reader.defaults().at("threads"), "0");
}

TEST(ParameterReader, ListsAllMistakesAtOnce) {
  ParameterReader reader({{"a", "wide"},
                          {"b", "2.5"},
                          {"c", "yes"},
                          {"d", "-1"},
                          {"e", "0"},
                          {"f", "nan"},
                          {"g", "11"},
                          {"nobody", "x"}});
  reader.number("a", 1.0);
  reader.integer("b", 1);
  reader.boolean("c", true);
  reader.seed("d", 1);
  reader.positive("e", 1.0);
  reader.number("f", 1.0, 0.0, 2.0);
  reader.integer("g", 1, 0, 10);
  const std::string message = messageOf([&] { reader.check("some"); });
  expectIn(message, "method some: 8 wrong parameters");
  expectIn(message, "a: found 'wide', expected a number");
  expectIn(message, "b: found '2.5', expected an integer");
  expectIn(message, "c: found 'yes', expected true or false");
  expectIn(message, "d: found '-1'");
  expectIn(message, "e: found '0', expected a number greater than 0");
  expectIn(message, "f: found 'nan', expected a number from 0 to 2");
  expectIn(message, "g: found '11', expected an integer from 0 to 10");
  expectIn(message, "nobody: no parameter of this method");
}

TEST(MakeRegistration, NamesTheKnownMethodsWhereOneIsUnknown) {
  const std::string message = messageOf([] { makeRegistration("icpp", {}); });
  expectIn(message, "'icpp'");
  expectIn(message, "gicp, gicp_pcl, icp");
  EXPECT_THROW(makeRegistration("icpp", {}), InvalidParameter);
  EXPECT_THROW(registrationDefaults("icpp"), InvalidParameter);
}

class MethodFile : public Test {
 protected:
  std::string write(const std::string& text) {
    std::ofstream(folder_.file("method.yaml")) << text;
    return folder_.file("method.yaml");
  }
  std::string refusalOf(const std::string& text) {
    const std::string path = write(text);
    return messageOf([&] { MethodParameters(path).of("tum", 0.1); });
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(MethodFile, GivesADataSetItsOwnValues) {
  const auto path = write("voxel_leaf: 0.2  # m\nseed: 1\ntum: {voxel_leaf: 0.1}\n");
  EXPECT_EQ(MethodParameters(path).of("eth", 0.3),
            (Parameters{{"voxel_leaf", "0.2"}, {"seed", "1"}}));
  EXPECT_EQ(MethodParameters(path).of("tum", 0.3),
            (Parameters{{"voxel_leaf", "0.1"}, {"seed", "1"}}));
}

TEST_F(MethodFile, TakesTheVoxelLeafOfTheDataSetWhereItSaysSo) {
  const MethodParameters file(write("voxel_leaf: data_set\nseed: 1\ntum: {voxel_leaf: 0.3}\n"));
  EXPECT_EQ(file.of("mine", 0.05), (Parameters{{"voxel_leaf", "0.05"}, {"seed", "1"}}));
  EXPECT_EQ(file.of("tum", 0.05).at("voxel_leaf"), "0.3");
  EXPECT_EQ(file.asWritten("mine").at("voxel_leaf"), "data_set");
  EXPECT_EQ(MethodParameters(write("seed: 1\n")).of("mine", 0.05), (Parameters{{"seed", "1"}}));
}

TEST_F(MethodFile, MaySayWhichMethodItIsFor) {
  const MethodParameters file(write("method: ndt\nsource_leaf: data_set\n"));
  EXPECT_EQ(file.method(), "ndt");
  EXPECT_EQ(file.of("mine", 0.05), (Parameters{{"source_leaf", "0.05"}}));
  EXPECT_EQ(MethodParameters(write("seed: 1\n")).method(), "");
}

TEST_F(MethodFile, KeepsWhatItReadWhenTheFileChanges) {
  const MethodParameters parameters(write("seed: 1\ntum: {seed: 2}\neth: {seed: 3}\n"));
  write("seed: 4\n");
  EXPECT_EQ(parameters.of("kaist", 0.2), (Parameters{{"seed", "1"}}));
  EXPECT_EQ(parameters.of("tum", 0.2), (Parameters{{"seed", "2"}}));
  EXPECT_EQ(parameters.dataSets(), (std::vector<std::string>{"eth", "tum"}));
}

TEST_F(MethodFile, RefusesMistakesWithTheirLine) {
  expectIn(refusalOf("a: 1\na: 2\n"), "method.yaml:2: found 'a' again");
  expectIn(refusalOf("a: 1\nb: [1, 2]\n"), "method.yaml:2: found 'b' without a single value");
  expectIn(refusalOf("a: 1\nb:\n"), "method.yaml:2: found 'b' without a single value");
  expectIn(refusalOf("a: 1\ntum: {a: {b: 1}}\n"), "method.yaml:2: found 'a' without");
  expectIn(refusalOf("a: 1\n\neth: {b: 2}\n"), "method.yaml:3: found 'b' for one data set only");
  expectIn(refusalOf("a: 1\n b: : 2\n"), "method.yaml:2: found");
  expectIn(refusalOf("a: 1\nmax_step: data_set\n"), "method.yaml:2: found 'max_step' as the data");
  expectIn(refusalOf("just text\n"), "expected lines of `name: value`");
  expectIn(refusalOf(""), "expected lines of `name: value`");
  EXPECT_THROW(MethodParameters(folder_.file("absent.yaml")).of("tum", 0.1), InvalidFile);
}

}  // namespace
}  // namespace pcrb
