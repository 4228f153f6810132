#include "fetch/fetch_tool.hpp"

#include <filesystem>
#include <map>
#include <set>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "fetch/checksums.hpp"
#include "fetch/dspace.hpp"
#include "fetch/published_files.hpp"
#include "fetch/sources.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// One run of the tool.
class Fetch {
 public:
  Fetch(const FetchOptions& options, std::ostream& out)
      : options_(options),
        out_(out),
        sources_(selectSources(options.sources, options.set, options.sequences)),
        checksums_(options.logs + "/SHA256SUMS") {}

  bool run() {
    if (options_.dry_run) return describe();
    for (const Source& source : sources_) {
      try {
        fetch(source);
        install(source);
      } catch (const pcrb::Error& error) {
        out_ << "error: " << error.what() << std::endl;
        ++failures_;
        incomplete_.insert(source.name());
      }
    }
    out_ << sources_.size() - failures_ << " of " << sources_.size() << " files are there"
         << std::endl;
    const bool is_sound = !options_.prepare || prepare();
    return failures_ == 0 && is_sound;
  }

 private:
  std::string pathOf(const Source& source) const { return options_.logs + "/" + source.file; }

  /// A file of the user's: under its name with or without folders.
  std::string findByHand(const Source& source) const {
    if (options_.from.empty()) return "";
    const fs::path from = fs::absolute(options_.from);
    for (const fs::path& name : {fs::path(source.file), fs::path(source.file).filename()}) {
      if (fs::is_regular_file(from / name)) return (from / name).string();
    }
    return "";
  }

  bool describe() const {
    std::uint64_t bytes = 0;
    std::size_t unknown = 0;
    for (const Source& source : sources_) {
      out_ << source.name() << ": ";
      const std::string by_hand = findByHand(source);
      if (fs::is_regular_file(pathOf(source))) {
        out_ << "is there: " << pathOf(source);
      } else if (!by_hand.empty()) {
        out_ << "take " << by_hand;
      } else if (!source.places.empty()) {
        const Place& place = source.places.front();
        out_ << "download " << place.describe() << " to " << pathOf(source);
        if (place.bytes) out_ << ", " << inGigabytes(*place.bytes);
        bytes += place.bytes.value_or(0);
        if (!place.bytes) ++unknown;
      } else {
        out_ << "needs you: " << source.by_hand << "; there = " << pathOf(source);
      }
      out_ << "\n";
    }
    if (bytes > 0) out_ << describeTotal(bytes) << "\n";
    if (unknown > 0) out_ << unknown << " downloads are of unknown size\n";
    out_ << sources_.size() << " files; nothing was done (--dry-run)" << std::endl;
    return true;
  }

  static std::string inGigabytes(std::uint64_t bytes) {
    return pcrb::formatFixed(static_cast<double>(bytes) / 1e9, 2) + " GB";
  }

  static std::string describeTotal(std::uint64_t bytes) {
    const double hours = static_cast<double>(bytes) / 1e7 / 3600.0;
    return "known in all: " + inGigabytes(bytes) + ", " + pcrb::formatFixed(hours, 1) +
           " h at 10 MB/s";
  }

  void fetch(const Source& source) {
    const std::string path = pathOf(source);
    Place place = source.known();
    if (!fs::is_regular_file(path)) {
      const std::string by_hand = findByHand(source);
      if (!by_hand.empty()) {
        requireContent(source, by_hand, place.bytes);
        fs::create_directories(fs::path(path).parent_path());
        fs::remove(path);  // a link to a file that is gone
        fs::create_symlink(by_hand, path);
      } else if (source.places.empty()) {
        throw pcrb::InvalidParameter(source.name() + " cannot be downloaded: " + source.by_hand +
                                     "; there = " + path + ", or a folder for --from");
      } else {
        place = downloadFromOne(source, path);
      }
    } else if (checksums_.find(source.file).empty()) {
      requireContent(source, path, place.bytes);  // put there by hand
    }
    checksums_.check(source.file, path, place.sha256);
  }

  /// Tries the places in turn; if all fail, the error names each with its cause.
  Place downloadFromOne(const Source& source, const std::string& path) const {
    std::string failures;
    for (const Place& place : source.places) {
      try {
        const bool is_in_dspace = !place.dspace_item.empty();
        const Place found =
            is_in_dspace ? findInDspace(place, path + ".dspace.json", options_.policy) : place;
        downloadFrom(found, source, path);
        return found;
      } catch (const pcrb::InvalidFile& error) {
        if (source.places.size() == 1) throw;
        failures += (failures.empty() ? "" : "; ") + std::string(error.what());
      }
    }
    throw pcrb::InvalidFile(source.file, "none of " + std::to_string(source.places.size()) +
                                             " places has it: " + failures);
  }

  void downloadFrom(const Place& place, const Source& source, const std::string& path) const {
    Progress progress(source.file, "bytes", 0);
    DownloadPolicy policy = options_.policy;
    policy.on_progress = [&](std::uint64_t done, std::uint64_t total) {
      progress.set(done, total);
    };
    download({place.url, path, place.google_drive, place.bytes,
              [&](const std::string& part) {
                requireContent(source, part, place.bytes);
                if (!place.md5.empty()) requireMd5(part, place.md5);
              }},
             policy);
    progress.finish();
  }

  void install(const Source& source) {
    const std::string folder = options_.root + "/" + source.name();
    switch (source.kind) {
      case SourceKind::kLog:
        addLog(source);
        return;
      case SourceKind::kClouds: {
        Progress progress(source.name(), "clouds", 0);
        unpackClouds(pathOf(source), checksums_.find(source.file), folder, options_.force,
                     [&] { progress.add(); });
        progress.finish();
        break;
      }
      case SourceKind::kCloud:
        copy(pathOf(source), folder + "/" + fs::path(source.file).filename().string());
        break;
      case SourceKind::kProblems:
        copy(pathOf(source), options_.root + "/" + source.data_set + "/" +
                                 fs::path(source.file).filename().string());
        with_problems_.insert(source.name());
        break;
    }
  }

  /// Converters find text files, such as poses, beside the log that they belong to.
  void addLog(const Source& source) {
    SequenceLog& log = logs_[source.name()];
    log.data_set = source.data_set;
    log.sequence = source.sequence;
    if (fs::path(source.file).extension() != ".txt") log.inputs.push_back(pathOf(source));
  }

  void copy(const std::string& from, const std::string& to) const {
    putPublishedFile(to, pcrb::FileBytes(from).text(), from, options_.force);
  }

  bool prepare() const {
    bool is_sound = true;
    for (const auto& [name, log] : logs_) {
      if (incomplete_.count(name) > 0) {
        out_ << name << ": not converted, as not all of its files are there" << std::endl;
        is_sound = false;
      } else if (!options_.convert(log)) {
        out_ << "error: " << name << ": its conversion failed" << std::endl;
        is_sound = false;
      }
    }
    if (with_problems_.empty()) return is_sound;
    return options_.check({with_problems_.begin(), with_problems_.end()}, out_) && is_sound;
  }

  const FetchOptions& options_;
  std::ostream& out_;
  std::vector<Source> sources_;
  Checksums checksums_;
  std::map<std::string, SequenceLog> logs_;  ///< by sequence
  std::set<std::string> incomplete_;         ///< sequences that lack a file
  std::set<std::string> with_problems_;      ///< sequences whose problem files are there
  std::size_t failures_ = 0;
};

}  // namespace

bool runConverter(const SequenceLog& log, const FetchOptions& options) {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  std::vector<std::string> command{(folder / (log.data_set + "_to_pcd")).string()};
  command.insert(command.end(), log.inputs.begin(), log.inputs.end());
  command.insert(command.end(), {"--root", options.root, "--sequence", log.sequence, "--threads",
                                 std::to_string(options.threads)});
  if (options.force) command.push_back("--force");
  return runChild(command) == 0;
}

bool runFetchTool(const FetchOptions& options, std::ostream& out) {
  return Fetch(options, out).run();
}

}  // namespace pcrb_tools
