#include "pcrb_core/registration/registry.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

struct Entry {
  std::string name;
  RegistrationFactory factory;
  RegistrationLayout layout;
};

// Two libraries may bring one name: loading the second or asking for the name reports that, since
// nothing can be thrown while a library registers.
struct Registry {
  std::mutex mutex;
  std::vector<Entry> entries;                           // in the order of registration
  std::map<void*, std::vector<std::string>> libraries;  // by handle
};

Registry& registry() {
  static Registry instance;
  return instance;
}

std::vector<std::string> sortedNames(const std::vector<Entry>& entries, std::size_t first) {
  std::vector<std::string> names;
  for (std::size_t i = first; i < entries.size(); ++i) names.push_back(entries[i].name);
  std::sort(names.begin(), names.end());
  return names;
}

std::string describeLayout(const RegistrationLayout& layout) {
  const std::array<const char*, 6> names{"interface ", ", Registration of ", ", result of ",
                                         "/",          ", cloud of ",        "/"};
  std::string text;
  for (std::size_t i = 0; i < layout.size(); ++i) text += names[i] + std::to_string(layout[i]);
  return text + " bytes";
}

void requireLayout(const Entry& entry, const std::string& place) {
  if (entry.layout == kRegistrationLayout) return;
  throw InvalidParameter(place + ": found " + inQuotes(entry.name) + " compiled for " +
                         describeLayout(entry.layout) + ", expected " +
                         describeLayout(kRegistrationLayout) +
                         ": compile it anew, with this release's headers and without flags that "
                         "change the layout of the standard library");
}

RegistrationFactory findFactory(const std::string& method) {
  std::vector<RegistrationFactory> found;
  {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    for (const auto& entry : registry().entries) {
      if (entry.name != method) continue;
      requireLayout(entry, "method");
      found.push_back(entry.factory);
    }
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    throw InvalidParameter("method: found " + inQuotes(method) + ", expected one of " +
                           joined(registrationMethods()));
  }
  throw InvalidParameter("method: found " + inQuotes(method) + " registered " +
                         std::to_string(found.size()) + " times, expected one method of a name");
}

/// Names of a library's methods, which are those from `first` on.
std::vector<std::string> acceptLibrary(const std::string& path, std::size_t first) {
  const auto& entries = registry().entries;
  for (std::size_t i = first; i < entries.size(); ++i) requireLayout(entries[i], "plugin " + path);
  const std::vector<std::string> all = sortedNames(entries, 0);
  const auto twice = std::adjacent_find(all.begin(), all.end());
  if (twice != all.end()) {
    throw InvalidParameter("plugin: " + path + " registers " + inQuotes(*twice) +
                           ", expected a name that is not taken");
  }
  const std::vector<std::string> names = sortedNames(entries, first);
  if (names.empty()) {
    throw InvalidParameter("plugin: " + path +
                           " registers no method, expected PCRB_REGISTER_METHOD in it");
  }
  return names;
}

}  // namespace

bool registerMethod(const std::string& name, RegistrationFactory factory,
                    const RegistrationLayout& layout) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  registry().entries.push_back({name, std::move(factory), layout});
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
  const std::lock_guard<std::mutex> lock(registry().mutex);
  std::vector<std::string> names = sortedNames(registry().entries, 0);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Parameters registrationDefaults(const std::string& method) {
  ParameterReader reader({});
  findFactory(method)(reader);
  return reader.defaults();
}

std::vector<std::string> loadRegistrationLibrary(const std::string& path) {
  // The library's own registration takes the registry's mutex: it cannot be held meanwhile.
  static std::mutex loading;
  const std::lock_guard<std::mutex> one_at_a_time(loading);
  const std::size_t first = [] {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    return registry().entries.size();
  }();
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw InvalidParameter("plugin: cannot load " + std::string(dlerror()));

  const std::lock_guard<std::mutex> lock(registry().mutex);
  const auto known = registry().libraries.find(handle);
  if (known != registry().libraries.end()) return known->second;
  try {
    return registry().libraries[handle] = acceptLibrary(path, first);
  } catch (const InvalidParameter&) {
    auto& entries = registry().entries;
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(first), entries.end());
    registry().libraries.erase(handle);
    dlclose(handle);
    throw;
  }
}

}  // namespace pcrb
