#include "pcd_header.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

using Values = std::vector<std::string_view>;

constexpr double kNewestVersion = 0.7;
constexpr double kUnitTolerance = 1e-3;
constexpr std::size_t kLargestCount = std::numeric_limits<std::int32_t>::max();

/// Reads the entries one by one; knows which were there.
class HeaderReader {
 public:
  explicit HeaderReader(LineReader& lines) : lines_(lines) {}

  PcdHeader read() {
    std::string_view line;
    do {
      if (!lines_.next(line)) {
        lines_.fail(lines_.lineNumber() == 0 ? "an empty file" : "the end of the file",
                    "a PCD header that ends with a DATA entry");
      }
      readLine(line);
    } while (!has("DATA"));
    checkTogether();
    return std::move(header_);
  }

 private:
  bool has(std::string_view entry) const {
    return std::find(seen_.begin(), seen_.end(), entry) != seen_.end();
  }

  void readLine(std::string_view line) {
    Values values;
    splitAtBlanks(line, values);
    if (startsWith(line, kViewpointComment)) header_.is_viewpoint_known = true;
    if (values.empty() || values[0].front() == '#') return;
    const std::string entry(values[0] == "COLUMNS" ? "FIELDS" : values[0]);
    if (has(entry)) lines_.fail(entry + " again", "it once");
    seen_.push_back(entry);
    values.erase(values.begin());
    readEntry(entry, values);
  }

  void readEntry(const std::string& entry, const Values& values) {
    if (entry == "VERSION") {
      readVersion(one(entry, values));
    } else if (entry == "FIELDS") {
      readFields(values);
    } else if (entry == "SIZE") {
      forEachField(entry, values, [&](PcdField& field, auto text) { field.size = size(text); });
    } else if (entry == "TYPE") {
      forEachField(entry, values, [&](PcdField& field, auto text) { field.type = type(text); });
    } else if (entry == "COUNT") {
      forEachField(entry, values, [&](PcdField& field, auto text) { field.count = count(text); });
    } else if (entry == "WIDTH") {
      width_ = number(entry, one(entry, values));
    } else if (entry == "HEIGHT") {
      height_ = number(entry, one(entry, values));
    } else if (entry == "POINTS") {
      header_.points = number(entry, one(entry, values));
    } else if (entry == "VIEWPOINT") {
      readViewpoint(values);
    } else if (entry == "DATA") {
      readData(one(entry, values));
    } else {
      lines_.fail(inQuotes(entry), "a PCD header entry");
    }
  }

  std::string_view one(const std::string& entry, const Values& values) const {
    if (values.size() != 1) {
      lines_.fail(std::to_string(values.size()) + " values for " + entry, "1");
    }
    return values[0];
  }

  void readVersion(std::string_view text) const {
    const auto version = parseDouble(text);
    if (!version || !(*version > 0.0 && *version <= kNewestVersion)) {
      lines_.fail("version " + inQuotes(text), "0.7 or an older one");
    }
  }

  void readFields(const Values& names) {
    for (const auto name : names) header_.fields.push_back({std::string(name)});
    const std::vector<std::string> used{"x", "y", "z", "intensity"};
    for (std::size_t i = 0; i < used.size(); ++i) use(used[i], static_cast<PcdUse>(i));
  }

  /// Gives the field of this name, or else of this name in capitals, its use.
  void use(const std::string& name, PcdUse purpose) {
    auto& fields = header_.fields;
    const auto find = [&](const auto& is_it) {
      return std::find_if(fields.begin(), fields.end(), is_it);
    };
    auto found = find([&](const PcdField& field) { return field.name == name; });
    if (found == fields.end()) {
      found = find([&](const PcdField& field) { return inSmallLetters(field.name) == name; });
      if (found != fields.end()) note("field " + found->name + " is taken for " + name);
    }
    if (found == fields.end() && purpose == PcdUse::kIntensity) return;
    if (found == fields.end()) lines_.fail("no field " + name, "fields x, y and z");
    const auto again = [&](const PcdField& field) { return field.name == found->name; };
    if (std::find_if(found + 1, fields.end(), again) != fields.end()) {
      lines_.fail(name + " again", "it once");
    }
    found->use = purpose;
  }

  void note(const std::string& text) { header_.notes.push_back(text); }
  template <typename Set>
  void forEachField(const std::string& entry, const Values& values, const Set& set) {
    if (!has("FIELDS")) lines_.fail(entry + " without FIELDS before it", "FIELDS first");
    if (values.size() != header_.fields.size()) {
      lines_.fail(std::to_string(values.size()) + " values for " + entry,
                  std::to_string(header_.fields.size()) + ", one for each field");
    }
    for (std::size_t i = 0; i < values.size(); ++i) set(header_.fields[i], values[i]);
  }

  std::size_t size(std::string_view text) const {
    if (text == "1" || text == "2" || text == "4" || text == "8") {
      return static_cast<std::size_t>(text[0] - '0');
    }
    lines_.fail("size " + inQuotes(text), "1, 2, 4 or 8 bytes");
  }

  char type(std::string_view text) const {
    if (text != "F" && text != "I" && text != "U")
      lines_.fail("type " + inQuotes(text), "F, I or U");
    return text[0];
  }

  std::size_t count(std::string_view text) const {
    const std::size_t value = number("COUNT", text);
    if (value == 0 || value > kLargestCount) {
      lines_.fail("count " + inQuotes(text), "1 to " + std::to_string(kLargestCount));
    }
    return value;
  }

  std::size_t number(const std::string& entry, std::string_view text) const {
    const auto value = parseUnsigned(text);
    if (!value) lines_.fail(inQuotes(text) + " for " + entry, "a whole number");
    return *value;
  }

  void readViewpoint(const Values& values) {
    if (values.size() != 7) {
      lines_.fail(std::to_string(values.size()) + " values for VIEWPOINT",
                  "7: translation and quaternion w x y z");
    }
    double numbers[7];
    for (std::size_t i = 0; i < 7; ++i) {
      const auto value = parseDouble(values[i]);
      if (!value || !std::isfinite(*value)) lines_.fail(inQuotes(values[i]), "a finite number");
      numbers[i] = *value;
    }
    if (std::all_of(numbers, numbers + 7, [](double number) { return number == 0.0; })) {
      note("VIEWPOINT has only zeros: the sensor's pose is taken as unknown");
      return;
    }
    const Eigen::Quaterniond rotation(numbers[3], numbers[4], numbers[5], numbers[6]);
    if (!(std::abs(rotation.norm() - 1.0) <= kUnitTolerance)) {
      lines_.fail("a quaternion of norm " + formatShortest(rotation.norm()), "a unit quaternion");
    }
    header_.viewpoint = makeTransform({numbers[0], numbers[1], numbers[2]}, rotation);
  }

  void readData(std::string_view text) {
    if (text == "ascii") {
      header_.data = PcdData::kAscii;
    } else if (text == "binary") {
      header_.data = PcdData::kBinary;
    } else if (text == "binary_compressed") {
      header_.data = PcdData::kBinaryCompressed;
    } else {
      lines_.fail("data " + inQuotes(text), "ascii, binary or binary_compressed");
    }
  }

  void checkTogether() {
    for (const char* entry : {"FIELDS", "SIZE", "TYPE", "WIDTH", "POINTS"}) {
      if (!has(entry)) lines_.fail(std::string("no ") + entry, "it before DATA");
    }
    if (!has("HEIGHT")) {
      height_ = 1;
      note("no HEIGHT: it is taken as 1");
    }
    const bool fits = width_ == 0 || height_ <= std::numeric_limits<std::size_t>::max() / width_;
    if (!fits || width_ * height_ != header_.points) {
      lines_.fail("WIDTH " + std::to_string(width_) + ", HEIGHT " + std::to_string(height_) +
                      " and POINTS " + std::to_string(header_.points),
                  "WIDTH * HEIGHT = POINTS");
    }
    for (PcdField& field : header_.fields) checkField(field);
  }

  void checkField(PcdField& field) {
    const std::string found = "type " + std::string(1, field.type) + ", size " +
                              std::to_string(field.size) + ", count " +
                              std::to_string(field.count) + " for field " + inQuotes(field.name);
    if (field.type == 'F' && field.size < 4) lines_.fail(found, "size 4 or 8");
    const bool is_axis = field.use < PcdUse::kIntensity;
    if (is_axis && field.type != 'F') lines_.fail(found, "type F");
    if (is_axis && field.count != 1) lines_.fail(found, "count 1");
    if (field.use == PcdUse::kIntensity && field.count != 1) {
      note("intensity has COUNT " + std::to_string(field.count) + ": it is not kept");
      field.use = PcdUse::kNone;
    }
  }

  LineReader& lines_;
  PcdHeader header_;
  std::vector<std::string> seen_;
  std::size_t width_ = 0;
  std::size_t height_ = 0;
};

}  // namespace

std::size_t PcdHeader::find(PcdUse use) const {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const PcdField& field) { return field.use == use; });
  return static_cast<std::size_t>(found - fields.begin());
}

PcdHeader readPcdHeader(LineReader& lines, bool with_times) {
  PcdHeader header = HeaderReader(lines).read();
  const auto time = std::find_if(
      header.fields.begin(), header.fields.end(),
      [](const PcdField& field) { return field.count == 1 && field.timeScale() > 0.0; });
  if (with_times && time != header.fields.end()) time->use = PcdUse::kTime;
  return header;
}

}  // namespace pcrb
