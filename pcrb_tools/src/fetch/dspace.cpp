#include "fetch/dspace.hpp"

#include <boost/uuid/detail/md5.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

using nlohmann::json;

constexpr const char* kBundle = "ORIGINAL";  ///< what was uploaded; others hold e.g. thumbnails
constexpr std::size_t kMostPages = 1000;

/// The answers of a repository.
class Dspace {
 public:
  Dspace(const Place& place, std::string scratch, const DownloadPolicy& policy)
      : place_(place), scratch_(std::move(scratch)), policy_(policy) {}

  Place find() const {
    std::vector<std::string> names;
    const json bundle = findNamed(place_.url + "/core/items/" + place_.dspace_item + "/bundles",
                                  "bundles", kBundle, names);
    if (bundle.is_null()) refuse("the bundles " + pcrb::joined(names), kBundle);
    names.clear();
    const std::string files =
        place_.url + "/core/bundles/" + bundle.at("uuid").get<std::string>() + "/bitstreams";
    const json file = findNamed(files, "bitstreams", place_.dspace_name, names);
    if (file.is_null()) refuse("the files " + pcrb::joined(names), place_.dspace_name);
    Place found = place_;
    found.url = file.at("_links").at("content").at("href").get<std::string>();
    found.bytes = file.at("sizeBytes").get<std::uint64_t>();
    const json& sum = file.at("checkSum");
    if (sum.at("checkSumAlgorithm") == "MD5") found.md5 = sum.at("value").get<std::string>();
    return found;
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw pcrb::InvalidFile("item " + place_.dspace_item + " at " + place_.url, 0, found, expected);
  }

  /// The element with a name in a list of one page or several; null if there is none.
  json findNamed(std::string url, const std::string& list, const std::string& name,
                 std::vector<std::string>& names) const {
    for (std::size_t page = 0; page != kMostPages && !url.empty(); ++page) {
      const json answer = get(url);
      if (answer.contains("_embedded")) {
        for (const json& element : answer.at("_embedded").at(list)) {
          if (element.at("name") == name) return element;
          names.push_back(element.at("name").get<std::string>());
        }
      }
      const json links = answer.value("_links", json::object());
      url = links.contains("next") ? links.at("next").at("href").get<std::string>() : "";
    }
    return nullptr;
  }

  json get(const std::string& url) const {
    download({url, scratch_, false, std::nullopt, {}}, policy_);
    const pcrb::FileBytes bytes(scratch_);
    json answer = json::parse(bytes.begin(), bytes.end());
    std::filesystem::remove(scratch_);
    return answer;
  }

  const Place& place_;
  std::string scratch_;
  const DownloadPolicy& policy_;
};

}  // namespace

Place findInDspace(const Place& place, const std::string& scratch, const DownloadPolicy& policy) {
  try {
    DownloadPolicy quiet = policy;
    quiet.on_progress = nullptr;
    return Dspace(place, scratch, quiet).find();
  } catch (const json::exception& error) {
    throw pcrb::InvalidFile(place.url, 0, error.what(), "an answer of DSpace 7");
  }
}

void requireMd5(const std::string& path, const std::string& expected) {
  boost::uuids::detail::md5 hash;
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(1 << 18);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    hash.process_bytes(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  boost::uuids::detail::md5::digest_type digest;
  hash.get_digest(digest);
  constexpr const char* kHex = "0123456789abcdef";
  std::string found;
  for (const auto part : digest) {  // words, or bytes since Boost 1.86
    for (unsigned shift = 8 * sizeof(part); shift > 0;) {
      shift -= 4;
      found += kHex[(static_cast<unsigned>(part) >> shift) & 0xfU];
    }
  }
  if (found != expected) throw pcrb::InvalidFile(path, 0, "MD5 " + found, expected);
}

}  // namespace pcrb_tools
