#include "benchmarking/method_choice.hpp"

#include <dlfcn.h>
#include <link.h>
#include <ros/package.h>
#include <ros/param.h>

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/registration/registry.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kInEffect = "in_effect";

/// A method's parameters, defaults included.
pcrb::Parameters completed(const std::string& method, const pcrb::Parameters& given) {
  pcrb::Parameters parameters = given;
  const pcrb::Parameters defaults = pcrb::registrationDefaults(method);
  parameters.insert(defaults.begin(), defaults.end());
  return parameters;
}

/// Where the loader found a library that has been loaded.
std::string fileOfLibrary(const std::string& library) {
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_NOLOAD);
  const link_map* map = nullptr;
  const bool is_found = handle != nullptr && dlinfo(handle, RTLD_DI_LINKMAP, &map) == 0;
  const std::string file = is_found ? map->l_name : "";
  if (handle != nullptr) dlclose(handle);
  if (!is_found) throw pcrb::InvalidParameter("~plugin: " + library + " is not loaded any more");
  return file;
}

/// A bare name is one that the loader looks for.
std::string readPlugin(pcrb::NodeParameters& reader) {
  const std::string plugin = reader.string("plugin");
  return plugin.find('/') == std::string::npos ? plugin : reader.path("plugin");
}

std::string readFile(pcrb::NodeParameters& reader, const std::string& method) {
  const std::string file = reader.path("parameters");
  return file.empty() ? ros::package::getPath("pcrb_launch") + "/config/methods/" + method + ".yaml"
                      : file;
}

}  // namespace

const pcrb::ParameterTable& MethodChoice::parameters() {
  static const pcrb::ParameterTable kTable{
      {"method", "gicp", "",
       "icp, gicp, … (a wrong name lists them all), or the name of a parameter file that says "
       "which "
       "method it is for, as ndt_1m"},
      {"plugin", "", "",
       "shared library with methods of your own, loaded before the method is looked up"},
      {"parameters", "", "",
       "YAML file of the method's parameters; empty: config/methods/<method>.yaml of the package "
       "pcrb_launch, the paper's"}};
  return kTable;
}

MethodChoice::MethodChoice(pcrb::NodeParameters& reader)
    : method_(reader.string("method")),
      plugin_(readPlugin(reader)),
      file_(readFile(reader, method_)) {
  reader.allowOwnParameter(kInEffect);
  reader.check([this] {
    if (!plugin_.empty()) pcrb::loadRegistrationLibrary(plugin_);
    if (!std::filesystem::exists(file_)) pcrb::registrationDefaults(method_);  // is it unknown?
    parameters_.emplace(file_);
    if (!parameters_->method().empty()) method_ = parameters_->method();
    check();
  });
}

void MethodChoice::check() const {
  const double any_leaf = 1.0;
  make("", any_leaf);
  for (const auto& data_set : parameters_->dataSets()) make(data_set, any_leaf);
}

std::unique_ptr<pcrb::Registration> MethodChoice::make(const std::string& data_set,
                                                       double voxel_leaf) const {
  return pcrb::makeRegistration(method_, parameters_->of(data_set, voxel_leaf));
}

std::string MethodChoice::inEffect() const {
  std::string text = "\n";
  if (!parameters_->method().empty()) text += "method: " + method_ + "\n";
  const pcrb::Parameters common = completed(method_, parameters_->asWritten(""));
  for (const auto& [name, value] : common) text += name + ": " + value + "\n";
  for (const auto& data_set : parameters_->dataSets()) {
    for (const auto& [name, value] : parameters_->asWritten(data_set)) {
      if (common.at(name) != value) text += data_set + "/" + name + ": " + value + "\n";
    }
  }
  const bool is_ours = plugin_.empty();
  return text +
         (is_ours ? "pcl: " + pcrb::pclOfMethods()
                  : "plugin: " + pcrb::fileHash(fileOfLibrary(plugin_))) +
         "\n";
}

void MethodChoice::announce() const { ros::param::set(std::string("~") + kInEffect, inEffect()); }

}  // namespace pcrb_tools
