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

using Answers = std::function<std::string(const std::string& url)>;

constexpr const char* kBundle = "ORIGINAL";  ///< what was uploaded; others hold e.g. thumbnails
constexpr std::size_t kMostPages = 1000;
constexpr std::uint64_t kLongestAnswer = 1 << 22;  // bytes
constexpr int kDeepest = 100;                      // objects and arrays in each other

/// An answer's JSON.
json parsed(const std::string& answer, const std::string& url) {
  return json::parse(answer, [&](int depth, json::parse_event_t, const json&) {
    if (depth > kDeepest) throw pcrb::InvalidFile(url, 0, "JSON of great depth", "a list of files");
    return true;
  });
}

bool isMd5(const std::string& text) {
  return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// The answers of a repository.
class Dspace {
 public:
  Dspace(const Place& place, const Answers& get) : place_(place), get_(get) {}

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
    return placeOf(file);
  }

 private:
  Place placeOf(const json& file) const {
    Place found = place_;
    found.url = file.at("_links").at("content").at("href").get<std::string>();
    const json& bytes = file.at("sizeBytes");
    if (!bytes.is_number_unsigned()) refuse("sizeBytes " + bytes.dump(), "a number of bytes");
    found.bytes = bytes.get<std::uint64_t>();
    const json& sum = file.at("checkSum");
    if (sum.at("checkSumAlgorithm") != "MD5") return found;
    found.md5 = sum.at("value").get<std::string>();
    if (!isMd5(found.md5)) refuse("MD5 " + pcrb::inQuotes(found.md5), "32 hexadecimal digits");
    return found;
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw pcrb::InvalidFile("item " + place_.dspace_item + " at " + place_.url, 0, found, expected);
  }

  /// The element with a name in a list of one page or several; null if there is none.
  json findNamed(std::string url, const std::string& list, const std::string& name,
                 std::vector<std::string>& names) const {
    for (std::size_t page = 0; page != kMostPages && !url.empty(); ++page) {
      const json answer = parsed(get_(url), url);
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

  const Place& place_;
  const Answers& get_;
};

}  // namespace

Place findInDspace(const Place& place, const Answers& get) {
  try {
    return Dspace(place, get).find();
  } catch (const json::exception& error) {
    throw pcrb::InvalidFile(place.url, 0, error.what(), "an answer of DSpace 7");
  }
}

Place findInDspace(const Place& place, const std::string& scratch, const DownloadPolicy& policy) {
  DownloadPolicy quiet = policy;
  quiet.on_progress = nullptr;
  return findInDspace(place, [&](const std::string& url) {
    Download answer;
    answer.url = url;
    answer.destination = scratch;
    answer.most_bytes = kLongestAnswer;
    download(answer, quiet);
    const pcrb::FileBytes bytes(scratch);
    std::filesystem::remove(scratch);
    return std::string(bytes.text());
  });
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
