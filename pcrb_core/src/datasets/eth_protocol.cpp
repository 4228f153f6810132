#include "datasets/named_columns.hpp"
#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr const char* kProtocolColumns = "columns reading, reference and iT00 to iT33";

/// `reading` also where it is written `reading_name`.
std::string meaningOf(const std::string& column) {
  const std::string small = inSmallLetters(column);
  return small == "reading_name" || small == "reference_name" ? small.substr(0, small.find('_'))
                                                              : small;
}

EthScanName scanIn(const NamedColumns& columns, const std::string& column) {
  const std::string& field = columns.field(column);
  const auto name = parseEthScanName(field.substr(field.find_last_of("/\\") + 1));
  if (!name) columns.reader().fail(inQuotes(field), "a scan, PointCloudN.csv or Hokuyo_N.csv");
  return *name;
}

}  // namespace

std::vector<EthProtocolRow> parseEthProtocol(std::string_view text, const std::string& name) {
  NamedColumns columns(text, name, meaningOf, kProtocolColumns);
  const std::string prefix = columns.hasMatrix("it") ? "it" : "t";
  if (!columns.has("reading") || !columns.has("reference") || !columns.hasMatrix(prefix)) {
    columns.reader().fail("the columns " + joined(columns.names()), kProtocolColumns);
  }
  std::vector<EthProtocolRow> rows;
  while (columns.next()) {
    rows.push_back(
        {scanIn(columns, "reading"), scanIn(columns, "reference"), columns.pose(prefix)});
    if (rows.back().reading.frame != rows.back().reference.frame) {
      columns.reader().fail("scans in two frames", "both PointCloudN.csv or both Hokuyo_N.csv");
    }
  }
  if (rows.empty()) throw InvalidFile(name, 0, "no row", "pairs of scans");
  return rows;
}

}  // namespace pcrb
