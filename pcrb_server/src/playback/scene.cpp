#include "pcrb_server/playback/scene.hpp"

#include <cmath>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {

namespace {

constexpr std::string_view kOrigin = "# local_origin";

Eigen::Vector3d parseOrigin(const LineReader& reader, std::string_view line) {
  std::vector<std::string_view> fields;
  splitAtBlanks(line.substr(kOrigin.size()), fields);
  Eigen::Vector3d origin;
  if (fields.size() != 3) reader.fail(inQuotes(line), "`# local_origin x y z`");
  for (int i = 0; i < 3; ++i) {
    const auto number = parseDouble(fields[static_cast<std::size_t>(i)]);
    if (!number || !std::isfinite(*number)) reader.fail(inQuotes(line), "three numbers");
    origin[i] = *number;
  }
  return origin;
}

}  // namespace

void appendScan(std::string& text, const Scene& scene) {
  if (text.empty()) {
    text = "# scans as they were played: timestamp file\n" + std::string(kOrigin);
    for (int i = 0; i < 3; ++i) {
      text += ' ';
      appendShortest(text, scene.local_origin[i]);
    }
    text += '\n';
  }
  text += formatStamp(static_cast<Stamp>(scene.stamp.toNSec())) + ' ' + scene.name + '\n';
}

ScanList readScanList(const std::string& path) {
  const FileBytes bytes(path);
  LineReader reader(bytes.text(), path);
  ScanList list;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (reader.next(line)) {
    if (line.substr(0, kOrigin.size()) == kOrigin) list.local_origin = parseOrigin(reader, line);
    if (trimmed(line).empty() || line.front() == '#') continue;
    splitAtBlanks(line, fields);
    const auto stamp = fields.size() == 2 ? parseTimestamp(fields[0]) : std::nullopt;
    if (!stamp || fields[1].find('/') != std::string_view::npos) {
      reader.fail(inQuotes(line), "`timestamp file`");
    }
    if (!list.scans.emplace(*stamp, fields[1]).second) {
      reader.fail("the timestamp " + std::string(fields[0]) + " again", "a later one");
    }
  }
  if (list.scans.empty()) throw InvalidFile(path, 0, "no scan", "rows `timestamp file`");
  return list;
}

}  // namespace pcrb
