#include "conversion/file_scans.hpp"

#include <memory>

namespace pcrb_tools {

void convertFileScans(const LogFiles& files, std::vector<FileScan> scans, Conversion& conversion) {
  std::map<std::size_t, FileScan> in_archives;
  std::vector<std::size_t> indices;
  for (auto& scan : scans) {
    const LogFile& file = files.all().at(scan.file);
    if (!conversion.wants(scan.cloud_name, file.identity + '\n' + file.name + '\n' + scan.origin)) {
      continue;
    }
    if (file.in_archive) {
      indices.push_back(scan.file);
      in_archives.emplace(scan.file, std::move(scan));
      continue;
    }
    conversion.add(scan.cloud_name, [&files, index = scan.file, make = std::move(scan.make)] {
      return make(files.read(index).text(), files.all()[index].path());
    });
  }
  files.readArchived(indices, [&](std::size_t index, std::string bytes) {
    FileScan& scan = in_archives.at(index);
    const auto shared = std::make_shared<const std::string>(std::move(bytes));
    conversion.add(scan.cloud_name, [shared, path = files.all()[index].path(),
                                     make = std::move(scan.make)] { return make(*shared, path); });
  });
}

}  // namespace pcrb_tools
