#include "datasets/pose_rows.hpp"

#include <Eigen/Core>
#include <cmath>

#include "datasets/log_rows.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  if (line.find(',') == std::string_view::npos) {
    splitAtBlanks(line, words);
    return words;
  }
  splitAt(',', line, words);
  if (words.back().empty()) words.pop_back();  // a comma at the end
  return words;
}

std::string quoted(const std::vector<std::string_view>& words, std::string_view line) {
  return inQuotes(line) + " (" + std::to_string(words.size()) + " fields)";
}

std::string adviceOnSeparators(std::string_view line) {
  const bool has_semicolons = line.find(';') != std::string_view::npos;
  return has_semicolons ? ", separated by blanks or commas, with decimal points" : "";
}

std::vector<double> requireFinite(const LineReader& reader,
                                  const std::vector<std::string_view>& words, std::size_t first,
                                  std::size_t count, const std::string& expected) {
  std::vector<double> numbers;
  for (std::size_t i = first; i != first + count; ++i) {
    const auto number = parseDouble(words[i]);
    if (!number || !std::isfinite(*number)) {
      const bool has_blank = words[i].find(' ') != std::string_view::npos;
      reader.fail(inQuotes(words[i]),
                  expected + (has_blank ? " between commas, with a decimal point" : ""));
    }
    numbers.push_back(*number);
  }
  return numbers;
}

Transform requireQuaternionPose(const LineReader& reader, const Eigen::Vector3d& translation,
                                const Eigen::Quaterniond& rotation) {
  // Four decimals leave a norm within 2e-4 of 1; anything far from it is no rotation.
  if (std::abs(rotation.norm() - 1.0) > 0.01) {
    reader.fail("a quaternion of norm " + formatShortest(rotation.norm()), "1");
  }
  return makeTransform(translation, rotation);
}

Transform requireMatrixPose(const LineReader& reader, const std::vector<double>& numbers) {
  Transform T = Transform::Identity();
  if (numbers.size() == 16) {
    T = requireLogPose4x4(reader, numbers.data());
  } else {
    using RowMajor = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
    T = requireLogPose(reader, Eigen::Map<const RowMajor>(numbers.data()));
  }
  T.linear() = nearestRotation(T.linear());
  return T;
}

Stamp unitBySize(std::string_view timestamp, std::vector<std::string>& notes) {
  struct Unit {
    double least;  ///< timestamp of 1973 in the unit
    Stamp ns;
    const char* name;
  };
  constexpr Unit kUnits[] = {
      {1e17, 1, "nanoseconds"}, {1e14, 1'000, "microseconds"}, {1e11, 1'000'000, "milliseconds"}};
  const auto value = parseDouble(timestamp);
  for (const Unit& unit : kUnits) {
    if (!value || *value < unit.least) continue;
    notes.push_back("timestamps like " + std::string(timestamp) + " were taken as " + unit.name);
    return unit.ns;
  }
  return kSecond;
}

Stamp requireStamp(const LineReader& reader, std::string_view word, Stamp unit) {
  std::string text(word);
  if (unit != kSecond) {
    // A power of ten moves the point only: exact in any unit.
    const std::size_t e = text.find_first_of("eE");
    const auto given = e == std::string::npos
                           ? std::optional<std::int64_t>(0)
                           : parseInt(text[e + 1] == '+' ? text.substr(e + 2) : text.substr(e + 1));
    if (!given) reader.fail(inQuotes(word), "a timestamp");
    const Stamp units_in_second = kSecond / unit;
    const int power =
        static_cast<int>(std::lround(std::log10(static_cast<double>(units_in_second))));
    text = text.substr(0, e) + "e" + std::to_string(*given - power);
  }
  const auto stamp = parseTimestamp(text);
  if (!stamp) reader.fail(inQuotes(word), "a timestamp");
  return *stamp;
}

}  // namespace pcrb
