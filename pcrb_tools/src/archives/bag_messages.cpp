#include "archives/bag_messages.hpp"

#include <ros/exception.h>
#include <rosbag/view.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "common/process.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/foreign_data.hpp"

namespace pcrb_tools {
namespace {

constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";

/// A length or position that the file has next, little-endian; 0 behind its end.
template <typename Number>
Number readNumber(std::istream& file) {
  std::array<char, sizeof(Number)> bytes{};
  file.read(bytes.data(), bytes.size());
  Number number = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    number = static_cast<Number>(number << 8 | static_cast<unsigned char>(bytes[i]));
  }
  return file ? number : 0;
}

/// Where the index begins, as the first record's header says; 0 = nowhere, -1 = no such header.
std::int64_t indexPosition(std::istream& file) {
  constexpr std::uint32_t kLongest = 1 << 16;
  const auto size = readNumber<std::uint32_t>(file);
  if (size == 0 || size > kLongest) return -1;
  std::string header(size, ' ');
  file.read(header.data(), size);
  constexpr std::string_view kField = "index_pos=";
  const std::size_t field = header.find(kField);
  if (!file || field == std::string::npos) return -1;
  std::istringstream value(header.substr(field + kField.size(), sizeof(std::int64_t)));
  return static_cast<std::int64_t>(readNumber<std::uint64_t>(value));
}

/// Whether whole records, each a header and data behind their lengths, go from here to the end.
bool endsWithRecord(std::istream& file, std::int64_t begin, std::int64_t size) {
  std::int64_t position = begin;
  while (position < size) {
    for (int part = 0; part < 2; ++part) {
      file.seekg(position);
      position +=
          static_cast<std::int64_t>(sizeof(std::uint32_t)) + readNumber<std::uint32_t>(file);
      if (!file) return false;
    }
  }
  return position == size;
}

/// Names what is not a bag of ROS 1, by its first bytes.
void requireRos1Bag(const std::string& path) {
  std::string start(512, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file) throw pcrb::InvalidFile(path, 0, "nothing that can be read", "a bag of ROS 1");
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  pcrb::requireData(start, path);
  const auto begins = [&](std::string_view with) {
    return start.compare(0, with.size(), with) == 0;
  };
  if (begins(kBagMagic)) return;
  const char* const convert = "a bag of ROS 1 (rosbags-convert makes one of it)";
  if (begins("SQLite format 3"))
    throw pcrb::InvalidFile(path, 0, "a bag of ROS 2 (sqlite3)", convert);
  if (begins("\x89MCAP")) throw pcrb::InvalidFile(path, 0, "a bag of ROS 2 (mcap)", convert);
  if (begins("#ROSBAG V1")) {
    throw pcrb::InvalidFile(path, 0, "a bag of version 1", "version 2 (rosbag fix makes it)");
  }
  throw pcrb::InvalidFile(path, 0, start.empty() ? "an empty file" : "another beginning",
                          "a bag of ROS 1");
}

[[noreturn]] void refuseOpenBag(const std::string& path) {
  throw pcrb::InvalidFile(path, 0, "a bag that was not closed",
                          "an index (rosbag reindex makes it; a bag.active is one whose recording "
                          "did not end)");
}

}  // namespace

bool isBag(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".bag" || ending == ".active" || ending == ".db3" || ending == ".mcap";
}

bool areBags(const std::vector<std::string>& inputs) {
  const auto bags = std::count_if(inputs.begin(), inputs.end(), isBag);
  if (bags == 0 || static_cast<std::size_t>(bags) == inputs.size()) return bags > 0;
  throw pcrb::InvalidParameter("found bags together with other inputs, expected bags only or none");
}

BagMessages::BagMessages(const std::vector<std::string>& paths) {
  for (const auto& path : paths) {
    identity_ += pcrb::fileIdentity(path) + ' ';
    paths_ += (paths_.empty() ? "" : " + ") + path;
    bags_.push_back(std::make_unique<rosbag::Bag>());
    requireRos1Bag(path);
    try {
      bags_.back()->open(path, rosbag::bagmode::Read);
    } catch (const rosbag::BagUnindexedException&) {
      refuseOpenBag(path);
    } catch (const ros::Exception& error) {
      requireWholeBag(path);
      throw pcrb::InvalidFile(path, "damaged or no bag: " + std::string(error.what()));
    }
  }
}

void requireWholeBag(const std::string& path) {
  requireRos1Bag(path);
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(kBagMagic.size()));
  const std::int64_t index = indexPosition(file);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
  if (index == 0) refuseOpenBag(path);
  const bool is_empty = index == size;  // a bag without a message has an index without a record
  if (index < 0 || index > size || (!is_empty && !endsWithRecord(file, index, size))) {
    throw pcrb::InvalidFile(
        path, 0, std::to_string(size) + " bytes of a bag that is cut or damaged",
        "all of it" +
            (index > size ? ": its index begins at " + std::to_string(index) : std::string()));
  }
}

std::size_t BagMessages::count(const std::vector<std::string>& topics) const {
  rosbag::View view;
  for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics));
  return view.size();
}

std::map<std::string, std::string> BagMessages::topics() const {
  std::map<std::string, std::string> types;
  for (const auto& bag : bags_) {
    for (const auto* connection : rosbag::View(*bag).getConnections()) {
      types[connection->topic] = connection->datatype;
    }
  }
  return types;
}

std::string BagMessages::describeTopics() const {
  const auto types = topics();
  std::string text = types.empty() ? "no topic at all" : "the topics";
  for (const auto& [topic, type] : types) text += " " + topic + " (" + type + ")";
  return text;
}

void BagMessages::forEach(const std::vector<std::string>& topics,
                          const std::function<void(const rosbag::MessageInstance&)>& take) const {
  try {
    rosbag::View view;
    for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics));
    for (const auto& message : view) {
      Interruption::check();
      take(message);
    }
  } catch (const ros::Exception& error) {
    throw pcrb::InvalidFile(paths_, "damaged: " + std::string(error.what()));
  }
}

}  // namespace pcrb_tools
