#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"

namespace pcrb {

// The ETH / ASL sequences ("Challenging data sets for point cloud registration algorithms",
// Pomerleau et al., IJRR 2012): scans as text, poses of the scanner from a theodolite.

/// In which frame the points of a scan file are.
enum class EthFrame { kGlobal, kLocal };

/// What the name of a scan file says: `PointCloud12.csv` is global, `Hokuyo_12.csv` local.
struct EthScanName {
  EthFrame frame = EthFrame::kGlobal;
  std::uint64_t number = 0;
};

/// @param file_name  without folders; nothing for any other name
std::optional<EthScanName> parseEthScanName(std::string_view file_name);

/// `PointCloud12.pcd`
std::string ethCloudName(std::uint64_t number);

/// Reads the scan file of either frame: a header that names columns x, y, z in any place, case and
/// quoting, then one point a row, metres. Other columns are not read.
///
/// Blank lines and CRLF are accepted; a row with too few or too many columns is an error.
/// @param name  stands for the path in messages
/// @throws InvalidFile  with line, what was found and what was expected.
SensorScan parseEthScan(std::string_view text, const std::string& name);

/// Reads `pose_scanner_leica.csv`: T_world_scanner of each scan number (p_global = T · p_local),
/// the rotation as written.
///
/// @throws InvalidFile  for rows without 18 columns, a last row of T other than 0 0 0 1, a rotation
///                      part that is no rotation (1e-3), and scan numbers given twice.
std::map<std::uint64_t, Transform> parseLeicaPoses(std::string_view text, const std::string& name);

/// A row of the original protocol: a pair of scans and where the registration of the first to the
/// second begins.
struct EthProtocolRow {
  EthScanName reading;
  EthScanName reference;
  Transform T_reference_reading = Transform::Identity();  ///< of the files' coordinates
};

/// Reads `<sequence>_protocol.csv` of the original evaluation: columns `reading` and `reference`,
/// names of scan files, and the initial transform as `iT00` … `iT33` (or `T00` … `T33`) in any
/// order, as libpointmatcher's lists of files have them. The nearest rotation is taken.
///
/// @throws InvalidFile  with line, what was found and what was expected.
std::vector<EthProtocolRow> parseEthProtocol(std::string_view text, const std::string& name);

/// One of the eight published sequences.
struct EthSequence {
  std::string name;            ///< `apartment`
  std::string log_name;        ///< folder of the original logs: `apartment_03-Dec-2011-18_13_33`
  std::size_t scan_count = 0;  ///< clouds that the published sequence has
};

const std::vector<EthSequence>& ethSequences();

/// The published sequence that a folder or an archive is named after, or empty: its name, its log's
/// name, or its name with an ending or a date (`plain.zip`, `plain_01-Sep`, not `plain_text`).
std::string ethSequenceName(std::string_view file_name);

}  // namespace pcrb
