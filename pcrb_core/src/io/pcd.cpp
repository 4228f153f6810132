#include "pcrb_core/io/pcd.hpp"

#include <array>
#include <initializer_list>

#include "pcd_data.hpp"
#include "pcd_header.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text_rows.hpp"

namespace pcrb {
namespace {

void appendValues(std::string& text, std::initializer_list<double> values) {
  char separator = 0;
  for (const double value : values) {
    if (separator != 0) text += separator;
    appendShortest(text, value);
    separator = ' ';
  }
  text += '\n';
}

std::string formatHeader(const DatasetCloud& cloud) {
  const std::string points = std::to_string(cloud.points.size());
  std::string text =
      "# .PCD v0.7 - Point Cloud Data file format\n"
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
      "WIDTH " +
      points + "\nHEIGHT 1\nVIEWPOINT ";
  const Eigen::Vector3d t = cloud.viewpoint.translation();
  const Eigen::Quaterniond q(cloud.viewpoint.linear());
  appendValues(text, {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()});
  return text + "POINTS " + points + "\nDATA ascii\n";
}

}  // namespace

DatasetCloud readPcd(const std::string& path, const PcdReadOptions& options) {
  const FileBytes file(path);
  return parsePcd(file.begin(), file.end(), path, options);
}

DatasetCloud parsePcd(const char* begin, const char* end, const std::string& name,
                      const PcdReadOptions& options) {
  if (options.threads < 1) {
    throw InvalidParameter("threads: found " + std::to_string(options.threads) +
                           ", expected at least 1");
  }
  LineReader lines({begin, static_cast<std::size_t>(end - begin)}, name);
  const PcdHeader header = readPcdHeader(lines);
  DatasetCloud cloud;
  cloud.viewpoint = header.viewpoint;
  switch (header.data) {
    case PcdData::kAscii:
      readPcdAscii(header, lines, options.threads, cloud);
      break;
    case PcdData::kBinary:
      readPcdBinary(header, lines, cloud);
      break;
    case PcdData::kBinaryCompressed:
      readPcdCompressed(header, lines, cloud);
      break;
  }
  return cloud;
}

void writePcd(const std::string& path, const DatasetCloud& cloud) {
  AtomicFile file(path);
  file.write(formatHeader(cloud));
  std::array<char, 3 * (kLongestNumber + 1)> row;
  for (const Eigen::Vector3d& point : cloud.points) {
    if (!point.allFinite()) {
      throw InvalidFile(path, "cannot write a point that is not finite");
    }
    char* end = row.data();
    for (int axis = 0; axis < 3; ++axis) {
      end = writeShortest(end, point[axis]);
      *end++ = axis < 2 ? ' ' : '\n';
    }
    file.write({row.data(), static_cast<std::size_t>(end - row.data())});
  }
  file.commit();
}

}  // namespace pcrb
