#include "pcrb_core/registration/registry.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "pcrb_core/io/text_rows.hpp"

namespace pcrb {
namespace {

// A name may come twice, from two libraries: that is reported to whoever asks for it, since
// nothing can be thrown while a library is being loaded.
struct Registry {
  std::mutex mutex;
  std::multimap<std::string, RegistrationFactory> factories;
  std::map<void*, std::vector<std::string>> libraries;  // by handle, never closed
};

Registry& registry() {
  static Registry instance;
  return instance;
}

std::vector<std::string> allNames() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  std::vector<std::string> names;
  for (const auto& [name, factory] : registry().factories) names.push_back(name);
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

RegistrationFactory findFactory(const std::string& method) {
  std::vector<RegistrationFactory> found;
  {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    const auto [begin, end] = registry().factories.equal_range(method);
    for (auto it = begin; it != end; ++it) found.push_back(it->second);
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    throw InvalidParameter("method: found " + inQuotes(method) + ", expected one of " +
                           joined(registrationMethods()));
  }
  throw InvalidParameter("method: found " + inQuotes(method) + " registered " +
                         std::to_string(found.size()) + " times, expected one method of a name");
}

}  // namespace

bool registerMethod(const std::string& name, RegistrationFactory factory) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  registry().factories.emplace(name, std::move(factory));
  return true;
}

std::unique_ptr<Registration> makeRegistration(const std::string& method,
                                               const Parameters& parameters) {
  const RegistrationFactory factory = findFactory(method);
  ParameterReader reader(parameters);
  auto registration = factory(reader);
  reader.check(method);
  return registration;
}

std::vector<std::string> registrationMethods() {
  std::vector<std::string> names = allNames();
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Parameters registrationDefaults(const std::string& method) {
  ParameterReader reader({});
  findFactory(method)(reader);
  return reader.defaults();
}

std::vector<std::string> loadRegistrationLibrary(const std::string& path) {
  const std::vector<std::string> before = allNames();
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw InvalidParameter("plugin: cannot load " + std::string(dlerror()));
  const std::vector<std::string> after = allNames();

  std::vector<std::string> added;
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(added));
  {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    added = registry().libraries.emplace(handle, added).first->second;
  }
  if (added.empty()) {
    throw InvalidParameter("plugin: " + path +
                           " registers no method, expected PCRB_REGISTER_METHOD in it");
  }
  for (const auto& name : added) findFactory(name);
  return added;
}

}  // namespace pcrb
