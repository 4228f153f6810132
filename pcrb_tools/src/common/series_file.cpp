#include "common/series_file.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kSeriesHeader = "folder,parameter,value,trial";

}  // namespace

std::vector<SeriesRun> readSeries(const std::string& folder) {
  const std::string path = folder + "/" + kSeriesFile;
  std::vector<SeriesRun> runs;
  if (!std::filesystem::is_regular_file(path)) return runs;
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  std::string_view header;
  if (!lines.next(header) || header != kSeriesHeader) {
    throw pcrb::InvalidFile(path, 1, pcrb::inQuotes(header),
                            std::string("the header ") + kSeriesHeader);
  }
  std::vector<std::string> fields;
  while (pcrb::nextCsvRow(lines, fields)) {
    const auto trial = fields.size() == 4 ? pcrb::parseInt(fields[3]) : std::nullopt;
    if (!trial || *trial < 1 || fields[0].find("..") != std::string::npos) {
      lines.fail("a row that is none of a series", kSeriesHeader);
    }
    runs.push_back({fields[0], fields[1], fields[2], static_cast<int>(*trial)});
  }
  return runs;
}

std::string formatSeries(const std::vector<SeriesRun>& runs) {
  std::string text = std::string(kSeriesHeader) + "\n";
  for (const SeriesRun& run : runs) {
    for (const std::string& field : {run.folder, run.parameter, run.value}) {
      pcrb::appendCsvField(text, field);
      text += ',';
    }
    text += std::to_string(run.trial) + "\n";
  }
  return text;
}

}  // namespace pcrb_tools
