#include "archives/bag_messages.hpp"

#include <ros/exception.h>
#include <rosbag/view.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

#include "common/process.hpp"
#include "pcrb_core/io/derived_file.hpp"

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

}  // namespace

bool isBag(const std::string& path) { return std::filesystem::path(path).extension() == ".bag"; }

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
    try {
      bags_.back()->open(path, rosbag::bagmode::Read);
    } catch (const rosbag::BagUnindexedException&) {
      throw pcrb::InvalidFile(path, 0, "a bag that was not closed",
                              "an index (rosbag reindex makes it)");
    } catch (const ros::Exception& error) {
      throw pcrb::InvalidFile(path, "damaged or no bag: " + std::string(error.what()));
    }
  }
}

void requireWholeBag(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic(kBagMagic.size(), ' ');
  file.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (magic != kBagMagic) throw pcrb::InvalidFile(path, 0, "another beginning", "a bag of ROS 1");
  const std::int64_t index = indexPosition(file);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
  if (index == 0) {
    throw pcrb::InvalidFile(path, 0, "a bag that was not closed",
                            "an index (rosbag reindex makes it)");
  }
  if (index < 0 || index >= size || !endsWithRecord(file, index, size)) {
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

std::string BagMessages::describeTopics() const {
  std::map<std::string, std::string> types;
  for (const auto& bag : bags_) {
    for (const auto* connection : rosbag::View(*bag).getConnections()) {
      types[connection->topic] = connection->datatype;
    }
  }
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
